#include "core/dynamics/statics/free_motion.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/body/brick_hessian.h"
#include "core/dynamics/linear/stiffness.h"
#include "core/error.h"
#include "core/text.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr int kIterations = 8;
/// A motion resisted by less than this share of the largest stiffness of a brick counts as free: as little as the
/// system that finds it adds.
constexpr double kNoResistance = 1e-11;
constexpr double kMovesAlong = 0.3;  // of the largest displacement

/// The softest motion, 3 m, of length 1, by inverse iteration; empty if the solver fails.
Eigen::VectorXd softest_motion(const Body& body, const Supports& supports, LinearSolver& system) {
  const StepTerms terms = support_terms(supports);
  if (!system.linearize(body, supports, true, terms)) return {};
  Eigen::VectorXd motion(3 * body.node_count());
  for (Eigen::Index i = 0; i < motion.size(); ++i) motion[i] = supports.fixed[i] ? 0 : std::sin(1.0 + 7 * double(i));
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    motion = system.solve(motion.normalized(), 1e-4);
    if (motion.size() == 0 || !motion.allFinite()) return {};
  }
  return motion.normalized();
}

std::string place_text(const Vec3& position) {
  const auto coordinate = [](double value) { return readable(std::round(value * 1e4) / 1e4, Dimension::kLength); };
  return fmt::format("({}, {}, {})", coordinate(position.x()), coordinate(position.y()), coordinate(position.z()));
}

std::string direction_text(Vec3 direction) {
  direction.normalize();
  Eigen::Index longest = 0;
  direction.cwiseAbs().maxCoeff(&longest);
  if (direction[longest] < 0) direction = -direction;
  direction = (100 * direction).array().round() / 100 + 0.0;
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", direction.x(), direction.y(), direction.z());
}

/// "12 nodes near (1 cm, 2 cm, 0 m) can turn about an axis along (0.00, 1.00, 0.00)".
std::string description_of(const Body& body, const Eigen::VectorXd& motion) {
  const auto moved = [&](int node) -> Vec3 { return motion.segment<3>(Eigen::Index{3} * node); };
  double largest = 0;
  for (int node = 0; node < body.node_count(); ++node) largest = std::max(largest, moved(node).norm());
  std::vector<int> nodes;
  for (int node = 0; node < body.node_count(); ++node) {
    if (moved(node).norm() > kMovesAlong * largest) nodes.push_back(node);
  }
  Vec3 middle = Vec3::Zero();
  Vec3 slide = Vec3::Zero();
  for (const int node : nodes) {
    middle += body.positions.row(node).transpose() / double(nodes.size());
    slide += moved(node) / double(nodes.size());
  }
  Mat3 inertia = Mat3::Zero();
  Vec3 moment = Vec3::Zero();
  for (const int node : nodes) {
    const Vec3 arm = body.positions.row(node).transpose() - middle;
    inertia += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
    moment += arm.cross(moved(node));
  }
  const Vec3 turn = inertia.completeOrthogonalDecomposition().solve(moment);
  const double radius = std::sqrt(inertia.trace() / 2 / double(nodes.size()));
  const std::string where = fmt::format("{} near {}", count_of(long(nodes.size()), "node"), place_text(middle));
  if (turn.norm() * radius > 0.2 * slide.norm()) {
    return fmt::format("{} can turn about an axis along {}", where, direction_text(turn));
  }
  return fmt::format("{} can slide along {}", where, direction_text(slide));
}

}  // namespace

void throw_if_free(const Body& body, const Supports& supports, const std::string& doing) {
  const std::unique_ptr<LinearSolver> system = make_robust_solver(body);
  const Eigen::VectorXd motion = softest_motion(body, supports, *system);
  if (motion.size() == 0) return;
  ProductWorkspace workspace;
  Eigen::VectorXd product;
  multiply_stiffness(body, motion, workspace, product);
  for (const SpringSupport& support : supports.springs) add_point_product(body, support.spring, motion, product);
  const double stiffness = motion.dot(product);
  if (stiffness > kNoResistance * largest_brick_stiffness(body)) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: the supports leave the body free to move; {}. Support more of it, or "
                          "use more bricks where its parts are joined by less than a brick",
                          doing, description_of(body, motion)));
}

}  // namespace sprung
