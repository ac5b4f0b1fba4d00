#include "core/body/kernel/tile_kernel.h"

namespace sprung {

namespace plain {
[[nodiscard]] SpringKernel spring_kernel();
}
namespace avx2 {
[[nodiscard]] SpringKernel spring_kernel();
}
namespace avx512 {
[[nodiscard]] SpringKernel spring_kernel();
}

namespace {

std::array<SpringKernel, 3> find_kernels() {
  std::array<SpringKernel, 3> kernels{{{.name = "avx512"}, {.name = "avx2"}, {.name = "plain"}}};
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("fma")) {
    kernels[0] = avx512::spring_kernel();
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) kernels[1] = avx2::spring_kernel();
#endif
  kernels[2] = plain::spring_kernel();
  return kernels;
}

}  // namespace

const std::array<SpringKernel, 3>& all_spring_kernels() {
  static const std::array<SpringKernel, 3> kKernels = find_kernels();
  return kKernels;
}

const SpringKernel& best_spring_kernel() {
  for (const SpringKernel& kernel : all_spring_kernels()) {
    if (kernel.tile != nullptr) return kernel;
  }
  return all_spring_kernels().back();
}

}  // namespace sprung
