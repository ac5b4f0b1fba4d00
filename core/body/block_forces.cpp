#include "core/body/brick_block.h"

namespace sprung {

void block_forces_plain(const BlockInput& input, int first, double* corner_forces, double* energies);
void block_forces_avx2(const BlockInput& input, int first, double* corner_forces, double* energies);
void block_forces_avx512(const BlockInput& input, int first, double* corner_forces, double* energies);

std::array<NamedBlockForces, 3> all_block_forces() {
#ifdef __x86_64__
  return {{{"avx512",
            __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") ? block_forces_avx512 : nullptr},
           {"avx2", __builtin_cpu_supports("avx2") ? block_forces_avx2 : nullptr},
           {"plain", block_forces_plain}}};
#else
  return {{{"avx512", nullptr}, {"avx2", nullptr}, {"plain", block_forces_plain}}};
#endif
}

BlockForces block_forces() {
  for (const NamedBlockForces& version : all_block_forces()) {
    if (version.forces != nullptr) return version.forces;
  }
  return block_forces_plain;
}

}  // namespace sprung
