#include "core/mesh/io/reader_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "tests/support/error_message.h"
#include "tests/support/meshes.h"
#include "tests/support/sanitized.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

const std::filesystem::path kFile = "shape.fbx";

std::string outcome(const std::function<SurfaceMesh()>& read, const ReadingLimits& limits = {}) {
  return error_message([&] { static_cast<void>(read_in_child(kFile, limits, read)); });
}

void expect_part(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

SurfaceMesh mesh_with_everything() {
  SurfaceMesh mesh = test::torus_mesh(2, 0.5, 200, 100);
  const auto rows = mesh.positions.rows();
  mesh.normals = mesh.positions.cast<float>().rowwise().normalized();
  mesh.uvs.setRandom(rows, 2);
  mesh.colors.setOnes(rows, 4);
  mesh.parts.at(0).material = 0;
  SurfaceMaterial material;
  material.name = "skin";
  material.texture_name = "skin.png";
  material.texture.assign(3 << 20, std::byte{7});
  mesh.materials.push_back(material);
  mesh.notes.emplace_back("left out a line");
  mesh.single_precision = true;
  return mesh;
}

TEST(ReadingChild, GivesTheMeshAsItWasRead) {
  const SurfaceMesh sent = mesh_with_everything();
  const SurfaceMesh got = read_in_child(kFile, {}, [&] { return sent; });
  EXPECT_EQ(bytes_from_mesh(got), bytes_from_mesh(sent));
  EXPECT_EQ(got.positions, sent.positions);
  EXPECT_EQ(got.materials.at(0).texture, sent.materials[0].texture);
  EXPECT_EQ(got.notes, sent.notes);
}

TEST(ReadingChild, SaysWhatTheReaderFound) {
  EXPECT_EQ(outcome([]() -> SurfaceMesh { throw Error(ErrorKind::kBadInput, "shape.fbx:3: no face"); }),
            "shape.fbx:3: no face");
  EXPECT_EQ(outcome([]() -> SurfaceMesh { throw std::runtime_error("odd"); }), "odd");
}

TEST(ReadingChild, NamesTheFileAndTheSignalOfACrash) {
  expect_part(outcome([]() -> SurfaceMesh { std::abort(); }), "shape.fbx: the reader crashed on this file");
  expect_part(outcome([]() -> SurfaceMesh { _exit(3); }), "shape.fbx: the reader crashed on this file");
  expect_part(outcome([]() -> SurfaceMesh { _exit(0); }), "the reader gave no answer");
  const auto segfault = []() -> SurfaceMesh {
    std::signal(SIGSEGV, SIG_DFL);
    std::raise(SIGSEGV);
    return {};
  };
  expect_part(outcome(segfault), "(signal SIGSEGV)");
}

TEST(ReadingChild, StopsAReaderThatNeverEnds) {
  const auto spin = []() -> SurfaceMesh {
    volatile unsigned turns = 0;
    while (true) turns = turns + 1;
  };
  expect_part(outcome(spin, {.cpu_time = 1}), "shape.fbx: gave up reading it after 1 s of computing");
  const auto sleep = []() -> SurfaceMesh {
    while (true) pause();
  };
  expect_part(outcome(sleep, {.wall_time = 1}), "gave up reading it after 1 s");
}

TEST(ReadingChild, StopsAReaderThatEatsMemory) {
  if (test::kAddressSanitized) GTEST_SKIP() << "no limit of memory in builds for ASan";
  const auto eat = []() -> SurfaceMesh {
    std::vector<std::vector<char>> eaten;
    while (true) eaten.emplace_back(std::size_t{1} << 24, '\1');
  };
  expect_part(outcome(eat, {.memory = std::uint64_t{1} << 28}), "takes more than 256 MB of memory");
}

TEST(ReadingChild, EndsByCtrlCAndLeavesNoZombie) {
  std::signal(SIGINT, SIG_DFL);  // a shell has it ignored in what it runs in the background
  const auto interrupted = []() -> SurfaceMesh {
    kill(getpid(), SIGINT);
    return {};
  };
  expect_part(outcome(interrupted), "stopped by SIGINT");
  expect_part(outcome([]() -> SurfaceMesh { std::abort(); }), "crashed");
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
  EXPECT_EQ(errno, ECHILD);
}

TEST(ReadingChild, WritesNoFiles) {
  const TempFolder folder;
  const auto write = [&]() -> SurfaceMesh {
    std::signal(SIGXFSZ, SIG_IGN);
    std::ofstream(folder.path() / "left_behind") << "much";
    return test::box_mesh(Vec3::Zero(), Vec3::Ones());
  };
  EXPECT_EQ(read_in_child(kFile, {}, write).triangles.rows(), 12);
  EXPECT_EQ(std::filesystem::file_size(folder.path() / "left_behind"), 0U);
}

TEST(MeshBytes, RefusesAnythingCutOrBlownUp) {
  const std::vector<std::byte> whole = bytes_from_mesh(test::box_mesh(Vec3::Zero(), Vec3::Ones()));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(static_cast<void>(mesh_from_bytes(std::span(whole).first(size))), Error) << size;
  }
  std::vector<std::byte> huge = whole;
  for (std::size_t i = 0; i < 7; ++i) huge[i] = std::byte{255};
  EXPECT_THROW(static_cast<void>(mesh_from_bytes(huge)), Error);
}

TEST(FindFault, SeesEveryFlaw) {
  const SurfaceMesh sound = mesh_with_everything();
  EXPECT_EQ(find_fault(sound), "");
  const auto fault_after = [&](const auto& spoil) {
    SurfaceMesh mesh = sound;
    spoil(mesh);
    return find_fault(mesh);
  };
  expect_part(fault_after([](SurfaceMesh& m) { m.positions(4, 1) = NAN; }), "vertex 5 has a coordinate");
  expect_part(fault_after([](SurfaceMesh& m) { m.triangles(2, 0) = -1; }), "triangle 3 refers to vertex -1");
  expect_part(fault_after([](SurfaceMesh& m) { m.triangles(2, 0) = 1 << 30; }), "out of range");
  expect_part(fault_after([](SurfaceMesh& m) { m.triangles.resize(0, 3); }), "no faces (a point cloud)");
  expect_part(fault_after([](SurfaceMesh& m) { m.uvs.resize(3, 2); }), "do not fit");
  expect_part(fault_after([](SurfaceMesh& m) { m.normals(3, 2) = INFINITY; }), "not finite");
  expect_part(fault_after([](SurfaceMesh& m) { m.parts[0].triangle_count -= 1; }), "parts do not cover");
  expect_part(fault_after([](SurfaceMesh& m) { m.parts[0].material = 1; }), "parts do not cover");
}

}  // namespace
}  // namespace sprung
