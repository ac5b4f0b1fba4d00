#include "core/bricks/brick_size.h"

#include <cmath>

namespace sprung {
namespace {

constexpr double kCounts = 0.05;        // of the surface: thinner parts do not count
constexpr double kBricksAcross = 2;     // the thinnest part that counts
constexpr double kFewestAlong = 12;     // the longest side
constexpr double kSurfaceBricks = 0.6;  // a square of one brick's side adds so many bricks beside the volume's

}  // namespace

BrickChoice choose_brick_size(const std::vector<Solid>& solids, const std::vector<std::vector<WallSample>>& walls,
                              double longest, double budget) {
  std::vector<WallSample> all;
  for (const std::vector<WallSample>& some : walls) all.insert(all.end(), some.begin(), some.end());
  double volume = 0;
  double area = 0;
  for (const Solid& solid : solids) {
    volume += solid.volume;
    area += surface_area(solid);
  }
  BrickChoice choice;
  choice.thickness = thickness_quantile(all, kCounts);
  choice.size = choice.thickness / kBricksAcross;
  if (all.empty() || choice.size > longest / kFewestAlong) {
    choice.size = longest / kFewestAlong;
    choice.reason = BrickChoice::Reason::kShape;
  }
  const auto bricks = [&](double size) { return (volume / size + kSurfaceBricks * area) / (size * size); };
  if (bricks(choice.size) > budget) {
    choice.reason = BrickChoice::Reason::kBudget;
    while (bricks(choice.size) > budget) choice.size *= 1.01;
  }
  choice.across = choice.thickness / choice.size;
  return choice;
}

}  // namespace sprung
