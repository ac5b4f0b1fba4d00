#include "core/contact/watch/cell_bricks.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/bricks/brick_topology.h"

namespace sprung {
namespace {

constexpr double kOpposite = -0.17;  // cosine of normals that point away from or at each other
constexpr double kRounding = 1e-13;  // of coordinates

/// A triangle of the skin at rest.
struct RestTriangle {
  Vec3 middle;
  Vec3 normal;   // unit
  double reach;  // of the corners from the middle
};

std::vector<RestTriangle> rest_triangles(const Skin& skin, const CellTriangles& cell) {
  std::vector<RestTriangle> triangles;
  for (const std::array<int, 3>& corners : cell) {
    const Vec3 a = skin.positions.row(corners[0]);
    const Vec3 b = skin.positions.row(corners[1]);
    const Vec3 c = skin.positions.row(corners[2]);
    const Vec3 middle = (a + b + c) / 3;
    const double reach = std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
    triangles.push_back({middle, (b - a).cross(c - a).normalized(), reach});
  }
  return triangles;
}

/// Whether two triangles face each other, or are back to back, and so near that tame bricks may let them cross.
bool are_delicate(const RestTriangle& a, const RestTriangle& b, double brick) {
  if (a.normal.dot(b.normal) > kOpposite) return false;
  const Vec3 way = b.middle - a.middle;
  const double ahead = std::min(way.dot(a.normal), -way.dot(b.normal));
  if (ahead > 0) return way.norm() < CellBricks::kFacing * brick + a.reach + b.reach;
  const double beside = (way - way.dot(a.normal) * a.normal).norm();
  return -ahead < CellBricks::kThin * brick && beside < a.reach + b.reach;
}

/// The triangles of a cell at rest, a cone about their normals, and a ball about their middles.
struct RestCell {
  std::vector<RestTriangle> triangles;
  Vec3 axis = Vec3::UnitX();
  double spread = std::numbers::pi;  // rad
  Vec3 middle = Vec3::Zero();
  double radius = 0;
};

RestCell rest_cell(const Skin& skin, const CellTriangles& cell) {
  RestCell at_rest{.triangles = rest_triangles(skin, cell)};
  for (const RestTriangle& triangle : at_rest.triangles) at_rest.middle += triangle.middle;
  at_rest.middle /= double(at_rest.triangles.size());
  for (const RestTriangle& triangle : at_rest.triangles) {
    at_rest.radius = std::max(at_rest.radius, (triangle.middle - at_rest.middle).norm());
  }
  Vec3 sum = Vec3::Zero();
  for (const RestTriangle& triangle : at_rest.triangles) sum += triangle.normal;
  if (!(sum.norm() > 0)) return at_rest;
  at_rest.axis = sum.normalized();
  double least = 1;
  for (const RestTriangle& triangle : at_rest.triangles) least = std::min(least, triangle.normal.dot(at_rest.axis));
  at_rest.spread = std::acos(std::max(least, -1.0));
  return at_rest;
}

bool are_delicate(const RestCell& a, const RestCell& b, double brick) {
  const double between = std::acos(std::clamp(a.axis.dot(b.axis), -1.0, 1.0));
  if (between + a.spread + b.spread < std::acos(kOpposite)) return false;
  const double behind = -CellBricks::kThin * brick;
  return std::any_of(a.triangles.begin(), a.triangles.end(), [&](const RestTriangle& one) {
    if ((b.middle - one.middle).dot(one.normal) + b.radius <= behind) return false;
    return std::any_of(b.triangles.begin(), b.triangles.end(),
                       [&](const RestTriangle& other) { return are_delicate(one, other, brick); });
  });
}

/// The rotation in a deformation gradient, by Newton's iteration for its polar decomposition (N. Higham, "Computing the
/// polar decomposition", 1986); not one if the gradient is far from any.
Mat3 nearest_rotation(const Mat3& gradient) {
  Mat3 rotation = gradient;
  for (int i = 0; i < 4; ++i) {
    Mat3 inverse;
    bool is_invertible = false;
    rotation.computeInverseWithCheck(inverse, is_invertible, 1e-3);
    if (!is_invertible) return Mat3::Zero();
    rotation = (rotation + inverse.transpose()) / 2;
  }
  return rotation;
}

bool is_rotation(const Mat3& matrix) {
  constexpr double kError = 1e-3;
  return matrix.determinant() > 0 && (matrix.transpose() * matrix - Mat3::Identity()).cwiseAbs().maxCoeff() < kError;
}

/// The largest distance by which two rotations move a unit vector apart.
double turn_between(const Mat3& a, const Mat3& b) { return (a - b).norm() / std::sqrt(2.0); }

/// From the deformed corners of a part of a brick, which enclose all of it.
void extend(AlignedBox& box, const BrickColumns& x, const AlignedBox& part) {
  const auto along = [&](int axis, const Vec3& low, const Vec3& high, bool at_end) -> Vec3 {
    return low + (at_end ? part.max()[axis] : part.min()[axis]) * (high - low);
  };
  for (const bool at_z : {false, true}) {
    const Vec3 a = along(2, x.col(0), x.col(4), at_z);
    const Vec3 b = along(2, x.col(1), x.col(5), at_z);
    const Vec3 c = along(2, x.col(2), x.col(6), at_z);
    const Vec3 d = along(2, x.col(3), x.col(7), at_z);
    for (const bool at_y : {false, true}) {
      const Vec3 low = along(1, a, c, at_y);
      const Vec3 high = along(1, b, d, at_y);
      box.extend(along(0, low, high, false)).extend(along(0, low, high, true));
    }
  }
}

}  // namespace

CellBricks::CellBricks(const SoftBody& body, const std::vector<CellTriangles>& cells)
    : body_(body),
      carriers_(cells.size()),
      is_used_(body.grid.nodes.size()),
      rotations_(is_used_.size()),
      strains_(is_used_.size()),
      of_cells_(cells.size()),
      boxes_(cells.size()) {
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    std::vector<Carrier>& carriers = carriers_[cell];
    for (const std::array<int, 3>& triangle : cells[cell]) {
      for (const int vertex : triangle) {
        const int brick = body.drawn.embedding.brick[vertex];
        const auto known =
            std::find_if(carriers.begin(), carriers.end(), [&](const Carrier& at) { return at.brick == brick; });
        Carrier& carrier = known == carriers.end() ? carriers.emplace_back(Carrier{brick, {}}) : *known;
        carrier.part.extend(Vec3(body.drawn.embedding.local.row(vertex)));
      }
    }
    for (const Carrier& carrier : carriers) is_used_[carrier.brick] = 1;
  }
  find_neighbours(cells);
}

void CellBricks::find_neighbours(const std::vector<CellTriangles>& cells) {
  std::vector<std::vector<int>> at_nodes(body_.node_count());  // cells
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    for (const Carrier& carrier : carriers_[cell]) {
      for (const int node : body_.grid.nodes[carrier.brick]) at_nodes[node].push_back(int(cell));
    }
  }
  std::vector<RestCell> at_rest;
  at_rest.reserve(cells.size());
  for (const CellTriangles& cell : cells) at_rest.push_back(rest_cell(body_.drawn.skin, cell));
  neighbours_.resize(cells.size());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    std::vector<int>& around = neighbours_[cell];
    for (const Carrier& carrier : carriers_[cell]) {
      for (const int node : body_.grid.nodes[carrier.brick]) {
        around.insert(around.end(), at_nodes[node].begin(), at_nodes[node].end());
      }
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (const int other : around) {
      if (other < int(cell)) continue;
      pairs_.push_back({{int(cell), other}, are_delicate(at_rest[cell], at_rest[other], body_.grid.brick_size)});
    }
  }
}

bool CellBricks::are_neighbours(int a, int b) const {
  return std::binary_search(neighbours_[a].begin(), neighbours_[a].end(), b);
}

void CellBricks::measure_bricks(const Points& nodes) {
  const double size = body_.grid.brick_size;
  for (std::size_t brick = 0; brick < is_used_.size(); ++brick) {
    if (is_used_[brick] == 0) continue;
    const BrickColumns x = columns_of(body_.grid.nodes[brick], nodes);
    const Mat3 rotation = nearest_rotation(mean_axes_of(x) / size);
    rotations_[brick] = rotation;
    double strain = is_rotation(rotation) ? 0 : 1;
    for (std::size_t edge = 0; edge < kEdges.size(); ++edge) {
      const Vec3 along = (x.col(kEdges[edge].to) - x.col(kEdges[edge].from)) / size;
      strain = std::max(strain, (along - rotation.col(int(edge) / 4)).norm());
    }
    strains_[brick] = strain;
  }
}

void CellBricks::follow(const Points& nodes) {
  measure_bricks(nodes);
  const auto rotation_of = [&](std::size_t cell) -> const Mat3& { return rotations_[carriers_[cell].front().brick]; };
  for (std::size_t cell = 0; cell < carriers_.size(); ++cell) {
    AlignedBox& box = boxes_[cell];
    box.setEmpty();
    of_cells_[cell] = 0;
    for (const Carrier& carrier : carriers_[cell]) {
      extend(box, columns_of(body_.grid.nodes[carrier.brick], nodes), carrier.part);
      of_cells_[cell] = std::max(of_cells_[cell],
                                 strains_[carrier.brick] + turn_between(rotation_of(cell), rotations_[carrier.brick]));
    }
    const Vec3 rounding = Vec3::Constant(kRounding * box.max().cwiseAbs().cwiseMax(box.min().cwiseAbs()).maxCoeff());
    box = AlignedBox(box.min() - rounding, box.max() + rounding);
  }
  suspects_.clear();
  for (const Neighbours& pair : pairs_) {
    const auto [a, b] = pair.cells;
    const bool is_tame = of_cells_[a] < kTame && of_cells_[b] + turn_between(rotation_of(a), rotation_of(b)) < kTame;
    if (!pair.is_delicate && is_tame) continue;
    if (boxes_[a].intersects(boxes_[b])) suspects_.push_back(pair.cells);
  }
}

}  // namespace sprung
