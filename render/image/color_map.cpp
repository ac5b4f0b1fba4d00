#include "render/image/color_map.h"

#include <algorithm>
#include <array>
#include <span>

namespace sprung {
namespace {

using Stops = std::span<const std::array<float, 3>>;

constexpr std::array<std::array<float, 3>, 9> kViridis{{{0.267F, 0.005F, 0.329F},
                                                        {0.279F, 0.175F, 0.483F},
                                                        {0.230F, 0.322F, 0.546F},
                                                        {0.173F, 0.449F, 0.558F},
                                                        {0.128F, 0.567F, 0.551F},
                                                        {0.158F, 0.684F, 0.502F},
                                                        {0.369F, 0.789F, 0.383F},
                                                        {0.678F, 0.864F, 0.190F},
                                                        {0.993F, 0.906F, 0.144F}}};

constexpr std::array<std::array<float, 3>, 9> kCividis{{{0.000F, 0.135F, 0.305F},
                                                        {0.103F, 0.220F, 0.436F},
                                                        {0.264F, 0.308F, 0.423F},
                                                        {0.381F, 0.395F, 0.436F},
                                                        {0.489F, 0.485F, 0.471F},
                                                        {0.609F, 0.580F, 0.464F},
                                                        {0.736F, 0.681F, 0.424F},
                                                        {0.871F, 0.790F, 0.343F},
                                                        {0.996F, 0.909F, 0.218F}}};

constexpr std::array<std::array<float, 3>, 17> kCoolwarm{{{0.230F, 0.299F, 0.754F},
                                                          {0.304F, 0.407F, 0.845F},
                                                          {0.383F, 0.509F, 0.917F},
                                                          {0.467F, 0.605F, 0.968F},
                                                          {0.553F, 0.689F, 0.995F},
                                                          {0.639F, 0.760F, 0.998F},
                                                          {0.722F, 0.814F, 0.977F},
                                                          {0.799F, 0.850F, 0.932F},
                                                          {0.865F, 0.865F, 0.865F},
                                                          {0.924F, 0.827F, 0.775F},
                                                          {0.959F, 0.770F, 0.678F},
                                                          {0.970F, 0.694F, 0.579F},
                                                          {0.958F, 0.603F, 0.482F},
                                                          {0.924F, 0.497F, 0.388F},
                                                          {0.869F, 0.378F, 0.300F},
                                                          {0.796F, 0.241F, 0.221F},
                                                          {0.706F, 0.016F, 0.150F}}};

constexpr std::array<std::array<float, 3>, 3> kEmber{
    {{0.130F, 0.520F, 0.900F}, {0.600F, 0.605F, 0.615F}, {0.950F, 0.380F, 0.130F}}};

Eigen::Vector3f interpolate(Stops stops, double coordinate) {
  const double at = coordinate * double(stops.size() - 1);
  const auto from = std::min(std::size_t(at), stops.size() - 2);
  const auto part = float(at - double(from));
  return (1 - part) * Eigen::Map<const Eigen::Vector3f>(stops[from].data()) +
         part * Eigen::Map<const Eigen::Vector3f>(stops[from + 1].data());
}

constexpr double kTurboLow = 0.07;  // the part of it that is used
constexpr double kTurboHigh = 0.97;

/// Rows: red, green, blue; columns: powers of the coordinate.
Eigen::Vector3f turbo(double coordinate) {
  Eigen::Matrix<double, 3, 6> factors;
  factors << 0.13572138, 4.61539260, -42.66032258, 132.13108234, -152.94239396, 59.28637943,  //
      0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604,               //
      0.10667330, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973;
  Eigen::Matrix<double, 6, 1> powers;
  powers[0] = 1;
  for (int i = 1; i < 6; ++i) powers[i] = powers[i - 1] * coordinate;
  return (factors * powers).cwiseMax(0.0).cwiseMin(1.0).cast<float>();
}

}  // namespace

Eigen::Vector3f map_color(ColorMap map, double coordinate) {
  const double clamped = std::clamp(coordinate, 0.0, 1.0);
  switch (map) {
    case ColorMap::kViridis:
      return interpolate(kViridis, clamped);
    case ColorMap::kCividis:
      return interpolate(kCividis, clamped);
    case ColorMap::kCoolwarm:
      return interpolate(kCoolwarm, clamped);
    case ColorMap::kEmber:
      return interpolate(kEmber, clamped);
    case ColorMap::kTurbo:
      break;
  }
  return turbo(kTurboLow + clamped * (kTurboHigh - kTurboLow));
}

}  // namespace sprung
