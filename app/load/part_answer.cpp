#include "app/load/part_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "core/mesh/repair/faces.h"
#include "core/simulation/drivers.h"
#include "core/simulation/skin_supports.h"

namespace sprung {
namespace {

constexpr double kSafetyOfTwoGrids = 3;  // Roache's
constexpr double kAround = 1.5;          // bricks of the coarser grid: search radius for its value at a position
constexpr double kLeftOut = 3;           // of its bricks, around a singular place
constexpr int kMaxSingular = 60;         // places; beyond that nothing is resolved
constexpr double kCorner = 50;           // degrees

}  // namespace

double convergence_index(double fine, double coarse, double ratio) {
  return kSafetyOfTwoGrids * std::abs(fine - coarse) / (ratio * ratio - 1);
}

namespace {

/// A scalar on the skins of all grids.
struct SkinScalar {
  const std::vector<PartSkin>& skins;
  const std::vector<double>& sizes;     // m
  std::vector<Eigen::VectorXd> values;  // by grid

  /// The largest within some bricks of a position; 0 if there is nothing.
  [[nodiscard]] double around(std::size_t grid, const Vec3& position) const {
    const double reach = std::pow(kAround * sizes[grid], 2);
    double largest = 0;
    for (Eigen::Index row = 0; row < values[grid].size(); ++row) {
      if (values[grid][row] <= largest) continue;
      if ((skins[grid].positions.row(row).transpose() - position).squaredNorm() <= reach) largest = values[grid][row];
    }
    return largest;
  }
};

/// Points on a line, at most a brick apart.
class DottedLines {
 public:
  void add(const Vec3& point) { points_.push_back(point); }
  [[nodiscard]] bool is_near(const Vec3& position, double reach) const {
    return std::any_of(points_.begin(), points_.end(),
                       [&](const Vec3& point) { return (point - position).squaredNorm() <= reach * reach; });
  }

 private:
  std::vector<Vec3> points_;
};

/// Where the exact stress is unbounded: inner corners, and the ends of supports.
class SingularLines {
 public:
  SingularLines(const LoadPart& part, const PartSolution& solution);
  /// The a of stress ~ size^-a from which on a peak at `position` (m, in the frame of LoadedBody) is singular; infinite
  /// if none of the lines is within `reach` (m).
  [[nodiscard]] double min_exponent(const Vec3& position, double reach) const {
    if (certain_.is_near(position, reach)) return kSurelySingular;
    return possible_.is_near(position, reach) ? kSingular : std::numeric_limits<double>::infinity();
  }

 private:
  DottedLines certain_;   // inner edges that turn by kCorner, and clamped faces
  DottedLines possible_;  // blunter edges, which may stand for a rounding, and faces that are held along some axes
};

struct FoundPeak {
  std::optional<Peak> peak;
  std::vector<Singularity> singular;
};

SingularLines::SingularLines(const LoadPart& part, const PartSolution& solution) {
  const double apart = solution.brick_size;
  const auto add_edges = [&](double min_turn, DottedLines& lines) {
    for (const Solid& solid : part.loaded.solids) {
      for (const std::array<int, 2>& edge : sharp_inner_edges(solid.points, solid.triangles, min_turn)) {
        const Vec3 a = solid.points.row(edge[0]);
        const Vec3 b = solid.points.row(edge[1]);
        const int count = 1 + int((b - a).norm() / apart);
        for (int i = 0; i <= count; ++i) lines.add(a + double(i) / count * (b - a));
      }
    }
  };
  add_edges(kCorner, certain_);
  add_edges(kSharpEdge, possible_);
  const Simulation& simulation = solution.simulation;
  for (std::size_t row = 0; row < simulation.origins.size(); ++row) {
    const Body& body = simulation.world.bodies[row];
    for (const PinnedSkin& skin : simulation.origins[row].pinned_skins) {
      const Pin& pin = solution.scene.bodies[simulation.origins[row].body].pins[skin.pin];
      const bool is_clamped = !pin.normal && pin.axes.fixed == Axes{}.fixed;
      DottedLines& lines = is_clamped ? certain_ : possible_;
      const Points pinned = part_from_world(solution, part, deform_points(body.grid, skin.points, body.rest_positions));
      for (const auto& point : pinned.rowwise()) lines.add(point.transpose());
    }
  }
}

/// The largest value that does not grow under refinement; the scalar is positive where it matters.
FoundPeak find_peak(const SkinScalar& scalar, const SingularLines& lines, const LoadPart& part) {
  FoundPeak found;
  const Eigen::VectorXd& fine = scalar.values.front();
  const Points& positions = scalar.skins.front().positions;
  const std::size_t coarsest = scalar.values.size() - 1;
  const double ratio = scalar.sizes[coarsest] / scalar.sizes.front();
  const double left_out = std::pow(kLeftOut * scalar.sizes[coarsest], 2);
  std::vector<int> rows(std::size_t(fine.size()));
  std::iota(rows.begin(), rows.end(), 0);
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return fine[a] > fine[b]; });
  std::vector<Vec3> singular;
  for (const int row : rows) {
    const Vec3 position = positions.row(row);
    if (!(fine[row] > 0)) break;
    if (std::any_of(singular.begin(), singular.end(),
                    [&](const Vec3& one) { return (one - position).squaredNorm() < left_out; })) {
      continue;
    }
    Peak peak{{.value = fine[row], .error = std::numeric_limits<double>::infinity()}, part.file_from_rest(position)};
    if (coarsest == 0) {
      found.peak = peak;
      return found;
    }
    const double exponent = std::log(fine[row] / std::max(scalar.around(coarsest, position), 1e-300)) / std::log(ratio);
    const double known = singular.empty() ? 1 : 0.5;  // the rest of a known singular line
    if (exponent < known * lines.min_exponent(position, kAround * scalar.sizes[coarsest])) {
      peak.error = 0;
      for (std::size_t grid = 1; grid <= coarsest; ++grid) {
        peak.error = std::max(peak.error, convergence_index(fine[row], scalar.around(grid, position),
                                                            scalar.sizes[grid] / scalar.sizes.front()));
      }
      found.peak = peak;
      return found;
    }
    singular.push_back(position);
    found.singular.push_back({.position = peak.position, .stress = fine[row], .exponent = exponent});
    if (int(singular.size()) == kMaxSingular) return found;
  }
  return found;
}

Peak largest_displacement(const std::vector<PartSkin>& skins, const std::vector<double>& sizes, const LoadPart& part,
                          Vec3& vector) {
  Eigen::Index row = 0;
  const auto largest = [&](std::size_t grid) {
    return std::sqrt(skins[grid].displacements.rowwise().squaredNorm().maxCoeff(&row));
  };
  Peak peak;
  double error = skins.size() == 1 ? std::numeric_limits<double>::infinity() : 0;
  std::vector<double> coarse;
  for (std::size_t grid = 1; grid < skins.size(); ++grid) coarse.push_back(largest(grid));
  peak.value = largest(0);
  for (std::size_t grid = 1; grid < skins.size(); ++grid) {
    error = std::max(error, convergence_index(peak.value, coarse[grid - 1], sizes[grid] / sizes[0]));
  }
  peak.error = error;
  peak.position = part.file_from_rest(skins[0].positions.row(row));
  vector = skins[0].displacements.row(row);
  return peak;
}

/// The reactions on the finest grid.
std::vector<PartAnswer::Reaction> reactions_of(const PartSolution& solution, const LoadPart& part,
                                               const LoadCase& loads) {
  std::vector<PartAnswer::Reaction> reactions;
  std::vector<Vec3> centres;  // m
  const auto add = [&](const std::string& text, const PartFace& face) {
    centres.push_back(face.centre);
    reactions.push_back({.fix = text, .area = face.area, .centre = part.file_from_rest(face.centre)});
  };
  for (const PartFix& fix : loads.fixes) add(fix.text, fix.face);
  for (const PartLoad& load : loads.loads) {
    if (load.movement) add(load.text, *load.face);
  }
  const Mat3 here = part.world_from_file.transpose();
  const Simulation& simulation = solution.simulation;
  for (std::size_t row = 0; row < simulation.origins.size(); ++row) {
    const std::vector<Pin>& pins = solution.scene.bodies[simulation.origins[row].body].pins;
    const SoftBody& body = simulation.world.bodies[row];
    const std::vector<PinnedSkin>& skins = simulation.origins[row].pinned_skins;
    for (std::size_t k = 0; k < skins.size(); ++k) {
      const PinnedSkin& skin = skins[k];
      const Vec3 centre =
          centre_of(skin.centre, pins[skin.pin], solution.scene, time_of(solution.scene, 1), solution.is_linear);
      const SkinReaction reaction = reaction_of(skin, body.foundations[k], centre, body, solution.is_linear);
      PartAnswer::Reaction& sum = reactions[skin.pin];
      const Vec3 force = here * reaction.force;
      const Vec3 about = part_from_world(solution, part, skin.centre.transpose()).row(0);  // of the pin
      sum.force += force;
      sum.moment += here * reaction.torque + (about - centres[skin.pin]).cross(force);
    }
  }
  return reactions;
}

}  // namespace

PartAnswer answer_of(const std::vector<PartSolution>& solutions, const LoadPart& part, const LoadCase& loads,
                     const PartBricks& bricks) {
  PartAnswer answer;
  answer.extent = part.loaded.extent;
  answer.is_linear = solutions.front().is_linear;
  for (const Solid& solid : part.loaded.solids) answer.volume += solid.volume;
  answer.mass = answer.volume * part.body.material.density;
  std::vector<PartSkin> skins;
  for (const PartSolution& solution : solutions) {
    answer.brick_sizes.push_back(solution.brick_size);
    answer.brick_counts.push_back(solution.brick_count());
    skins.push_back(skin_of(solution, part));
  }
  answer.bricks_across = bricks.thickness / answer.brick_sizes.front();
  answer.displacement = largest_displacement(skins, answer.brick_sizes, part, answer.displacement_vector);
  SkinScalar von_mises_stress{.skins = skins, .sizes = answer.brick_sizes, .values = {}};
  SkinScalar tension = von_mises_stress;
  SkinScalar compression = von_mises_stress;
  for (const PartSkin& skin : skins) {
    von_mises_stress.values.push_back(von_mises(skin.stresses));
    const Points principal = principal_stresses(skin.stresses).values;
    tension.values.emplace_back(principal.col(0));
    compression.values.emplace_back(-principal.col(2));
  }
  const SingularLines lines(part, solutions.front());
  FoundPeak found = find_peak(von_mises_stress, lines, part);
  answer.von_mises = found.peak;
  answer.singular = std::move(found.singular);
  answer.tension = find_peak(tension, lines, part).peak;
  answer.compression = find_peak(compression, lines, part).peak;
  if (answer.compression) answer.compression->value *= -1;
  answer.reactions = reactions_of(solutions.front(), part, loads);
  return answer;
}

namespace {

/// The solution of one grid at a point in the frame of LoadedBody; none if it is in none of the bricks.
std::optional<PointAnswer> answer_at(const Vec3& position, const PartSolution& solution, const LoadPart& part) {
  for (const SoftBody& body : solution.simulation.world.bodies) {
    const Embedding seat = embed(body.grid, position.transpose());
    if (seat.outside > 0) continue;
    const auto& nodes = body.grid.nodes[std::size_t(seat.brick[0])];
    const StressTensors corners =
        recover_stress(body, body.positions, {nodes.begin(), nodes.end()}, strain_measure(solution.scene));
    StressTensors stress(1, 6);
    stress.row(0) = (corners.transpose() * trilinear_weights(seat.local.row(0))).transpose();
    stress = turned_back(std::move(stress), part.world_from_file);
    const Points moved = deform_points(body.grid, seat, body.positions - body.rest_positions) * part.world_from_file;
    return PointAnswer{.displacement = moved.row(0).transpose(),
                       .stress = stress.row(0).transpose(),
                       .von_mises = {.value = von_mises(stress)[0]}};
  }
  return std::nullopt;
}

}  // namespace

std::vector<PointAnswer> answers_at(const std::vector<Vec3>& points, const std::vector<PartSolution>& solutions,
                                    const LoadPart& part) {
  std::vector<PointAnswer> answers;
  for (const Vec3& point : points) {
    const Vec3 position = part.rest_from_file(point);
    std::optional<PointAnswer> answer = answer_at(position, solutions.front(), part);
    if (!answer) {
      throw Error(ErrorKind::kUsage, fmt::format("--at {:g},{:g},{:g}: the point is not in {}", point.x(), point.y(),
                                                 point.z(), part.loaded.name));
    }
    answer->position = point;
    answer->von_mises.error = solutions.size() == 1 ? std::numeric_limits<double>::infinity() : 0;
    for (std::size_t grid = 1; grid < solutions.size(); ++grid) {
      const std::optional<PointAnswer> coarse = answer_at(position, solutions[grid], part);
      if (!coarse) continue;
      answer->von_mises.error = std::max(answer->von_mises.error,
                                         convergence_index(answer->von_mises.value, coarse->von_mises.value,
                                                           solutions[grid].brick_size / solutions.front().brick_size));
    }
    answers.push_back(*answer);
  }
  return answers;
}

}  // namespace sprung
