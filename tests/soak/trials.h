#pragma once
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace sprung::test {

/// Numbered random trials, each of which can be repeated by itself.
struct Trials {
  std::uint32_t seed = 1;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  bool verbose = false;

  /// `name`: of one trial.
  void add_options(CLI::App& app, const std::string& name) {
    app.add_option("--" + name + "s", count, "how many");
    app.add_option("--seed", seed, "of the series");
    app.add_option("--first", first, fmt::format("number of the first {0}: to see one again, with --{0}s 1", name));
    app.add_flag("--verbose", verbose, fmt::format("a line for every {}, not only for those that fail", name));
  }
};

/// What a trial came to, in a line.
struct TrialLine {
  bool has_failed;
  std::string text;
};

/// Runs them and prints lines with their times. `run`: returns the TrialLine of a number. Returns how many failed.
template <class Run>
int run_trials(const Trials& trials, const std::string& name, const Run& run) {
  int failed = 0;
  for (std::uint32_t index = trials.first; index < trials.first + trials.count; ++index) {
    const auto start = std::chrono::steady_clock::now();
    const TrialLine line = run(index);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    failed += line.has_failed ? 1 : 0;
    if (!trials.verbose && !line.has_failed) continue;
    fmt::print("seed {} {} {}: {}, {:.2f} s\n", trials.seed, name, index, line.text, seconds);
    std::fflush(stdout);
  }
  fmt::print("seed {}: {} of {} {}s failed\n", trials.seed, failed, trials.count, name);
  return failed;
}

}  // namespace sprung::test
