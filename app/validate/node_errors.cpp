#include "app/validate/node_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/bricks/embedding.h"
#include "core/error.h"

namespace sprung {
namespace {

constexpr std::string_view kHead = "poisson,x,y,z,ux,uy,uz";
constexpr double kAtNode = 1e-6;  // of a brick

using Row = std::array<double, 7>;

Row row_of(const std::string& line, const std::string& place) {
  Row row{};
  std::istringstream words(line);
  std::string word;
  std::size_t count = 0;
  bool is_number = true;
  while (is_number && std::getline(words, word, ',')) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    is_number = count < row.size() && !word.empty() && *end == '\0';
    if (is_number) row[count++] = value;
  }
  if (is_number && count == row.size()) return row;
  throw Error(ErrorKind::kBadInput, fmt::format("{}: '{}' must be seven numbers, {}", place, line, kHead));
}

KnownSolution solution_of(double poisson, const std::vector<Row>& rows) {
  KnownSolution solution{.poisson = poisson, .places = {}, .displacements = {}};
  const Eigen::Index count = rows.size();
  solution.places.resize(count, 3);
  solution.displacements.resize(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Row& row = rows[i];
    solution.places.row(i) << row[1], row[2], row[3];
    solution.displacements.row(i) << row[4], row[5], row[6];
  }
  return solution;
}

bool is_at_node(const Vec3& local) { return ((local.array() - local.array().round()).abs() < kAtNode).all(); }

}  // namespace

std::vector<KnownSolution> read_known_solutions(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw Error(ErrorKind::kBadInput, fmt::format("cannot read the table '{}'", file.string()));
  std::vector<std::pair<double, std::vector<Row>>> groups;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.empty() || line.front() == '#' || line == kHead) continue;
    const Row row = row_of(line, fmt::format("{}:{}", file.string(), number));
    if (groups.empty() || groups.back().first != row[0]) groups.emplace_back(row[0], std::vector<Row>{});
    groups.back().second.push_back(row);
  }
  std::vector<KnownSolution> solutions;
  solutions.reserve(groups.size());
  for (const auto& [poisson, rows] : groups) solutions.push_back(solution_of(poisson, rows));
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
  const Embedding seats = embed(body.grid, known.places * bricks_from_rest.transpose());
  const Points moved =
      deform_points(body.grid, seats, body.positions) - deform_points(body.grid, seats, body.rest_positions);
  const double low = known.places.col(0).minCoeff();
  const double length = known.places.col(0).maxCoeff() - low;
  NodeErrors errors;
  errors.largest = known.displacements.rowwise().norm().maxCoeff();
  for (Eigen::Index i = 0; i < known.places.rows(); ++i) {
    if (!is_at_node(seats.local.row(i))) continue;
    const Vec3 expected = known.displacements.row(i);
    errors.nodes.push_back(
        {.along = (known.places(i, 0) - low) / length, .known = expected, .error = Vec3(moved.row(i)) - expected});
  }
  if (errors.nodes.empty()) throw Error(ErrorKind::kBadInput, "the bricks have no node where the solution is known");
  return errors;
}

}  // namespace sprung
