#include "core/contact/contacts.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sprung {
namespace {

constexpr double kRecoverySteps = 20;
constexpr double kMaxSteps = 24;  // compressed bodies can be fast within a few steps

}  // namespace

RigidMotion rigid_motion_of(const Group& group) {
  Vec3 middle = Vec3::Zero();
  Vec3 momentum = Vec3::Zero();
  double mass = 0;
  for (const SoftBody* body : group) {
    middle += body->positions.transpose() * body->masses;
    momentum += body->velocities.transpose() * body->masses;
    mass += body->masses.sum();
  }
  middle /= mass;
  Mat3 inertia = Mat3::Zero();
  Vec3 angular_momentum = Vec3::Zero();
  for (const SoftBody* body : group) {
    for (int node = 0; node < body->node_count(); ++node) {
      const Vec3 arm = body->positions.row(node).transpose() - middle;
      inertia += body->masses[node] * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
      angular_momentum += body->masses[node] * arm.cross(Vec3(body->velocities.row(node)));
    }
  }
  const Vec3 spin = inertia.ldlt().solve(angular_momentum);
  return {.shift = momentum / mass - spin.cross(middle), .spin = spin};
}

void ContactList::append(const ContactList& other) {
  const std::size_t start = shares.size();
  shares.insert(shares.end(), other.shares.begin(), other.shares.end());
  for (Contact contact : other.list) {
    contact.first += start;
    contact.last += start;
    list.push_back(contact);
  }
}

void add_shares(const Group& group, std::size_t body, int brick, const CornerWeights& weights, ContactList& contacts) {
  const auto& nodes = group[body]->grid.nodes[brick];
  for (int i = 0; i < 8; ++i) {
    if (weights[i] == 0) continue;
    contacts.shares.push_back({int(body), nodes[i], weights[i]});
  }
}

Vec3 within_friction_cone(const Vec3& impulse, const Vec3& normal, double friction) {
  const double normal_force = impulse.dot(normal);
  if (!(normal_force > 0)) return Vec3::Zero();
  const Vec3 sideways = impulse - normal_force * normal;
  const double length = sideways.norm();
  const double most = friction * normal_force;
  return length > most ? Vec3(normal_force * normal + most / length * sideways) : impulse;
}

double min_speed(double gap, double gravity, double dt) {
  if (gap >= 0) return -gap / dt;
  return std::min(-gap / (kRecoverySteps * dt), std::sqrt(-2 * std::max(gravity, kMinGravity) * gap));
}

int steps_until_update(double margin, double speed, double gravity, double dt) {
  const double steps = std::min(margin / (4 * speed * dt), std::sqrt(margin / gravity) / dt);
  return steps >= 1 ? int(std::min(steps, kMaxSteps)) : 1;
}

}  // namespace sprung
