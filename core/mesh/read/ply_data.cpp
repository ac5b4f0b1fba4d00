#include "core/mesh/read/ply_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/error.h"

namespace sprung {
namespace {

/// A number from its bytes in the order of this machine.
template <class Number>
double decode(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

double decode(PlyType type, const char* bytes) {
  switch (type) {
    case PlyType::kInt8:
      return decode<std::int8_t>(bytes);
    case PlyType::kUint8:
      return decode<std::uint8_t>(bytes);
    case PlyType::kInt16:
      return decode<std::int16_t>(bytes);
    case PlyType::kUint16:
      return decode<std::uint16_t>(bytes);
    case PlyType::kInt32:
      return decode<std::int32_t>(bytes);
    case PlyType::kUint32:
      return decode<std::uint32_t>(bytes);
    case PlyType::kFloat32:
      return decode<float>(bytes);
    case PlyType::kFloat64:
      return decode<double>(bytes);
  }
  return 0;
}

std::string_view text_part(std::string_view bytes, const PlyHeader& header) {
  return header.format == PlyFormat::kText ? bytes.substr(header.size) : std::string_view{};
}

}  // namespace

PlyData::PlyData(std::string_view bytes, const PlyHeader& header, const std::string& name)
    : format_(header.format),
      name_(name),
      left_(bytes.substr(header.size)),
      scanner_(text_part(bytes, header), name, header.lines) {}

double PlyData::take_binary(PlyType type, const Named& what) {
  const std::size_t size = size_of(type);
  if (left_.size() < size) refuse(fmt::format("the file ends before {}: it is cut short", what.text()));
  char bytes[8];
  std::copy_n(left_.data(), size, bytes);
  left_.remove_prefix(size);
  const bool is_native = (format_ == PlyFormat::kLittleEndian) == (std::endian::native == std::endian::little);
  if (!is_native) std::reverse(bytes, bytes + size);
  return decode(type, bytes);
}

double PlyData::take(PlyType type, const Named& what) {
  return format_ == PlyFormat::kText ? scanner_.number_ahead(what) : take_binary(type, what);
}

void PlyData::read(const PlyElement& element, const Named& what, PlyEntry& entry) {
  entry.numbers.resize(element.properties.size());
  entry.lists.resize(element.properties.size());
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (!property.is_list) {
      entry.numbers[i] = take(property.type, what);
      continue;
    }
    const double length = take(property.count_type, what);
    if (!(length >= 0) || length != std::floor(length)) refuse(fmt::format("{} has a list of {}", what.text(), length));
    entry.lists[i].clear();
    for (double k = 0; k < length; ++k) entry.lists[i].push_back(take(property.type, what));
  }
}

void PlyData::refuse(const std::string& reason) const {
  if (format_ == PlyFormat::kText) scanner_.refuse(reason);
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", name_, reason));
}

}  // namespace sprung
