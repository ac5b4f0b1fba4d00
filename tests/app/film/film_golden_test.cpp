#include <gtest/gtest.h>

#include <algorithm>

#include "app/film/film_pipeline.h"
#include "app/film/render_film.h"
#include "app/scene/scene_file.h"
#include "core/simulation/simulation.h"
#include "render/image/exr.h"
#include "render/image/png.h"
#include "tests/support/error_message.h"
#include "tests/support/golden.h"
#include "tests/support/temp_folder.h"

/// Pictures of a bar that is bent by hand: no motion is computed.
namespace sprung {
namespace {

constexpr const char* kBar =
    "fps = 4\nduration = 0.5\n[[body]]\nbox = [\"30 cm\", \"10 cm\", \"10 cm\"]\nbrick_size = \"2.5 cm\"\n"
    "color = \"#e0912f\"\nposition = [0, 0.1, 0]\nmaterial = { young = \"20 kPa\", poisson = 0.3, density = 1000 }\n"
    "[[body.pin]]\nbox = { min = [0, 0, 0], max = [0.01, 1, 1] }\n[[obstacle]]\nplane = { y = 0 }\n"
    "[render]\nresolution = [320, 180]\n";

struct FilmUnderTest {
  Film scene;
  Simulation simulation;
  Recording recording;

  /// `render`: further keys of [render], then tables.
  explicit FilmUnderTest(const std::string& render) : scene(parse_scene(kBar + render, "/scene.toml")) {
    simulation = prepare_simulation(scene, Console::terse());
    for (int frame = 0; frame < 3; ++frame) add_frame(0.5 * frame);
  }

  /// Bent upwards like a parabola, by up to `amount` of 16 cm, and lengthened a little.
  void add_frame(double amount) {
    Points nodes = simulation.world.bodies[0].rest_positions;
    const double begin = nodes.col(0).minCoeff();
    for (auto node : nodes.rowwise()) {
      const double x = node[0] - begin;
      node[1] += amount * 0.16 * x * x / 0.09;
      node[0] += amount * 0.12 * x;
    }
    recording.frames.push_back({nodes.cast<float>()});
    recording.progress.push_back(0.25 * double(recording.progress.size()));
  }

  [[nodiscard]] Image picture(int frame = 3) const {
    const TempFolder folder;
    render_film({{scene, simulation, recording}}, read_surroundings(scene.render),
                {.range = {.first = frame, .last = frame}}, {parse_output((folder.path() / "p_{}.png").string())},
                Console::terse());
    return read_png(folder.path() / ("p_" + std::to_string(frame) + ".png"));
  }
};

Image picture(const std::string& render, int frame = 3) { return FilmUnderTest(render).picture(frame); }

TEST(FilmPictures, ABoxIsTheSameSmoothOrNot) {
  EXPECT_EQ(picture("smooth = true\n").pixels, picture("smooth = false\n").pixels);
}

TEST(FilmGolden, StressWithLegend) {
  expect_golden(picture("color_by = \"stress\"\nframe_number = true\n"), "film_stress");
}

TEST(FilmGolden, VolumeOnExplodedBricks) {
  expect_golden(picture("color_by = \"volume\"\nbricks = \"exploded\"\nlegend = false\n"), "film_exploded_volume");
}

TEST(FilmGolden, CutBricks) {
  expect_golden(
      picture("bricks = \"whole\"\ncut = { point = [0.5, 0.5, 0.5], normal = [1, 0.4, 0] }\nscale_bar = true\n"),
      "film_cut_bricks");
}

TEST(FilmGolden, SpringsNodesAndPins) {
  expect_golden(picture("springs = true\nnodes = true\npins = true\n"), "film_springs");
}

// The legend is of the second frame, which is half as bent as the last.
TEST(FilmGolden, EdgesAndTheRangeOfOneFrame) {
  expect_golden(picture("color_by = \"stretch\"\ncolor_range = \"frame\"\nedges = true\n", 2), "film_edges");
}

TEST(FilmGolden, GhostOfTheShapeAtRest) { expect_golden(picture("ghost = true\n"), "film_ghost"); }

TEST(FilmGolden, Orthographic) {
  expect_golden(picture("caption = \"From the side\"\n[camera]\northographic = true\nazimuth = 0\nelevation = 0\n"),
                "film_orthographic");
}

// Lit from the right, from lower than the preset's sun.
TEST(FilmGolden, Sunset) {
  expect_golden(
      picture("light = \"sunset\"\nkey_light = { azimuth = 75, elevation = 18, size = 8, color = \"#ffe0b0\" }\n"),
      "film_sunset");
}

TEST(FilmGolden, MotionBlur) { expect_golden(picture("motion_blur = 180\n", 2), "film_motion_blur"); }

TEST(FilmGolden, Sheet) {
  FilmUnderTest film("sheet = [2, 2]\ncolor_by = \"displacement\"\n");
  film.add_frame(1.5);
  const TempFolder folder;
  render_film({{film.scene, film.simulation, film.recording}}, std::nullopt, {.range = {.first = 1, .last = 4}},
              {parse_output((folder.path() / "s_{}.png").string())}, Console::terse());
  expect_golden(read_png(folder.path() / "s_1.png"), "film_sheet");
}

TEST(FilmGolden, SideBySide) {
  FilmUnderTest first("color_by = \"displacement\"\n");
  first.scene.render.resolution = {320, 130};
  FilmUnderTest second("");
  second.recording.frames.pop_back();  // stays where it ends
  second.recording.progress.pop_back();
  const TempFolder folder;
  const std::vector<FilmRun> runs{{first.scene, first.simulation, first.recording, "bent"},
                                  {second.scene, second.simulation, second.recording, "half"}};
  render_film(runs, std::nullopt, {.range = {.first = 3, .last = 3}},
              {parse_output((folder.path() / "p_{}.png").string())}, Console::terse());
  expect_golden(read_png(folder.path() / "p_3.png"), "film_side_by_side");
}

TEST(FilmGolden, Contacts) {
  FilmUnderTest film("contacts = true\n[camera]\nazimuth = -50\nelevation = 6\n");
  for (std::vector<Floats3>& frame : film.recording.frames) frame[0].col(1).array() -= 0.1F;  // onto the ground
  expect_golden(film.picture(), "film_contacts");
}

TEST(FilmGolden, TracesAndPlots) {
  FilmUnderTest film("traces = true\nplots = true\n");
  film.recording.probes.push_back({.name = "tip", .samples = {}});
  for (const std::vector<Floats3>& frame : film.recording.frames) {
    const Vec3 tip = frame[0].row(frame[0].rows() - 1).cast<double>().transpose();
    ProbeSample& sample = film.recording.probes[0].samples.emplace_back();
    sample.position = tip;
    sample.displacement = tip - film.recording.probes[0].samples.front().position;
  }
  expect_golden(film.picture(), "film_traces_plots");
}

TEST(FilmGolden, Lens) { expect_golden(picture("[camera]\naperture = 0.08\nazimuth = 75\n"), "film_lens"); }

// A film without flicker.
TEST(FilmPictures, OfWhatStandsStillHasEqualPictures) {
  FilmUnderTest film("color_by = \"strain\"\n");
  film.recording.frames[1] = film.recording.frames[0];
  EXPECT_EQ(film.picture(1).pixels, film.picture(2).pixels);
}

TEST(FilmPictures, AreLitByThePanoramaThatTheSceneNames) {
  const TempFolder folder;
  Image blue(8, 4);
  for (std::size_t i = 2; i < blue.pixels.size(); i += 3) blue.pixels[i] = 255;
  write_png(blue, folder.path() / "blue.png");
  write_png(Image(8, 4), folder.path() / "black.png");
  FilmUnderTest film("");
  const Image studio = film.picture();
  film.scene.render.environment = folder.path() / "blue.png";
  const Image lit = film.picture();
  EXPECT_GT(lit.pixels[2], studio.pixels[2] + 20);  // the floor at the top left
  EXPECT_LT(lit.pixels[0], studio.pixels[0]);
  film.scene.render.environment = folder.path() / "black.png";
  EXPECT_EQ(error_message([&] { (void)film.picture(); }),
            (folder.path() / "black.png").string() + ": the surroundings are black above the horizon: no light");
}

// The left half of the panorama is red, the right one blue; the camera looks along -z, the middle of it.
TEST(FilmPictures, ShowThePanoramaAsTheSceneTurnsIt) {
  const TempFolder folder;
  Image halves(64, 32);
  for (std::size_t i = 0; i < halves.pixels.size() / 3; ++i) halves.pixels[3 * i + (i % 64 < 32 ? 0 : 2)] = 255;
  write_png(halves, folder.path() / "halves.png");
  FilmUnderTest film("floor = \"none\"\n[camera]\nazimuth = 0\n");
  film.scene.render.environment = folder.path() / "halves.png";
  film.scene.render.environment_background = true;
  const auto redness = [](const Image& image, int x) {
    return image.pixels[3 * std::size_t(x)] - image.pixels[3 * std::size_t(x) + 2];
  };
  const Image ahead = film.picture();
  EXPECT_GT(redness(ahead, 10), 100);
  EXPECT_LT(redness(ahead, 310), -100);
  film.scene.render.environment_turn = 90;
  const Image turned = film.picture();
  EXPECT_LT(redness(turned, 10), -100);
  EXPECT_LT(redness(turned, 310), -100);
}

TEST(FilmPictures, WritesPassesBesideItsPictures) {
  const FilmUnderTest film("");
  const TempFolder folder;
  render_film({{film.scene, film.simulation, film.recording}}, std::nullopt, {.range = {.first = 2, .last = 2}},
              parse_outputs({folder.path().string() + "/", (folder.path() / "p_{}.exr").string()}), Console::terse());
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "frame_0002.png"));
  const Passes passes = read_exr(folder.path() / "p_2.exr");
  EXPECT_EQ(passes.width, 320);
  EXPECT_EQ(passes.height, 180);
  EXPECT_GT(std::count(passes.id.begin(), passes.id.end(), 1.0F), 5000);
  const double highest = *std::max_element(passes.position[1].begin(), passes.position[1].end());
  EXPECT_NEAR(highest, 0.20 + 0.08, 0.002);  // the bar's upper side, bent upwards by half
}

TEST(FilmGolden, Looks) {
  std::string more = "[camera]\nelevation = 20\n";
  int index = 0;
  for (const char* look : {"gelatin", "rubber", "steel"}) {
    more += "[[body]]\nsphere = { radius = \"6 cm\" }\nbricks = 4\nlook = \"" + std::string(look) + "\"\ncolor = \"" +
            (index == 2 ? "#c8ccd2" : "#c8382e") + "\"\nposition = [" + std::to_string(-0.14 + 0.14 * index) +
            ", 0, 0.16]\n";
    ++index;
  }
  const Film scene = parse_scene(kBar + more, "/scene.toml");
  FilmUnderTest film("");
  film.scene = scene;
  film.simulation = prepare_simulation(scene, Console::terse());
  film.recording = {};
  film.recording.progress = {0};
  film.recording.frames.emplace_back();
  for (const SoftBody& body : film.simulation.world.bodies) {
    film.recording.frames[0].emplace_back(body.rest_positions.cast<float>());
  }
  expect_golden(film.picture(1), "film_looks");
}

// The range of the colours is that of the film, not that of a picture.
TEST(FilmColors, MeanTheSameInEveryFrame) {
  const Image first = picture("color_by = \"displacement\"\nlegend = false\n", 1);
  const Image fixed = picture("color_by = \"displacement\"\nlegend = false\ncolor_low = 0\ncolor_high = 100\n", 3);
  const Image last = picture("color_by = \"displacement\"\nlegend = false\n", 3);
  const auto brightest = [](const Image& image) {  // the yellow end: much green, little blue
    int most = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      most = std::max(most, image.pixels[i + 1] - image.pixels[i + 2]);
    }
    return most;
  };
  EXPECT_GT(brightest(last), 60);
  EXPECT_LT(brightest(first), 30);  // all at rest: the dark end
  EXPECT_LT(brightest(fixed), 30);
}

TEST(FilmTransparent, HasAlphaAndNoFloor) {
  const FilmUnderTest film("transparent = true\n");
  const TempFolder folder;
  const Output output = parse_output((folder.path() / "p_{}.png").string());
  render_film({{film.scene, film.simulation, film.recording}}, std::nullopt, {.range = {.first = 1, .last = 1}},
              {output}, Console::terse());
  const Image image = read_png(output.picture(1));
  ASSERT_EQ(image.alpha.size(), 320U * 180U);
  EXPECT_EQ(image.alpha.front(), 0);
  EXPECT_EQ(*std::max_element(image.alpha.begin(), image.alpha.end()), 255);
  const auto is_partly = [](std::uint8_t alpha) { return alpha > 0 && alpha < 255; };
  EXPECT_GT(std::count_if(image.alpha.begin(), image.alpha.end(), is_partly), 50);  // smooth edges
  EXPECT_EQ(error_message([&] {
              render_film({{film.scene, film.simulation, film.recording}}, std::nullopt,
                          {.range = {.first = 1, .last = 1}}, {parse_output((folder.path() / "f.mp4").string())},
                          Console::terse());
            }),
            "render.transparent: of films only .mov and .webm have alpha; or give a folder for pictures");
}

TEST(FilmFinal, IsDrawnAndOtherQualitiesRefuseItsSamples) {
  const auto draw = [](const std::string& render, const TempFolder& folder) {
    const FilmUnderTest film(render);
    render_film({{film.scene, film.simulation, film.recording}}, std::nullopt, {.range = {.first = 1, .last = 1}},
                {parse_output((folder.path() / "p_{}.png").string())}, Console::terse());
    return read_png(folder.path() / "p_1.png");
  };
  const TempFolder folder;
  const Image traced = draw("quality = \"final\"\nsamples = 8\n", folder);
  const TempFolder other;
  const Image raster = draw("quality = \"high\"\n", other);
  EXPECT_NE(traced.pixels, raster.pixels);
  EXPECT_LT(compare_images(traced, raster).mean, 5);
  EXPECT_EQ(error_message([&] { draw("samples = 8\n", folder); }),
            "render.samples = 8: 1, 4 or 16; other numbers are for render.quality = \"final\"");
}

}  // namespace
}  // namespace sprung
