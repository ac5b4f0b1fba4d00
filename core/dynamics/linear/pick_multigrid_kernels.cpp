#include <vector>

#include "core/dynamics/linear/multigrid_kernels.h"

namespace sprung::multigrid {

namespace plain {
[[nodiscard]] Kernels kernels();
}
#ifdef __x86_64__
namespace avx2 {
[[nodiscard]] Kernels kernels();
}
namespace avx512 {
[[nodiscard]] Kernels kernels();
}
#endif

std::span<const Kernels> all_kernels() {
  static const std::vector<Kernels> supported = [] {
    std::vector<Kernels> list;
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("fma")) {
      list.push_back(avx512::kernels());
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) list.push_back(avx2::kernels());
#endif
    list.push_back(plain::kernels());
    return list;
  }();
  return supported;
}

}  // namespace sprung::multigrid
