#include "render/image/cryptomatte.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace sprung {
namespace {

constexpr std::string_view kLayer = "CryptoObject";

std::uint32_t scrambled(std::uint32_t word) { return std::rotl(word * 0xcc9e2d51U, 15) * 0x1b873593U; }

/// The bits of a name's number.
std::uint32_t matte_bits(std::string_view name) {
  const std::uint32_t hash = murmur_hash(name);
  const std::uint32_t exponent = hash >> 23U & 255U;
  return exponent == 0 || exponent == 255 ? hash ^ 1U << 23U : hash;
}

/// As a JSON string.
std::string json_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    if (static_cast<unsigned char>(letter) < 0x20) {
      quoted += fmt::format("\\u{:04x}", int(letter));
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

}  // namespace

std::uint32_t murmur_hash(std::string_view text) {
  std::uint32_t hash = 0;
  std::size_t done = 0;
  for (; done + 4 <= text.size(); done += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, text.data() + done, 4);
    hash = std::rotl(hash ^ scrambled(word), 13) * 5 + 0xe6546b64U;
  }
  std::uint32_t rest = 0;
  for (std::size_t i = text.size(); i > done; --i) rest = rest << 8U | static_cast<unsigned char>(text[i - 1]);
  hash ^= scrambled(rest);
  hash ^= static_cast<std::uint32_t>(text.size());
  hash = (hash ^ hash >> 16U) * 0x85ebca6bU;
  hash = (hash ^ hash >> 13U) * 0xc2b2ae35U;
  return hash ^ hash >> 16U;
}

float matte_number(std::string_view name) { return std::bit_cast<float>(matte_bits(name)); }

std::vector<std::pair<std::string, std::string>> matte_metadata(const std::vector<std::string>& names) {
  std::string manifest;
  for (const std::string& name : names) {
    manifest += fmt::format("{}{}:\"{:08x}\"", manifest.empty() ? "" : ",", json_text(name), matte_bits(name));
  }
  const std::string key = fmt::format("cryptomatte/{}/", fmt::format("{:08x}", murmur_hash(kLayer)).substr(0, 7));
  return {{key + "name", std::string(kLayer)},
          {key + "hash", "MurmurHash3_32"},
          {key + "conversion", "uint32_to_float32"},
          {key + "manifest", "{" + manifest + "}"}};
}

std::vector<std::string> names_in_manifest(std::string_view manifest) {
  std::vector<std::string> texts;  // names and numbers in turn
  bool is_inside = false;
  for (std::size_t i = 0; i < manifest.size(); ++i) {
    if (manifest[i] == '"') {
      is_inside = !is_inside;
      if (is_inside) texts.emplace_back();
    } else if (is_inside) {
      if (manifest[i] == '\\' && i + 1 < manifest.size()) ++i;
      texts.back() += manifest[i];
    }
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < texts.size(); i += 2) names.push_back(texts[i]);
  return names;
}

}  // namespace sprung
