#include "core/simulation/body_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/bricks/thin_parts.h"
#include "core/bricks/voxelize.h"
#include "core/error.h"
#include "core/files.h"
#include "core/io/decode_image.h"
#include "core/mesh/io/read_mesh.h"
#include "core/simulation/selector.h"
#include "core/simulation/shapes.h"
#include "core/simulation/simulation.h"
#include "core/types.h"
#include "core/units.h"

namespace sprung {
namespace {

Vec3 centre_of(const AlignedBox& box) { return box.min() + box.sizes() / 2; }

/// Moves a mesh so that the centre of its bounding box is at the origin, and returns the box before that. Vertices
/// without triangles are ignored. Done in double precision and first of all, so that a mesh far from the origin loses
/// no accuracy later.
AlignedBox recentre(SurfaceMesh& mesh) {
  AlignedBox box;
  for (const int vertex : mesh.triangles.reshaped()) box.extend(Vec3(mesh.positions.row(vertex)));
  mesh.positions.rowwise() -= centre_of(box).transpose();
  return box;
}

/// The distance of a mesh from its origin, in its sizes, beyond which single precision distorts it by more than 0.1 %.
constexpr double kFarAway = 1e4;

/// Surface points at which the thickness of a body is sampled.
constexpr double kFewestWallSamples = 20000;
constexpr double kMaxWallSamples = 200000;
constexpr double kWallSamplesABrick = 4;  // that the surface cuts

void warn_if_far_away(const SceneBody& body, const SurfaceMesh& mesh, double sizes, const Observer& observer) {
  if (sizes < kFarAway || !mesh.single_precision) return;
  observer.warn(
      fmt::format("{}: lies {:.2g} times its size from the origin of its file; in the single precision of its format, "
                  "that moves its points by up to {:.1g} of its size; move it to the origin in a mesh editor",
                  body.mesh.filename().string(), sizes, sizes * std::numeric_limits<float>::epsilon() / 2));
}

/// Only for accepted meshes: one that is rejected gets a single line.
void report_reading(const SceneBody& body, const LoadedBody& loaded, const Observer& observer) {
  for (const std::string& note : loaded.mesh.notes) observer.warn(fmt::format("{}: {}", loaded.name, note));
  const double length = (loaded.file_from_rest.linear() * loaded.extent).maxCoeff();
  warn_if_far_away(body, loaded.mesh, loaded.file_from_rest.translation().norm() / length, observer);
  if (body.scale || body.size || body.mesh.empty()) return;
  observer.note(fmt::format("size: {} is {:.4g} file units long, drawn {} m long; --size 12cm or --unit mm changes it",
                            loaded.name, length, kDefaultSize));
}

/// Replaces all materials of the file.
void put_on_texture(const SceneBody& body, SurfaceMesh& mesh) {
  if (mesh.uvs.rows() == 0) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has no UVs, which say where the texture '{}' goes; unwrap it in a mesh editor",
                            body.mesh.string(), body.texture.string()));
  }
  check_readable(body.texture);
  std::ostringstream stream;
  stream << std::ifstream(body.texture, std::ios::binary).rdbuf();
  const std::string bytes = stream.str();
  SurfaceMaterial material{.name = "texture", .color = Eigen::Vector4f::Ones(), .texture = {}, .texture_name = {}};
  material.texture.resize(bytes.size());
  std::memcpy(material.texture.data(), bytes.data(), bytes.size());
  material.texture_name = body.texture.filename().string();
  static_cast<void>(decode_pixels(material.texture, body.texture.string()));  // fail early
  mesh.materials = {std::move(material)};
  for (Part& part : mesh.parts) part.material = 0;
}

/// m; the default if it is yet to be chosen.
double wanted_brick_size(const SceneBody& body, const Vec3& extent) {
  const BrickCount count = body.bricks.value_or(kDefaultBricks);
  return body.brick_size.value_or(extent.maxCoeff() / (count.is_auto() ? kDefaultBricks : count.along));
}

void load_mesh(const SceneBody& body, LoadedBody& loaded) {
  loaded.name = body.surface ? "the mesh" : body.mesh.filename().string();
  loaded.mesh = body.surface ? *body.surface : read_mesh(body.mesh);
  if (!body.texture.empty()) put_on_texture(body, loaded.mesh);
  const AlignedBox box = recentre(loaded.mesh);
  const Vec3 centre = centre_of(box);
  const Vec3 extent = box.sizes();
  const double length = extent.maxCoeff();
  if (!(length > 0)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: all points of the mesh coincide{}", body.mesh.string(),
                            centre.norm() > 0 ? ", perhaps because they lie too far from the origin" : ""));
  }
  const double scale = body.scale.value_or(body.size.value_or(kDefaultSize) / length);
  loaded.mesh.positions *= scale;
  loaded.extent = extent * scale;
  loaded.file_from_rest = Eigen::Translation3d(centre) * Eigen::Scaling(1 / scale);
  loaded.brick_size = wanted_brick_size(body, loaded.extent);
}

/// Removes the bricks of a box that the cuts select.
void take_out(const std::vector<Cut>& cuts, LoadedBody& loaded) {
  BrickGrid& grid = *loaded.grid;
  std::vector<bool> is_gone(grid.cells.size());
  const Selector selector(loaded);
  for (const Cut& cut : cuts) {
    for (const int brick : selector.bricks(cut, grid, 0)) is_gone[brick] = true;
  }
  std::vector<Eigen::Vector3i> kept;
  for (std::size_t brick = 0; brick < is_gone.size(); ++brick) {
    if (!is_gone[brick]) kept.push_back(grid.cells[brick]);
  }
  if (kept.empty()) throw Error(ErrorKind::kBadInput, "the cuts leave nothing of the box");
  grid.cells = std::move(kept);
  grid.fill.resize(grid.cells.size());
  number_nodes(grid);
  loaded.mesh = surface_of(grid);
}

void load_box(const SceneBody& body, LoadedBody& loaded) {
  loaded.name = "box";
  loaded.extent = *body.box;
  if (body.bricks && body.bricks->is_auto()) {
    throw Error(ErrorKind::kBadInput, "a box is a whole number of bricks; bricks = \"auto\" is for a mesh");
  }
  loaded.brick_size = wanted_brick_size(body, loaded.extent);
  loaded.grid = box_grid(loaded.extent, loaded.brick_size);
  loaded.mesh = surface_of(*loaded.grid);
  if (!body.cuts.empty()) take_out(body.cuts, loaded);
}

void load_shape(const SceneBody& body, LoadedBody& loaded) {
  if (body.sphere) loaded.mesh = mesh_of(*body.sphere);
  if (body.cylinder) loaded.mesh = mesh_of(*body.cylinder);
  if (body.torus) loaded.mesh = mesh_of(*body.torus);
  loaded.name = loaded.mesh.parts[0].name;
  loaded.extent = loaded.mesh.positions.colwise().maxCoeff() - loaded.mesh.positions.colwise().minCoeff();
  loaded.brick_size = wanted_brick_size(body, loaded.extent);
}

/// Such bricks would not represent the body at all.
void refuse_giant_bricks(const LoadedBody& loaded) {
  constexpr double kRounding = 1e-9;
  const double longest = loaded.extent.maxCoeff();
  if (loaded.brick_size <= longest * (1 + kRounding)) return;
  throw Error(ErrorKind::kBadInput, fmt::format("{}: a brick of {} is larger than the body, whose longest side is {}; "
                                                "give a smaller --brick-size, or --bricks",
                                                loaded.name, readable(loaded.brick_size, Dimension::kLength),
                                                readable(longest, Dimension::kLength)));
}

void refuse_giant_shell(const SceneBody& body, const LoadedBody& loaded) {
  const double longest = loaded.extent.maxCoeff();
  if (body.thickness.value_or(0) <= longest) return;
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("{}: a shell of {} is thicker than the body is long ({}); give a smaller --thickness", loaded.name,
                  readable(*body.thickness, Dimension::kLength), readable(longest, Dimension::kLength)));
}

/// Reports repairs. Bricks do not need a surface without self-intersections, but overlapping parts merge.
void report_repairs(const Solids& found, const Observer& observer, const LoadedBody& loaded) {
  const Vec3 position = loaded.file_from_rest * (loaded.bricks_from_rest.transpose() * found.crossing);
  for (const Repair& repair : found.repairs) {
    const std::string where = repair.kind == "self_intersection"
                                  ? fmt::format("; the first near ({:.4g}, {:.4g}, {:.4g}) of the file", position.x(),
                                                position.y(), position.z())
                                  : "";
    const std::string text = fmt::format("{}: {}{}", loaded.name, repair.text, where);
    if (repair.harmless) {
      observer.detail(text);
    } else {
      observer.warn(text);
    }
  }
}

/// Bricks larger than the thickness of a shell have its mass, but bend like a shell of their own size.
void report_thickness(const SceneBody& body, const Observer& observer, const LoadedBody& loaded) {
  constexpr double kRounding = 1e-9;
  if (!body.thickness || loaded.brick_size <= *body.thickness * (1 + kRounding)) return;
  observer.warn(fmt::format(
      "{}: bricks of {} are larger than the shell is thick, which bends as if it were as thick as "
      "they are; bricks of {} would be right (--brick-size)",
      loaded.name, readable(loaded.brick_size, Dimension::kLength), readable(*body.thickness, Dimension::kLength)));
}

/// Existing bricks do not rotate with the body.
void turn(const Mat3& rotation, LoadedBody& loaded) {
  if (rotation.isIdentity(0)) return;
  loaded.bricks_from_rest = rotation;
  loaded.mesh.positions = loaded.mesh.positions * rotation.transpose();
  loaded.mesh.normals = loaded.mesh.normals * rotation.transpose().cast<float>();
  loaded.grid.reset();
}

std::string reason_of(const BrickChoice& choice) {
  const std::string thickness = readable(choice.thickness, Dimension::kLength);
  switch (choice.reason) {
    case BrickChoice::Reason::kThickness:
      return fmt::format("two across {}, which 95 % of the surface is thicker than", thickness);
    case BrickChoice::Reason::kShape:
      return "enough for the shape; no relevant part is thinner than two of them";
    case BrickChoice::Reason::kBudget:
      break;
  }
  return fmt::format(
      "the most that {:.0f} bricks allow; {}, which 95 % of the surface is thicker than, is {:.2g} of "
      "them thick",
      kBrickBudget, thickness, choice.across);
}

/// Several per brick at the surface, unless the bricks are very small.
std::vector<std::vector<WallSample>> sample_walls(const LoadedBody& loaded) {
  double bricks = 0;
  for (const Solid& solid : loaded.solids) bricks += surface_area(solid) / (loaded.brick_size * loaded.brick_size);
  const double count = std::clamp(kWallSamplesABrick * bricks, kFewestWallSamples, kMaxWallSamples);
  return sample_thickness(loaded.solids, int(count));
}

void choose_bricks(LoadedBody& loaded, const Observer& observer) {
  const double longest = loaded.extent.maxCoeff();
  const BrickChoice choice = choose_brick_size(loaded.solids, loaded.walls, longest);
  loaded.brick_size = choice.size;
  observer.note(fmt::format("bricks: {} of {} along {}: {}", std::lround(longest / choice.size),
                            readable(choice.size, Dimension::kLength), loaded.name, reason_of(choice)));
}

}  // namespace

namespace {

/// Errors that a scene file cannot contain, but a caller of the library can.
void check_body(const SceneBody& body, const std::string& name) {
  check_material(body.material);
  const auto refuse = [&](std::string_view what, double value, std::string_view range) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {} is {:g} m; it must be {}", name, what, value, range));
  };
  const double size = body.size.value_or(1);
  if (!std::isfinite(size)) refuse("size", size, "finite");
  if (size <= 0) refuse("size", size, "above 0");
  if (body.brick_size.value_or(1) <= 0) refuse("brick_size", *body.brick_size, "above 0");
  if (body.bricks && body.bricks->along < 0) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: bricks ({}) must be above 0", name, body.bricks->along));
  }
}

}  // namespace

LoadedBody load_solids(const SceneBody& body, const Observer& observer) {
  check_body(body, body.surface ? "the mesh" : body.mesh.filename().string());
  LoadedBody loaded;
  if (body.box) {
    load_box(body, loaded);
  } else if (body.mesh.empty() && !body.surface) {
    load_shape(body, loaded);
  } else {
    load_mesh(body, loaded);
  }
  refuse_giant_bricks(loaded);
  refuse_giant_shell(body, loaded);
  const std::string file = body.mesh.empty() ? loaded.name : body.mesh.string();
  turn(rotation_matrix(body.brick_rotation), loaded);
  Solids found = find_solids(loaded.mesh, file, {.repair = body.repair, .thickness = body.thickness.value_or(0)});
  if (!body.box) {
    report_reading(body, loaded, observer);
    report_repairs(found, observer, loaded);
  }
  loaded.repairs = std::move(found.repairs);
  loaded.solids = std::move(found.solids);
  if (loaded.solids.size() > 1) loaded.grid.reset();
  return loaded;
}

LoadedBody load_body(const SceneBody& body, const Observer& observer) {
  LoadedBody loaded = load_solids(body, observer);
  for (Solid& solid : loaded.solids) solid.volume = enclosed_volume(solid);
  if (body.box) return loaded;
  loaded.walls = sample_walls(loaded);
  if (body.bricks && body.bricks->is_auto()) {
    choose_bricks(loaded, observer);
    loaded.walls = sample_walls(loaded);
  }
  report_thickness(body, observer, loaded);
  return loaded;
}

}  // namespace sprung
