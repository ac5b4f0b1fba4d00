#include "render/trace/sampler.h"

#include <array>

namespace sprung {
namespace {

std::uint32_t reversed_bits(std::uint32_t x) {
  x = x << 16U | x >> 16U;
  x = (x & 0x00ff00ffU) << 8U | (x & 0xff00ff00U) >> 8U;
  x = (x & 0x0f0f0f0fU) << 4U | (x & 0xf0f0f0f0U) >> 4U;
  x = (x & 0x33333333U) << 2U | (x & 0xccccccccU) >> 2U;
  return (x & 0x55555555U) << 1U | (x & 0xaaaaaaaaU) >> 1U;
}

constexpr std::uint32_t kSamples = 4096;  // after which the sequence begins again

/// The second dimension of the Sobol sequence, with the bits reversed; the first is the index itself.
constexpr std::array<std::uint32_t, kSamples> kSecondDimension = [] {
  std::array<std::uint32_t, kSamples> numbers{};
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    std::uint32_t direction = 1;
    for (std::uint32_t bits = i; bits != 0; bits >>= 1U, direction ^= direction << 1U) {
      if ((bits & 1U) != 0) numbers[i] ^= direction;
    }
  }
  return numbers;
}();

/// Flips each bit by a hash of the bits below it: the permutation of Laine and Karras, an Owen scramble of a number
/// whose bits are reversed.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= seed >> 16U | 1U;
  x ^= x * 0x05526c56U;
  return x ^ x * 0x53a22864U;
}

float fraction(std::uint32_t reversed) { return float(reversed_bits(reversed) >> 8U) * 0x1p-24F; }

}  // namespace

/// Wellons's hash of 32 bits.
std::uint32_t Sampler::hashed(std::uint32_t value) {
  value ^= value >> 16U;
  value *= 0x7feb352dU;
  value ^= value >> 15U;
  value *= 0x846ca68bU;
  return value ^ value >> 16U;
}

Eigen::Vector2f Sampler::pair() {
  const std::uint32_t seed = hashed(seed_ + 0x9e3779b9U * ++drawn_);
  // Another order of the samples for every pair.
  const std::uint32_t index = reversed_bits(scrambled(reversed_bits(sample_), seed)) % kSamples;
  return {fraction(scrambled(index, hashed(seed + 1))), fraction(scrambled(kSecondDimension[index], hashed(seed + 2)))};
}

}  // namespace sprung
