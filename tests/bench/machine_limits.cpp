#include "tests/bench/machine_limits.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string_view>
#include <thread>
#include <vector>

#include "core/body/kernel/tile_kernel.h"

namespace sprung {

namespace plain {
[[nodiscard]] test::LimitLoops limit_loops();
}
namespace avx2 {
[[nodiscard]] test::LimitLoops limit_loops();
}
namespace avx512 {
[[nodiscard]] test::LimitLoops limit_loops();
}

namespace test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr long kRounds = 3000000;
constexpr long kRootRounds = 300000;
constexpr std::size_t kArray = std::size_t{1} << 22U;  // doubles a thread and array, 32 MB
constexpr int kTrials = 7;

/// The shortest of a few trials, s: `work(thread)` on all threads at once.
template <class Work>
double shortest(int threads, const Work& work) {
  double best = 1e30;
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto begin = Clock::now();
    std::vector<std::jthread> team;
    for (int thread = 1; thread < threads; ++thread) team.emplace_back([&, thread] { work(thread); });
    work(0);
    team.clear();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return best;
}

/// Packs a second of one of the loops.
double rate(int threads, double (*loop)(long), long rounds) {
  std::vector<double> results(threads);
  const double time = shortest(threads, [&](int thread) { results[thread] = loop(rounds); });
  return double(rounds) * kChains * threads / time;
}

double bandwidth(int threads) {
  const std::vector<double> zeros(kArray);
  std::vector<std::vector<double>> a(threads, zeros);
  std::vector<std::vector<double>> b = a;
  std::vector<std::vector<double>> c = a;
  const double time = shortest(threads, [&](int thread) {
    const auto t = std::size_t(thread);
    const double* from = a[t].data();
    const double* more = b[t].data();
    double* to = c[t].data();
    for (std::size_t i = 0; i < kArray; ++i) to[i] = from[i] + 0.5 * more[i];
  });
  return 3.0 * sizeof(double) * kArray * threads / time;
}

}  // namespace

LimitLoops best_loops() {
#ifdef __x86_64__
  const std::string_view name = best_spring_kernel().name;
  if (name == "avx512") return avx512::limit_loops();
  if (name == "avx2") return avx2::limit_loops();
#endif
  return plain::limit_loops();
}

MachineLimits measure_limits(int threads) {
  const LimitLoops loops = best_loops();
  const double lanes = loops.lanes;
  return {.bandwidth = bandwidth(threads),
          .operations = 2 * lanes * rate(threads, loops.operations, kRounds),
          .roots = lanes * rate(threads, loops.roots, kRootRounds)};
}

}  // namespace test
}  // namespace sprung
