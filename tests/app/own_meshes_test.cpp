#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/io/mesh_export.h"
#include "tests/support/mesh_row.h"
#include "tests/support/mesh_text.h"
#include "tests/support/meshes.h"

/// Meshes of known properties and faults, in all formats, given to the built program.
namespace sprung {
namespace {

using test::box_mesh;
using test::joined;

SurfaceMesh ring() { return test::torus_mesh(2, 0.7, 48, 24); }

SurfaceMesh with_triangles(const SurfaceMesh& mesh, const Triangles& triangles) {
  return test::mesh_of(mesh.positions, triangles);
}

SurfaceMesh with_rows(const SurfaceMesh& mesh, const Triangles& more) {
  Triangles all(mesh.triangles.rows() + more.rows(), 3);
  all << mesh.triangles, more;
  return with_triangles(mesh, all);
}

SurfaceMesh flipped(SurfaceMesh mesh, int count) {
  for (int t = 0; t < count; ++t) std::swap(mesh.triangles(t, 1), mesh.triangles(t, 2));
  return mesh;
}

SurfaceMesh sheet() {
  const SurfaceMesh mesh = box_mesh(Vec3::Zero(), Vec3(1, 0, 1));
  return with_triangles(mesh, mesh.triangles.middleRows(6, 2));
}

/// In the format that the name ends in.
void write_mesh(const SurfaceMesh& mesh, const std::filesystem::path& file) {
  if (file.extension() == ".off") {
    std::ofstream(file) << off_text(mesh);
    return;
  }
  const Skin skin = make_skin(mesh, {});
  PosedMesh posed;
  posed.name = "mesh";
  posed.rest = &skin;
  posed.positions = skin.positions;
  posed.normals = skin.normals;
  export_meshes({posed}, file);
}

struct OwnMesh {
  MeshRow row;
  std::function<void(const std::filesystem::path&)> write;
};

OwnMesh own(const MeshRow& row, const SurfaceMesh& mesh) {
  return {row, [mesh](const std::filesystem::path& file) { write_mesh(mesh, file); }};
}

OwnMesh text(const MeshRow& row, const std::string& bytes) {
  return {row, [bytes](const std::filesystem::path& file) { std::ofstream(file, std::ios::binary) << bytes; }};
}

std::vector<OwnMesh> own_meshes() {
  const double ring_volume = test::signed_volume(ring().positions, ring().triangles);
  const SurfaceMesh cube = box_mesh(Vec3::Zero(), Vec3::Ones());
  const SurfaceMesh apart = joined(cube, box_mesh(Vec3(2, 0, 0), Vec3(3, 1, 1)));
  const SurfaceMesh through = joined(cube, box_mesh(Vec3(0.5, 0.25, 0.25), Vec3(1.5, 0.75, 0.75)));
  const SurfaceMesh hollow = joined(cube, test::inside_out(box_mesh(Vec3::Constant(0.25), Vec3::Constant(0.75))));
  std::vector<OwnMesh> all{
      own({"hollow.ply", 16, 24, true, 1, 1 - 0.125, {}, ""}, hollow),
      own({"inside_out.ply", 1152, 2304, true, 1, ring_volume, {"inside_out"}, "outwards"}, test::inside_out(ring())),
      own({"some_flipped.off", 1152, 2304, true, 1, ring_volume, {"oriented"}, "to agree with their neighbours"},
          flipped(ring(), 40)),
      own({"hole.stl", 1152, 2300, false, 1, {}, {"hole_filled"}, "filled 1 hole"},
          test::without_triangles(ring(), 100, 4)),
      own({"doubled.off", 1152, 2307, true, 1, ring_volume, {"duplicate"}, "repeated"},
          with_rows(ring(), ring().triangles.topRows(3))),
      own({"degenerate.off", 1152, 2306, true, 1, ring_volume, {"degenerate"}, "without area"},
          with_rows(ring(), (Triangles(2, 3) << 0, 1, 1, 5, 5, 5).finished())),
      own({"two.dae", 16, 24, true, 2, 2, {}, ""}, apart),
      own({"overlapping.glb", 16, 24, true, 1, {}, {"united", "self_intersection"}, "united"}, through),
      own({"sheet.ply", 0, 0, false, 0, {}, {}, "encloses no volume; ask for a shell with --thickness"}, sheet()),
      text(refused("empty.obj", "empty file"), ""),
      text(refused("beyond.obj", "face 1 refers to vertex 12 of 3 (index out of range)"),
           "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 12\n"),
      text(refused("nan.obj", "vertex 1 has a coordinate that is not finite"),
           "v nan 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"),
      text(refused("points.ply", "no faces (a point cloud)"),
           "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
           "end_header\n0 0 0\n1 0 0\n"),
      text(refused("huge.off", "header declares 353535235358 vertices, more than the file can hold"),
           "OFF\n353535235358 12 0\n0 0 0\n"),
      {refused("cut.glb", "file is shorter"), [](const std::filesystem::path& file) {
         write_mesh(ring(), file);
         std::filesystem::resize_file(file, 700);
       }}};
  for (const MeshFormat& format : mesh_formats()) {
    all.push_back(own({"ring" + std::string(format.extension), 1152, 2304, true, 1, ring_volume, {}, ""}, ring()));
  }
  return all;
}

class OwnMeshes : public testing::TestWithParam<OwnMesh> {
 protected:
  TempFolder folder_;
};

TEST_P(OwnMeshes, AreReadRepairedOrRefused) {
  const std::filesystem::path file = folder_.path() / GetParam().row.file;
  GetParam().write(file);
  expect_row(folder_, file.string(), GetParam().row, 16);
}

INSTANTIATE_TEST_SUITE_P(All, OwnMeshes, testing::ValuesIn(own_meshes()), [](const auto& tested) {
  std::string name = tested.param.row.file;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

}  // namespace
}  // namespace sprung
