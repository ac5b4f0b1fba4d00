#include "core/contact/search/contact_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/body/body.h"
#include "core/bricks/brick_grid.h"
#include "core/mesh/repair/weld.h"

namespace sprung {
namespace {

/// first[i] .. first[i + 1]: the rows of an ascending list that are equal to values[i].
std::vector<int> starts_of(const std::vector<int>& values, const std::vector<int>& ascending) {
  std::vector<int> first{0};
  for (const int value : values) {
    const auto end = std::upper_bound(ascending.begin() + first.back(), ascending.end(), value);
    first.push_back(int(end - ascending.begin()));
  }
  return first;
}

ContactPoint point_at(const Embedding& embedding, int row) {
  const auto weights = trilinear_weights(embedding.local.row(row));
  int corner = 0;
  weights.maxCoeff(&corner);
  return {embedding.brick[row], corner, weights};
}

NormalCone cone_of(const Points& normals) {
  const Vec3 sum = normals.colwise().sum();
  if (!(sum.norm() > 0)) return {Vec3::UnitX(), std::numbers::pi};
  const Vec3 axis = sum.normalized();
  return {axis, std::acos(std::clamp((normals * axis).minCoeff(), -1.0, 1.0))};
}

/// A brick, and those that share a node with it.
std::vector<int> bricks_around(const Body& body, const CornerLists& at_nodes, int brick) {
  std::vector<int> around;
  for (const int node : body.grid.nodes[brick]) {
    const std::size_t row = node;
    for (int i = at_nodes.first[row]; i < at_nodes.first[row + 1]; ++i) {
      around.push_back(at_nodes.corners[i] / 8);
    }
  }
  sort_unique(around);
  return around;
}

/// The vertices of a skin without those that have the place and the brick of another.
Embedding distinct_points(const BodySkin& drawn) {
  const Embedding& all = drawn.embedding;
  const std::vector<int> point_of = weld_points(drawn.skin.positions);
  std::vector<int> rows;
  for (int row = 0; row < isize(point_of); ++row) {
    const int first = point_of[row];
    if (first == row || all.brick[first] != all.brick[row]) rows.push_back(row);
  }
  Embedding distinct{.brick = {}, .local = all.local(rows, Eigen::all)};
  for (const int row : rows) distinct.brick.push_back(all.brick[row]);
  return distinct;
}

/// By row of `bricks`: the rows of those connected to it by at most `links` shared nodes.
std::vector<std::vector<int>> connected_among(const std::vector<int>& bricks, const Body& body, int links) {
  std::vector<int> row_of(body.grid.nodes.size(), -1);
  for (std::size_t row = 0; row < bricks.size(); ++row) {
    row_of[bricks[row]] = int(row);
  }
  const CornerLists at_nodes = list_corners(body.grid.nodes, body.node_count());
  std::vector<std::vector<int>> connected(bricks.size());
  for (std::size_t row = 0; row < bricks.size(); ++row) {
    std::vector<int> reached{bricks[row]};
    for (int link = 0; link < links; ++link) {
      std::vector<int> further;
      for (const int brick : reached) {
        const std::vector<int> around = bricks_around(body, at_nodes, brick);
        further.insert(further.end(), around.begin(), around.end());
      }
      sort_unique(further);
      reached = std::move(further);
    }
    for (const int brick : reached) {
      if (row_of[brick] >= 0) connected[row].push_back(row_of[brick]);
    }
    sort_unique(connected[row]);
  }
  return connected;
}

}  // namespace

void sort_unique(std::vector<int>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

ContactSurface::ContactSurface(const Body& body, const Embedding& embedding, const Triangles& corners,
                               const Embedding& skin, const std::vector<int>& beneath) {
  const std::vector<int> triangle_of = add_triangles(body, corners, add_points(embedding));
  add_edges();
  add_skin(skin, beneath, triangle_of);
  for (std::size_t row = 0; row < bricks.size(); ++row) {
    cones.push_back(cone_of(normals.middleRows(first_point[row], first_point[row + 1] - first_point[row])));
  }
  connected = connected_among(bricks, body, 1);
  neighbours = connected_among(bricks, body, 2);
}

std::vector<int> ContactSurface::add_points(const Embedding& embedding) {
  std::vector<int> order(embedding.brick.size());
  std::iota(order.begin(), order.end(), 0);
  const auto brick_of = [&](int row) { return embedding.brick[row]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return brick_of(a) < brick_of(b); });
  std::vector<int> point_of(order.size());
  std::vector<int> brick_of_point;
  for (const int row : order) {
    point_of[row] = isize(points);
    points.push_back(point_at(embedding, row));
    brick_of_point.push_back(brick_of(row));
    if (bricks.empty() || bricks.back() != brick_of(row)) bricks.push_back(brick_of(row));
  }
  first_point = starts_of(bricks, brick_of_point);
  return point_of;
}

std::vector<int> ContactSurface::add_triangles(const Body& body, const Triangles& corners,
                                               const std::vector<int>& point_of) {
  const auto owner = [&](const std::array<int, 3>& triangle) { return points[triangle[0]].brick; };
  std::vector<int> order(corners.rows());
  std::iota(order.begin(), order.end(), 0);
  const auto owner_of = [&](int row) { return points[point_of[corners(row, 0)]].brick; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return owner_of(a) < owner_of(b); });
  std::vector<int> triangle_of(order.size());
  around.resize(points.size());
  for (const int row : order) {
    triangle_of[row] = isize(triangles);
    triangles.push_back({point_of[corners(row, 0)], point_of[corners(row, 1)], point_of[corners(row, 2)]});
    for (const int corner : triangles.back()) around[corner].push_back(triangle_of[row]);
  }
  normals = Points::Zero(points.size(), 3);
  std::vector<int> brick_of_triangle;
  for (const std::array<int, 3>& triangle : triangles) {
    brick_of_triangle.push_back(owner(triangle));
    std::array<Vec3, 3> x;
    for (std::size_t i = 0; i < 3; ++i) {
      x[i] = carried(body, points[triangle[i]], body.rest_positions);
    }
    const Vec3 area = (x[1] - x[0]).cross(x[2] - x[0]);
    for (const int corner : triangle) normals.row(corner) += area.transpose();
  }
  first_triangle = starts_of(bricks, brick_of_triangle);
  normals.rowwise().normalize();
  return triangle_of;
}

void ContactSurface::add_skin(const Embedding& embedding, const std::vector<int>& beneath,
                              const std::vector<int>& triangle_of) {
  std::vector<std::vector<int>> above(triangles.size());
  for (std::size_t row = 0; row < beneath.size(); ++row) {
    if (beneath[row] >= 0) above[triangle_of[beneath[row]]].push_back(int(row));
  }
  first_drawn.push_back(0);
  for (const std::vector<int>& rows : above) {
    for (const int row : rows) drawn.push_back(point_at(embedding, row));
    first_drawn.push_back(isize(drawn));
  }
}

void ContactSurface::add_edges() {
  for (const std::array<int, 3>& corners : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
      edges.push_back({low, high});
    }
  }
  std::sort(edges.begin(), edges.end());  // points are grouped by brick already
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<int> brick_of_edge;
  for (const auto& [low, high] : edges) brick_of_edge.push_back(points[low].brick);
  first_edge = starts_of(bricks, brick_of_edge);
  opposite.assign(edges.size(), {-1, -1});
  for (const std::array<int, 3>& corners : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(corners[i], corners[(i + 1) % 3]);
      auto& [first, second] = opposite[row_of_edge(low, high)];
      (first < 0 ? first : second) = corners[(i + 2) % 3];
    }
  }
}

std::size_t ContactSurface::row_of_edge(int low, int high) const {
  return std::lower_bound(edges.begin(), edges.end(), std::array{low, high}) - edges.begin();
}

Vec3 carried_normal(const Body& body, int brick, const Vec3& normal) {
  const auto& nodes = body.grid.nodes[brick];
  const Vec3 along = mean_axes_of(columns_of(nodes, body.rest_positions)).transpose() * normal;
  return (areas_of(mean_axes_of(columns_of(nodes, body.positions))) * along).normalized();
}

bool share_a_node(const Body& body, int a, int b) {
  const std::size_t brick_a = a;
  const std::size_t brick_b = b;
  if ((body.grid.cells[brick_a] - body.grid.cells[brick_b]).cwiseAbs().maxCoeff() > 1) return false;
  const auto& nodes = body.grid.nodes[brick_b];
  return std::any_of(body.grid.nodes[brick_a].begin(), body.grid.nodes[brick_a].end(),
                     [&](int node) { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); });
}

const ContactSurface& contact_surface_of(SoftBody& body) {
  ContactSkin& contact = body.contact;
  if (!contact.surface) {
    contact.surface = std::make_shared<const ContactSurface>(body, contact.points, contact.triangles,
                                                             body.drawn.embedding, contact.beneath);
  }
  return *contact.surface;
}

const ContactSurface& outline_of(SoftBody& body) {
  ContactSkin& contact = body.contact;
  if (contact.outline) return *contact.outline;
  const bool is_drawn = !contact.points.brick.empty() && !body.drawn.embedding.brick.empty();
  contact.outline = std::make_shared<const ContactSurface>(
      body, is_drawn ? distinct_points(body.drawn) : contact.points, Triangles(0, 3));
  return *contact.outline;
}

}  // namespace sprung
