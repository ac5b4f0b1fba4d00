#pragma once
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/film/film_cameras.h"
#include "app/film/film_stage.h"
#include "app/film/labels.h"
#include "app/scene/scene_render.h"
#include "render/image/image.h"
#include "render/stage/environment.h"

namespace sprung {

/// A run that a film shows. The objects that it refers to must outlive the film.
struct FilmRun {
  const Film& film;
  const Simulation& simulation;
  const Recording& recording;
  std::string name{};  // written over its pictures in a film of several runs
};

/// Draws the pictures of a film: of one run, or of several side by side, with the camera and the look of the first
/// run's scene and one range of colours in each frame. A run that is shorter than the others stays in its last frame.
/// OpenGL starts with the first picture, so a process may fork before that.
class FilmPipeline {
 public:
  /// Shapes of the skins by run and time: one time per picture, or those that separate the exposures of its motion
  /// blur.
  using Moments = std::vector<std::vector<std::vector<SkinShape>>>;

  /// `surroundings` lights all runs and must outlive it; none: the studio.
  FilmPipeline(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings);

  [[nodiscard]] std::size_t frames() const { return cameras_.size(); }
  [[nodiscard]] double lowest() const { return reach_.lowest; }  // m, of all bodies in all frames
  [[nodiscard]] std::string driver() { return renderer(panels_.front()).driver(); }

  [[nodiscard]] Moments moments(std::size_t frame) const;
  [[nodiscard]] Image draw(std::size_t frame, const Moments& moments);
  /// The passes of the first run at the first time.
  [[nodiscard]] Passes passes(std::size_t frame, const Moments& moments);
  /// The pictures in rows and columns, with the legend.
  [[nodiscard]] Image sheet(const std::vector<Image>& pictures) const;

 private:
  [[nodiscard]] static ColorRanges common_ranges(const std::vector<FilmRun>& runs);
  FilmPipeline(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings,
               const ColorRanges& ranges);

  /// One run's part of the picture.
  struct Panel {
    Panel(Film its_scene, const FilmRun& its_run, double pixel, const ColorRanges& ranges)
        : scene(std::move(its_scene)), run(its_run), stage(scene, run.simulation, run.recording, pixel, ranges) {}
    [[nodiscard]] std::size_t frame(std::size_t of_film) const;  // clamped to the run's last

    const Film scene;
    const FilmRun run;
    const FilmStage stage;
    std::unique_ptr<Renderer> renderer;  // made with the first picture
  };
  Renderer& renderer(Panel& panel);

  [[nodiscard]] Image draw(std::size_t frame, Panel& panel, const std::vector<std::vector<SkinShape>>& shapes);
  [[nodiscard]] Image sheet_of_panels(const std::vector<Image>& pictures) const;

  const std::optional<Environment>& surroundings_;
  Film film_;
  Reach reach_;
  Labels labels_;
  Film scene_of_panel_;  // with the panel's resolution
  std::vector<Camera> cameras_;
  std::deque<Panel> panels_;
  std::size_t longest_ = 0;  // index of the run with the most frames
};

/// Pictures of the same size in rows of `columns`, from the top left, with `gutter` white pixels between them. `margin`
/// more pixels at the right edge continue the background.
[[nodiscard]] Image sheet_of(const std::vector<Image>& pictures, int columns, int gutter, int margin);

/// The environment of the scene's panorama, if it has one. Throws Error(kBadInput) naming the file if it cannot be read
/// or is black.
[[nodiscard]] std::optional<Environment> read_surroundings(const SceneRender& render);

}  // namespace sprung
