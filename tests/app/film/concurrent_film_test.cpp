#include "app/film/concurrent_film.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "tests/support/run_program.h"

namespace sprung {
namespace {

/// The pictures and the film of a mesh that is animated, drawn by that many processes.
struct Take {
  TempFolder folder;
  ProgramRun run;

  Take(const std::string& words, int jobs)
      : run(run_program(folder, "animate '" SPRUNG_SOURCE_DIR "/assets/models/" + words +
                                    " --bricks 8 --resolution 160x90 --fps 12 -o film -o film.mp4 --verbose --jobs " +
                                    std::to_string(jobs))) {
    EXPECT_EQ(run.exit_code, 0) << run.err;
  }

  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> all{read_file(folder.path() / "film.mp4")};
    for (int frame = 1; std::filesystem::exists(picture(frame)); ++frame) all.push_back(read_file(picture(frame)));
    return all;
  }
  [[nodiscard]] std::filesystem::path picture(int frame) const {
    return folder.path() / "film" / fmt::format("frame_{:04}.png", frame);
  }
  [[nodiscard]] bool says(const std::string& words) const { return run.err.find(words) != std::string::npos; }
};

/// Draws a film by several processes, expects the files of one alone, and returns how many pictures these are.
/// `said`: what the several report.
std::size_t expect_that_of_one_process(const std::string& words, int jobs, const std::string& said) {
  const Take concurrent(words, jobs);
  const Take plain(words, 1);
  EXPECT_TRUE(concurrent.says(fmt::format("drawn by {} processes while it moves", jobs))) << concurrent.run.err;
  EXPECT_TRUE(concurrent.says(said)) << concurrent.run.err;
  EXPECT_FALSE(plain.says("while it moves"));
  EXPECT_TRUE(concurrent.files() == plain.files());
  return plain.files().size() - 1;
}

TEST(ConcurrentFilm, IsThatOfOneProcess) {
  EXPECT_EQ(expect_that_of_one_process("torus.ply' --duration 1s", 3, "of them while it moved"), 12U);
}

TEST(ConcurrentFilm, IsDrawnAnewIfTheBodyLeavesItsView) {
  const std::string words = "torus.ply' --duration 1s --material gelatin --scenario tumble";
  EXPECT_EQ(expect_that_of_one_process(words, 2, "drawn anew"), 12U);
}

TEST(ConcurrentFilm, EndsWithAMotionThatEndsEarly) {
  const std::string words = "torus.ply' --material rubber --set until_still=0.5s --duration 6s";
  EXPECT_LT(expect_that_of_one_process(words, 2, "of them while it moved"), 72U);
}

TEST(ConcurrentFilm, WaitsForTheWholeMotionWhereColoursNeedIt) {
  const Take take("torus.ply' --duration 0.5s --color-by speed", 2);
  EXPECT_FALSE(take.says("while it moves"));
  EXPECT_EQ(take.files().size(), 1U + 6);
}

TEST(SharedFrames, ReachAForkedReader) {
  Floats3 nodes(2, 3);
  nodes << 1, 2, 3, 4, 5, 6;
  SharedFrames frames(3, {2}, 1);
  DrawingProcesses reader(1, [&](std::size_t, const DrawingProcesses::Send& send) {
    for (std::size_t frame = 0; frame < 3; ++frame) {
      const std::vector<Floats3> bodies = frames.wait_for(frame, 0);
      if (bodies.empty()) return;
      Image image(1, 1);
      image.pixels[0] = std::uint8_t(bodies.front()(1, 2));
      send(image);
    }
  });
  frames.add({nodes});
  EXPECT_EQ(reader.receive(0).value().pixels[0], 6);
  frames.add({Floats3(2 * nodes)});
  EXPECT_EQ(reader.receive(0).value().pixels[0], 12);
  frames.close();
  EXPECT_FALSE(reader.receive(0));
}

}  // namespace
}  // namespace sprung
