#include "app/film/concurrent_film.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "app/console/interrupt.h"
#include "app/film/film_report.h"
#include "core/units.h"

namespace sprung {
namespace {

constexpr int kNiceness = 5;  // the motion comes first: pictures cannot be drawn before it

std::vector<Floats3> nodes_of(const World& world) {
  std::vector<Floats3> nodes;
  for (const SoftBody& body : world.bodies) nodes.emplace_back(body.positions.cast<float>());
  return nodes;
}

std::vector<Eigen::Index> node_counts(const World& world) {
  std::vector<Eigen::Index> counts;
  for (const SoftBody& body : world.bodies) counts.push_back(body.node_count());
  return counts;
}

/// The first frame, and the times of all.
Recording first_frame(const Film& film, const Simulation& simulation) {
  Recording recording;
  recording.frames.push_back(nodes_of(simulation.world));
  for (int frame = 0; frame < frame_count(film); ++frame) recording.progress.push_back(frame / film.fps);
  return recording;
}

/// Whether a picture shows its own frame only.
bool needs_own_frame_only(const SceneRender& render) {
  return render.color_by == Field::kSkin && !render.springs && !render.frame_number && !render.contacts &&
         !render.traces && !render.plots && render.motion_blur == 0;
}

/// Whether it gets a picture of every frame.
bool is_of_frames(const Output& output) {
  return output.is_sequence() || (output.kind == Output::Kind::kPictures && output.is_numbered());
}

/// "12 mm to the side, 0 um up".
std::string excess_text(const AlignedBox& view, const AlignedBox& bounds) {
  const Vec3 excess = (view.min() - bounds.min()).cwiseMax(bounds.max() - view.max()).cwiseMax(0);
  return fmt::format("{} to the side, {} up", readable(std::max(excess.x(), excess.z()), Dimension::kLength),
                     readable((bounds.max() - view.max()).cwiseMax(0).y(), Dimension::kLength));
}

}  // namespace

std::unique_ptr<ConcurrentFilm> ConcurrentFilm::begin(const Film& film, const Simulation& simulation,
                                                      const std::optional<Environment>& surroundings,
                                                      const FrameChoice& choice, const std::vector<Output>& outputs,
                                                      const Console& console, int jobs) {
  const bool can_be_drawn = needs_own_frame_only(film.render) && !choice.skips_existing &&
                            std::all_of(outputs.begin(), outputs.end(), is_of_frames) &&
                            foreseen_reach(film, simulation, first_frame(film, simulation)).has_value();
  if (!can_be_drawn) return nullptr;
  FilmTask task(film, choice, with_streams_chosen(outputs, film.render, choice));
  const std::size_t processes = task.processes(jobs);
  if (processes <= 1 || !end_worker_threads()) return nullptr;
  share_cores(processes);
  return std::unique_ptr<ConcurrentFilm>(
      new ConcurrentFilm(film, simulation, surroundings, std::move(task), console, processes));
}

ConcurrentFilm::ConcurrentFilm(const Film& film, const Simulation& simulation,
                               const std::optional<Environment>& surroundings, FilmTask task, const Console& console,
                               std::size_t processes)
    : film_(film),
      simulation_(simulation),
      console_(console),
      task_(std::move(task)),
      recording_(first_frame(film, simulation)),
      pipeline_({{film_, simulation_, recording_}}, surroundings),
      foreseen_(foreseen_reach(film, simulation, recording_).value()),
      frames_(recording_.progress.size(), node_counts(simulation.world), processes),
      processes_(processes,
                 [this, processes](std::size_t process, const DrawingProcesses::Send& send) {
                   static_cast<void>(nice(kNiceness));
                   recording_.frames.resize(recording_.progress.size());
                   task_.draw_share(pipeline_, process, processes, send, [this, process](std::size_t frame) {
                     recording_.frames[frame] = frames_.wait_for(frame, process);
                     return !recording_.frames[frame].empty();
                   });
                 }),
      count_(processes) {
  console_.detail(fmt::format("drawn by {} processes while it moves", count_));
  collected_ = std::async(std::launch::async, [this] { return collect(); });
}

ConcurrentFilm::~ConcurrentFilm() {
  frames_.close();
  if (!collected_.valid()) return;
  processes_.interrupt();
  collected_.wait();
}

void ConcurrentFilm::add(const World& world) {
  const std::vector<Floats3> nodes = nodes_of(world);
  for (std::size_t body = 0; body < nodes.size(); ++body) {
    bounds_.extend(bounding_box(world.bodies[body].skin_positions(nodes[body].cast<double>())));
  }
  if (is_foreseen(foreseen_, bounds_)) {
    frames_.add(nodes);
  } else {
    frames_.close();
  }
}

std::unique_ptr<PictureWriter> ConcurrentFilm::collect() {
  auto writer = std::make_unique<PictureWriter>(task_.sequences(true), task_.format());
  for (std::size_t i = 0; i < task_.frames().size(); ++i, ++drawn_) {
    std::optional<Image> image = processes_.receive(i % count_);
    if (!image) break;
    if (task_.has_sequence()) writer->write({.image = std::move(*image)});
  }
  processes_.finish();
  return writer;
}

bool ConcurrentFilm::finish(const FrameChoice& choice) {
  frames_.close();
  if (!is_foreseen(foreseen_, bounds_)) {
    static_cast<void>(collected_.get());  // removes the unfinished films
    console_.detail(fmt::format("the motion left the foreseen view by {}: its pictures are drawn anew",
                                excess_text(foreseen_.bounds, bounds_)));
    return false;
  }
  const FilmTask whole(film_, choice, task_.outputs());
  const std::size_t early = drawn_;
  Progress progress(console_, "render", double(whole.frames().size()), 1, "frames/s");
  while (collected_.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    stop_if_interrupted();
    progress.update(double(drawn_));
  }
  const std::unique_ptr<PictureWriter> writer = collected_.get();
  if (drawn_ != whole.frames().size()) return false;
  writer->close();
  finish_drawing(progress, whole, simulation_, bounds_.min().y(), console_,
                 fmt::format(", {} of them while it moved", early));
  return true;
}

}  // namespace sprung
