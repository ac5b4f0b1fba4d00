#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>

#include "tests/support/meshes.h"
#include "tests/support/run_program.h"

/// Files that are no mesh, given to the built program: each ends soon, small, with exit code 3 and one clear line.
namespace sprung {
namespace {

constexpr double kMostSeconds = 5;
constexpr long kMostKilobytes = 500'000;

struct BadFile {
  std::string name;
  std::string reason;
};

/// As GoogleTest wants the names of its tests.
std::string test_name(std::string file) {
  std::replace(file.begin(), file.end(), '.', '_');
  return file;
}

/// The most memory that one of the processes took that have ended so far; only rises.
long peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return usage.ru_maxrss;
}

void expect_refusal(const TempFolder& folder, const std::string& file, const std::string& reason) {
  const auto start = std::chrono::steady_clock::now();
  const ProgramRun ended = run_program(folder, "simulate '" + file + "' -o out");
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(ended.exit_code, 3) << ended.err;
  EXPECT_LT(seconds, kMostSeconds);
  EXPECT_LT(peak_kilobytes(), kMostKilobytes);
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_NE(ended.err.find("sprung: error: " + file), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(reason), std::string::npos) << ended.err;
  EXPECT_EQ(ended.out, "");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

class SharedBadMesh : public testing::TestWithParam<BadFile> {};

TEST_P(SharedBadMesh, IsRefusedInOneLine) {
  const auto file = test::shared_mesh("bad/" + GetParam().name);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the shared meshes are not here";
  const TempFolder folder;
  expect_refusal(folder, std::filesystem::canonical(file).string(), GetParam().reason);
}

INSTANTIATE_TEST_SUITE_P(
    All, SharedBadMesh,
    testing::Values(BadFile{"empty.obj", "empty file"},
                    BadFile{"malformed.obj", "face 1 refers to vertex 12 of 8 (index out of range)"},
                    BadFile{"inf_nan.obj", "vertex 1 has a coordinate that is not finite"},
                    BadFile{"truncated.glb", "file is shorter (700) than its header says (1012)"},
                    BadFile{"points.ply", "no faces (a point cloud)"},
                    BadFile{"OutOfMemory.off", "header declares 353535235358 vertices, more than the file can hold"}),
    [](const auto& bad) { return test_name(bad.param.name); });

/// The same for files made here, which the readers of other formats crash, hang or give up on.
class BadMesh : public testing::TestWithParam<std::pair<BadFile, std::string>> {};

TEST_P(BadMesh, IsRefusedInOneLine) {
  const auto& [bad, text] = GetParam();
  const TempFolder folder;
  expect_refusal(folder, folder.write(bad.name, text).string(), bad.reason);
}

const std::string kPlyStart = "ply\nformat ascii 1.0\nelement vertex 3\n";

/// A Collada file with one triangle that refers to vertices that are not there.
const std::string kDae =
    "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><library_geometries>"
    "<geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"9\">0 0 0 1 0 0 0 1 0</float_array>"
    "<technique_common><accessor source=\"#a\" count=\"3\" stride=\"3\"/></technique_common></source>"
    "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\">"
    "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 7</p></triangles></mesh></geometry>"
    "</library_geometries></COLLADA>";

INSTANTIATE_TEST_SUITE_P(
    All, BadMesh,
    testing::Values(std::pair{BadFile{"cut.ply", "no 'end_header'"}, kPlyStart},
                    std::pair{BadFile{"cut.stl", "the file ends inside facet 1: it is cut short"},
                              std::string("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n")},
                    std::pair{BadFile{"wrong.obj", "no vertices and no faces"},
                              std::string("<!DOCTYPE html><html></html>\n")},
                    std::pair{BadFile{"wrong.gltf", "not a valid mesh file"}, std::string("{\"asset\": 3}")},
                    std::pair{BadFile{"meshopt.gltf", "EXT_meshopt_compression, which is not supported"},
                              std::string("{\"extensionsRequired\": [\"EXT_meshopt_compression\"]}")},
                    std::pair{BadFile{"wrong.fbx", "not a valid mesh file"},
                              std::string("Kaydara FBX Binary  \0\x1A\0 garbage", 31)},
                    std::pair{BadFile{"wrong.3mf", "cut short or not a 3MF"}, std::string("PK\3\4 garbage")},
                    std::pair{BadFile{"range.dae", "range.dae"}, kDae},
                    std::pair{BadFile{"wrong.dae", "not a valid mesh file"}, std::string("<COLLADA>")}),
    [](const auto& bad) { return test_name(bad.param.first.name); });

}  // namespace
}  // namespace sprung
