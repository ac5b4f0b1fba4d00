#pragma once

// Compiled once for each instruction set: SPRUNG_INSTRUCTION_SET names the current one and the namespace of everything
// compiled for it, so that the linker cannot pick a function compiled for another.
#pragma once
#include <experimental/simd>
#ifdef __AVX__
#include <immintrin.h>
#endif

#ifndef SPRUNG_INSTRUCTION_SET
#define SPRUNG_INSTRUCTION_SET plain
#endif

namespace sprung::SPRUNG_INSTRUCTION_SET {

namespace simd = std::experimental;

/// As many neighbours along x as this processor computes at once. Lanes are independent and use only operations that
/// IEEE 754 defines to the last bit, so results do not depend on the width; they do depend on whether the processor
/// fuses products and sums.
using Pack = simd::native_simd<double>;
using FloatPack = simd::rebind_simd_t<float, Pack>;
inline constexpr int kLanes = int(Pack::size());

struct Pack3 {
  Pack x, y, z;
};

[[gnu::always_inline]] inline Pack load(const double* values) { return {values, simd::element_aligned}; }
[[gnu::always_inline]] inline void store(const Pack& pack, double* values) {
  pack.copy_to(values, simd::element_aligned);
}
[[gnu::always_inline]] inline void add(const Pack& pack, double* values) { store(load(values) + pack, values); }

[[gnu::always_inline]] inline Pack3 operator+(const Pack3& a, const Pack3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] inline Pack3 operator-(const Pack3& a, const Pack3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Pack3 operator-(const Pack3& a) { return {-a.x, -a.y, -a.z}; }
[[gnu::always_inline]] inline Pack3 operator*(const Pack& a, const Pack3& b) { return {a * b.x, a * b.y, a * b.z}; }
[[gnu::always_inline]] inline Pack dot(const Pack3& a, const Pack3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[gnu::always_inline]] inline Pack3 cross(const Pack3& a, const Pack3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// x, y and z of the points at values + places[lane]. Three numbers at a time and then apart, which takes a third of
/// the shuffles that lane by lane takes.
[[nodiscard]] [[gnu::always_inline]] inline Pack3 gather_points(const double* values, const int* places) {
#if defined(__AVX512F__) && defined(__AVX512VL__)
  const auto points = [&](int low, int high) __attribute__((always_inline)) {
    const __m256d first = _mm256_maskz_loadu_pd(7, values + places[low]);
    return _mm512_insertf64x4(_mm512_castpd256_pd512(first), _mm256_maskz_loadu_pd(7, values + places[high]), 1);
  };
  const __m512d a = points(0, 2);
  const __m512d b = points(1, 3);
  const __m512d c = points(4, 6);
  const __m512d d = points(5, 7);
  const __m512d xz_low = _mm512_unpacklo_pd(a, b);
  const __m512d xz_high = _mm512_unpacklo_pd(c, d);
  return {Pack(_mm512_shuffle_f64x2(xz_low, xz_high, 0x88)),
          Pack(_mm512_shuffle_f64x2(_mm512_unpackhi_pd(a, b), _mm512_unpackhi_pd(c, d), 0x88)),
          Pack(_mm512_shuffle_f64x2(xz_low, xz_high, 0xDD))};
#elif defined(__AVX__)
  const __m256i three = _mm256_set_epi64x(0, -1, -1, -1);
  const auto point = [&](int lane) __attribute__((always_inline)) {
    return _mm256_maskload_pd(values + places[lane], three);
  };
  const __m256d a = point(0);
  const __m256d b = point(1);
  const __m256d c = point(2);
  const __m256d d = point(3);
  const __m256d xz_low = _mm256_unpacklo_pd(a, b);
  const __m256d xz_high = _mm256_unpacklo_pd(c, d);
  return {Pack(_mm256_permute2f128_pd(xz_low, xz_high, 0x20)),
          Pack(_mm256_permute2f128_pd(_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d), 0x20)),
          Pack(_mm256_permute2f128_pd(xz_low, xz_high, 0x31))};
#else
  return {Pack([&](auto lane) { return values[places[lane]]; }),
          Pack([&](auto lane) { return values[places[lane] + 1]; }),
          Pack([&](auto lane) { return values[places[lane] + 2]; })};
#endif
}

/// 1 / sqrt(q), rounding error below 2e-16 of it, for q from 1e-37 to 1e37. Square root and division in single
/// precision, which IEEE 754 defines to the bit (the processor's own estimates differ from maker to maker), then one
/// step of third order: an error d of the first guess leaves 5/2 d^3.
[[gnu::always_inline]] inline Pack inverse_root(const Pack& q) {
  const FloatPack guess = 1.0F / simd::sqrt(simd::static_simd_cast<FloatPack>(q));
  const Pack first = simd::static_simd_cast<Pack>(guess);
  const Pack deficit = 1.0 - q * (first * first);
  return first + first * (deficit * (0.5 + 0.375 * deficit));
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace sprung {

/// While it lives, denormal numbers are flushed to zero on this thread: they cost a hundred times as much and occur by
/// the million as a motion dies away.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040U); }
  ~FlushDenormals() { _mm_setcsr(before_); }
#elif defined(__aarch64__)
  FlushDenormals() : before_(__builtin_aarch64_get_fpcr()) { __builtin_aarch64_set_fpcr(before_ | 1U << 24U); }
  ~FlushDenormals() { __builtin_aarch64_set_fpcr(before_); }
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_ = 0;
};

}  // namespace sprung
