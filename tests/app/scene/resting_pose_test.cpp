#include "app/scene/resting_pose.h"

#include <gtest/gtest.h>

#include "core/mesh/io/read_mesh.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

/// The corners of a box, its centre at the origin.
Points corners(const Vec3& sides) {
  Points points(8, 3);
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) points(corner, axis) = ((corner >> axis & 1) - 0.5) * sides[axis];
  }
  return points;
}

/// Points all over a unit sphere.
Points sphere() {
  constexpr int kCount = 3000;
  Points points(kCount, 3);
  for (int i = 0; i < kCount; ++i) {
    const double y = 1 - 2 * (i + 0.5) / kCount;
    points.row(i) << std::sqrt(1 - y * y) * std::cos(2.4 * i), y, std::sqrt(1 - y * y) * std::sin(2.4 * i);
  }
  return points;
}

bool stands(const Points& points, const Vec3& centre_of_mass) {
  return rolled_to_rest(points, centre_of_mass).isIdentity(0);
}

TEST(RestingPose, WhatStandsStaysAsItIs) {
  for (const Points& points : {corners(Vec3(1, 1, 1)), corners(Vec3(1, 4, 1)), corners(Vec3(8, 1, 8)), sphere()}) {
    EXPECT_TRUE(stands(points, Vec3::Zero()));
  }
}

TEST(RestingPose, AHeavyTopTipsOver) {
  const Points points = corners(Vec3(1, 4, 1));
  EXPECT_TRUE(stands(points, Vec3(0.2, 0, 0)));
  EXPECT_FALSE(stands(points, Vec3(0.45, 0, 0)));
}

TEST(RestingPose, ACubeTipsOverWhenItsMiddleStandsOverItsEdge) {
  EXPECT_NEAR(tipping_rise(corners(Vec3(1, 1, 1)), Vec3::Zero()), std::sqrt(0.5) - 0.5, 1e-3);
  EXPECT_NEAR(tipping_rise(corners(Vec3(0.2, 1, 1)), Vec3::Zero()), std::sqrt(0.26) - 0.5, 1e-3);
  EXPECT_NEAR(tipping_rise(sphere(), Vec3::Zero()), 0, 1e-2);
}

TEST(RestingPose, APlateOnItsEdgeLiesFlat) {
  const Points plate = corners(Vec3(10, 6, 0.3));
  EXPECT_FALSE(stands(plate, Vec3::Zero()));
  const Points lying = plate * rolled_to_rest(plate, Vec3::Zero()).transpose();
  EXPECT_TRUE(stands(lying, Vec3::Zero()));
  EXPECT_NEAR(lying.col(1).maxCoeff() - lying.col(1).minCoeff(), 0.3, 0.01);
}

/// A cube that is put down a little askew.
TEST(RestingPose, ABaseThatIsNotLevelIsMadeSo) {
  const Points askew = corners(Vec3(1, 1, 1)) * rotation_matrix(Vec3(7, 0, 4)).transpose();
  const Points level = askew * rolled_to_rest(askew, Vec3::Zero()).transpose();
  EXPECT_NEAR(level.col(1).maxCoeff(), 0.5, 1e-3);
}

TEST(RestingPose, ALongEllipsoidLiesLong) {
  const Points standing = sphere() * Vec3(1, 3, 0.8).asDiagonal();
  const Points lying = standing * rolled_to_rest(standing, Vec3::Zero()).transpose();
  EXPECT_NEAR(lying.col(1).maxCoeff(), 0.8, 0.01);
}

TEST(RestingPose, TheCentreOfMassIsThatOfTheVolumeOrElseOfTheArea) {
  const TempFolder folder;
  SurfaceMesh cube = read_mesh(folder.write("cube.obj", kCubeObj));
  const Vec3 low = cube.positions.colwise().minCoeff();
  const Vec3 high = cube.positions.colwise().maxCoeff();
  EXPECT_TRUE(centre_of_mass(cube).isApprox((low + high) / 2, 1e-12));
  SurfaceMesh sheet;
  sheet.positions = Points{{0, 5, 0}, {3, 5, 0}, {0, 5, 3}};
  sheet.triangles = Triangles{{0, 1, 2}};
  EXPECT_TRUE(centre_of_mass(sheet).isApprox(Vec3(1, 5, 1), 1e-12));
}

/// A plate that stands on its edge in the file: laid flat, unless its rotation is given.
TEST(RestingPose, IsWrittenIntoTheSceneOfADroppedMesh) {
  const TempFolder folder;
  static_cast<void>(folder.write("plate.obj",
                                 "v 0 0 0\nv 19 0 0\nv 19 19 0\nv 0 19 0\nv 0 0 1\nv 19 0 1\nv 19 19 1\nv 0 19 1\n"
                                 "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"));
  const auto first_rotation = [&](const std::string& options) {
    const ProgramRun run = run_program(folder, "animate plate.obj --print-scene " + options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err.find("would tip over") != std::string::npos, options.empty()) << run.err;
    const auto at = run.out.find("\nrotation = ") + 1;
    return run.out.substr(at, run.out.find('\n', at) - at);
  };
  EXPECT_NE(first_rotation(""), "rotation = [0, 0, 0]");
  EXPECT_EQ(first_rotation("--scenario hang"), "rotation = [0, 0, 0]");
  EXPECT_EQ(first_rotation("--set 'body.rotation=[0,0,0]'"), "rotation = [0, 0, 0]");
}

/// Its centre of mass has to rise by 0.0154 of its height before it tips over.
TEST(RestingPose, ASlenderMeshFallsNoHigherThanItMustRiseToTipOver) {
  const TempFolder folder;
  static_cast<void>(folder.write("tower.obj",
                                 "v 0 0 0\nv 1 0 0\nv 1 4 0\nv 0 4 0\nv 0 0 1\nv 1 0 1\nv 1 4 1\nv 0 4 1\n"
                                 "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"));
  const ProgramRun run = run_program(folder, "animate tower.obj --size 1m --material rubber --print-scene");
  const std::string before = "\nposition = [0, ";
  const std::size_t at = run.out.find(before);
  ASSERT_NE(at, std::string::npos) << run.out << run.err;
  EXPECT_NEAR(std::stod(run.out.substr(at + before.size())), (std::sqrt(4.25) - 2) / 4, 2e-4);
}

}  // namespace
}  // namespace sprung
