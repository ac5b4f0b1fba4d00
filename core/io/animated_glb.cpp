#include "core/io/animated_glb.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/io/mesh_export.h"

namespace sprung {
namespace {

constexpr std::uint64_t kMostBytes = 0xFFFFFF00;
constexpr std::uint32_t kMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t kJson = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinary = 0x004E4942;  // "BIN"

float linear(float srgb) { return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F); }

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

/// A file in parts, so that none of it need be copied.
struct GlbPieces {
  std::string head;
  std::string_view numbers;
  std::string padding;
};

/// The lists of a glTF file as they grow.
class GlbFilm {
 public:
  GlbFilm(std::size_t frames, GlbNumbers numbers) : frames_(frames), numbers_(numbers) {}

  /// Returns by how much coordinates are off at most, m.
  double add(const AnimatedMesh& mesh) {
    const bool is_exact = numbers_ == GlbNumbers::kFloats;
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
    nodes_.push_back(fmt::format("{{\"name\":{},\"mesh\":{}{}}}", name, nodes_.size(), vertices.placement));
    return vertices.error;
  }

  /// Nothing can be added after that.
  [[nodiscard]] GlbPieces finish(const std::vector<double>& times) {
    const std::string animation = frames_ > 1 ? animation_of(times) : "";
    std::vector<std::size_t> roots(nodes_.size());
    for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = i;
    std::string json = fmt::format(
        "{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"sprung\"}}{},\"scene\":0,\"scenes\":[{{\"nodes\":[{}]}}],"
        "\"nodes\":[{}],\"meshes\":[{}],\"materials\":[{}]{}{},{}}}",
        extensions(), fmt::join(roots, ","), fmt::join(nodes_, ","), fmt::join(meshes_, ","),
        fmt::join(materials_, ","), pictures(), animation, buffer_.json());
    json.append(padding_of(json.size()), ' ');
    GlbPieces pieces{.head = {}, .numbers = buffer_.bytes(), .padding = {}};
    pieces.padding.assign(padding_of(pieces.numbers.size()), '\0');
    const std::size_t binary = pieces.numbers.size() + pieces.padding.size();
    for (const std::size_t number :
         {std::size_t{kMagic}, std::size_t{2}, 28 + json.size() + binary, json.size(), std::size_t{kJson}}) {
      add_number(pieces.head, number);
    }
    pieces.head += json;
    add_number(pieces.head, binary);
    add_number(pieces.head, kBinary);
    return pieces;
  }

 private:
  [[nodiscard]] std::string extensions() const {
    if (numbers_ == GlbNumbers::kFloats) return "";
    return R"(,"extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"])";
  }

  std::string attributes_of(const AnimatedMesh& mesh, const GlbVertices& vertices) {
    const Skin& rest = *mesh.first.rest;
    std::string text =
        fmt::format("\"POSITION\":{},\"NORMAL\":{}", vertices.positions.front(), vertices.normals.front());
    if (rest.uvs.rows() > 0) text += fmt::format(",\"TEXCOORD_0\":{}", buffer_.add_uvs(rest.uvs));
    if (rest.colors.rows() > 0) {
      Floats4 colors = rest.colors.cwiseMax(0.0F).cwiseMin(1.0F);
      colors.leftCols<3>() = colors.leftCols<3>().unaryExpr(&linear).eval();
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
    if (part.source != nullptr && !ending_of_texture(*part.source).empty()) {
      const int view = buffer_.add_picture(part.source->texture);
      const bool is_png = ending_of_texture(*part.source) == ".png";
      texture = fmt::format(",\"baseColorTexture\":{{\"index\":{}}}", images_.size());
      images_.push_back(fmt::format("{{\"bufferView\":{},\"mimeType\":\"image/{}\"}}", view, is_png ? "png" : "jpeg"));
    }
    materials_.push_back(fmt::format(
        "{{\"name\":{},\"doubleSided\":true{},\"pbrMetallicRoughness\":{{\"baseColorFactor\":[{:.6g},{:.6g},{:.6g},"
        "{:.6g}],\"metallicFactor\":0,\"roughnessFactor\":0.6{}}}}}",
        quoted(part.material), part.color[3] < 1 ? ",\"alphaMode\":\"BLEND\"" : "", linear(part.color[0]),
        linear(part.color[1]), linear(part.color[2]), part.color[3], texture));
    return materials_.size() - 1;
  }

  [[nodiscard]] std::string pictures() const {
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
  GlbNumbers numbers_;
  GlbBuffer buffer_;
  std::vector<std::string> nodes_;
  std::vector<std::string> meshes_;
  std::vector<std::string> materials_;
  std::vector<std::string> material_names_;
  std::vector<std::string> images_;
};

}  // namespace

double write_animated_glb(const std::vector<AnimatedMesh>& meshes, const std::vector<double>& times,
                          const std::filesystem::path& file, GlbNumbers numbers) {
  const unsigned vertex_bytes = numbers == GlbNumbers::kFloats ? 24 : 20;  // at most
  std::uint64_t bytes = 0;
  for (const AnimatedMesh& mesh : meshes) {
    bytes += vertex_bytes * static_cast<std::uint64_t>(mesh.first.positions.rows()) * times.size();
  }
  if (bytes > kMostBytes) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("'{}' would have {:.1f} GB, more than the 4 GB of a .glb; export fewer frames (--frames)",
                            file.string(), 1e-9 * double(bytes)));
  }
  GlbFilm film(times.size(), numbers);
  double error = 0;
  for (const AnimatedMesh& mesh : meshes) error = std::max(error, film.add(mesh));
  const GlbPieces pieces = film.finish(times);
  write_pieces(file, {pieces.head, pieces.numbers, pieces.padding});
  return error;
}

std::string still_glb(const std::vector<PosedMesh>& meshes) {
  GlbFilm film(1, GlbNumbers::kFloats);
  for (const PosedMesh& mesh : meshes) {
    film.add(
        {.first = mesh, .positions = {mesh.positions.cast<float>()}, .normals = {shading_normals(mesh).cast<float>()}});
  }
  const GlbPieces pieces = film.finish({0});
  return pieces.head + std::string(pieces.numbers) + pieces.padding;
}

namespace {

constexpr int kByte = 5120;
constexpr int kShort = 5122;
constexpr int kFloat = 5126;
constexpr int kUnsigned = 5125;

template <class Row>
std::string list_of(const Row& row) {
  std::vector<float> values(row.begin(), row.end());
  return fmt::format("[{:.9g}]", fmt::join(values, ","));
}

/// Rows of four: vertices begin at multiples of four bytes.
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

int GlbBuffer::add_picture(std::span<const std::byte> bytes) {
  return add_view(bytes.data(), bytes.size(), Use::kOther);
}

std::string GlbBuffer::json() const {
  return fmt::format("\"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":[{{\"byteLength\":{}}}]",
                     fmt::join(accessors_, ","), fmt::join(views_, ","), bytes_.size());
}

namespace {

constexpr float kMostShort = 32766;  // one less than there is: differences of rounded numbers may gain one
constexpr float kMostByte = 127;
constexpr float kLeastLength = 0.25F;

using Numbers3 = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Whole numbers in place of positions: of those at origin + step * numbers.
struct Lattice {
  Eigen::RowVector3f origin;
  float step = 1;

  [[nodiscard]] Numbers3 numbers_at(const Floats3& positions) const {
    return ((positions.rowwise() - origin) / step).array().round().cast<int>();
  }
};

/// The coarsest that the first frame needs around its middle, or the way of any vertex from there.
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

/// What turns the base into these normals; nothing where it does not fit.
std::optional<Bytes3> turns_to(const Floats3& normals, const Floats3& base) {
  Floats3 turns(normals.rows(), 3);
  for (Eigen::Index i = 0; i < normals.rows(); ++i) {
    const float length = fitting_length(normals.row(i), base.row(i));
    if (length < kLeastLength) return std::nullopt;
    turns.row(i) = length * normals.row(i) - base.row(i);
  }
  return bytes_of(turns);
}

}  // namespace

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
  const Numbers3 first = lattice.numbers_at(mesh.positions.front());
  const Bytes3 base_bytes = bytes_of(mesh.normals.front());
  const Floats3 base = base_bytes.cast<float>() / kMostByte;
  GlbVertices vertices;
  vertices.positions = {buffer.add_shorts(first.cast<std::int16_t>())};
  vertices.normals = {buffer.add_bytes(base_bytes)};
  for (std::size_t frame = 1; frame < mesh.positions.size(); ++frame) {
    // In whole numbers, so that the later frame is rounded only once.
    vertices.positions.push_back(
        buffer.add_shorts((lattice.numbers_at(mesh.positions[frame]) - first).cast<std::int16_t>()));
    const std::optional<Bytes3> turns = turns_to(mesh.normals[frame], base);
    vertices.normals.push_back(turns ? buffer.add_bytes(*turns)
                                     : buffer.add_vectors(mesh.normals[frame] - base, false));
  }
  const Eigen::RowVector3f& origin = lattice.origin;
  vertices.placement = fmt::format(",\"translation\":[{0:.9g},{1:.9g},{2:.9g}],\"scale\":[{3:.9g},{3:.9g},{3:.9g}]",
                                   origin.x(), origin.y(), origin.z(), lattice.step);
  vertices.error = 0.5 * double(lattice.step);
  return vertices;
}

}  // namespace sprung
