#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/error.h"
#include "core/simulation/cache.h"
#include "core/simulation/cache_format.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

using Cells = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

Cells rows_of(const std::vector<Eigen::Vector3i>& list) {
  Cells rows(list.size(), 3);
  for (std::size_t i = 0; i < list.size(); ++i) rows.row(i) = list[i];
  return rows;
}

void write_number(Hdf5Writer& hdf5, const std::string& name, double value) {
  hdf5.write(name, std::span<const double>(&value, 1), {1});
}
void write_number(Hdf5Writer& hdf5, const std::string& name, int value) {
  hdf5.write(name, std::span<const int>(&value, 1), {1});
}

template <class Values>
void write_list(Hdf5Writer& hdf5, const std::string& name, const Values& values) {
  hdf5.write(name, std::span(values.data(), values.size()), {values.size()});
}

void write_grid(Hdf5Writer& hdf5, const std::string& folder, const BrickGrid& grid) {
  hdf5.write(folder + "/origin", std::span<const double>(grid.origin.data(), 3), {3});
  write_number(hdf5, folder + "/brick_size", grid.brick_size);
  write_matrix(hdf5, folder + "/cells", rows_of(grid.cells));
  write_list(hdf5, folder + "/fill", grid.fill);
  hdf5.write(folder + "/nodes",
             std::span<const int>(grid.nodes.empty() ? nullptr : grid.nodes[0].data(), 8 * grid.nodes.size()),
             {grid.nodes.size(), 8});
  write_matrix(hdf5, folder + "/lattice", rows_of(grid.lattice));
}

void write_color(Hdf5Writer& hdf5, const std::string& name, const Color& color) {
  write_list(hdf5, name, std::array<std::uint8_t, 3>{color.red, color.green, color.blue});
}

void write_embedding(Hdf5Writer& hdf5, const std::string& folder, const Embedding& embedding) {
  write_list(hdf5, folder + "/brick", embedding.brick);
  write_matrix(hdf5, folder + "/place_in_brick", embedding.local);
}

/// A surface in the folder of a body, whose skin has its materials.
void write_surface(Hdf5Writer& hdf5, const std::string& folder, const SurfaceMesh& mesh) {
  write_skin(hdf5, folder,
             {.positions = mesh.positions,
              .normals = mesh.normals.cast<double>(),
              .uvs = mesh.uvs,
              .colors = mesh.colors,
              .triangles = mesh.triangles,
              .parts = mesh.parts,
              .materials = {}});
}

/// Only some models want them.
void write_moments(Hdf5Writer& hdf5, const std::string& folder, const std::vector<SolidMoments>& moments) {
  Points centroids(moments.size(), 3);
  Points covariances(3 * moments.size(), 3);
  for (std::size_t brick = 0; brick < moments.size(); ++brick) {
    centroids.row(Eigen::Index(brick)) = moments[brick].centroid;
    covariances.middleRows<3>(Eigen::Index(3 * brick)) = moments[brick].covariance;
  }
  write_matrix(hdf5, folder + "/centroids", centroids);
  write_matrix(hdf5, folder + "/covariances", covariances);
}

void write_origin(Hdf5Writer& hdf5, const std::string& folder, const Origin& origin) {
  write_number(hdf5, folder + "/body", int(origin.body));
  write_number(hdf5, folder + "/copy", origin.copy);
  write_list(hdf5, folder + "/regions", origin.regions);
  write_list(hdf5, folder + "/pinned", origin.pinned_nodes());
  write_list(hdf5, folder + "/mesh/vertices", origin.file_vertices);
  write_embedding(hdf5, folder + "/mesh", origin.file_embedding);
}

void write_body(Hdf5Writer& hdf5, const std::string& folder, const SoftBody& body, bool is_exact) {
  write_color(hdf5, folder + "/color", body.drawn.color);
  write_grid(hdf5, folder, body.grid);
  if (body.model == Model::kCalibrated) write_moments(hdf5, folder, body.grid.moments);
  write_list(hdf5, folder + "/stiffness_scale", body.stiffness_scale);
  hdf5.write(folder + "/masses", flat_values(body.masses), {std::size_t(body.masses.size())});
  write_matrix(hdf5, folder + "/rest_positions", body.rest_positions);
  write_skin(hdf5, folder + "/skin", body.drawn.skin);
  write_embedding(hdf5, folder + "/skin", body.drawn.embedding);
  if (body.drawn.mesh != nullptr) write_surface(hdf5, folder + "/surface", *body.drawn.mesh);
  const ArrayShape state{std::size_t(body.rest_positions.rows()), 3};
  hdf5.make_series<double>(folder + "/positions", state);
  hdf5.make_series<double>(folder + "/velocities", state);
  hdf5.make_slots(folder + kExactName, 2, is_exact ? 0 : 6 * state[0]);
}

void write_obstacle(Hdf5Writer& hdf5, const std::string& folder, const StageObstacle& obstacle) {
  write_color(hdf5, folder + "/color", obstacle.color);
  hdf5.write(folder + "/translation", std::span<const double>(obstacle.start.translation.data(), 3), {3});
  write_matrix(hdf5, folder + "/rotation", Points(obstacle.start.rotation));
  write_skin(hdf5, folder + "/skin", obstacle.skin);
}

/// Rounds to multiples of the largest power of two that respects the error; not at all if that is 0.
void append_rounded(Hdf5Writer& hdf5, const std::string& name, const Points& values, double error) {
  if (error == 0) return hdf5.append(name, flat_values(values));
  const double step = std::exp2(std::floor(std::log2(2 * error)));
  const Points rounded = (values / step).array().round() * step;
  hdf5.append(name, flat_values(rounded));
}

void write_header(Hdf5Writer& hdf5, const CacheHeader& header) {
  const Simulation& simulation = header.simulation;
  const std::vector<SoftBody>& bodies = simulation.world.bodies;
  write_number(hdf5, kLayoutName, kCacheLayout);
  hdf5.write_text("/version", header.version);
  hdf5.write_text("/build", header.build);
  hdf5.write_text("/scene", header.scene);
  hdf5.write_text("/progress_name", header.progress_name);
  write_number(hdf5, "/size", simulation.size);
  write_number(hdf5, "/position_error", header.position_error);
  write_number(hdf5, "/velocity_error", header.velocity_error);
  hdf5.write_texts("/probes", header.probes);
  write_number(hdf5, "/mesh_count", isize(simulation.meshes));
  write_number(hdf5, "/actor_count", isize(bodies));
  write_number(hdf5, "/obstacle_count", isize(simulation.obstacles));
  for (std::size_t i = 0; i < simulation.meshes.size(); ++i) write_skin(hdf5, mesh_folder(i), simulation.meshes[i]);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    write_origin(hdf5, body_folder(i), simulation.origins[i]);
    write_body(hdf5, body_folder(i), bodies[i], header.position_error == 0);
  }
  for (std::size_t i = 0; i < simulation.obstacles.size(); ++i) {
    write_obstacle(hdf5, obstacle_folder(i), simulation.obstacles[i]);
  }
}

}  // namespace

CacheWriter::CacheWriter(fs::path file, const CacheHeader& header, std::size_t memory_size)
    : lock_(PartialFile::temporary_name(file)),
      file_(std::move(file)),
      position_error_(header.position_error),
      velocity_error_(header.velocity_error),
      hdf5_(file_.path()) {
  write_header(hdf5_, header);
  hdf5_.make_series<double>(kProgressName, {});
  hdf5_.make_series<double>(kProbesName, {header.probes.size(), kNumbersOfProbe});
  hdf5_.make_series<std::uint64_t>(kHashName, {});
  hdf5_.make_series<double>(kSecondsName, {});
  hdf5_.make_slots(kMemoryName, 2, memory_size);
  hdf5_.start_series();
}

void CacheWriter::append(const CachedFrame& frame, const std::vector<const Points*>& positions,
                         const std::vector<const Points*>& velocities, const std::vector<double>& memory) {
  if (!lock_.is_of(file_.path())) {
    throw Error(ErrorKind::kFailed,
                fmt::format("'{}' was removed or replaced while it was being written", file_.path().string()));
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::string folder = body_folder(i);
    append_rounded(hdf5_, folder + "/positions", *positions[i], position_error_);
    append_rounded(hdf5_, folder + "/velocities", *velocities[i], velocity_error_);
    if (position_error_ == 0) continue;
    std::vector<double> exact(positions[i]->data(), positions[i]->data() + positions[i]->size());
    exact.insert(exact.end(), velocities[i]->data(), velocities[i]->data() + velocities[i]->size());
    hdf5_.fill_slot(folder + kExactName, frames_ % 2, exact);
  }
  hdf5_.append(kProbesName, std::span<const double>(frame.probes));
  hdf5_.append(kHashName, std::span<const std::uint64_t>(&frame.state_hash, 1));
  hdf5_.append(kSecondsName, std::span<const double>(&frame.seconds, 1));
  hdf5_.fill_slot(kMemoryName, frames_ % 2, memory);
  hdf5_.append(kProgressName, std::span<const double>(&frame.progress, 1));
  ++frames_;
}

void CacheWriter::publish() {
  file_.publish();
  hdf5_.rename(file_.path());
}

void CacheWriter::close() { hdf5_.close(); }

bool is_cache_file(const fs::path& file) { return file.extension() == ".h5"; }

}  // namespace sprung
