#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "core/contact/pairs/feature_pairs.h"
#include "core/contact/pairs/shape_pairs.h"
#include "core/contact/search/group.h"

namespace sprung {

/// All features of a group's bodies, and of the obstacles about them, that may meet in a step: points and triangles,
/// edges, and points and obstacles without edges. Predicts some steps ahead, and again if nodes leave the predicted
/// path. Deterministic: the results depend on the bodies' motion since construction.
class NearFeatures {
 public:
  using Trees = std::vector<std::unique_ptr<SurfaceTree>>;
  struct Surfaces {
    std::vector<std::unique_ptr<SoftBody>> obstacles;  // those with edges
    Trees trees;                                       // of the bodies, then of these
    Trees outlines;                                    // of the bodies, see outline_of(), if others have none
  };
  /// The bodies must outlive it. `glue` by rows of the group; `surfaces`: of the same bodies and obstacles, from an
  /// earlier instance; or none. Results do not depend on them.
  NearFeatures(const Group& group, const World& world, const std::vector<GluedPoint>& glue = {},
               Surfaces surfaces = {});
  [[nodiscard]] Surfaces take_surfaces() && { return std::move(surfaces_); }
  /// Returns whether bodies and obstacles still have the same surfaces.
  [[nodiscard]] bool is_of_surfaces(const World& world) const;

  /// Measures the pairs that may meet in a step of dt, as predicted in the last one. `elapsed`: since the obstacles had
  /// the world's poses, s.
  void begin_step(const World& world, double elapsed, double dt);
  /// Once velocities are those of the step: finds and measures all pairs that may meet, if something deviates from the
  /// prediction. Returns whether it did.
  [[nodiscard]] bool recheck(const World& world, double dt);
  void end_step(double dt) { since_look_ += dt; }

  /// As they were when last measured.
  [[nodiscard]] const std::vector<AwakePair>& awake() const { return awake_; }
  /// Returns whether a corner of one of these is inside the other body: they overlap there.
  [[nodiscard]] bool is_entangled(std::size_t row);
  /// m, the smallest brick.
  [[nodiscard]] double brick() const { return brick_; }
  /// Those of the group, then the surfaces of obstacles, which nothing pushes.
  [[nodiscard]] SoftBody& body(std::size_t row) const;
  [[nodiscard]] std::size_t group_size() const { return group_.size(); }

  /// The velocity of a pair's corner, m/s: as it was after begin_step() or refresh_velocities(), or now.
  [[nodiscard]] Vec3 known_velocity(const AwakePair& pair, int corner);
  [[nodiscard]] Vec3 velocity(const AwakePair& pair, int corner) const;
  void refresh_velocities();
  /// The position of a pair's corner, m.
  [[nodiscard]] const Vec3& position(const AwakePair& pair, int corner) const {
    return tree_of(pair, corner).position_of(pair.pair.corners[corner]);
  }
  /// A pair's corner, of a surface.
  [[nodiscard]] const ContactPoint& point_of(const AwakePair& pair, int corner) const {
    return tree_of(pair, corner).skin().points[pair.pair.corners[corner]];
  }
  /// The node that carries most of a pair's first corner.
  [[nodiscard]] int nearest_node(const AwakePair& pair) const;
  /// Calls visit(body, node, weight) for all nodes that carry a corner, none for an obstacle without edges.
  template <class Visit>
  void each_node(const AwakePair& pair, int corner, const Visit& visit) const {
    const std::size_t row = pair.body_of(corner);
    if (row == AwakePair::kNoBody) return;
    const ContactPoint& at = point_of(pair, corner);
    const auto& nodes = body(row).grid.nodes[at.brick];
    for (int i = 0; i < 8; ++i) {
      if (at.weights[i] != 0) visit(row, nodes[i], at.weights[i]);
    }
  }

 private:
  /// Those of its points, or of its contact surface.
  [[nodiscard]] SurfaceTree& tree_of(const AwakePair& pair, int corner) const {
    const std::size_t row = pair.body_of(corner);
    return pair.bodies[1] == AwakePair::kNoBody ? *surfaces_.outlines[row] : *surfaces_.trees[row];
  }
  template <class Visit>
  void each_tree(const Visit& visit) const {
    for (const auto& tree : surfaces_.trees) visit(*tree);
    for (const auto& tree : surfaces_.outlines) visit(*tree);
  }
  /// A body and an obstacle without edges.
  struct Against {
    std::size_t obstacle;  // row in the world
    ShapePairs pairs;
  };

  void make_surfaces(const World& world, bool with_outlines);
  /// `surfaces`: by row of pairs_.
  void arrange_rounds(const std::vector<std::array<std::size_t, 2>>& surfaces);
  /// How far the next step of dt takes any node from its predicted position, bricks; infinite: beyond the prediction.
  [[nodiscard]] double deviation(double dt) const;
  /// `slack`: how far nodes may deviate from the prediction, bricks. Throws Diverged if a node moves so far in a step
  /// of dt that everything would be near everything.
  void predict(const World& world, double dt, double slack);
  /// `way`: m, in a step, of a node of that body of the group.
  [[noreturn]] void throw_runaway(const World& world, std::size_t row, double way) const;
  void measure(const World& world);

  Group group_;
  std::vector<Shape> shapes_;               // of the obstacles
  std::vector<std::size_t> obstacle_rows_;  // in the world, of those with edges
  double brick_;                            // m
  Surfaces surfaces_;
  std::vector<std::unique_ptr<FeaturePairs>> pairs_;
  /// Rows of these: no surface occurs twice in a round, whose pairs can be found at once.
  std::vector<std::vector<std::size_t>> rounds_;
  std::vector<std::vector<Against>> against_;  // by body
  std::vector<Pose> poses_;                    // of all obstacles, in this step
  std::vector<AwakePair> awake_;
  std::vector<std::optional<bool>> are_entangled_;  // of these, as far as asked
  /// At the last prediction: how far it reaches, and the nodes.
  struct Seen {
    Points positions;
    Points velocities;
  };
  std::vector<Seen> seen_;  // by body
  double horizon_ = 0;      // s
  double slack_ = 0;        // bricks
  double since_look_ = 0;   // s
  int rechecks_ = 0;        // in this step
};

}  // namespace sprung
