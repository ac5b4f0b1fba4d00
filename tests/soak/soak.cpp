#include <fmt/format.h>

#include <map>
#include <string>

#include "tests/soak/drop.h"
#include "tests/soak/trials.h"

namespace sprung::test {
namespace {

struct Options : Trials {
  double min_poisson = -0.2;
  std::string model = "calibrated";
  StrainEnergyKind law = StrainEnergyKind::kNeoHooke;
};

/// With parameters that are common for rubbers and tissues.
StrainEnergyLaw law_of(StrainEnergyKind kind) {
  StrainEnergyLaw law{.kind = kind};
  if (kind == StrainEnergyKind::kMooneyRivlin) law.mooney_share = 0.3;
  if (kind == StrainEnergyKind::kFung) law.fung_exponent = 1;
  if (kind == StrainEnergyKind::kOgden) {
    law.ogden_exponents = {1.3, 5, -2};
    law.ogden_shares = {0.75, 0.05, 0.2};
  }
  return law;
}

TrialLine soak(const Options& options, std::uint32_t index) {
  Drop drop =
      random_drop(options.seed, index, model_from_name(options.model), options.min_poisson, law_of(options.law));
  const DropResult result = run_drop(drop);
  return {!result.fault.empty(),
          fmt::format("{}: {}; depth {:.2g}, energy {:+.2g}, smallest volume {:.2g}, inverted on the way {}, {} frames "
                      "taken back, {:.2g} M brick-steps",
                      drop.description, result.fault.empty() ? "well" : result.fault, result.deepest,
                      result.energy_gain, result.smallest_volume, result.inverted_on_the_way, result.halvings,
                      double(result.brick_steps) * 1e-6)};
}

}  // namespace
}  // namespace sprung::test

int main(int argc, char** argv) {
  using namespace sprung::test;
  Options options;
  options.count = 100;
  CLI::App app(
      "Drops random bodies and fails where a number is not finite, a brick ends inside out, energy grows or a "
      "body sinks into the ground.");
  options.add_options(app, "drop");
  app.add_option("--least-poisson", options.min_poisson, "of the materials")->check(CLI::Range(-0.9, 0.49));
  app.add_option("--model", options.model, "of the bricks");
  app.add_option("--law", options.law, "of the materials")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, sprung::StrainEnergyKind>(sprung::kLawNames.begin(), sprung::kLawNames.end())));
  CLI11_PARSE(app, argc, argv);
  return run_trials(options, "drop", [&](std::uint32_t index) { return soak(options, index); }) == 0 ? 0 : 1;
}
