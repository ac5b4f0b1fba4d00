#include <bit>
#include <cstdint>

#include "core/files.h"
#include "core/io/animation.h"

namespace sprung {
namespace {

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
