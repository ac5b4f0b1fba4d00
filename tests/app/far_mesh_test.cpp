#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/scene/film.h"
#include "core/bricks/voxelize.h"
#include "core/simulation/body_source.h"
#include "tests/support/mesh_text.h"
#include "tests/support/meshes.h"
#include "tests/support/run_program.h"

/// Meshes have no absolute scale: scaled by any factor and moved far away they give the same bricks.
namespace sprung {
namespace {

/// A mesh in a text format, with all digits of its coordinates.
std::string obj_text(const SurfaceMesh& mesh) {
  std::string text;
  for (const auto& p : mesh.positions.rowwise()) text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  for (const auto& t : mesh.triangles.rowwise()) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

std::string ply_text(const SurfaceMesh& mesh) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.positions.rows(), mesh.triangles.rows());
  const std::string off = off_text(mesh);
  return text + off.substr(off.find('\n', 4) + 1);
}

std::string stl_text(const SurfaceMesh& mesh) {
  std::string text = "solid torus\n";
  for (const auto& t : mesh.triangles.rowwise()) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int vertex : t) {
      const auto p = mesh.positions.row(vertex);
      text += fmt::format("vertex {} {} {}\n", p[0], p[1], p[2]);
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

class FarMesh : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] std::string text_of_format(const SurfaceMesh& mesh) const {
    if (GetParam() == "obj") return obj_text(mesh);
    if (GetParam() == "off") return off_text(mesh);
    return GetParam() == "ply" ? ply_text(mesh) : stl_text(mesh);
  }

  /// The bricks of the mesh brought to 1 m by the program; what it warned of goes to `warnings`.
  [[nodiscard]] BrickGrid bricks_of(const SurfaceMesh& mesh) const {
    SceneBody body = default_body();
    body.mesh = folder_.write("torus." + GetParam(), text_of_format(mesh));
    body.size = 1;
    testing::internal::CaptureStderr();
    const LoadedBody loaded = load_body(body, Observer());
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(loaded.solids.size(), 1U);
    return voxelize(loaded.solids.at(0), 1.0 / 16);
  }

 private:
  TempFolder folder_;
};

TEST_P(FarMesh, GivesTheSameBricksAtAnyScaleAndPlace) {
  const SurfaceMesh torus = test::torus_mesh(0.37, 0.13, 48, 24);
  const BrickGrid expected = bricks_of(torus);
  EXPECT_GT(expected.cells.size(), 500U);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    for (const double sizes : {0.0, 1e6}) {
      SurfaceMesh moved = torus;
      moved.positions = scale * (torus.positions.rowwise() + sizes * Vec3(1, -0.3, 0.7).transpose());
      const BrickGrid bricks = bricks_of(moved);
      EXPECT_EQ(bricks.cells, expected.cells) << "scaled by " << scale << ", moved by " << sizes;
      ASSERT_EQ(bricks.fill.size(), expected.fill.size());
      double worst = 0;
      for (std::size_t i = 0; i < bricks.fill.size(); ++i) {
        worst = std::max(worst, std::abs(bricks.fill[i] - expected.fill[i]));
      }
      EXPECT_LT(worst, 1e-3) << "scaled by " << scale << ", moved by " << sizes;
    }
  }
}

TEST_P(FarMesh, GivesTheSameBricksWithVerticesThatNoTriangleUses) {
  const SurfaceMesh torus = test::torus_mesh(0.37, 0.13, 48, 24);
  SurfaceMesh littered = torus;
  littered.positions.conservativeResize(torus.positions.rows() + 1, 3);
  littered.positions.bottomRows(1).setConstant(1e3);
  EXPECT_EQ(bricks_of(littered).cells, bricks_of(torus).cells);
}

INSTANTIATE_TEST_SUITE_P(TextFormats, FarMesh, testing::Values("obj", "off", "ply", "stl"),
                         [](const auto& format) { return format.param; });

TEST(FarMeshInSinglePrecision, IsWarnedOf) {
  const TempFolder folder;
  std::string bytes(80, ' ');
  const SurfaceMesh box = test::box_mesh(Vec3(1e5, 0, 0), Vec3(1e5 + 1, 1, 1));
  const auto count = static_cast<std::uint32_t>(box.triangles.rows());
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& t : box.triangles.rowwise()) {
    bytes.append(12, '\0');
    for (const int vertex : t) {
      const Eigen::RowVector3f p = box.positions.row(vertex).cast<float>();
      bytes.append(reinterpret_cast<const char*>(p.data()), 12);
    }
    bytes.append(2, '\0');
  }
  static_cast<void>(folder.write("far.stl", bytes));
  const ProgramRun ended = run_program(folder, "simulate far.stl -o out --bricks 4 --duration 0.05");
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("in the single precision of its format"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace sprung
