#include "core/simulation/cache.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>

#include "core/body/body.h"
#include "tests/support/bodies.h"
#include "tests/support/error_message.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

namespace sprung {
namespace {

constexpr std::size_t kMemory = 5;

/// A box with a one-triangle skin that has everything a skin can have.
CacheHeader box_header(int side) {
  CacheHeader header{.version = "1",
                     .build = "b",
                     .scene = "fps = 24\n",
                     .progress_name = "time_s",
                     .probes = {"tip"},
                     .simulation = {}};
  Simulation& simulation = header.simulation;
  simulation.size = 0.5;
  SoftBody& body = simulation.world.bodies.emplace_back(
      make_body(make_box_grid({side, side, side}, 0.1), Model::kTensile, test::test_material(0.3)));
  body.drawn.color = {1, 2, 3};
  Origin& origin = simulation.origins.emplace_back();
  origin.regions.assign(body.grid.cells.size(), 2);
  body.drawn.skin.positions = Points::Random(3, 3);
  body.drawn.skin.normals = Points::Random(3, 3);
  body.drawn.skin.uvs = Floats2::Random(3, 2);
  body.drawn.skin.colors = Floats4::Random(3, 4);
  body.drawn.skin.triangles = Triangles{{0, 1, 2}};
  body.drawn.skin.parts = {{.name = "ear left", .first_triangle = 0, .triangle_count = 1, .material = 0}};
  body.drawn.skin.materials = {
      {.name = "fur", .texture = {std::byte{7}, std::byte{0}, std::byte{9}}, .texture_name = "f.png"}};
  body.drawn.embedding = embed(body.grid, body.drawn.skin.positions);
  origin.file_vertices = {2, 0, 1};
  origin.file_embedding = body.drawn.embedding;
  simulation.meshes.push_back(body.drawn.skin);
  StageObstacle& obstacle = simulation.obstacles.emplace_back();
  obstacle.color = {4, 5, 6};
  obstacle.start.translation = {1, 2, 3};
  obstacle.skin = body.drawn.skin;
  return header;
}

/// Synthetic values that identify every number of a frame.
Points state_of(const CacheHeader& header, std::size_t frame, double kind) {
  const Points& rest = header.simulation.world.bodies[0].rest_positions;
  return rest.array() * std::sqrt(2.0) + kind + double(frame) / 3;
}

void append(CacheWriter& writer, const CacheHeader& header, std::size_t frame) {
  const Points positions = state_of(header, frame, 0);
  const Points velocities = state_of(header, frame, 100);
  CachedFrame made{.progress = double(frame) / 24, .probes = std::vector<double>(kNumbersOfProbe, 0.1)};
  made.probes[3] = double(frame);
  made.state_hash = ~std::uint64_t{frame};
  made.seconds = 0.25 * double(frame);
  writer.append(made, {&positions}, {&velocities}, std::vector<double>(kMemory, double(frame)));
}

void write_frames(const std::filesystem::path& file, const CacheHeader& header, std::size_t count) {
  CacheWriter writer(file, header, kMemory);
  for (std::size_t frame = 0; frame < count; ++frame) {
    append(writer, header, frame);
    if (frame == 0) writer.publish();
  }
  writer.close();
}

void expect_frames(const CacheReader& reader, const CacheHeader& header) {
  for (std::size_t frame = 0; frame < reader.frame_count(); ++frame) {
    EXPECT_EQ(reader.positions(frame).at(0), state_of(header, frame, 0)) << frame;
    EXPECT_EQ(reader.velocities(frame).at(0), state_of(header, frame, 100)) << frame;
    const CachedFrame read = reader.frame(frame);
    EXPECT_EQ(read.progress, double(frame) / 24);
    EXPECT_EQ(read.probes.at(3), double(frame));
    EXPECT_EQ(read.state_hash, ~std::uint64_t{frame});
    EXPECT_EQ(read.seconds, 0.25 * double(frame));
  }
  if (reader.frame_count() == 0) return;
  const std::size_t last = reader.frame_count() - 1;
  EXPECT_EQ(reader.memory(last), std::vector<double>(kMemory, double(last)));
}

TEST(Cache, GivesBackEveryBit) {
  const TempFolder folder;
  const CacheHeader header = box_header(3);
  write_frames(folder.path() / "run.h5", header, 4);
  const CacheReader reader(folder.path() / "run.h5");
  ASSERT_EQ(reader.frame_count(), 4U);
  expect_frames(reader, header);
  const CacheHeader& read = reader.header();
  EXPECT_EQ(read.scene, header.scene);
  EXPECT_EQ(read.probes, header.probes);
  EXPECT_EQ(read.simulation.size, header.simulation.size);
  const SoftBody& body = read.simulation.world.bodies.at(0);
  const SoftBody& made = header.simulation.world.bodies[0];
  EXPECT_EQ(body.grid.nodes, made.grid.nodes);
  EXPECT_EQ(body.grid.cells, made.grid.cells);
  EXPECT_EQ(body.grid.lattice, made.grid.lattice);
  EXPECT_EQ(body.grid.fill, made.grid.fill);
  EXPECT_EQ(read.simulation.origins.at(0).regions, header.simulation.origins[0].regions);
  EXPECT_EQ(body.masses, made.masses);
  EXPECT_EQ(body.drawn.embedding.local, made.drawn.embedding.local);
  EXPECT_EQ(read.simulation.origins.at(0).file_vertices, header.simulation.origins[0].file_vertices);
  EXPECT_EQ(read.simulation.meshes.at(0).triangles, made.drawn.skin.triangles);
  EXPECT_EQ(body.drawn.skin.uvs, made.drawn.skin.uvs);
  EXPECT_EQ(body.drawn.skin.colors, made.drawn.skin.colors);
  EXPECT_EQ(body.drawn.skin.parts.at(0).name, "ear left");
  EXPECT_EQ(body.drawn.skin.materials.at(0).texture, made.drawn.skin.materials[0].texture);
  EXPECT_EQ(read.simulation.obstacles.at(0).start.translation, Vec3(1, 2, 3));
  EXPECT_EQ(read.simulation.obstacles.at(0).color.green, 5);
}

TEST(Cache, KeepsHowTheSolidLiesInItsBricksForModelsThatAskForIt) {
  const TempFolder folder;
  CacheHeader header = box_header(1);
  SoftBody& made = header.simulation.world.bodies[0];
  for (int brick = 0; brick < made.grid.brick_count(); ++brick) {
    made.grid.moments.push_back({.centroid = Vec3(0.1, brick, 0.3), .covariance = Vec3(1, brick, 3).asDiagonal()});
  }
  for (const Model model : {Model::kTensile, Model::kCalibrated}) {
    made.model = model;
    write_frames(folder.path() / model_name(model), header, 1);
    const CacheReader reader(folder.path() / model_name(model));
    const std::vector<SolidMoments>& read = reader.header().simulation.world.bodies.at(0).grid.moments;
    ASSERT_EQ(read.size(), model == Model::kCalibrated ? made.grid.moments.size() : 0);
    for (std::size_t brick = 0; brick < read.size(); ++brick) {
      EXPECT_EQ(read[brick].centroid, made.grid.moments[brick].centroid);
      EXPECT_EQ(read[brick].covariance, made.grid.moments[brick].covariance);
    }
  }
}

TEST(Cache, WithAnErrorAllowedKeepsToItAndTheLastFrameToTheLastBit) {
  const TempFolder folder;
  CacheHeader header = box_header(12);
  write_frames(folder.path() / "exact.h5", header, 6);
  for (const double error : {1e-3, 2.7e-5, 1e-9}) {
    header.position_error = error;
    header.velocity_error = 24 * error;
    write_frames(folder.path() / "rounded.h5", header, 6);
    const CacheReader reader(folder.path() / "rounded.h5");
    EXPECT_EQ(reader.header().position_error, error);
    double worst = 0;
    for (std::size_t frame = 0; frame < 6; ++frame) {
      worst = std::max(worst, (reader.positions(frame).at(0) - state_of(header, frame, 0)).cwiseAbs().maxCoeff());
      EXPECT_LE((reader.velocities(frame).at(0) - state_of(header, frame, 100)).cwiseAbs().maxCoeff(), 24 * error);
    }
    EXPECT_LE(worst, error);
    EXPECT_GT(worst, 0.4 * error) << "no finer than it need be";
    for (const std::size_t frame : {4U, 5U}) {
      EXPECT_EQ(reader.exact_positions(frame).at(0), state_of(header, frame, 0));
      EXPECT_EQ(reader.exact_velocities(frame).at(0), state_of(header, frame, 100));
    }
  }
  EXPECT_EQ(CacheReader(folder.path() / "exact.h5").exact_positions(5).at(0), state_of(header, 5, 0));
}

TEST(Cache, IsReadWhileItGrows) {
  const TempFolder folder;
  const CacheHeader header = box_header(2);
  CacheWriter writer(folder.path() / "run.h5", header, kMemory);
  append(writer, header, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "run.h5"));
  writer.publish();
  append(writer, header, 1);
  EXPECT_TRUE(is_being_written(folder.path() / "run.h5"));
  const CacheReader reader(folder.path() / "run.h5");
  EXPECT_EQ(reader.frame_count(), 2U);
  expect_frames(reader, header);
}

/// Tests that fork hold one: another thread may hold a lock of the allocator at that moment, for ever in the child.
class NoThreads {
  tbb::global_control control_{tbb::global_control::max_allowed_parallelism, 1};
};

/// Writes frames until it is killed.
[[noreturn]] void write_for_ever(const std::filesystem::path& file, const CacheHeader& header) {
  CacheWriter writer(file, header, kMemory);
  for (std::size_t frame = 0;; ++frame) {
    append(writer, header, frame);
    if (frame == 0) writer.publish();
  }
}

TEST(Cache, KilledAtAnyMomentItHasEveryFinishedFrame) {
  const NoThreads alone;
  const CacheHeader header = box_header(4);
  std::mt19937 random(20091);
  std::size_t frames = 0;
  for (int kill_number = 0; kill_number < 20; ++kill_number) {
    const TempFolder folder;
    const auto file = folder.path() / "run.h5";
    const pid_t child = fork();
    if (child == 0) write_for_ever(file, header);
    while (!std::filesystem::exists(file)) usleep(100);
    usleep(static_cast<useconds_t>(std::uniform_int_distribution(0, 60000)(random)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_FALSE(is_being_written(file));
    const CacheReader reader(file);
    EXPECT_GE(reader.frame_count(), 1U);
    expect_frames(reader, header);
    frames += reader.frame_count();
  }
  EXPECT_GT(frames, 20U);
}

/// As when a writer was killed in the middle of a block of the index: HDF5 would wait for it for ever.
TEST(Cache, ATornIndexIsAnErrorAtOnce) {
  const TempFolder folder;
  const CacheHeader header = box_header(4);
  const auto file = folder.path() / "run.h5";
  {
    CacheWriter writer(file, header, kMemory);
    for (std::size_t frame = 0; frame < 40; ++frame) append(writer, header, frame);
    writer.publish();
  }
  std::string bytes = text_of(file);
  int torn = 0;
  for (std::size_t at = bytes.find("EADB"); at != std::string::npos; at = bytes.find("EADB", at + 1), ++torn) {
    bytes[at + 30] = char(~bytes[at + 30]);
  }
  ASSERT_GT(torn, 0);
  static_cast<void>(folder.write("run.h5", bytes));
  const auto began = std::chrono::steady_clock::now();
  const std::string message = error_message([&] {
    const CacheReader reader(file);
    for (std::size_t frame = 0; frame < reader.frame_count(); ++frame) {
      static_cast<void>(reader.positions(frame));
      static_cast<void>(reader.velocities(frame));
    }
  });
  EXPECT_NE(message.find("cannot read"), std::string::npos) << message;
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count(), 10);
}

TEST(Cache, AFullDiskLosesNothingThatIsFinished) {
  const NoThreads alone;
  const TempFolder folder;
  const CacheHeader header = box_header(6);
  const auto file = folder.path() / "run.h5";
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{.rlim_cur = 200000, .rlim_max = 200000};
    setrlimit(RLIMIT_FSIZE, &limit);
    const std::string message = error_message([&] { write_for_ever(file, header); });
    std::ofstream(folder.path() / "message") << message;
    _exit(message.find("File too large") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0) << std::ifstream(folder.path() / "message").rdbuf();
  const CacheReader reader(file);
  EXPECT_GE(reader.frame_count(), 2U);
  expect_frames(reader, header);
}

TEST(Cache, NoticesThatItsFileIsGone) {
  const TempFolder folder;
  const CacheHeader header = box_header(2);
  CacheWriter writer(folder.path() / "run.h5", header, kMemory);
  append(writer, header, 0);
  writer.publish();
  std::filesystem::remove(folder.path() / "run.h5");
  EXPECT_NE(error_message([&] { append(writer, header, 1); }).find("was removed"), std::string::npos);
}

TEST(Cache, RefusesWhatIsNone) {
  const TempFolder folder;
  const auto text = folder.write("text.h5", "no cache");
  EXPECT_NE(error_message([&] { CacheReader reader(text); }).find("text.h5"), std::string::npos);
  Hdf5Writer(folder.path() / "other.h5").close();
  EXPECT_NE(error_message([&] { CacheReader reader(folder.path() / "other.h5"); }).find("no cache of sprung"),
            std::string::npos);
  EXPECT_NE(error_message([&] { CacheReader reader(folder.path() / "none.h5"); }).find("none.h5"), std::string::npos);
  EXPECT_NE(error_message([&] { CacheWriter writer("/proc/none/run.h5", box_header(2), 0); }).find("/proc/none"),
            std::string::npos);
}

}  // namespace
}  // namespace sprung
