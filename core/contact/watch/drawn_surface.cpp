#include "core/contact/watch/drawn_surface.h"

#include <algorithm>
#include <numeric>

namespace sprung {
namespace {

constexpr int kMaxOfCell = 64;  // triangles

std::array<double, 3> key_of(const Points& points, int row) { return {points(row, 0), points(row, 1), points(row, 2)}; }

/// Sorts a part of a list into two halves along the longest side of its box; returns where the second one begins.
int halve(std::vector<int>& rows, int first, int last, const Points& middles) {
  AlignedBox box;
  for (int i = first; i < last; ++i) box.extend(Vec3(middles.row(rows[i])));
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const int half = first + (last - first) / 2;
  std::nth_element(rows.begin() + first, rows.begin() + half, rows.begin() + last,
                   [&](int a, int b) { return std::pair(middles(a, axis), a) < std::pair(middles(b, axis), b); });
  return half;
}

}  // namespace

DrawnSurface::DrawnSurface(const SoftBody& body) : body_(&body) {
  build(body.drawn.skin, body.drawn.embedding.brick);
  std::vector<CellTriangles> cells;
  for (const Cell& cell : cells_) {
    CellTriangles& triangles = cells.emplace_back();
    for (int row = cell.first; row < cell.last; ++row) {
      std::array<int, 3> corners{};
      for (int i = 0; i < 3; ++i) corners[i] = sources_[triangles_(row, i)];
      triangles.push_back(corners);
    }
  }
  bricks_ = std::make_unique<CellBricks>(body, cells);
  follow(body.positions);
}

DrawnSurface::DrawnSurface(const Skin& skin) {
  build(skin, std::vector<int>(skin.positions.rows(), 0));
  move_to(skin.positions);
}

void DrawnSurface::build(const Skin& skin, const std::vector<int>& owners) {
  const int count = int(skin.positions.rows());
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return key_of(skin.positions, a) < key_of(skin.positions, b); });
  std::vector<int> point_of(count);
  for (int i = 0; i < count; ++i) {
    const bool is_new = i == 0 || key_of(skin.positions, order[i]) != key_of(skin.positions, order[i - 1]);
    if (is_new) sources_.push_back(order[i]);
    point_of[order[i]] = isize(sources_) - 1;
  }
  triangles_.resize(skin.triangles.rows(), 3);
  int kept = 0;
  for (const auto& triangle : skin.triangles.rowwise()) {
    const int a = point_of[triangle[0]];
    const int b = point_of[triangle[1]];
    const int c = point_of[triangle[2]];
    if (a == b || b == c || c == a) continue;
    triangles_.row(kept++) << a, b, c;
  }
  triangles_.conservativeResize(kept, 3);
  points_ = skin.positions(sources_, Eigen::all);
  is_placed_.assign(sources_.size(), 0);
  Points middles(kept, 3);
  for (int row = 0; row < kept; ++row) middles.row(row) = points_(triangles_.row(row), Eigen::all).colwise().mean();
  std::vector<int> rows(kept);
  std::iota(rows.begin(), rows.end(), 0);
  const auto owner = [&](int row) { return owners[sources_[triangles_(row, 0)]]; };
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return owner(a) < owner(b); });
  for (int first = 0; first < kept;) {
    int last = first;
    while (last < kept && owner(rows[last]) == owner(rows[first])) ++last;
    add_cells(rows, first, last, middles);
    first = last;
  }
  triangles_ = Triangles(triangles_(rows, Eigen::all));
  Points of_cells(cells_.size(), 3);
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    of_cells.row(Eigen::Index(cell)) = middles.row(rows[cells_[cell].first]);
  }
  std::vector<int> cells(cells_.size());
  std::iota(cells.begin(), cells.end(), 0);
  leaves_.resize(cells_.size());
  if (!cells.empty()) add_node(cells, 0, isize(cells), of_cells);
  neighbours_.resize(sources_.size());
  for (const auto& triangle : triangles_.rowwise()) {
    for (int corner = 0; corner < 3; ++corner) {
      neighbours_[triangle[corner]].push_back(triangle[(corner + 1) % 3]);
      neighbours_[triangle[(corner + 1) % 3]].push_back(triangle[corner]);
    }
  }
  for (std::vector<int>& around : neighbours_) {
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
  }
}

void DrawnSurface::add_cells(std::vector<int>& rows, int first, int last, const Points& middles) {
  if (last - first <= kMaxOfCell) {
    cells_.push_back({first, last});
    return;
  }
  const int half = halve(rows, first, last, middles);
  add_cells(rows, first, half, middles);
  add_cells(rows, half, last, middles);
}

void DrawnSurface::add_node(std::vector<int>& cells, int first, int last, const Points& middles) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({.box = {}, .cell = -1, .second_child = 0});
  if (last - first == 1) {
    nodes_[node].cell = cells[first];
    leaves_[cells[first]] = int(node);
    return;
  }
  const int half = halve(cells, first, last, middles);
  add_node(cells, first, half, middles);
  nodes_[node].second_child = isize(nodes_);
  add_node(cells, half, last, middles);
}

void DrawnSurface::refit(const std::vector<AlignedBox>& boxes) {
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    node.box = node.cell >= 0 ? boxes[node.cell] : nodes_[i + 1].box.merged(nodes_[node.second_child].box);
  }
}

void DrawnSurface::follow(const Points& nodes) {
  body_nodes_ = &nodes;
  winding_.reset();
  std::fill(is_placed_.begin(), is_placed_.end(), 0);
  bricks_->follow(nodes);
  refit(bricks_->boxes());
}

void DrawnSurface::move_to(const Points& vertices) {
  points_ = vertices(sources_, Eigen::all);
  winding_.reset();
  std::vector<AlignedBox> boxes(cells_.size());
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    for (int row = cells_[cell].first; row < cells_[cell].last; ++row) {
      for (const int corner : triangles_.row(row)) boxes[cell].extend(Vec3(points_.row(corner)));
    }
  }
  refit(boxes);
}

void DrawnSurface::place_vertices(const std::vector<int>& cells) {
  if (body_ == nullptr) return;
  const Embedding& embedding = body_->drawn.embedding;
  for (const int cell : cells) {
    for (int row = cells_[cell].first; row < cells_[cell].last; ++row) {
      for (const int point : triangles_.row(row)) {
        if (is_placed_[point] != 0) continue;
        is_placed_[point] = 1;
        const int vertex = sources_[point];
        const auto& nodes = body_->grid.nodes[embedding.brick[vertex]];
        points_.row(point) = columns_of(nodes, *body_nodes_) * trilinear_weights(embedding.local.row(vertex));
      }
    }
  }
}

void DrawnSurface::complete() {
  if (winding_) return;
  std::vector<int> cells(cells_.size());
  std::iota(cells.begin(), cells.end(), 0);
  place_vertices(cells);
  winding_ = std::make_unique<WindingTree>(points_, triangles_);
}

}  // namespace sprung
