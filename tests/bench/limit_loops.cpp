#include <array>

#include "core/body/kernel/pack.h"
#include "tests/bench/machine_limits.h"

namespace sprung::SPRUNG_INSTRUCTION_SET {

[[nodiscard]] test::LimitLoops limit_loops();
void step_rows(test::SpringRows& rows, double dt);

namespace {

template <class Operation>
double repeat(long rounds, const Operation& operation) {
  std::array<Pack, test::kChains> values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0 + 0.1 * double(i);
  for (long round = 0; round < rounds; ++round) {
    for (Pack& value : values) value = operation(value);
  }
  double sum = 0;
  for (const Pack& value : values) sum += value[0];
  return sum;
}

double operations(long rounds) {
  return repeat(rounds, [](const Pack& value) { return value * 0.999999 + 1e-6; });
}

double roots(long rounds) {
  return repeat(rounds, [](const Pack& value) { return Pack(2.0 / simd::sqrt(value)); });
}

}  // namespace

test::LimitLoops limit_loops() {
  return {.lanes = kLanes, .operations = operations, .roots = roots, .rows = step_rows};
}

}  // namespace sprung::SPRUNG_INSTRUCTION_SET
