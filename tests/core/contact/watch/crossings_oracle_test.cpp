#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/scene/scene_file.h"
#include "core/contact/watch/crossing_pairs.h"
#include "core/simulation/crossing_watch.h"
#include "core/simulation/motion.h"
#include "core/simulation/shapes.h"
#include "core/simulation/simulate.h"

/// Crossings, checked against all pairs of triangles in exact arithmetic.
namespace sprung {
namespace {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactTriangle = ExactKernel::Triangle_3;

/// A triangle with its box and, in its own skin, its corners at rest.
struct Facet {
  AlignedBox box;
  std::array<Vec3, 3> corners;
  std::array<Vec3, 3> at_rest;
};

std::vector<Facet> facets_of(const Skin& skin, const Points& positions) {
  std::vector<Facet> facets;
  for (const auto& triangle : skin.triangles.rowwise()) {
    Facet facet;
    for (int corner = 0; corner < 3; ++corner) {
      facet.corners[corner] = positions.row(triangle[corner]);
      facet.at_rest[corner] = skin.positions.row(triangle[corner]);
      facet.box.extend(facet.corners[corner]);
    }
    facets.push_back(facet);
  }
  return facets;
}

bool share_a_corner(const Facet& a, const Facet& b) {
  for (const Vec3& corner : a.at_rest) {
    if (std::find(b.at_rest.begin(), b.at_rest.end(), corner) != b.at_rest.end()) return true;
  }
  return false;
}

bool intersect(const Facet& a, const Facet& b) {
  if (!a.box.intersects(b.box)) return false;
  const auto exact = [](const Facet& facet) {
    const auto point = [&](int i) {
      return ExactKernel::Point_3(facet.corners[i].x(), facet.corners[i].y(), facet.corners[i].z());
    };
    return ExactTriangle(point(0), point(1), point(2));
  };
  return CGAL::do_intersect(exact(a), exact(b));
}

long count_between(const std::vector<Facet>& a, const std::vector<Facet>& b) {
  long count = 0;
  for (const Facet& one : a) {
    for (const Facet& other : b) count += intersect(one, other) ? 1 : 0;
  }
  return count;
}

long count_within(const std::vector<Facet>& all) {
  long count = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (!share_a_corner(all[i], all[j]) && intersect(all[i], all[j])) ++count;
    }
  }
  return count;
}

/// The crossings of a simulation in its present state, except those of planes.
long count_all(const Simulation& simulation, bool bodies_touch, double time) {
  std::vector<std::vector<Facet>> facets;
  for (const SoftBody& body : simulation.world.bodies) {
    facets.push_back(facets_of(body.drawn.skin, body.skin_positions(body.positions)));
  }
  const std::size_t bodies = facets.size();
  for (const StageObstacle& obstacle : simulation.obstacles) {
    const bool is_plane = std::holds_alternative<SolidHalfSpace>(obstacle.shape);
    facets.push_back(is_plane ? std::vector<Facet>{} : facets_of(obstacle.skin, skin_positions(obstacle, time)));
  }
  long count = 0;
  for (std::size_t i = 0; i < bodies; ++i) {
    count += count_within(facets[i]);
    for (std::size_t j = i + 1; j < facets.size(); ++j) {
      if (j >= bodies || bodies_touch) count += count_between(facets[i], facets[j]);
    }
  }
  return count;
}

struct Stage {
  const char* name;
  const char* scene;
  double amplitude;  // of random waves through the bodies, over their size
};

const Stage kStages[] = {
    {"two balls", R"([[body]]
sphere = { radius = "4 cm" }
bricks = 6
[[body]]
sphere = { radius = "3 cm" }
position = [0.03, 0.079, 0]
bricks = 6
)",
     0.02},
    {"chain", R"([[body]]
torus = { radius = "2 cm", tube = "5 mm" }
bricks = 10
[[body]]
torus = { radius = "2 cm", tube = "5 mm" }
position = [0.027, -0.02, 0]
rotation = [90, 0, 0]
bricks = 10
)",
     0.1},
    {"mat in itself", R"([[body]]
box = ["24 cm", "1 cm", "8 cm"]
brick_size = "1 cm"
)",
     0.5},
    {"boxes face to face", R"([[body]]
box = ["4 cm", "4 cm", "4 cm"]
brick_size = "1 cm"
copies = { count = [1, 3, 1], spacing = [0, "4 cm", 0] }
)",
     0.003},
    {"bodies that do not touch", R"([contact]
bodies = false
[[body]]
box = ["4 cm", "4 cm", "4 cm"]
brick_size = "1 cm"
copies = { count = [1, 3, 1], spacing = [0, "3 cm", 0] }
)",
     0.3},
    {"ball and cylinder", R"([[body]]
sphere = { radius = "4 cm" }
bricks = 6
[[obstacle]]
cylinder = { radius = "1 cm", height = "10 cm" }
position = [0, -0.04, 0]
keyframes = [ { t = 0 }, { t = 1, translate = [0, 0.06, 0] } ]
)",
     0.02},
    {"torus and box", R"([[body]]
torus = { radius = "3 cm", tube = "1 cm" }
bricks = 12
[[obstacle]]
box = ["4 cm", "1 cm", "4 cm"]
position = [0, -0.01, 0]
keyframes = [ { t = 0 }, { t = 1, rotate = [0, 90, 20] } ]
)",
     0.2},
    {"ring shrunk to nothing", R"([[body]]
torus = { radius = "3 cm", tube = "1 cm" }
bricks = 12
)",
     2},
};

/// Moves the nodes of all bodies by smooth random waves.
void wave(World& world, double amplitude, std::mt19937& random) {
  std::normal_distribution<double> normal;
  for (SoftBody& body : world.bodies) {
    const double size = bounding_box(body.rest_positions).sizes().maxCoeff();
    Points moved = body.rest_positions;
    for (int i = 0; i < 4; ++i) {
      const Vec3 along(normal(random), normal(random), normal(random));
      const Vec3 shift(normal(random), normal(random), normal(random));
      const double phase = normal(random);
      for (int node = 0; node < moved.rows(); ++node) {
        const double angle = 5 / size * along.dot(body.rest_positions.row(node).transpose()) + phase;
        moved.row(node) += amplitude * size / 4 * std::sin(angle) * shift.transpose();
      }
    }
    body.positions = moved;
  }
}

TEST(CrossingsOracle, WatchFindsWhatAllPairsFind) {
  std::mt19937 random(40);
  std::uniform_real_distribution<double> uniform(0, 1);
  long frames = 0;
  long crossing = 0;
  for (const Stage& stage : kStages) {
    const Film scene = parse_scene(stage.scene, "/scene.toml", SceneFiles::kAnywhere);
    const Observer silent;
    Simulation simulation = prepare_simulation(scene, silent);
    CrossingWatch watch(scene, simulation);
    for (int frame = 0; frame < 7; ++frame, ++frames) {
      wave(simulation.world, stage.amplitude * uniform(random), random);
      const double time = uniform(random);
      std::vector<const Points*> nodes;
      for (const SoftBody& body : simulation.world.bodies) nodes.push_back(&body.positions);
      const Crossings found = watch.look(nodes, frame, time);
      const long expected = count_all(simulation, scene.contact.bodies, time);
      ASSERT_EQ(found.pairs + found.pairs_at_start, expected) << stage.name << ", frame " << frame;
      if (expected > 0) ++crossing;
    }
  }
  EXPECT_EQ(frames, 56);
  EXPECT_GT(crossing, 20);
  EXPECT_LT(crossing, 50);
}

}  // namespace
}  // namespace sprung
