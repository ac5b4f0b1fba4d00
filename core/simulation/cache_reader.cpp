#include <fmt/format.h>

#include "core/error.h"
#include "core/files.h"
#include "core/simulation/cache.h"
#include "core/simulation/cache_format.h"

namespace sprung {
namespace {

using Cells = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Bricks = Eigen::Matrix<int, Eigen::Dynamic, 8, Eigen::RowMajor>;
using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 1>;

std::vector<Eigen::Vector3i> list_of(const Cells& rows) {
  std::vector<Eigen::Vector3i> list;
  list.reserve(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) list.emplace_back(rows.row(i));
  return list;
}

BrickGrid read_grid(const Hdf5Reader& hdf5, const std::string& folder) {
  BrickGrid grid;
  grid.origin = read_matrix<Numbers>(hdf5, folder + "/origin");
  grid.brick_size = hdf5.read<double>(folder + "/brick_size").values.at(0);
  grid.cells = list_of(read_matrix<Cells>(hdf5, folder + "/cells"));
  grid.fill = hdf5.read<double>(folder + "/fill").values;
  const auto bricks = read_matrix<Bricks>(hdf5, folder + "/nodes");
  grid.nodes.resize(bricks.rows());
  std::copy_n(bricks.data(), bricks.size(), grid.nodes.empty() ? nullptr : grid.nodes[0].data());
  grid.lattice = list_of(read_matrix<Cells>(hdf5, folder + "/lattice"));
  return grid;
}

std::vector<SolidMoments> read_moments(const Hdf5Reader& hdf5, const std::string& folder) {
  const auto centroids = read_matrix<Points>(hdf5, folder + "/centroids");
  const auto covariances = read_matrix<Points>(hdf5, folder + "/covariances");
  std::vector<SolidMoments> moments(centroids.rows());
  for (std::size_t brick = 0; brick < moments.size(); ++brick) {
    moments[brick].centroid = centroids.row(Eigen::Index(brick));
    moments[brick].covariance = covariances.middleRows<3>(Eigen::Index(3 * brick));
  }
  return moments;
}

Color read_color(const Hdf5Reader& hdf5, const std::string& name) {
  const std::vector<std::uint8_t> values = hdf5.read<std::uint8_t>(name).values;
  return {values.at(0), values.at(1), values.at(2)};
}

/// See write_surface().
SurfaceMesh read_surface(const Hdf5Reader& hdf5, const std::string& folder, const Skin& skin) {
  Skin surface = read_skin(hdf5, folder);
  SurfaceMesh mesh;
  mesh.positions = std::move(surface.positions);
  mesh.triangles = std::move(surface.triangles);
  mesh.normals = surface.normals.cast<float>();
  mesh.uvs = std::move(surface.uvs);
  mesh.colors = std::move(surface.colors);
  mesh.parts = std::move(surface.parts);
  mesh.materials = skin.materials;
  return mesh;
}

Origin read_origin(const Hdf5Reader& hdf5, const std::string& folder) {
  Origin origin;
  origin.body = hdf5.read<int>(folder + "/body").values.at(0);
  origin.copy = hdf5.read<int>(folder + "/copy").values.at(0);
  origin.regions = hdf5.read<int>(folder + "/regions").values;
  if (hdf5.has(folder + "/pinned")) {
    std::vector<int> pinned = hdf5.read<int>(folder + "/pinned").values;
    if (!pinned.empty()) origin.pins.push_back({.pin = 0, .nodes = std::move(pinned)});
  }
  origin.file_vertices = hdf5.read<int>(folder + "/mesh/vertices").values;
  origin.file_embedding.brick = hdf5.read<int>(folder + "/mesh/brick").values;
  origin.file_embedding.local = read_matrix<Points>(hdf5, folder + "/mesh/place_in_brick");
  return origin;
}

SoftBody read_body(const Hdf5Reader& hdf5, const std::string& folder) {
  SoftBody body;
  body.drawn.color = read_color(hdf5, folder + "/color");
  body.grid = read_grid(hdf5, folder);
  if (hdf5.has(folder + "/centroids")) body.grid.moments = read_moments(hdf5, folder);
  body.stiffness_scale = hdf5.read<double>(folder + "/stiffness_scale").values;
  body.masses = read_matrix<Numbers>(hdf5, folder + "/masses");
  body.rest_positions = read_matrix<Points>(hdf5, folder + "/rest_positions");
  body.positions = body.rest_positions;
  body.drawn.skin = read_skin(hdf5, folder + "/skin");
  body.drawn.embedding.brick = hdf5.read<int>(folder + "/skin/brick").values;
  body.drawn.embedding.local = read_matrix<Points>(hdf5, folder + "/skin/place_in_brick");
  if (hdf5.has(folder + "/surface")) {
    body.drawn.mesh = std::make_shared<const SurfaceMesh>(read_surface(hdf5, folder + "/surface", body.drawn.skin));
  }
  return body;
}

StageObstacle read_obstacle(const Hdf5Reader& hdf5, const std::string& folder) {
  StageObstacle obstacle;
  obstacle.color = read_color(hdf5, folder + "/color");
  obstacle.start.translation = read_matrix<Numbers>(hdf5, folder + "/translation");
  obstacle.start.rotation = read_matrix<Points>(hdf5, folder + "/rotation");
  obstacle.skin = read_skin(hdf5, folder + "/skin");
  return obstacle;
}

Hdf5Reader open_cache(const std::filesystem::path& file) {
  check_readable(file);
  Hdf5Reader hdf5(file);
  if (!hdf5.has(kLayoutName) || !hdf5.has(kProgressName)) {
    throw Error(ErrorKind::kBadInput, fmt::format("'{}' is an HDF5 file, but no cache of sprung", file.string()));
  }
  const int layout = hdf5.read<int>(kLayoutName).values.at(0);
  if (layout != kCacheLayout) {
    throw Error(ErrorKind::kBadInput, fmt::format("'{}' has layout {}; this program reads layout {}: simulate anew",
                                                  file.string(), layout, kCacheLayout));
  }
  return hdf5;
}

CacheHeader read_header(const Hdf5Reader& hdf5) {
  CacheHeader header;
  Simulation& simulation = header.simulation;
  header.version = hdf5.read_text("/version");
  header.build = hdf5.read_text("/build");
  header.scene = hdf5.read_text("/scene");
  header.progress_name = hdf5.read_text("/progress_name");
  simulation.size = hdf5.read<double>("/size").values.at(0);
  header.position_error = hdf5.read<double>("/position_error").values.at(0);
  header.velocity_error = hdf5.read<double>("/velocity_error").values.at(0);
  header.probes = hdf5.read_texts("/probes");
  const std::size_t meshes = hdf5.read<int>("/mesh_count").values.at(0);
  const std::size_t bodies = hdf5.read<int>("/actor_count").values.at(0);
  const std::size_t obstacles = hdf5.read<int>("/obstacle_count").values.at(0);
  for (std::size_t i = 0; i < meshes; ++i) simulation.meshes.push_back(read_skin(hdf5, mesh_folder(i)));
  for (std::size_t i = 0; i < bodies; ++i) {
    simulation.world.bodies.push_back(read_body(hdf5, body_folder(i)));
    simulation.origins.push_back(read_origin(hdf5, body_folder(i)));
  }
  for (std::size_t i = 0; i < obstacles; ++i) simulation.obstacles.push_back(read_obstacle(hdf5, obstacle_folder(i)));
  return header;
}

}  // namespace

CacheReader::CacheReader(const std::filesystem::path& file)
    : hdf5_(open_cache(file)), header_(read_header(hdf5_)), frame_count_(hdf5_.shape_of(kProgressName).at(0)) {}

namespace {

/// Caches of before some quantities were probed have fewer numbers of each.
std::vector<double> filled_up(const std::vector<double>& numbers, std::size_t probes) {
  if (probes == 0 || numbers.size() == probes * kNumbersOfProbe) return numbers;
  const std::size_t of_each = std::min(numbers.size() / probes, kNumbersOfProbe);
  std::vector<double> filled(probes * kNumbersOfProbe, 0);
  for (std::size_t probe = 0; probe < probes; ++probe) {
    for (std::size_t i = 0; i < of_each; ++i) {
      filled[probe * kNumbersOfProbe + i] = numbers[probe * (numbers.size() / probes) + i];
    }
  }
  return filled;
}

}  // namespace

CachedFrame CacheReader::frame(std::size_t frame) const {
  return {.progress = hdf5_.read_row<double>(kProgressName, frame).values.at(0),
          .probes = filled_up(hdf5_.read_row<double>(kProbesName, frame).values, header_.probes.size()),
          .state_hash = hdf5_.read_row<std::uint64_t>(kHashName, frame).values.at(0),
          .seconds = hdf5_.read_row<double>(kSecondsName, frame).values.at(0)};
}

std::vector<Points> CacheReader::positions(std::size_t frame) const { return states("/positions", frame); }

std::vector<Points> CacheReader::velocities(std::size_t frame) const { return states("/velocities", frame); }

std::vector<Points> CacheReader::exact_positions(std::size_t frame) const {
  return header_.position_error > 0 ? exact_states(0, frame) : positions(frame);
}

std::vector<Points> CacheReader::exact_velocities(std::size_t frame) const {
  return header_.position_error > 0 ? exact_states(1, frame) : velocities(frame);
}

std::vector<double> CacheReader::memory(std::size_t frame) const {
  return hdf5_.read_row<double>(kMemoryName, frame % 2).values;
}

std::vector<Points> CacheReader::states(const char* name, std::size_t frame) const {
  std::vector<Points> all;
  for (std::size_t i = 0; i < header_.simulation.world.bodies.size(); ++i) {
    const std::string path = body_folder(i) + name;
    all.push_back(matrix_from<Points>(hdf5_.read_row<double>(path, frame), path));
  }
  return all;
}

std::vector<Points> CacheReader::exact_states(std::size_t which, std::size_t frame) const {
  std::vector<Points> all;
  for (std::size_t i = 0; i < header_.simulation.world.bodies.size(); ++i) {
    const std::vector<double> row = hdf5_.read_row<double>(body_folder(i) + kExactName, frame % 2).values;
    const Eigen::Index nodes = header_.simulation.world.bodies[i].rest_positions.rows();
    all.emplace_back(Eigen::Map<const Points>(row.data() + Eigen::Index(which) * 3 * nodes, nodes, 3));
  }
  return all;
}

}  // namespace sprung
