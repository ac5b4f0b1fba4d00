#include "tests/bench/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace sprung::test {
namespace {

constexpr const char* kSpringsAlone = "springs alone";

/// Additions, multiplications and comparisons in double of one brick in the middle of a body and its share of edges and
/// nodes, counted in core/body/kernel; square roots and divisions, in single precision there, are left out.
/// Calibrated, a whole brick: 69 for its map, 123 for its differences, 68 for the stress, 39 for the stiffness, 243 for
/// what pulls at the map, 96 at the corners, 22 for the node; damped 427 more. Tensile: 4 inner diagonals of 29 (damped
/// 41), 3 edges of 36 (47), 33 for their coupling, 1 stiffness, 22 for the node. Rows of springs alone (spring_rows.h):
/// 7 springs of 28, 12 for the node.
double operations_of(const std::string& model, bool damped) {
  if (model == kSpringsAlone) return 208;
  if (model == "calibrated") return damped ? 1087 : 660;
  return damped ? 361 : 280;
}

/// Bytes from and to memory of a brick-step at least: positions and velocities read and written, the mass; of rows of
/// springs positions, velocities and forces. Shares of bricks are few inside a body.
double bytes_of(const std::string& model) { return model == kSpringsAlone ? 144 : 104; }

std::string body_of(const std::vector<std::string>& parts) {
  if (parts[0] == "list") return "list of springs";
  return parts[0] == "rows" ? "rows of springs" : parts[1];
}

std::vector<std::string> split(const std::string& name) {
  std::vector<std::string> parts;
  std::istringstream stream(name);
  for (std::string part; std::getline(stream, part, '/');) parts.push_back(part);
  return parts;
}

bool is_explicit(const std::vector<std::string>& parts) {
  return parts[0] == "explicit" || parts[0] == "list" || parts[0] == "rows";
}

/// A ratio, or nothing if one of the two was not measured.
std::string ratio(double value, double by) { return value > 0 && by > 0 ? fmt::format("{:.2f}", value / by) : "-"; }

}  // namespace

bool TableReporter::ReportContext(const Context& context) {
  (void)context;
  return true;
}

void TableReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
    const std::string& name = run.run_name.function_name;
    GetErrorStream() << name << '\n';
    if (results_.count(name) == 0) order_.push_back(name);
    Result result{run.real_accumulated_time / double(run.iterations), {}};
    for (const auto& [key, value] : run.counters) result.counters[key] = value.value;
    Result& best = results_[name];
    if (best.time == 0 || result.time < best.time) best = result;
  }
}

double TableReporter::counter(const std::string& name, const std::string& counter) const {
  const auto found = results_.find(name);
  if (found == results_.end() || found->second.counters.count(counter) == 0) return 0;
  return found->second.counters.at(counter);
}

void TableReporter::print_explicit(const std::map<int, MachineLimits>& limits) const {
  fmt::print(
      "\nExplicit steps. `arithmetic`, `memory`: share of the machine's limit that the brick-steps need; `list`: "
      "times the list of springs;\n`box64`: of the rate of 64^3 bricks; `1 thread`: times the rate on one.\n\n"
      "| body | model | damping | threads | bricks | M brick-steps/s | arithmetic | memory | list | box64 | "
      "1 thread | bytes a brick |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const std::string& name : order_) {
    const std::vector<std::string> parts = split(name);
    if (!is_explicit(parts)) continue;
    const auto name_like = [&](const char* kind, const char* body, const char* threads) {
      return fmt::format("{}/{}/{}/{}/{}", kind, body, parts[2], parts[3], threads);
    };
    const double rate = counter(name, "brick_steps");
    const MachineLimits& limit = limits.at(std::stoi(parts[4]));
    fmt::print("| {} | {} | {} | {} | {:.0f} | {:.1f} | {} | {} | {} | {} | {} | {:.0f} |\n", body_of(parts), parts[2],
               parts[3], parts[4], counter(name, "bricks"), 1e-6 * rate,
               ratio(rate * operations_of(parts[2], parts[3] == "damped"), limit.operations),
               ratio(rate * bytes_of(parts[2]), limit.bandwidth),
               ratio(rate, counter(name_like("list", "box32", "1"), "brick_steps")),
               ratio(rate, counter(name_like("explicit", "box64", parts[4].c_str()), "brick_steps")),
               ratio(rate, counter(name_like("explicit", parts[1].c_str(), "1"), "brick_steps")),
               counter(name, "bytes"));
  }
}

void TableReporter::print_stages() const {
  fmt::print("\n| stage | body | bricks or points | ms | M a second |\n| --- | --- | --- | --- | --- |\n");
  for (const std::string& name : order_) {
    const std::vector<std::string> parts = split(name);
    if (is_explicit(parts)) continue;
    const Result& result = results_.at(name);
    const double things = counter(name, "things");
    fmt::print("| {} | {} | {:.0f} | {:.3g} | {:.3g} |\n", parts[0], parts[1], things, 1e3 * result.time,
               1e-6 * things / result.time);
  }
}

void TableReporter::print(const std::map<int, MachineLimits>& limits) const {
  fmt::print(
      "| threads | GB/s | G operations/s | G root-and-divisions/s |\n"
      "| --- | --- | --- | --- | --- |\n");
  for (const auto& [threads, limit] : limits) {
    fmt::print("| {} | {:.1f} | {:.1f} | {:.2f} |\n", threads, 1e-9 * limit.bandwidth, 1e-9 * limit.operations,
               1e-9 * limit.roots);
  }
  print_explicit(limits);
  print_stages();
}

}  // namespace sprung::test
