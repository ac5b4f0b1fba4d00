#include "core/simulation/fill_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/bricks/voxelize.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

/// The relative error of the bricks' volume from which on there is a warning.
constexpr double kVolumeError = 0.02;
constexpr double kFarOutside = 0.1;   // bricks
constexpr double kResolvedShell = 2;  // bricks: thicker shells are resolved

double volume_error(const BrickGrid& grid, const Solid& solid) { return std::abs(grid.volume() / solid.volume - 1); }

/// The first of half of the brick size, a quarter, ... that represents the solid's volume; none down to a 64th.
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
  // For thick shells the bricks are more accurate: area times thickness counts overlaps twice.
  if (solid.thickness > kResolvedShell * body_.brick_size) return;
  if (volume_error(grid, solid) <= kVolumeError) return;
  ++wrong_volumes_;
  if (wrong_volumes_ > 1) return;
  const std::optional<double> better = brick_size_for(solid, body_.brick_size);
  volume_warning_ =
      fmt::format("bricks of {} are too coarse: they hold {:.4g} kg, the mesh {:.4g} kg; {}",
                  readable(body_.brick_size, Dimension::kLength), grid.volume() * density_, solid.volume * density_,
                  better ? fmt::format("bricks of {} would suffice for the mass", readable(*better, Dimension::kLength))
                         : "use much smaller ones");
}

void FillReport::tell(const Observer& observer) const {
  if (furthest_outside_ > kFarOutside) {
    observer.note(
        fmt::format("{}: {} outside all bricks, by up to {:.2g} bricks, and {} the motion of the nearest "
                    "brick; smaller bricks hold them better",
                    body_.name, count_of(outside_, "skin vertex is", "skin vertices are"), furthest_outside_,
                    outside_ == 1 ? "follows" : "follow"));
  }
  if (slivers_ > 0) {
    observer.detail(
        fmt::format("{}: {} merged into fuller neighbours", body_.name, count_of(slivers_, "nearly empty brick")));
  }
  tell_pieces(observer);
  if (wrong_volumes_ == 0) return;
  const int more = wrong_volumes_ - 1;
  observer.warn(fmt::format("{}: {}{}", body_.name, volume_warning_,
                            more > 0 ? fmt::format("; so are those of {} more", count_of(more, "solid")) : ""));
}

void FillReport::tell_pieces(const Observer& observer) const {
  if (pieces_.divided > 0) {
    observer.detail(fmt::format("{}: {} several pieces of solid, each in a brick of its own", body_.name,
                                count_of(pieces_.divided, "cell contains", "cells contain")));
  }
  if (pieces_.dropped > 0) {
    observer.warn(fmt::format("{}: dropped {} of floating specks, {:.2g} kg together", body_.name,
                              count_of(pieces_.dropped, "brick"), pieces_.dropped_volume * density_));
  }
  if (pieces_.floating > 0) {
    observer.warn(fmt::format("{}: {} connected by parts too thin for bricks of {}; use smaller bricks", body_.name,
                              count_of(pieces_.floating, "piece is", "pieces are"),
                              readable(body_.brick_size, Dimension::kLength)));
  }
}

}  // namespace sprung
