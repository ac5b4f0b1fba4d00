#include "app/export/posed_meshes.h"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <set>

#include "app/film/film_stage.h"
#include "core/bricks/embedding.h"
#include "core/unit_rows.h"

namespace sprung {
namespace {

/// A body of the scene, or one of its copies.
using BodyCopy = std::pair<std::size_t, int>;

BodyCopy copy_of(const Origin& origin) { return {origin.body, origin.copy}; }

std::string name_of(const Film& film, const BodyCopy& which) {
  const SceneBody& body = film.bodies[which.first];
  std::string name = body.mesh.empty() ? std::string("body") : body.mesh.stem().string();
  if (film.bodies.size() > 1) name += fmt::format("_{}", which.first + 1);
  if (copy_count(body) > 1) name += fmt::format("_{}", which.second + 1);
  return name;
}

PosedMesh empty_mesh(const Simulation& simulation, const Film& film, const BodyCopy& which, const Color& color) {
  const Skin& rest = simulation.meshes[which.first];
  PosedMesh mesh;
  mesh.name = name_of(film, which);
  mesh.rest = &rest;
  mesh.color = srgb(color);
  mesh.positions.setZero(rest.positions.rows(), 3);
  mesh.normals.setZero(rest.normals.rows(), 3);
  return mesh;
}

}  // namespace

std::vector<PosedMesh> posed_meshes(const Simulation& simulation, const Film& film, const std::vector<Points>& nodes) {
  std::map<BodyCopy, PosedMesh> meshes;
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    const SoftBody& body = simulation.world.bodies[row];
    const Origin& origin = simulation.origins[row];
    const BodyCopy which = copy_of(origin);
    if (!meshes.contains(which)) meshes[which] = empty_mesh(simulation, film, which, body.drawn.color);
    PosedMesh& mesh = meshes[which];
    mesh.positions(origin.file_vertices, Eigen::all) = deform_points(body.grid, origin.file_embedding, nodes[row]);
    if (mesh.normals.rows() == 0) continue;
    const Points rest = mesh.rest->normals(origin.file_vertices, Eigen::all);
    mesh.normals(origin.file_vertices, Eigen::all) =
        unit_rows(deform_normals(body.grid, origin.file_embedding, rest, nodes[row]));
  }
  std::vector<PosedMesh> list;
  list.reserve(meshes.size());
  for (auto& [which, mesh] : meshes) list.push_back(std::move(mesh));
  return list;
}

std::vector<std::size_t> meshes_of_bodies(const Simulation& simulation) {
  std::set<BodyCopy> copies;
  for (const Origin& origin : simulation.origins) copies.insert(copy_of(origin));
  std::vector<std::size_t> rows;
  for (const Origin& origin : simulation.origins) {
    rows.push_back(std::size_t(std::distance(copies.begin(), copies.find(copy_of(origin)))));
  }
  return rows;
}

std::size_t mesh_count(const Film& film) {
  std::size_t count = 0;
  for (const SceneBody& body : film.bodies) count += std::size_t(copy_count(body));
  return count;
}

}  // namespace sprung
