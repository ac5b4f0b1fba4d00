#include "app/export/export_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "app/console/console.h"
#include "app/console/interrupt.h"
#include "app/export/viewer.h"
#include "app/film/film_cameras.h"
#include "app/film/film_stage.h"
#include "core/error.h"
#include "core/files.h"
#include "core/io/animation.h"
#include "core/io/mesh_export.h"
#include "core/io/xdmf.h"
#include "core/simulation/run_cache.h"
#include "core/text.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using Kind = ExportTarget::Kind;

constexpr std::string_view kExamples =
    "give a pattern like skin_{:04}.obj, or film.glb, film.html, points.pc2, points.mdd, run.xdmf; sprung export "
    "--list names "
    "the formats";

[[noreturn]] void refuse(std::string_view words, std::string_view reason) {
  throw Error(ErrorKind::kUsage, fmt::format("--output {}: {}; {}", words, reason, kExamples));
}

std::size_t mesh_count(const Film& scene) {
  std::size_t count = 0;
  for (const SceneBody& body : scene.bodies) count += std::size_t(copy_count(body));
  return count;
}

/// points.pc2, or points_1.pc2 ... for several meshes.
fs::path file_of_mesh(const fs::path& file, std::size_t mesh, std::size_t count) {
  if (count == 1) return file;
  return file.parent_path() / fmt::format("{}_{}{}", file.stem().string(), mesh + 1, file.extension().string());
}

/// Calls visit(row, meshes) for every `stride`th frame of a range.
template <class Visit>
void each_frame(const CachedFilmView& view, const FrameRange& range, int stride, const Visit& visit) {
  for (int frame = range.first; frame <= range.last; frame += stride * range.step) {
    stop_if_interrupted();
    visit(frame, posed_meshes(view.simulation, view.film, view.cache.positions(frame - 1)));
  }
}

double time_at(const CachedFilmView& view, int frame) { return (frame - 1) / view.film.fps; }

void export_numbered(const ExportTarget& target, const CachedFilmView& view, const FrameRange& range,
                     const Console& console) {
  each_frame(view, range, 1, [&](int frame, const std::vector<PosedMesh>& meshes) {
    const fs::path file = target.numbered ? target.numbered->file(frame) : target.file;
    const std::string lost = frame == range.first ? lost_content(*find_mesh_format(file), meshes) : "";
    if (!lost.empty()) console.warn(fmt::format("{} files do not keep: {}", file.extension().string(), lost));
    export_meshes(meshes, file);
  });
}

void export_animation(const ExportTarget& target, const CachedFilmView& view, const FrameRange& range,
                      const Console& console) {
  const int stride = (range.count() - 2) / int(kMostTargets) + 1;
  if (stride > 1) {
    console.warn(
        fmt::format("{}: {} frames are too many for most players; every {}th is in the file, what is "
                    "between them moves evenly",
                    target.file.string(), range.count(), stride));
  }
  std::vector<AnimatedMesh> animated;
  std::vector<double> times;
  each_frame(view, range, stride, [&](int frame, std::vector<PosedMesh> meshes) {
    times.push_back(time_at(view, frame));
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      if (animated.size() == i) animated.push_back({.first = meshes[i], .positions = {}, .normals = {}});
      animated[i].positions.emplace_back(meshes[i].positions.cast<float>());
      animated[i].normals.emplace_back(shading_normals(meshes[i]).cast<float>());
    }
  });
  const double error = write_animated_glb(animated, times, target.file,
                                          target.quantize ? GlbPrecision::kQuantized : GlbPrecision::kFloat);
  if (target.quantize) {
    console.note(fmt::format("{}: coordinates are off by at most {:.2g} mm", target.file.string(), 1e3 * error));
  }
}

void export_page(const ExportTarget& target, const CachedFilmView& view, const FrameRange& range) {
  ViewerFilm viewer;
  each_frame(view, range, 1, [&](int, const std::vector<PosedMesh>& meshes) { viewer.add_frame(meshes); });
  const Reach reach = reach_of(view.simulation, cached_recording(view.cache, view.film));
  const Camera camera = cameras_of(view.film, reach, 0).at(range.first - 1);
  const auto [width, height] = view.film.render.resolution;
  write_file(target.file, viewer.page(view.film.fps / range.step, camera, double(width) / height));
}

void export_points(const ExportTarget& target, const CachedFilmView& view, const FrameRange& range) {
  std::vector<std::vector<Floats3>> points(mesh_count(view.film));
  std::vector<double> times;
  each_frame(view, range, 1, [&](int frame, const std::vector<PosedMesh>& meshes) {
    times.push_back(time_at(view, frame));
    for (std::size_t i = 0; i < meshes.size(); ++i) points[i].emplace_back(meshes[i].positions.cast<float>());
  });
  for (std::size_t i = 0; i < points.size(); ++i) {
    const fs::path file = file_of_mesh(target.file, i, points.size());
    if (target.kind == Kind::kPc2) {
      write_pc2(points[i], file);
    } else {
      write_mdd(points[i], times, file);
    }
  }
}

void export_xdmf(const ExportTarget& target, const CachedFilmView& view, const FrameRange& range) {
  XdmfWriter writer(target.file, view.simulation.world, strain_measure(view.film));
  for (const int frame : range.frames()) {
    stop_if_interrupted();
    const std::size_t row = frame - 1;
    writer.add_frame(view.cache.frame(row).progress, view.cache.positions(row), view.cache.velocities(row));
  }
  writer.close();
}

}  // namespace

ExportTarget parse_export_target(std::string_view typed) {
  const std::string name = with_braces(typed);
  const std::string_view words = name;
  if (has_number(words)) {
    NumberedName numbered = parse_numbered_name(words, kExamples);
    if (find_mesh_format(numbered.file(1)) == nullptr) refuse(words, "no format of single frames");
    return {.kind = Kind::kMeshes, .numbered = std::move(numbered), .file = {}};
  }
  const fs::path file(words);
  const std::string ending = file.extension().string();
  if (ending == ".glb") return {.kind = Kind::kAnimation, .numbered = {}, .file = file};
  if (ending == ".html") return {.kind = Kind::kPage, .numbered = {}, .file = file};
  if (ending == ".pc2") return {.kind = Kind::kPc2, .numbered = {}, .file = file};
  if (ending == ".mdd") return {.kind = Kind::kMdd, .numbered = {}, .file = file};
  if (ending == ".xdmf") return {.kind = Kind::kXdmf, .numbered = {}, .file = file};
  if (find_mesh_format(file) != nullptr) return {.kind = Kind::kMeshes, .numbered = {}, .file = file};
  std::vector<std::string_view> known{".html", ".pc2", ".mdd", ".xdmf"};
  for (const MeshFormat& format : mesh_formats()) known.push_back(format.extension);
  refuse(words, fmt::format("'{}' files cannot be written{}", ending, did_you_mean(ending, known)));
}

std::vector<fs::path> files_of(const ExportTarget& target, const Film& scene, const FrameRange& range) {
  std::vector<fs::path> files;
  if (target.kind == Kind::kMeshes && target.numbered) {
    for (const int frame : range.frames()) files.push_back(target.numbered->file(frame));
  } else if (target.kind == Kind::kPc2 || target.kind == Kind::kMdd) {
    for (std::size_t i = 0; i < mesh_count(scene); ++i)
      files.push_back(file_of_mesh(target.file, i, mesh_count(scene)));
  } else {
    files.push_back(target.file);
  }
  if (target.kind == Kind::kMeshes && files.size() == 1 && range.count() > 1) {
    refuse(target.file.string(), fmt::format("one such file cannot hold {} frames", range.count()));
  }
  return files;
}

void export_files(const ExportTarget& target, const CachedFilmView& view, const FrameRange& range,
                  const Console& console) {
  Progress progress(console, "export");
  switch (target.kind) {
    case Kind::kMeshes:
      export_numbered(target, view, range, console);
      break;
    case Kind::kAnimation:
      export_animation(target, view, range, console);
      break;
    case Kind::kPage:
      export_page(target, view, range);
      break;
    case Kind::kPc2:
    case Kind::kMdd:
      export_points(target, view, range);
      break;
    case Kind::kXdmf:
      export_xdmf(target, view, range);
      break;
  }
  const std::string name = target.numbered ? target.numbered->file(range.first).string() : target.file.string();
  progress.finish(fmt::format("{} to {}", count_of(range.count(), "frame"), name));
}

namespace {

/// A body of the scene, or one of its copies.
using BodyCopy = std::pair<std::size_t, int>;

std::string name_of(const Film& scene, const BodyCopy& which) {
  const SceneBody& body = scene.bodies[which.first];
  std::string name = body.mesh.empty() ? std::string("body") : body.mesh.stem().string();
  if (scene.bodies.size() > 1) name += fmt::format("_{}", which.first + 1);
  if (copy_count(body) > 1) name += fmt::format("_{}", which.second + 1);
  return name;
}

PosedMesh empty_mesh(const Simulation& simulation, const Film& scene, const BodyCopy& which, const Color& color) {
  const Skin& rest = simulation.meshes[which.first];
  PosedMesh mesh;
  mesh.name = name_of(scene, which);
  mesh.rest = &rest;
  mesh.color = srgb(color);
  mesh.positions.setZero(rest.positions.rows(), 3);
  mesh.normals.setZero(rest.normals.rows(), 3);
  return mesh;
}

}  // namespace

std::vector<PosedMesh> posed_meshes(const Simulation& simulation, const Film& scene, const std::vector<Points>& nodes) {
  std::map<BodyCopy, PosedMesh> meshes;
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    const SoftBody& body = simulation.world.bodies[row];
    const BodyCopy which{body.origin.body, body.origin.copy};
    if (!meshes.contains(which)) meshes[which] = empty_mesh(simulation, scene, which, body.color);
    PosedMesh& mesh = meshes[which];
    mesh.positions(body.file_vertices, Eigen::all) = deform_points(body.grid, body.file_embedding, nodes[row]);
    if (mesh.normals.rows() == 0) continue;
    const Points rest = mesh.rest->normals(body.file_vertices, Eigen::all);
    mesh.normals(body.file_vertices, Eigen::all) =
        deform_normals(body.grid, body.file_embedding, rest, nodes[row]).rowwise().normalized();
  }
  std::vector<PosedMesh> list;
  list.reserve(meshes.size());
  for (auto& [which, mesh] : meshes) list.push_back(std::move(mesh));
  return list;
}

}  // namespace sprung
