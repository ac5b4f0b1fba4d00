#include <vector>

#include "core/motion/multigrid/kernels.h"

namespace sprung::multigrid {

extern const Kernels kernels_plain;
#ifdef __x86_64__
extern const Kernels kernels_avx2;
extern const Kernels kernels_avx512;
#endif

std::span<const Kernels> all_kernels() {
  static const std::vector<Kernels> supported = [] {
    std::vector<Kernels> list;
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("fma")) {
      list.push_back(kernels_avx512);
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) list.push_back(kernels_avx2);
#endif
    list.push_back(kernels_plain);
    return list;
  }();
  return supported;
}

}  // namespace sprung::multigrid
