#include "app/fill_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/units.h"
#include "core/bricks/voxelize.h"
#include "core/text.h"

namespace sprung {
namespace {

/// The bricks' volume may differ from the mesh's by this share before it is worth a warning.
constexpr double kVolumeError = 0.02;
constexpr double kResolvedShell = 2;  // bricks: a thicker shell is held by them as it is

double volume_error(const BrickGrid& grid, const Solid& solid) { return std::abs(grid.volume() / solid.volume - 1); }

/// Half of the brick size, or a quarter, ... : the first that holds the solid's volume; none down to a 64th.
std::optional<double> brick_size_for(const Solid& solid, double brick_size) {
  for (int halving = 0; halving < 6; ++halving) {
    brick_size /= 2;
    if (volume_error(voxelize(solid, brick_size), solid) <= kVolumeError) return brick_size;
  }
  return std::nullopt;
}

}  // namespace

void FillReport::add(const PieceReport& pieces, int slivers) {
  pieces_.divided += pieces.divided;
  pieces_.dropped += pieces.dropped;
  pieces_.dropped_volume += pieces.dropped_volume;
  pieces_.floating += pieces.floating;
  slivers_ += slivers;
}

void FillReport::add(const Embedding& skin) {
  outside_ += skin.outside;
  furthest_outside_ = std::max(furthest_outside_, skin.furthest);
}

void FillReport::add_volume(const BrickGrid& grid, const Solid& solid) {
  // Of a shell as thick as that the bricks know better: where it meets itself, area times thickness counts twice.
  if (solid.thickness > kResolvedShell * body_.brick_size) return;
  if (volume_error(grid, solid) <= kVolumeError) return;
  ++wrong_volumes_;
  if (wrong_volumes_ > 1) return;
  const std::optional<double> better = brick_size_for(solid, body_.brick_size);
  volume_warning_ =
      fmt::format("bricks of {} are too coarse: they hold {:.4g} kg where the mesh holds {:.4g} kg; {}",
                  readable(body_.brick_size, Dimension::kLength), grid.volume() * density_, solid.volume * density_,
                  better ? fmt::format("for the mass bricks of {} would do", readable(*better, Dimension::kLength))
                         : "use much smaller ones");
}

void FillReport::tell(const Console& console) const {
  if (outside_ > 0) {
    console.note(fmt::format("{}: {} outside every brick, {:.2g} bricks away at most, on the nearest one", body_.name,
                             count_of(outside_, "skin vertex rides", "skin vertices ride"), furthest_outside_));
  }
  if (slivers_ > 0) {
    console.detail(
        fmt::format("{}: {} given to fuller neighbours", body_.name, count_of(slivers_, "nearly empty brick")));
  }
  tell_pieces(console);
  if (wrong_volumes_ == 0) return;
  const int more = wrong_volumes_ - 1;
  console.warn(fmt::format("{}: {}{}", body_.name, volume_warning_,
                           more > 0 ? fmt::format("; so are those of {} more", count_of(more, "solid")) : ""));
}

void FillReport::tell_pieces(const Console& console) const {
  if (pieces_.divided > 0) {
    console.detail(fmt::format("{}: {} more than one piece of solid, and a brick for each", body_.name,
                               count_of(pieces_.divided, "cell holds", "cells hold")));
  }
  if (pieces_.dropped > 0) {
    console.warn(fmt::format("{}: dropped {} of floating specks, {:.2g} kg together", body_.name,
                             count_of(pieces_.dropped, "brick"), pieces_.dropped_volume * density_));
  }
  if (pieces_.floating > 0) {
    console.warn(fmt::format("{}: {} by parts too thin for bricks of {}; smaller bricks would hold them", body_.name,
                             count_of(pieces_.floating, "piece hangs", "pieces hang"),
                             readable(body_.brick_size, Dimension::kLength)));
  }
}

}  // namespace sprung
