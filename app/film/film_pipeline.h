#pragma once
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "app/film/film_cameras.h"
#include "app/film/film_stage.h"
#include "app/film/labels.h"
#include "app/scene/scene_render.h"
#include "render/environment.h"
#include "render/image/image.h"

namespace sprung {

/// A run that a film shows. The three outlive the film.
struct FilmRun {
  const Film& scene;
  const Simulation& simulation;
  const Recording& recording;
  std::string name{};  // written over its pictures where there are others beside them
};

/// Everything that a picture of a film is made with: of one run, or of several side by side with one camera and one
/// range of colours, as the scene of the first has it. A run that is shorter than the others stays where it ends.
/// OpenGL is begun with the first picture: a crew can be handed to another process before.
class FilmPipeline {
 public:
  /// The skins at the moments of a picture, by run and moment: one, or as many as blur takes.
  using Moments = std::vector<std::vector<std::vector<SkinShape>>>;

  /// All runs are in the same surroundings, which outlive the crew; none: in the studio.
  FilmPipeline(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings);

  [[nodiscard]] std::size_t frames() const { return cameras_.size(); }
  [[nodiscard]] double lowest() const { return reach_.lowest; }  // m, of all bodies in all frames
  [[nodiscard]] std::string driver() { return renderer(panels_.front()).driver(); }

  [[nodiscard]] Moments moments(std::size_t frame) const;
  [[nodiscard]] Image draw(std::size_t frame, const Moments& moments);
  /// Of the first run, as the shutter opens.
  [[nodiscard]] Passes passes(std::size_t frame, const Moments& moments);
  /// Many pictures in one.
  [[nodiscard]] Image sheet(const std::vector<Image>& pictures) const;

 private:
  /// The scene of the first run with what the ends of the colours stand for in all runs.
  struct Colors {
    Film scene;
    std::optional<Legend> legend;
  };
  [[nodiscard]] static Colors common_colors(const std::vector<FilmRun>& runs);
  FilmPipeline(const std::vector<FilmRun>& runs, const std::optional<Environment>& surroundings, const Colors& colors);

  /// The part of a picture that shows one run.
  struct Panel {
    Panel(Film its_scene, const FilmRun& its_run) : scene(std::move(its_scene)), run(its_run) {}
    [[nodiscard]] std::size_t frame(std::size_t of_film) const;  // the same, or its last

    const Film scene;
    const FilmRun run;
    const FilmStage stage{scene, run.simulation, run.recording};
    std::unique_ptr<Renderer> renderer;  // from the first picture on
  };
  Renderer& renderer(Panel& panel);

  /// The camera of that exposure: somewhere on its lens.
  [[nodiscard]] Camera camera(std::size_t frame, int exposure) const;
  [[nodiscard]] int exposures() const;
  /// Pixels at the right side that no panel covers.
  [[nodiscard]] int margin() const;

  const std::optional<Environment>& surroundings_;
  Film scene_;  // of the film
  Reach reach_;
  Labels labels_;
  Film scene_of_panel_;  // smaller pictures
  std::vector<Camera> cameras_;
  std::deque<Panel> panels_;
  std::size_t longest_ = 0;  // the run with the most frames
};

/// The mean of pictures of the same size, in light (its root is what sRGB keeps, nearly): what an open shutter sees.
class Exposure {
 public:
  void add(const Image& image);
  [[nodiscard]] Image mean() const;

 private:
  Image first_;
  std::vector<float> light_;
  std::vector<float> alpha_;
  int count_ = 0;
};

/// Pictures of the same size in rows of `columns`, from the top left. `margin` pixels are free at the
/// right side, like the left ends of the rows.
[[nodiscard]] Image sheet_of(const std::vector<Image>& pictures, int columns, int margin);

/// What lights the bodies from all around, if the scene names a panorama. Throws Error(kBadInput) naming the file where
/// it cannot be read or gives no light.
[[nodiscard]] std::optional<Environment> read_surroundings(const SceneRender& render);

}  // namespace sprung
