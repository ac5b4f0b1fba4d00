#include "app/export/posed_meshes.h"

#include <fmt/format.h>

#include <map>

#include "app/drawn_shapes.h"

namespace sprung {
namespace {

/// A body of the scene, or one of its copies.
using BodyCopy = std::pair<std::size_t, int>;

std::string name_of(const Scene& scene, const BodyCopy& which) {
  const SceneBody& body = scene.bodies[which.first];
  std::string name = body.mesh.empty() ? std::string("body") : body.mesh.stem().string();
  if (scene.bodies.size() > 1) name += fmt::format("_{}", which.first + 1);
  if (copy_count(body) > 1) name += fmt::format("_{}", which.second + 1);
  return name;
}

PosedMesh empty_mesh(const Production& production, const Scene& scene, const BodyCopy& which, const Color& color) {
  const Skin& rest = production.meshes[which.first];
  PosedMesh mesh;
  mesh.name = name_of(scene, which);
  mesh.rest = &rest;
  mesh.color = srgb(color);
  mesh.positions.setZero(rest.positions.rows(), 3);
  mesh.normals.setZero(rest.normals.rows(), 3);
  return mesh;
}

}  // namespace

std::vector<PosedMesh> posed_meshes(const Production& production, const Scene& scene,
                                    const std::vector<Points>& nodes) {
  std::map<BodyCopy, PosedMesh> meshes;
  for (std::size_t actor = 0; actor < nodes.size(); ++actor) {
    const BodyCopy which{production.origins[actor].body, production.origins[actor].copy};
    if (!meshes.contains(which)) meshes[which] = empty_mesh(production, scene, which, production.skins[actor].color);
    PosedMesh& mesh = meshes[which];
    const CarriedVertices& carried = production.carried[actor];
    const BrickGrid& grid = production.world.actors[actor].body.grid;
    const Points& positions = nodes[actor];
    mesh.positions(carried.vertices, Eigen::all) = deform_points(grid, carried.embedding, positions);
    if (mesh.normals.rows() == 0) continue;
    const Points rest = mesh.rest->normals(carried.vertices, Eigen::all);
    mesh.normals(carried.vertices, Eigen::all) =
        deform_normals(grid, carried.embedding, rest, positions).rowwise().normalized();
  }
  std::vector<PosedMesh> list;
  list.reserve(meshes.size());
  for (auto& [which, mesh] : meshes) list.push_back(std::move(mesh));
  return list;
}

}  // namespace sprung
