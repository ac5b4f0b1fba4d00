#include "core/body/solid_tiles.h"

#include <algorithm>

#include "core/body/brick_model.h"
#include "core/law/solid/solid_brick.h"

namespace sprung {
namespace {

/// The numbers of a cut brick, one for each SolidNumber.
class CutBrick {
 public:
  CutBrick(double share, const BodySolid& solid) {
    numbers_[kSolidShare] = share;
    const auto& [moments, curved] = solid;
    Vec3::Map(&numbers_[kSolidCentroid]) = moments.centroid;
    auto entry = numbers_.begin() + kSolidStiffness;
    for (int row = 0; row < StrainDifferences::kGradients; ++row) {
      for (int column = row; column < StrainDifferences::kGradients; ++column)
        *entry++ = curved->stiffness(row, column);
    }
    Vec3::Map(&numbers_[kSolidWarping]) = warping_stiffness(moments);
    auto tangent = numbers_.begin() + kSolidTangent;
    for (const double rate : curved->tangent.reshaped<Eigen::RowMajor>()) *tangent++ = rate;
  }

  [[nodiscard]] double operator[](std::size_t number) const { return numbers_[number]; }

 private:
  std::array<double, kSolidNumbers> numbers_{};
};

double share_of(const Body& body, int brick) { return region_factor(body, brick) * body.grid.fill[brick]; }

bool is_whole(const Body& body, int brick) { return brick < 0 || body.solids[brick].moments.is_whole(); }

std::vector<double> numbers_of(const Body& body, const std::array<int, kPackPadding>& bricks) {
  const bool all_whole = std::all_of(bricks.begin(), bricks.end(), [&](int brick) { return is_whole(body, brick); });
  std::vector<double> pack((all_whole ? 1 : std::size_t{kSolidNumbers}) * kPackPadding, 0);
  for (std::size_t lane = 0; lane < bricks.size(); ++lane) {
    const int brick = bricks[lane];
    if (all_whole) {
      if (brick >= 0) pack[lane] = share_of(body, brick);
      continue;
    }
    pack[kSolidIsCut * kPackPadding + lane] = -1;
    if (brick < 0) continue;
    const CutBrick numbers(share_of(body, brick), body.solids[brick]);
    for (std::size_t number = kSolidShare; number < kSolidNumbers; ++number) {
      pack[number * kPackPadding + lane] = numbers[number];
    }
  }
  return pack;
}

/// Whether a whole brick is followed by another along x.
bool goes_on(const Body& body, int brick) {
  const BrickGrid& grid = body.grid;
  return brick + 1 < grid.brick_count() && is_whole(body, brick + 1) &&
         grid.cells[brick + 1] == grid.cells[brick] + Eigen::Vector3i::UnitX();
}

constexpr int kLongRow = 8;  // whole bricks along x, from which on a tile is faster than gathering them

/// Bricks, ascending: of tiles, and other whole and cut ones.
struct Division {
  std::vector<int> tiled;
  std::vector<int> whole;
  std::vector<int> cut;
};

Division divide(const Body& body) {
  Division division;
  for (int brick = 0; brick < body.grid.brick_count(); ++brick) {
    if (!is_whole(body, brick)) {
      division.cut.push_back(brick);
      continue;
    }
    const int first = brick;
    while (goes_on(body, brick)) ++brick;
    std::vector<int>& to = brick + 1 - first < kLongRow ? division.whole : division.tiled;
    for (int one = first; one <= brick; ++one) to.push_back(one);
  }
  return division;
}

}  // namespace

SolidLaw solid_law(const Material& material, double h) {
  const double volume = h * h * h;
  const double poisson = material.poisson;
  const double bending = 1 / (12 * (1 - poisson * poisson));
  return {.per_size = 1 / h,
          .young = material.young * volume,
          .shear = material.shear_modulus() * volume,
          .lambda = material.lame_lambda() * volume,
          .bending = bending,
          .across = poisson * bending,
          .twist = material.shear_modulus() / material.young / 12,
          .warping = warping_stiffness({})[0],
          .psi = hyperelastic_terms(material, volume)};
}

BrickTiles make_solid_tiles(const Body& body) {
  const auto numbers = [&](const std::array<int, kPackPadding>& bricks) { return numbers_of(body, bricks); };
  const Division division = divide(body);
  BrickTiles tiles = make_brick_tiles(body.grid, division.tiled, numbers, {});
  tiles.gathered = gather_bricks(body.grid, {division.whole, division.cut}, numbers);
  return tiles;
}

void solid_matrices(const Body& body, int first, double* matrices, const SpringKernel& kernel) {
  std::array<int, kPackPadding> bricks{};
  std::array<double, 24 * kPackPadding> corners{};
  for (int lane = 0; lane < kPackPadding; ++lane) {
    const bool is_there = first + lane < body.grid.brick_count();
    bricks[lane] = is_there ? first + lane : -1;
    const BrickVector x = at_corners(body, is_there ? first + lane : first, body.positions);
    for (int i = 0; i < 24; ++i) corners[i * kPackPadding + lane] = x[i];
  }
  kernel.solid_matrices(solid_law(body.material, body.grid.brick_size), numbers_of(body, bricks).data(), corners.data(),
                        matrices);
}

}  // namespace sprung
