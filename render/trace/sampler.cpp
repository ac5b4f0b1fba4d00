#include "render/trace/sampler.h"

#include <vector>

namespace sprung {
namespace {

std::uint32_t reversed_bits(std::uint32_t x) {
  x = x << 16U | x >> 16U;
  x = (x & 0x00ff00ffU) << 8U | (x & 0xff00ff00U) >> 8U;
  x = (x & 0x0f0f0f0fU) << 4U | (x & 0xf0f0f0f0U) >> 4U;
  x = (x & 0x33333333U) << 2U | (x & 0xccccccccU) >> 2U;
  return (x & 0x55555555U) << 1U | (x & 0xaaaaaaaaU) >> 1U;
}

constexpr std::uint32_t kSamples = 4096;  // after which a sequence begins again
constexpr std::uint32_t kSequences = 64;

/// Wellons's hash of 32 bits.
std::uint32_t hashed(std::uint32_t value) {
  value ^= value >> 16U;
  value *= 0x7feb352dU;
  value ^= value >> 15U;
  value *= 0x846ca68bU;
  return value ^ value >> 16U;
}

/// The second dimension of the Sobol sequence, with the bits reversed; the first is the index itself.
std::uint32_t second_dimension(std::uint32_t index) {
  std::uint32_t number = 0;
  std::uint32_t direction = 1;
  for (; index != 0; index >>= 1U, direction ^= direction << 1U) {
    if ((index & 1U) != 0) number ^= direction;
  }
  return number;
}

/// Flips each bit by a hash of the bits below it: the permutation of Laine and Karras, an Owen scramble of a number
/// whose bits are reversed.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= seed >> 16U | 1U;
  x ^= x * 0x05526c56U;
  return x ^ x * 0x53a22864U;
}

struct Point {
  std::uint32_t x, y;  // over 2^32
};

/// Sobol sequences, each in a different order and scrambled differently: all their first points, all their second
/// ones...
std::vector<Point> make_sequences() {
  std::vector<Point> points(kSequences * kSamples);
  for (std::uint32_t sequence = 0; sequence < kSequences; ++sequence) {
    const std::uint32_t seed = hashed(sequence + 1);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      const std::uint32_t index = reversed_bits(scrambled(reversed_bits(i), seed)) % kSamples;
      points[i * kSequences + sequence] = {reversed_bits(scrambled(index, hashed(seed + 1))),
                                           reversed_bits(scrambled(second_dimension(index), hashed(seed + 2)))};
    }
  }
  return points;
}

/// Inserts a zero before each of the 16 bits.
std::uint64_t spaced_bits(int value) {
  auto x = std::uint32_t(value) & 0xffffU;
  x = (x | x << 8U) & 0x00ff00ffU;
  x = (x | x << 4U) & 0x0f0f0f0fU;
  x = (x | x << 2U) & 0x33333333U;
  return (x | x << 1U) & 0x55555555U;
}

float fraction(std::uint32_t bits) { return float(bits >> 8U) * 0x1p-24F; }

}  // namespace

Sampler::Sampler(std::uint64_t number)
    : seed_(hashed(std::uint32_t(number / kSamples) + 1)), sample_(std::uint32_t(number % kSamples)) {}

Sampler::Sampler(int x, int y, int sample, int samples)
    : Sampler((spaced_bits(x) | spaced_bits(y) << 1U) * std::uint64_t(samples) + std::uint64_t(sample)) {}

Eigen::Vector2f Sampler::pair() {
  static const std::vector<Point> kPoints = make_sequences();
  ++drawn_;
  const Point& point = kPoints[sample_ * kSequences + (seed_ + drawn_) % kSequences];
  const std::uint32_t turn = hashed(seed_ + 0x9e3779b9U * drawn_);
  return {fraction(point.x ^ turn), fraction(point.y ^ (turn * 0x2c1b3c6dU))};
}

}  // namespace sprung
