#pragma once
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "tests/support/run_program.h"
#include "tests/support/sanitized.h"

namespace sprung {

/// The peak memory of the child processes that have ended so far; it only rises.
inline long peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return usage.ru_maxrss;
}

/// A file that is not a mesh ends the program quickly, with little memory, exit code 3 and one line of file and reason.
/// Sanitizers take time and memory of their own: these are not checked then.
inline void expect_refusal(const TempFolder& folder, const std::string& file, const std::string& reason) {
  constexpr double kMaxSeconds = 5;
  constexpr long kMaxKilobytes = 500'000;
  const auto start = std::chrono::steady_clock::now();
  const ProgramRun ended = run_program(folder, "simulate '" + file + "' -o out");
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(ended.exit_code, 3) << ended.err;
  if (!test::kSanitized) {
    EXPECT_LT(seconds, kMaxSeconds);
    EXPECT_LT(peak_kilobytes(), kMaxKilobytes);
  }
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_NE(ended.err.find("sprung: error: " + file), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(reason), std::string::npos) << ended.err;
  EXPECT_EQ(ended.out, "");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

}  // namespace sprung
