#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "core/contact/watch/crossing_depth.h"
#include "core/contact/watch/drawn_surface.h"
#include "core/simulation/crossings.h"
#include "core/simulation/simulation.h"

namespace sprung {

/// Checks the skins that are exported and drawn, not the points that contact uses, and shares no code with contact.
/// Every pair of bodies (if bodies collide), every body with itself and with every obstacle is tested, exactly. Limits:
/// a skin wholly inside another crosses nothing; two triangles of one skin that share a vertex are not tested, nor are
/// two that belonged to the same tangle at the start; curves that pictures add to coarse skins are not checked.
/// Neighbouring bricks that are hardly deformed are assumed to carry no crossing: see CellBricks.
class CrossingWatch {
 public:
  /// For a simulation at its start: what crosses now is distinguished later. Both must outlive it.
  CrossingWatch(const Scene& scene, const Simulation& simulation);

  /// Checks the nodes (by body, m x 3, m) of that frame, at that time of the film (s). Deterministic.
  [[nodiscard]] Crossings look(const std::vector<const Points*>& nodes, int frame, double time);

  /// Triangles of bodies that crossed at the last check, three rows of points (m) each; not those of the start.
  [[nodiscard]] const Points& crossing_triangles() const { return crossing_triangles_; }

 private:
  using VertexPair = std::uint64_t;
  /// Two surfaces, or a surface and a plane, that are tested.
  struct Task {
    std::array<int, 2> skins;
    std::unordered_set<VertexPair> at_start{};  // vertices of triangles that crossed then
    std::vector<int> tangles_at_start{};        // of a skin with itself, instead of these: tangles_of()
    [[nodiscard]] bool is_self() const { return skins[0] == skins[1]; }
  };
  /// The crossings found in a task.
  struct Found {
    RowPairs pairs;  // rows of the triangles; of planes: the triangle, twice
    long at_start = 0;
    CrossingDepth depth{};
  };

  /// The half-space behind it is solid.
  struct Plane {
    Vec3 normal;
    double offset;  // m
    [[nodiscard]] double height(const Vec3& position) const { return normal.dot(position) - offset; }
  };

  [[nodiscard]] bool is_plane(int skin) const;
  [[nodiscard]] Plane plane_of(const Task& task, double time) const;
  void move(const std::vector<const Points*>& nodes, double time);
  /// By task: all pairs that cross now.
  [[nodiscard]] std::vector<Found> find(const std::vector<const Points*>& nodes, double time);
  [[nodiscard]] RowPairs cells_of(const Task& task, double time) const;
  void place_vertices(const std::vector<RowPairs>& cells);
  [[nodiscard]] RowPairs pairs_of(const Task& task, const RowPairs& cells, double time) const;
  [[nodiscard]] CrossingDepth depth_of(const Task& task, const RowPairs& pairs, double time) const;
  template <class Visit>
  void for_each_vertex_pair(const Task& task, const std::array<int, 2>& pair, const Visit& visit) const;
  [[nodiscard]] bool was_at_start(const Task& task, const std::array<int, 2>& pair) const;

  void add_corners(const Task& task, const RowPairs& pairs, std::vector<Vec3>& corners) const;
  [[nodiscard]] std::string name_of(int skin) const;
  [[nodiscard]] std::string names_of(const std::array<int, 2>& skins) const;

  const Scene& scene_;
  const Simulation& simulation_;
  std::vector<DrawnSurface> surfaces_;  // of bodies, then of obstacles; planes: empty
  std::vector<Task> tasks_;
  Points crossing_triangles_;
};

}  // namespace sprung
