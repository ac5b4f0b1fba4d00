#include "app/validate/node_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "core/bricks/embedding.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr std::string_view kHead = "poisson,x,y,z,ux,uy,uz";
constexpr double kAtNode = 1e-6;  // distance in bricks

using Row = std::array<double, 7>;

Row parse_row(const std::string& line, const std::string& place) {
  Row row{};
  int end = 0;
  const int count = std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf%n", &row[0], &row[1], &row[2], &row[3],
                                &row[4], &row[5], &row[6], &end);
  if (count == 7 && end == isize(line)) return row;
  throw Error(ErrorKind::kBadInput, fmt::format("{}: '{}' is not seven numbers, {}", place, line, kHead));
}

}  // namespace

std::vector<KnownSolution> read_known_solutions(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw Error(ErrorKind::kBadInput, fmt::format("cannot read the table '{}'", file.string()));
  std::vector<Row> rows;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.empty() || line.front() == '#' || line == kHead) continue;
    rows.push_back(parse_row(line, fmt::format("{}:{}", file.string(), number)));
  }
  std::vector<KnownSolution> solutions;
  for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
    while (end < rows.size() && rows[end][0] == rows[begin][0]) ++end;
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>> table(
        rows[begin].data(), Eigen::Index(end - begin), 7);
    solutions.push_back({table(0, 0), table.middleCols<3>(1), table.rightCols<3>()});
  }
  return solutions;
}

double NodeErrors::mean_error() const {
  double sum = 0;
  for (const NodeError& node : nodes) sum += node.error.norm();
  return sum / double(nodes.size()) / largest;
}

double NodeErrors::max_error() const {
  double most = 0;
  for (const NodeError& node : nodes) most = std::max(most, node.error.norm());
  return most / largest;
}

double NodeErrors::rms_error() const {
  double errors = 0;
  double known = 0;
  for (const NodeError& node : nodes) {
    errors += node.error.squaredNorm();
    known += node.known.squaredNorm();
  }
  return std::sqrt(errors / known);
}

NodeErrors node_errors(const Body& body, const Mat3& bricks_from_rest, const KnownSolution& known) {
  const Embedding points = embed(body.grid, known.positions * bricks_from_rest.transpose());
  const Points moved =
      deform_points(body.grid, points, body.positions) - deform_points(body.grid, points, body.rest_positions);
  const double low = known.positions.col(0).minCoeff();
  const double length = known.positions.col(0).maxCoeff() - low;
  NodeErrors errors;
  errors.largest = known.displacements.rowwise().norm().maxCoeff();
  for (Eigen::Index i = 0; i < known.positions.rows(); ++i) {
    const auto local = points.local.row(i).array();
    if (((local - local.round()).abs() > kAtNode).any()) continue;
    const Vec3 expected = known.displacements.row(i);
    errors.nodes.push_back(
        {.along = (known.positions(i, 0) - low) / length, .known = expected, .error = Vec3(moved.row(i)) - expected});
  }
  if (errors.nodes.empty()) throw Error(ErrorKind::kBadInput, "the bricks have no node where the solution is known");
  return errors;
}

}  // namespace sprung
