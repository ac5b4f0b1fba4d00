#include "assets/models/ply.h"

#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <string>

#include "core/error.h"

namespace sprung::models {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as it lies in memory");

std::string header(const Toy& toy) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment sprung make_models, metres, y up\n";
  text += "element vertex " + std::to_string(toy.positions.rows()) + "\n";
  text += "property float x\nproperty float y\nproperty float z\n";
  if (toy.normals.rows() > 0) text += "property float nx\nproperty float ny\nproperty float nz\n";
  if (toy.colors.rows() > 0) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += "element face " + std::to_string(toy.triangles.rows()) + "\n";
  return text + "property list uchar int vertex_indices\nend_header\n";
}

template <typename Row>
void append(std::string& bytes, const Row& row) {
  for (const auto value : row) {
    const auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
    bytes.append(raw.data(), raw.size());
  }
}

}  // namespace

void write_ply(const Toy& toy, const std::filesystem::path& file) {
  std::string bytes;
  for (Eigen::Index row = 0; row < toy.positions.rows(); ++row) {
    append(bytes, toy.positions.row(row));
    if (toy.normals.rows() > 0) append(bytes, toy.normals.row(row));
    if (toy.colors.rows() > 0) append(bytes, toy.colors.row(row));
  }
  // assimp takes a first byte of 0x0A for the end of a line and reads everything shifted (its issue 5341). The lowest
  // byte of the first coordinate may change by one: that is less than a nanometre.
  if (bytes.front() == '\n') bytes.front() = '\v';
  for (const auto& row : toy.triangles.rowwise()) {
    bytes += '\3';
    append(bytes, row);
  }
  std::ofstream out(file, std::ios::binary);
  out << header(toy) << bytes;
  if (!out.flush()) throw Error(ErrorKind::kFailed, file.string() + ": cannot be written");
}

}  // namespace sprung::models
