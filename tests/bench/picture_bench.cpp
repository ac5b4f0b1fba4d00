// Draws a scene's bodies as they start, some pictures of 1280 x 720, and prints the time of each stage of a picture:
// skins, every pass of the renderer, PNG, a film's encoder, and one picture in final quality. Arguments: the scene (a
// .toml file), whose quality is used, and the number of pictures. Measured pass by pass, so that nothing overlaps; only
// the line "overlapping" is a picture with everything at once.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "app/film/film_output.h"
#include "app/film/film_stage.h"
#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/simulation/simulation.h"
#include "render/film.h"
#include "render/image/png.h"

namespace {

using namespace sprung;

RenderOptions options_of(Quality quality) {
  return {.width = 1280, .height = 720, .samples = samples_of(quality), .measure_passes = true, .quality = quality};
}

class Stopwatch {
 public:
  /// Prints the time since the last print, by picture.
  void print(std::string_view stage, int pictures) {
    const double processor = double(std::clock()) / CLOCKS_PER_SEC;
    const auto wall = std::chrono::steady_clock::now();
    row(stage, std::chrono::duration<double>(wall - wall_).count() / pictures, (processor - processor_) / pictures);
    wall_ = std::chrono::steady_clock::now();
    processor_ = double(std::clock()) / CLOCKS_PER_SEC;
  }
  static void row(std::string_view stage, double wall, double processor) {
    fmt::print("{:28} {:8.1f} {:8.1f}\n", stage, 1e3 * wall, 1e3 * processor);
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  double processor_ = double(std::clock()) / CLOCKS_PER_SEC;
};

/// A recording of one frame.
Recording as_they_start(const Simulation& simulation) {
  Recording recording;
  recording.progress = {0};
  std::vector<Floats3>& nodes = recording.frames.emplace_back();
  for (const SoftBody& body : simulation.world.bodies) nodes.emplace_back(body.positions.cast<float>());
  return recording;
}

struct Subject {
  Film scene;
  Simulation simulation;
  Recording recording;
  FilmStage film;
  std::vector<SkinShape> shapes;
  Stage stage;
  Camera camera;

  explicit Subject(const std::filesystem::path& file)
      : scene(read_scene(file)),
        simulation(prepare_simulation(scene, Observer())),
        recording(as_they_start(simulation)),
        film(scene, simulation, recording),
        shapes(film.shapes(0)) {
    AlignedBox bounds;
    for (const SkinShape& shape : shapes) bounds.extend(bounding_box(shape.positions.cast<double>().eval()));
    stage = film.stage(bounds, std::nullopt);
    camera = frame_bounds(bounds, 16.0 / 9);
  }
  /// Moved slightly in every second picture, so that nothing is reused from one to the next.
  [[nodiscard]] std::vector<SkinShape> shapes_of(int picture) const {
    std::vector<SkinShape> moved = film.shapes(0);
    for (SkinShape& shape : moved) shape.positions *= picture % 2 == 0 ? 1 + 1e-6F : 1;
    return moved;
  }
};

void print_passes(const std::vector<DrawTime>& first, const std::vector<DrawTime>& all, int pictures) {
  double wall = 0;
  double processor = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double w = (all[i].wall - first[i].wall) / pictures;
    const double p = (all[i].processor - first[i].processor) / pictures;
    Stopwatch::row(fmt::format("  {}", all[i].pass), w, p);
    wall += w;
    processor += p;
  }
  Stopwatch::row("drawing, all passes", wall, processor);
}

/// Overlapped, as when a film is made: skins, drawing, PNG and film at once.
void overlapped(const Subject& subject, const std::filesystem::path& folder, int pictures) {
  const std::vector<Output> outputs = parse_outputs({(folder / "p").string(), (folder / "q.mp4").string()});
  RenderOptions options = options_of(subject.scene.render.quality);
  options.measure_passes = false;
  Renderer renderer(subject.stage, options);
  Image warm = renderer.draw(subject.shapes, subject.camera);
  Stopwatch watch;
  PictureWriter writer(outputs, {.width = options.width, .height = options.height, .fps = 24});
  for (int i = 0; i < pictures; ++i) {
    writer.write({.image = renderer.draw(subject.shapes_of(i), subject.camera)});
  }
  writer.close();
  watch.print("all of it, overlapping", pictures);
}

/// One picture, since it takes as long as twenty others.
void final_quality(const Subject& subject) {
  const RenderOptions options = options_of(Quality::kFinal);
  Renderer renderer(subject.stage, options);
  const Image first = renderer.draw(subject.shapes, subject.camera);
  Stopwatch watch;
  const Image second = renderer.draw(subject.shapes, subject.camera);
  watch.print("final quality, 16 samples", 1);
}

void run(const std::filesystem::path& scene, int pictures) {
  const Subject subject(scene);
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "sprung_picture_bench";
  std::filesystem::create_directories(folder);
  fmt::print("{:28} {:>8} {:>8}  ms a picture; processor without the film's encoder\n", "stage", "wall", "processor");
  Stopwatch watch;
  for (int i = 0; i < pictures; ++i) (void)subject.film.shapes(0);
  watch.print("skins", pictures);

  Renderer renderer(subject.stage, options_of(subject.scene.render.quality));
  Image image = renderer.draw(subject.shapes, subject.camera);  // compiles the shaders
  const std::vector<DrawTime> first = renderer.draw_times();
  const std::array<std::vector<SkinShape>, 2> shapes{subject.shapes_of(0), subject.shapes_of(1)};
  for (int i = 0; i < pictures; ++i) image = renderer.draw(shapes[std::size_t(i) % 2], subject.camera);
  print_passes(first, renderer.draw_times(), pictures);

  watch = Stopwatch();
  for (int i = 0; i < pictures; ++i) write_png(image, folder / "picture.png");
  watch.print("PNG", pictures);
  FilmWriter film(folder / "film.mp4", {.width = image.width, .height = image.height, .fps = 24});
  for (int i = 0; i < pictures; ++i) film.write(image);
  film.close();
  watch.print("film", pictures);
  overlapped(subject, folder, pictures);
  final_quality(subject);
  std::filesystem::remove_all(folder);
}

}  // namespace

int main(int argc, char** argv) {
  const int pictures = argc == 3 ? std::atoi(argv[2]) : 0;
  if (pictures < 1) {
    fmt::print(stderr, "usage: picture_bench SCENE.toml PICTURES\n");
    return 2;
  }
  try {
    run(argv[1], pictures);
  } catch (const Error& error) {
    fmt::print(stderr, "picture_bench: {}\n", error.what());
    return 1;
  }
}
