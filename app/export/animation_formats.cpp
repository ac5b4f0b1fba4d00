#include "app/export/animation_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/console/interrupt.h"
#include "app/export/posed_meshes.h"
#include "app/export/viewer_take.h"
#include "core/files.h"
#include "core/io/animation.h"
#include "core/io/xdmf.h"

namespace sprung {
namespace {

double time_at(const CachedFilmView& view, int frame) { return (frame - 1) / view.film.fps; }

/// Calls visit(frame, meshes) for every `stride`th frame of the job.
template <class Visit>
void each_frame(const AnimationJob& job, int stride, const Visit& visit) {
  const CachedFilmView& view = job.film();
  for (int frame = job.range.first; frame <= job.range.last; frame += stride * job.range.step) {
    stop_if_interrupted();
    visit(frame, posed_meshes(view.simulation, view.film, view.cache.positions(frame - 1)));
  }
}

struct MeshesOverTime {
  std::vector<AnimatedMesh> meshes;
  std::vector<double> times;  // s
};

MeshesOverTime meshes_over_time(const AnimationJob& job, int stride) {
  MeshesOverTime film;
  each_frame(job, stride, [&](int frame, const std::vector<PosedMesh>& meshes) {
    film.times.push_back(time_at(job.film(), frame));
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      if (film.meshes.size() == i) film.meshes.push_back({.first = meshes[i], .positions = {}, .normals = {}});
      film.meshes[i].positions.emplace_back(meshes[i].positions.cast<float>());
      film.meshes[i].normals.emplace_back(shading_normals(meshes[i]).cast<float>());
    }
  });
  return film;
}

void write_glb_film(const AnimationJob& job) {
  const int stride = (job.range.count() - 2) / int(kMaxTargets) + 1;
  if (stride > 1) {
    job.console.warn(
        fmt::format("{}: {} frames are too many for most players; every {}th is in the file, what is "
                    "between them moves evenly",
                    job.file.string(), job.range.count(), stride));
  }
  const MeshesOverTime film = meshes_over_time(job, stride);
  const double error = write_animated_glb(film.meshes, film.times, job.file,
                                          job.quantize ? GlbPrecision::kQuantized : GlbPrecision::kFloat);
  if (job.quantize) {
    job.console.note(fmt::format("{}: coordinates are off by at most {:.2g} mm", job.file.string(), 1e3 * error));
  }
}

void write_usd_film(const AnimationJob& job) {
  const MeshesOverTime film = meshes_over_time(job, 1);
  write_usda(film.meshes, film.times, job.film().film.fps, job.file);
}

void write_page(const AnimationJob& job) { write_file(job.file, viewer_page(viewer_takes(job.takes, job.range))); }

/// Calls write(points, times, file) for each mesh.
template <class Write>
void write_points(const AnimationJob& job, const Write& write) {
  std::vector<std::vector<Floats3>> points(mesh_count(job.film().film));
  std::vector<double> times;
  each_frame(job, 1, [&](int frame, const std::vector<PosedMesh>& meshes) {
    times.push_back(time_at(job.film(), frame));
    for (std::size_t i = 0; i < meshes.size(); ++i) points[i].emplace_back(meshes[i].positions.cast<float>());
  });
  for (std::size_t i = 0; i < points.size(); ++i) write(points[i], times, file_of_mesh(job.file, i, points.size()));
}

void write_pc2_film(const AnimationJob& job) {
  write_points(job, [](const auto& points, const auto&, const auto& file) { write_pc2(points, file); });
}

void write_mdd_film(const AnimationJob& job) {
  write_points(job, [](const auto& points, const auto& times, const auto& file) { write_mdd(points, times, file); });
}

void write_xdmf_film(const AnimationJob& job) {
  const CachedFilmView& view = job.film();
  XdmfWriter writer(job.file, view.simulation.world, regions_of(view.simulation.origins), strain_measure(view.film));
  for (const int frame : job.range.frames()) {
    stop_if_interrupted();
    const std::size_t row = frame - 1;
    writer.add_frame(view.cache.frame(row).progress, view.cache.positions(row), view.cache.velocities(row));
  }
  writer.close();
}

constexpr std::array<AnimationFormat, 6> kFormats{{
    {.extension = ".glb",
     .example = "film.glb",
     .what = "glTF 2 with an animation, for Blender, three.js and browsers",
     .can_quantize = true,
     .write = write_glb_film},
    {.extension = ".usda",
     .example = "film.usda",
     .what = "USD as text, with time samples, for Houdini, Omniverse, Maya and Blender",
     .write = write_usd_film},
    {.extension = ".html",
     .example = "film.html",
     .what = "a page to look at in a browser, by itself: fields, bricks, springs, several takes",
     .holds_takes = true,
     .write = write_page},
    {.extension = ".pc2",
     .example = "points.pc2",
     .what = "Point Cache 2: vertices of each frame, for Blender's Mesh Cache modifier",
     .is_per_mesh = true,
     .write = write_pc2_film},
    {.extension = ".mdd",
     .example = "points.mdd",
     .what = "LightWave's point cache, likewise",
     .is_per_mesh = true,
     .write = write_mdd_film},
    {.extension = ".xdmf",
     .example = "run.xdmf",
     .what = "bricks with their fields, and skins, for ParaView; the numbers are in .xdmf.h5",
     .write = write_xdmf_film},
}};

}  // namespace

std::span<const AnimationFormat> animation_formats() { return kFormats; }

const AnimationFormat* find_animation_format(const std::filesystem::path& file) {
  const std::string extension = lower_extension(file);
  const auto* found = std::find_if(kFormats.begin(), kFormats.end(),
                                   [&](const AnimationFormat& format) { return format.extension == extension; });
  return found == kFormats.end() ? nullptr : found;
}

std::filesystem::path file_of_mesh(const std::filesystem::path& file, std::size_t mesh, std::size_t count) {
  if (count == 1) return file;
  return file.parent_path() / fmt::format("{}_{}{}", file.stem().string(), mesh + 1, file.extension().string());
}

}  // namespace sprung
