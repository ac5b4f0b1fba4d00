#include "app/report/locking.h"

#include <array>

#include "core/dynamics/statics/statics.h"

namespace sprung {

namespace {

constexpr double kThickness = 0.1;  // m
constexpr double kLength = 0.4;     // m
constexpr double kYoung = 1000;     // Pa; ratios of deflections do not depend on it
/// rho g L^4 / (8 E I) with I = A H^2 / 12, for a weight of 1 N/m^3, m.
constexpr double kBeamTheory = 12 * kLength * kLength * kLength * kLength / (8 * kYoung * kThickness * kThickness);

/// Tip deflections of that beam for 1 N/m^3, m, over beam theory's 0.00384 m.
constexpr std::array<DeflectionAt, 7> kReference{{{0, 0.004030315 / kBeamTheory},
                                                  {0.1, 0.004040113 / kBeamTheory},
                                                  {0.25, 0.00402089 / kBeamTheory},
                                                  {0.3, 0.004004546 / kBeamTheory},
                                                  {0.4, 0.00395431 / kBeamTheory},
                                                  {0.45, 0.00391884 / kBeamTheory},
                                                  {0.49, 0.003884205 / kBeamTheory}}};

}  // namespace

double cantilever_deflection(Model model, double poisson, int across) {
  const Material material{
      .name = "beam", .young = kYoung, .poisson = poisson, .density = 1, .damping = 0, .source = ""};
  const Body body = make_body(make_box_grid({4 * across, across, across}, kThickness / across), model, material);
  Supports supports(body.node_count());
  Points weight = Points::Zero(body.node_count(), 3);
  weight.col(1) = -body.masses;  // 1 kg/m^3 at 1 m/s^2
  for (int node = 0; node < body.node_count(); ++node) {
    if (body.grid.lattice[node].x() == 0) supports.fix(node);
  }
  const auto system = make_direct_solver();
  const Eigen::VectorXd moved = solve_linear(body, supports, weight, *system);
  double corners = 0;
  for (const int y : {0, across}) {
    for (const int z : {0, across}) {
      const Eigen::Vector3i corner(4 * across, y, z);
      for (int node = 0; node < body.node_count(); ++node) {
        if (body.grid.lattice[node] == corner) corners -= moved[3 * node + 1];
      }
    }
  }
  return corners / 4 / kBeamTheory;
}

std::span<const DeflectionAt> reference_deflections() { return kReference; }

}  // namespace sprung
