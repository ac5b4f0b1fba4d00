#include "core/io/animation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "core/appearance.h"
#include "core/error.h"
#include "core/files.h"
#include "core/io/mesh_export.h"

namespace sprung {
namespace {

constexpr int kByte = 5120;
constexpr int kShort = 5122;
constexpr int kFloat = 5126;
constexpr int kUnsigned = 5125;

constexpr std::uint64_t kMostBytes = 0xFFFFFF00;
constexpr std::uint32_t kMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t kJson = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinary = 0x004E4942;  // "BIN"

constexpr float kMostShort = 32766;  // one to spare for differences of rounded numbers
constexpr float kMostByte = 127;
constexpr float kLeastLength = 0.25F;  // of a scaled normal

template <class Row>
std::string list_of(const Row& row) {
  std::vector<float> values(row.begin(), row.end());
  return fmt::format("[{:.9g}]", fmt::join(values, ","));
}

/// With a fourth column of zeros: vertices are aligned to four bytes.
template <class Value>
Eigen::Matrix<Value, Eigen::Dynamic, 4, Eigen::RowMajor> padded(
    const Eigen::Matrix<Value, Eigen::Dynamic, 3, Eigen::RowMajor>& rows) {
  Eigen::Matrix<Value, Eigen::Dynamic, 4, Eigen::RowMajor> wide(rows.rows(), 4);
  wide << rows, Eigen::Matrix<Value, Eigen::Dynamic, 1>::Zero(rows.rows());
  return wide;
}

template <class Matrix>
std::size_t size_of(const Matrix& rows) {
  return std::size_t(rows.size()) * sizeof(float);
}

using Integers3 = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Quantized positions: origin + step * integers.
struct Lattice {
  Eigen::RowVector3f origin;
  float step = 1;

  [[nodiscard]] Integers3 quantize(const Floats3& positions) const {
    return ((positions.rowwise() - origin) / step).array().round().cast<int>();
  }
};

/// Covers the first frame around its centre, and the displacement of every vertex from it.
Lattice lattice_of(const std::vector<Floats3>& positions) {
  const Floats3& first = positions.front();
  const Eigen::RowVector3f low = first.colwise().minCoeff();
  const Eigen::RowVector3f high = first.colwise().maxCoeff();
  float reach = 0.5F * (high - low).maxCoeff();
  for (const Floats3& later : positions) reach = std::max(reach, (later - first).cwiseAbs().maxCoeff());
  return {.origin = 0.5F * (low + high), .step = reach > 0 ? reach / kMostShort : 1};
}

/// The greatest length, at most 1, at which `normal` minus `base` has no component outside [-1, 1].
float fitting_length(const Eigen::RowVector3f& normal, const Eigen::RowVector3f& base) {
  float length = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (normal[axis] == 0) continue;
    length = std::min(length, (1 + std::copysign(1.0F, normal[axis]) * base[axis]) / std::abs(normal[axis]));
  }
  return length;
}

Bytes3 bytes_of(const Floats3& normals) { return (kMostByte * normals).array().round().cast<std::int8_t>(); }

/// The targets that take the base to these normals; nothing where they do not fit.
std::optional<Bytes3> normal_targets(const Floats3& normals, const Floats3& base) {
  Floats3 targets(normals.rows(), 3);
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const float length = fitting_length(normals.row(i), base.row(i));
    if (length < kLeastLength) return std::nullopt;
    targets.row(i) = length * normals.row(i) - base.row(i);
  }
  return bytes_of(targets);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char letter : text) {
    if (static_cast<unsigned char>(letter) < 0x20) {
      out += fmt::format("\\u{:04x}", letter);
      continue;
    }
    if (letter == '"' || letter == '\\') out += '\\';
    out += letter;
  }
  return out + '"';
}

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
    const std::string attributes = attributes_of(mesh, vertices);
    const std::string targets = targets_of(vertices);
    std::vector<std::string> primitives;
    for (const PosedPart& part : parts_of(mesh.first)) {
      const auto* indices = mesh.first.rest->triangles.data() + 3 * std::ptrdiff_t(part.first_triangle);
      const int index = buffer_.add_indices({indices, 3 * std::size_t(part.triangle_count)});
      primitives.push_back(fmt::format("{{\"attributes\":{{{}}},\"indices\":{},\"material\":{}{}}}", attributes, index,
                                       material_of(part), targets));
    }
    const std::string weights =
        frames_ > 1 ? fmt::format(",\"weights\":[{}]", fmt::join(std::vector<int>(frames_ - 1, 0), ",")) : "";
    const std::string name = quoted(mesh.first.name);
    meshes_.push_back(fmt::format("{{\"name\":{},\"primitives\":[{}]{}}}", name, fmt::join(primitives, ","), weights));
    nodes_.push_back(fmt::format("{{\"name\":{},\"mesh\":{}{}}}", name, nodes_.size(), vertices.transform));
    return vertices.error;
  }

  /// Call last.
  [[nodiscard]] GlbFile finish(const std::vector<double>& times) {
    const std::string animation = frames_ > 1 ? animation_of(times) : "";
    std::vector<std::size_t> roots(nodes_.size());
    for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = i;
    std::string json = fmt::format(
        "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"sprung\"}}{},\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],"
        "\"nodes\":[{}],\"meshes\":[{}],\"materials\":[{}]{}{},{}}}",
        extensions(), fmt::join(roots, ","), fmt::join(nodes_, ","), fmt::join(meshes_, ","),
        fmt::join(materials_, ","), images(), animation, buffer_.json());
    json.append(padding_of(json.size()), ' ');
    GlbFile out{.head = {}, .buffer = buffer_.bytes(), .padding = {}};
    out.padding.assign(padding_of(out.buffer.size()), '\0');
    const std::size_t binary = out.buffer.size() + out.padding.size();
    for (const std::size_t number :
         {std::size_t{kMagic}, std::size_t{2}, 28 + json.size() + binary, json.size(), std::size_t{kJson}}) {
      add_number(out.head, number);
    }
    out.head += json;
    add_number(out.head, binary);
    add_number(out.head, kBinary);
    return out;
  }

 private:
  [[nodiscard]] std::string extensions() const {
    if (precision_ == GlbPrecision::kFloat) return "";
    return R"(,"extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"])";
  }

  std::string attributes_of(const AnimatedMesh& mesh, const GlbVertices& vertices) {
    const Skin& rest = *mesh.first.rest;
    std::string text =
        fmt::format("\"POSITION\":{},\"NORMAL\":{}", vertices.positions.front(), vertices.normals.front());
    if (rest.uvs.rows() > 0) text += fmt::format(",\"TEXCOORD_0\":{}", buffer_.add_uvs(rest.uvs));
    if (rest.colors.rows() > 0) {
      Floats4 colors = rest.colors.cwiseMax(0.0F).cwiseMin(1.0F);
      colors.leftCols<3>() = colors.leftCols<3>().unaryExpr(&linear_from_srgb).eval();
      text += fmt::format(",\"COLOR_0\":{}", buffer_.add_colors(colors));
    }
    return text;
  }

  [[nodiscard]] std::string targets_of(const GlbVertices& vertices) const {
    if (frames_ < 2) return "";
    std::vector<std::string> targets;
    for (std::size_t frame = 1; frame < frames_; ++frame) {
      targets.push_back(
          fmt::format("{{\"POSITION\":{},\"NORMAL\":{}}}", vertices.positions[frame], vertices.normals[frame]));
    }
    return fmt::format(",\"targets\":[{}]", fmt::join(targets, ","));
  }

  std::size_t material_of(const PosedPart& part) {
    const auto known = std::find(material_names_.begin(), material_names_.end(), part.material);
    if (known != material_names_.end()) return known - material_names_.begin();
    material_names_.push_back(part.material);
    std::string texture;
    if (part.source != nullptr && !texture_extension(*part.source).empty()) {
      const int view = buffer_.add_image(part.source->texture);
      const bool is_png = texture_extension(*part.source) == ".png";
      texture = fmt::format(",\"baseColorTexture\":{{\"index\":{}}}", images_.size());
      images_.push_back(fmt::format("{{\"bufferView\":{},\"mimeType\":\"image/{}\"}}", view, is_png ? "png" : "jpeg"));
    }
    materials_.push_back(fmt::format(
        "{{\"name\":{},\"doubleSided\":true{},\"pbrMetallicRoughness\":{{\"baseColorFactor\":[{:.6g},{:.6g},{:.6g},"
        "{:.6g}],\"metallicFactor\":0,\"roughnessFactor\":0.6{}}}}}",
        quoted(part.material), part.color[3] < 1 ? ",\"alphaMode\":\"BLEND\"" : "", linear_from_srgb(part.color[0]),
        linear_from_srgb(part.color[1]), linear_from_srgb(part.color[2]), part.color[3], texture));
    return materials_.size() - 1;
  }

  [[nodiscard]] std::string images() const {
    if (images_.empty()) return "";
    std::vector<std::string> textures;
    for (std::size_t i = 0; i < images_.size(); ++i) textures.push_back(fmt::format("{{\"source\":{}}}", i));
    return fmt::format(",\"images\":[{}],\"textures\":[{}]", fmt::join(images_, ","), fmt::join(textures, ","));
  }

  /// One sampler for all: at frame f the target f - 1 has all the weight.
  std::string animation_of(const std::vector<double>& times) {
    std::vector<float> seconds(times.begin(), times.end());
    for (float& second : seconds) second -= float(times.front());
    std::vector<float> weights(frames_ * (frames_ - 1), 0);
    for (std::size_t frame = 1; frame < frames_; ++frame) weights[frame * (frames_ - 1) + frame - 1] = 1;
    const int input = buffer_.add_scalars(seconds, true);
    const int output = buffer_.add_scalars(weights, false);
    std::vector<std::string> channels;
    for (std::size_t node = 0; node < nodes_.size(); ++node) {
      channels.push_back(fmt::format("{{\"sampler\":0,\"target\":{{\"node\":{},\"path\":\"weights\"}}}}", node));
    }
    return fmt::format(
        ",\"animations\":[{{\"name\":\"film\",\"channels\":[{}],\"samplers\":[{{\"input\":{},\"output\":{},"
        "\"interpolation\":\"LINEAR\"}}]}}]",
        fmt::join(channels, ","), input, output);
  }

  std::size_t frames_;
  GlbPrecision precision_;
  GlbBuffer buffer_;
  std::vector<std::string> nodes_;
  std::vector<std::string> meshes_;
  std::vector<std::string> materials_;
  std::vector<std::string> material_names_;
  std::vector<std::string> images_;
};

void add_bytes(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

template <class Value>
void add_little(std::string& bytes, Value value) {
  static_assert(std::endian::native == std::endian::little);
  add_bytes(bytes, &value, sizeof(value));
}

template <class Value>
void add_big(std::string& bytes, Value value) {
  static_assert(sizeof(value) == 4);
  const std::uint32_t flipped = __builtin_bswap32(std::bit_cast<std::uint32_t>(value));
  add_bytes(bytes, &flipped, sizeof(flipped));
}

std::int32_t count_of_points(const std::vector<Floats3>& frames) {
  return frames.empty() ? 0 : static_cast<std::int32_t>(frames.front().rows());
}

}  // namespace

int GlbBuffer::add_view(const void* data, std::size_t size, Use use, std::size_t stride) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
  const std::string target = use == Use::kOther ? "" : fmt::format(",\"target\":{}", int(use));
  const std::string apart = stride == 0 ? "" : fmt::format(",\"byteStride\":{}", stride);
  views_.push_back(
      fmt::format("{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}{}{}}}", bytes_.size(), size, apart, target));
  bytes_.append(static_cast<const char*>(data), size);
  return isize(views_) - 1;
}

int GlbBuffer::add_accessor(int view, const char* type, int component, std::size_t count, const std::string& bounds) {
  accessors_.push_back(fmt::format("{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}", view,
                                   component, count, type, bounds));
  return isize(accessors_) - 1;
}

int GlbBuffer::add_vectors(const Floats3& rows, bool with_bounds) {
  const int view = add_view(rows.data(), size_of(rows), Use::kVertices);
  std::string bounds;
  if (with_bounds) {
    const Eigen::RowVector3f low = rows.colwise().minCoeff();
    const Eigen::RowVector3f high = rows.colwise().maxCoeff();
    bounds = fmt::format(",\"min\":{},\"max\":{}", list_of(low), list_of(high));
  }
  return add_accessor(view, "VEC3", kFloat, rows.rows(), bounds);
}

int GlbBuffer::add_shorts(const Shorts3& rows) {
  const auto wide = padded(rows);
  const int view =
      add_view(wide.data(), std::size_t(wide.size()) * sizeof(std::int16_t), Use::kVertices, 4 * sizeof(std::int16_t));
  const std::string bounds = fmt::format(",\"min\":[{}],\"max\":[{}]", fmt::join(rows.colwise().minCoeff().eval(), ","),
                                         fmt::join(rows.colwise().maxCoeff().eval(), ","));
  return add_accessor(view, "VEC3", kShort, rows.rows(), bounds);
}

int GlbBuffer::add_bytes(const Bytes3& rows) {
  const auto wide = padded(rows);
  const int view = add_view(wide.data(), wide.size(), Use::kVertices, 4);
  return add_accessor(view, "VEC3", kByte, rows.rows(), ",\"normalized\":true");
}

int GlbBuffer::add_uvs(const Floats2& rows) {
  Floats2 down = rows;  // v runs down in glTF
  down.col(1) = 1.0F - down.col(1).array();
  const int view = add_view(down.data(), size_of(down), Use::kVertices);
  return add_accessor(view, "VEC2", kFloat, down.rows(), "");
}

int GlbBuffer::add_colors(const Floats4& rows) {
  const int view = add_view(rows.data(), size_of(rows), Use::kVertices);
  return add_accessor(view, "VEC4", kFloat, rows.rows(), "");
}

int GlbBuffer::add_indices(std::span<const int> indices) {
  const int view = add_view(indices.data(), indices.size_bytes(), Use::kIndices);
  return add_accessor(view, "SCALAR", kUnsigned, indices.size(), "");
}

int GlbBuffer::add_scalars(std::span<const float> values, bool with_bounds) {
  const int view = add_view(values.data(), values.size_bytes(), Use::kOther);
  std::string bounds;
  if (with_bounds) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    bounds = fmt::format(",\"min\":[{:.9g}],\"max\":[{:.9g}]", *low, *high);
  }
  return add_accessor(view, "SCALAR", kFloat, values.size(), bounds);
}

int GlbBuffer::add_image(std::span<const std::byte> bytes) { return add_view(bytes.data(), bytes.size(), Use::kOther); }

std::string GlbBuffer::json() const {
  return fmt::format("\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]",
                     fmt::join(accessors_, ","), fmt::join(views_, ","), bytes_.size());
}

GlbVertices add_floats(GlbBuffer& buffer, const AnimatedMesh& mesh) {
  GlbVertices vertices;
  vertices.positions = {buffer.add_vectors(mesh.positions.front(), true)};
  vertices.normals = {buffer.add_vectors(mesh.normals.front(), false)};
  for (std::size_t frame = 1; frame < mesh.positions.size(); ++frame) {
    vertices.positions.push_back(buffer.add_vectors(mesh.positions[frame] - mesh.positions.front(), true));
    vertices.normals.push_back(buffer.add_vectors(mesh.normals[frame] - mesh.normals.front(), false));
  }
  return vertices;
}

GlbVertices add_quantized(GlbBuffer& buffer, const AnimatedMesh& mesh) {
  const Lattice lattice = lattice_of(mesh.positions);
  const Integers3 first = lattice.quantize(mesh.positions.front());
  const Bytes3 base_bytes = bytes_of(mesh.normals.front());
  const Floats3 base = base_bytes.cast<float>() / kMostByte;
  GlbVertices vertices;
  vertices.positions = {buffer.add_shorts(first.cast<std::int16_t>())};
  vertices.normals = {buffer.add_bytes(base_bytes)};
  for (std::size_t frame = 1; frame < mesh.positions.size(); ++frame) {
    // The difference of rounded positions, so that every frame is rounded only once.
    vertices.positions.push_back(
        buffer.add_shorts((lattice.quantize(mesh.positions[frame]) - first).cast<std::int16_t>()));
    const std::optional<Bytes3> targets = normal_targets(mesh.normals[frame], base);
    vertices.normals.push_back(targets ? buffer.add_bytes(*targets)
                                       : buffer.add_vectors(mesh.normals[frame] - base, false));
  }
  const Eigen::RowVector3f& origin = lattice.origin;
  vertices.transform = fmt::format(",\"translation\":[{0:.9g},{1:.9g},{2:.9g}],\"scale\":[{3:.9g},{3:.9g},{3:.9g}]",
                                   origin.x(), origin.y(), origin.z(), lattice.step);
  vertices.error = 0.5 * double(lattice.step);
  return vertices;
}

double write_animated_glb(const std::vector<AnimatedMesh>& meshes, const std::vector<double>& times,
                          const std::filesystem::path& file, GlbPrecision precision) {
  const unsigned vertex_bytes = precision == GlbPrecision::kFloat ? 24 : 20;  // at most
  std::uint64_t bytes = 0;
  for (const AnimatedMesh& mesh : meshes) {
    bytes += vertex_bytes * static_cast<std::uint64_t>(mesh.first.positions.rows()) * times.size();
  }
  if (bytes > kMostBytes) {
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

void write_pc2(const std::vector<Floats3>& frames, const std::filesystem::path& file) {
  std::string bytes("POINTCACHE2\0", 12);
  add_little(bytes, std::int32_t{1});  // version
  add_little(bytes, count_of_points(frames));
  add_little(bytes, 0.0F);  // first frame
  add_little(bytes, 1.0F);  // frames from one sample to the next
  add_little(bytes, static_cast<std::int32_t>(frames.size()));
  for (const Floats3& frame : frames) {
    add_bytes(bytes, frame.data(), std::size_t(frame.size()) * sizeof(float));
  }
  write_file(file, bytes);
}

void write_mdd(const std::vector<Floats3>& frames, std::span<const double> times, const std::filesystem::path& file) {
  std::string bytes;
  add_big(bytes, static_cast<std::int32_t>(frames.size()));
  add_big(bytes, count_of_points(frames));
  for (const double time : times) add_big(bytes, float(time));
  for (const Floats3& frame : frames) {
    for (const float value : std::span(frame.data(), frame.size())) add_big(bytes, value);
  }
  write_file(file, bytes);
}

}  // namespace sprung
