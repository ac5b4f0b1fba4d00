#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "core/appearance.h"
#include "core/error.h"
#include "core/files.h"
#include "core/io/animation.h"
#include "core/io/glb_buffer.h"

namespace sprung {
namespace {

constexpr std::uint64_t kMaxBytes = 0xFFFFFF00;
constexpr std::uint32_t kMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t kJson = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinary = 0x004E4942;  // "BIN"

void add_number(std::string& bytes, std::size_t value) {
  const auto number = static_cast<std::uint32_t>(value);
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

std::size_t padding_of(std::size_t size) { return (4 - size % 4) % 4; }

/// A file in pieces: the buffer is not copied.
struct GlbFile {
  std::string head;
  std::string_view buffer;
  std::string padding;
};

/// Builds a glTF file mesh by mesh.
class GlbBuilder {
 public:
  GlbBuilder(std::size_t frames, GlbPrecision precision) : frames_(frames), precision_(precision) {}

  /// Returns the largest error of a coordinate, m.
  double add(const AnimatedMesh& mesh) {
    const bool is_exact = precision_ == GlbPrecision::kFloat;
    const GlbVertices vertices = is_exact ? add_floats(buffer_, mesh) : add_quantized(buffer_, mesh);
    const GltfJson attributes = attributes_of(mesh, vertices);
    GltfJson primitives = GltfJson::array();
    for (const PosedPart& part : parts_of(mesh.first)) {
      const auto* indices = mesh.first.rest->triangles.data() + 3 * std::ptrdiff_t(part.first_triangle);
      const int index = buffer_.add_indices({indices, 3 * std::size_t(part.triangle_count)});
      GltfJson primitive{{"attributes", attributes}, {"indices", index}, {"material", material_of(part)}};
      if (frames_ > 1) primitive["targets"] = targets_of(vertices);
      primitives.push_back(std::move(primitive));
    }
    GltfJson node{{"name", mesh.first.name}, {"mesh", meshes_.size()}};
    node.update(vertices.transform);
    nodes_.push_back(std::move(node));
    GltfJson made{{"name", mesh.first.name}, {"primitives", std::move(primitives)}};
    if (frames_ > 1) made["weights"] = std::vector<int>(frames_ - 1, 0);
    meshes_.push_back(std::move(made));
    return vertices.error;
  }

  /// Call last.
  [[nodiscard]] GlbFile finish(const std::vector<double>& times) {
    const std::string text = document(times).dump(-1, ' ', false, GltfJson::error_handler_t::replace);
    GlbFile out{.head = {}, .buffer = buffer_.bytes(), .padding = {}};
    out.padding.assign(padding_of(out.buffer.size()), '\0');
    const std::size_t size = text.size() + padding_of(text.size());
    const std::size_t binary = out.buffer.size() + out.padding.size();
    for (const std::size_t number :
         {std::size_t{kMagic}, std::size_t{2}, 28 + size + binary, size, std::size_t{kJson}}) {
      add_number(out.head, number);
    }
    out.head += text;
    out.head.append(size - text.size(), ' ');
    add_number(out.head, binary);
    add_number(out.head, kBinary);
    return out;
  }

 private:
  [[nodiscard]] GltfJson document(const std::vector<double>& times) {
    GltfJson document{{"asset", {{"version", "2.0"}, {"generator", "sprung"}}}};
    if (precision_ == GlbPrecision::kQuantized) {
      document["extensionsUsed"] = {"KHR_mesh_quantization"};
      document["extensionsRequired"] = {"KHR_mesh_quantization"};
    }
    std::vector<int> roots(nodes_.size());
    std::iota(roots.begin(), roots.end(), 0);
    document["scene"] = 0;
    document["scenes"] = {{{"nodes", roots}}};
    document["nodes"] = nodes_;
    document["meshes"] = meshes_;
    document["materials"] = materials_;
    if (!images_.empty()) {
      document["images"] = images_;
      for (std::size_t i = 0; i < images_.size(); ++i) document["textures"].push_back({{"source", i}});
    }
    if (frames_ > 1) document["animations"].push_back(animation_of(times));
    buffer_.describe(document);
    return document;
  }

  GltfJson attributes_of(const AnimatedMesh& mesh, const GlbVertices& vertices) {
    const Skin& rest = *mesh.first.rest;
    GltfJson attributes{{"POSITION", vertices.positions.front()}, {"NORMAL", vertices.normals.front()}};
    if (rest.uvs.rows() > 0) attributes["TEXCOORD_0"] = buffer_.add_uvs(rest.uvs);
    if (rest.colors.rows() > 0) {
      Floats4 colors = rest.colors.cwiseMax(0.0F).cwiseMin(1.0F);
      colors.leftCols<3>() = colors.leftCols<3>().unaryExpr(&linear_from_srgb).eval();
      attributes["COLOR_0"] = buffer_.add_colors(colors);
    }
    return attributes;
  }

  [[nodiscard]] GltfJson targets_of(const GlbVertices& vertices) const {
    GltfJson targets = GltfJson::array();
    for (std::size_t frame = 1; frame < frames_; ++frame) {
      targets.push_back({{"POSITION", vertices.positions[frame]}, {"NORMAL", vertices.normals[frame]}});
    }
    return targets;
  }

  std::size_t material_of(const PosedPart& part) {
    const auto known = std::find(material_names_.begin(), material_names_.end(), part.material);
    if (known != material_names_.end()) return known - material_names_.begin();
    material_names_.push_back(part.material);
    GltfJson material{{"name", part.material}, {"doubleSided", true}};
    if (part.color[3] < 1) material["alphaMode"] = "BLEND";
    GltfJson& surface = material["pbrMetallicRoughness"];
    surface["baseColorFactor"] = {linear_from_srgb(part.color[0]), linear_from_srgb(part.color[1]),
                                  linear_from_srgb(part.color[2]), part.color[3]};
    surface["metallicFactor"] = 0;
    surface["roughnessFactor"] = kExportedRoughness;
    if (part.source != nullptr && !texture_extension(*part.source).empty()) {
      const int view = buffer_.add_image(part.source->texture);
      const bool is_png = texture_extension(*part.source) == ".png";
      surface["baseColorTexture"]["index"] = images_.size();
      images_.push_back({{"bufferView", view}, {"mimeType", is_png ? "image/png" : "image/jpeg"}});
    }
    materials_.push_back(std::move(material));
    return materials_.size() - 1;
  }

  /// One sampler for all: at frame f the target f - 1 has all the weight.
  GltfJson animation_of(const std::vector<double>& times) {
    std::vector<float> seconds(times.begin(), times.end());
    for (float& second : seconds) second -= float(times.front());
    std::vector<float> weights(frames_ * (frames_ - 1), 0);
    for (std::size_t frame = 1; frame < frames_; ++frame) weights[frame * (frames_ - 1) + frame - 1] = 1;
    const int input = buffer_.add_scalars(seconds, true);
    const int output = buffer_.add_scalars(weights, false);
    GltfJson animation{{"name", "film"}};
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      animation["channels"].push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}});
    }
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
    return animation;
  }

  std::size_t frames_;
  GlbPrecision precision_;
  GlbBuffer buffer_;
  GltfJson nodes_ = GltfJson::array();
  GltfJson meshes_ = GltfJson::array();
  GltfJson materials_ = GltfJson::array();
  GltfJson images_ = GltfJson::array();
  std::vector<std::string> material_names_;
};

}  // namespace

double write_animated_glb(const std::vector<AnimatedMesh>& meshes, const std::vector<double>& times,
                          const std::filesystem::path& file, GlbPrecision precision) {
  const unsigned vertex_bytes = precision == GlbPrecision::kFloat ? 24 : 20;  // at most
  std::uint64_t bytes = 0;
  for (const AnimatedMesh& mesh : meshes) {
    bytes += vertex_bytes * static_cast<std::uint64_t>(mesh.first.positions.rows()) * times.size();
  }
  if (bytes > kMaxBytes) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("'{}' would have {:.1f} GB, more than the 4 GB of a .glb; export fewer frames (--frames)",
                            file.string(), 1e-9 * double(bytes)));
  }
  GlbBuilder builder(times.size(), precision);
  double error = 0;
  for (const AnimatedMesh& mesh : meshes) error = std::max(error, builder.add(mesh));
  const GlbFile out = builder.finish(times);
  write_file(file, {out.head, out.buffer, out.padding});
  return error;
}

std::string static_glb(const std::vector<PosedMesh>& meshes) {
  GlbBuilder builder(1, GlbPrecision::kFloat);
  for (const PosedMesh& mesh : meshes) {
    builder.add(
        {.first = mesh, .positions = {mesh.positions.cast<float>()}, .normals = {shading_normals(mesh).cast<float>()}});
  }
  const GlbFile out = builder.finish({0});
  return out.head + std::string(out.buffer) + out.padding;
}

}  // namespace sprung
