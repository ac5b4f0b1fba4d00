#include <benchmark/benchmark.h>

#include <algorithm>

#include "tests/bench/table.h"

namespace sprung::test {

void register_explicit_benchmarks();
void register_stage_benchmarks();

}  // namespace sprung::test

/// Takes Google Benchmark's options, for example --benchmark_filter=box64 or --benchmark_out=bench.json.
int main(int argc, char** argv) {
  using namespace sprung::test;
  register_explicit_benchmarks();
  register_stage_benchmarks();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const auto all_limits = [] { return std::map<int, MachineLimits>{{1, measure_limits(1)}, {2, measure_limits(2)}}; };
  std::map<int, MachineLimits> limits = all_limits();
  TableReporter table;
  benchmark::RunSpecifiedBenchmarks(&table);
  // Measured before and after: other work on the machine may have hidden the limit once.
  for (const auto& [threads, later] : all_limits()) {
    MachineLimits& limit = limits[threads];
    limit = {.bandwidth = std::max(limit.bandwidth, later.bandwidth),
             .operations = std::max(limit.operations, later.operations),
             .roots = std::max(limit.roots, later.roots)};
  }
  table.print(limits);
}
