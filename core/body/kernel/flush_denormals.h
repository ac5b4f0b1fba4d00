#pragma once
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace sprung {

/// While it lives, numbers too small for full precision count as zero on this thread: they cost a hundred times as much
/// and come by the million where a motion dies away.
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
