#pragma once
#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "tests/bench/machine_limits.h"

namespace sprung::test {

/// Keeps the best of every benchmark's repetitions; print() writes them as tables in Markdown, each next to the
/// machine's limit.
class TableReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;

  /// Limits by the number of threads.
  void print(const std::map<int, MachineLimits>& limits) const;

 private:
  struct Result {
    double time = 0;  // s, of an iteration
    std::map<std::string, double> counters;
  };

  void print_explicit(const std::map<int, MachineLimits>& limits) const;
  void print_stages() const;
  [[nodiscard]] double counter(const std::string& name, const std::string& counter) const;

  std::vector<std::string> order_;
  std::map<std::string, Result> results_;
};

}  // namespace sprung::test
