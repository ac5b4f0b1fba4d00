#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "tests/soak/drop.h"

namespace sprung::test {
namespace {

struct Options {
  std::uint32_t seed = 1;
  std::uint32_t first = 0;
  std::uint32_t drops = 100;
  double min_poisson = -0.2;
  std::string model = "calibrated";
  std::string law = "neo-hooke";
  bool verbose = false;
};

void print(std::uint32_t seed, std::uint32_t index, const Drop& drop, const DropResult& result, double seconds) {
  fmt::print(
      "seed {} drop {}: {}: {}; depth {:.2g}, energy {:+.2g}, smallest volume {:.2g}, inverted on the way {}, "
      "{} frames taken back, {:.2g} M brick-steps, {:.2f} s\n",
      seed, index, drop.description, result.fault.empty() ? "well" : result.fault, result.deepest, result.energy_gain,
      result.smallest_volume, result.inverted_on_the_way, result.halvings, double(result.brick_steps) * 1e-6, seconds);
  std::fflush(stdout);
}

/// With parameters that are common for rubbers and tissues.
StrainEnergyLaw law_named(const std::string& name) {
  if (name == "mooney-rivlin") return {.kind = StrainEnergyKind::kMooneyRivlin, .mooney_share = 0.3};
  if (name == "ogden") {
    return {.kind = StrainEnergyKind::kOgden, .ogden_exponents = {1.3, 5, -2}, .ogden_shares = {0.75, 0.05, 0.2}};
  }
  if (name == "fung") return {.kind = StrainEnergyKind::kFung, .fung_exponent = 1};
  if (name == "linear") return {.kind = StrainEnergyKind::kLinear};
  return {};
}

/// How many drops failed.
int soak(const Options& options) {
  int failed = 0;
  const Model model = model_from_name(options.model);
  const StrainEnergyLaw law = law_named(options.law);
  for (std::uint32_t index = options.first; index < options.first + options.drops; ++index) {
    const auto start = std::chrono::steady_clock::now();
    Drop drop = random_drop(options.seed, index, model, options.min_poisson, law);
    const DropResult result = run_drop(drop);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    failed += result.fault.empty() ? 0 : 1;
    if (options.verbose || !result.fault.empty()) print(options.seed, index, drop, result, seconds);
  }
  fmt::print("seed {}: {} of {} drops failed\n", options.seed, failed, options.drops);
  return failed;
}

}  // namespace
}  // namespace sprung::test

int main(int argc, char** argv) {
  sprung::test::Options options;
  CLI::App app(
      "Drops random bodies and fails where a number is not finite, a brick ends inside out, energy grows or a "
      "body sinks into the ground.");
  app.add_option("--drops", options.drops, "how many");
  app.add_option("--seed", options.seed, "of the series");
  app.add_option("--first", options.first, "number of the first drop: to see one again, with --drops 1");
  app.add_option("--least-poisson", options.min_poisson, "of the materials")->check(CLI::Range(-0.9, 0.49));
  app.add_option("--model", options.model, "of the bricks");
  app.add_option("--law", options.law, "of the materials")
      ->check(CLI::IsMember({"neo-hooke", "mooney-rivlin", "ogden", "fung", "linear"}));
  app.add_flag("--verbose", options.verbose, "a line for every drop, not only for those that fail");
  CLI11_PARSE(app, argc, argv);
  return sprung::test::soak(options) == 0 ? 0 : 1;
}
