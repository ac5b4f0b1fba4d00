#pragma once
#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "app/console/console.h"
#include "app/film/drawing_processes.h"
#include "app/film/film_pipeline.h"
#include "app/film/film_task.h"
#include "app/film/shared_frames.h"

namespace sprung {

/// A film whose pictures are drawn by other processes while later frames of its motion are computed. Its camera is
/// placed before anything has moved, see foreseen_reach(). The pictures are those of render_film().
class ConcurrentFilm {
 public:
  /// Starts the processes, before the first step. All but `outputs` must outlive it. None if the film has to be whole
  /// before its first picture can be drawn, or if one process is to draw it.
  [[nodiscard]] static std::unique_ptr<ConcurrentFilm> begin(const Film& film, const Simulation& simulation,
                                                             const std::optional<Environment>& surroundings,
                                                             const FrameChoice& choice,
                                                             const std::vector<Output>& outputs, const Console& console,
                                                             int jobs);
  /// Ends the processes; removes unfinished films.
  ~ConcurrentFilm();
  ConcurrentFilm(const ConcurrentFilm&) = delete;
  ConcurrentFilm& operator=(const ConcurrentFilm&) = delete;

  /// The next frame is that of the world.
  void add(const World& world);
  /// Waits until these frames of the whole motion are drawn. False: they are not, since a body left the view that was
  /// foreseen or the motion ended before the first of them; the film is to be drawn from its beginning. Throws what the
  /// processes threw, Interrupted.
  [[nodiscard]] bool finish(const FrameChoice& choice);

 private:
  ConcurrentFilm(const Film& film, const Simulation& simulation, const std::optional<Environment>& surroundings,
                 FilmTask task, const Console& console, std::size_t processes);
  [[nodiscard]] std::unique_ptr<PictureWriter> collect();

  const Film& film_;
  const Simulation& simulation_;
  const Console& console_;
  const FilmTask task_;
  Recording recording_;  // in the processes: the frames drawn so far
  FilmPipeline pipeline_;
  Reach foreseen_;
  AlignedBox bounds_;  // m, of all frames so far
  SharedFrames frames_;
  DrawingProcesses processes_;
  std::size_t count_;                                      // of these
  std::atomic<std::size_t> drawn_ = 0;                     // pictures
  std::future<std::unique_ptr<PictureWriter>> collected_;  // of the sequences, not closed
};

/// A console that also passes the frames of a motion on to a film, if there is one.
class FrameSender : public Console {
 public:
  FrameSender(const Console& console, ConcurrentFilm* film) : Console(console), film_(film) {}
  void finish_frame(int /*frame*/, double /*progress*/, const World& world) const override {
    if (film_ != nullptr) film_->add(world);
  }

 private:
  ConcurrentFilm* film_;
};

}  // namespace sprung
