#include <gtest/gtest.h>

#include "app/scene/scene_file.h"
#include "core/dynamics/energy.h"
#include "core/simulation/run_cache.h"
#include "core/simulation/simulate.h"
#include "core/simulation/simulation.h"
#include "tests/support/error_message.h"

/// Probes of a body and of its parts.
namespace sprung {
namespace {

/// 20 x 2 x 2 cm of 2 MPa, pulled at an end by 4 N.
const std::string kBar = R"(
gravity = [0, 0, 0]
[[body]]
box = [0.2, 0.02, 0.02]
bricks = 40
material = { young = 2e6, poisson = 0.3, density = 1000 }
  [[body.pin]]
  box = { min = [0, 0, 0], max = [0.01, 1, 1] }
  axes = "x"
  [[body.pin]]
  nearest = [0, 0, 0]
  [[body.pin]]
  nearest = [0, 1, 0]
  axes = "xz"
  [[body.force]]
  face = [1, 0.5, 0.5]
  traction = [1e4, 0, 0]
[[probe]]
name = "all"
[[probe]]
name = "low"
box = { min = [-1, -1, -1], max = [0.25, 2, 2] }
[[probe]]
name = "high"
box = { min = [0.25, -1, -1], max = [2, 2, 2] }
)";

/// The result of simulate() for a scene.
struct PartRun {
  Simulation simulation;
  Recording recording;

  explicit PartRun(const std::string& text) {
    const Observer silent;
    const Film scene = parse_scene(text, "/scene.toml");
    simulation = prepare_simulation(scene, silent);
    recording = simulate(simulation, scene, silent);
  }
  [[nodiscard]] const ProbeSample& last(std::size_t probe) const { return recording.probes.at(probe).samples.back(); }
};

class PulledBar : public testing::TestWithParam<std::string> {};

/// Stress F / A, strain s / E, energy s^2 V / (2 E), and a volume that grows by (1 - 2 nu) s / E.
TEST_P(PulledBar, StressStrainEnergyAndVolumeAreThoseOfTheFormulas) {
  const PartRun run(kBar + "[solver]\nscheme = \"" + GetParam() + "\"\nload_steps = 1\n");
  const double volume = 8e-5;
  const double strain = 1e4 / 2e6;
  const ProbeSample& all = run.last(0);
  EXPECT_NEAR(all.mean_stress, 1e4, 0.01 * 1e4);
  EXPECT_NEAR(all.max_stress, 1e4, 0.05 * 1e4);                   // at the corners that hold it sideways
  EXPECT_NEAR(all.mean_strain, strain * 2.6 / 3, 0.01 * strain);  // von Mises: 2 (1 + nu) / 3 of it
  EXPECT_NEAR(all.elastic_energy, 0.5 * 1e4 * strain * volume, 0.01 * 0.5 * 1e4 * strain * volume);
  EXPECT_NEAR(all.volume / volume - 1, 0.4 * strain, 0.01 * strain);
  EXPECT_NEAR(all.displacement.x(), 0.1 * strain, 0.01 * 0.1 * strain);
  EXPECT_EQ(all.kinetic_energy, 0);
}

TEST_P(PulledBar, PartsAddUp) {
  const PartRun run(kBar + "[solver]\nscheme = \"" + GetParam() + "\"\nload_steps = 1\n");
  const ProbeSample& all = run.last(0);
  const ProbeSample& low = run.last(1);
  const ProbeSample& high = run.last(2);
  EXPECT_NEAR(low.volume + high.volume, all.volume, 1e-12);
  EXPECT_NEAR(low.volume / all.volume, 0.25, 1e-3);
  EXPECT_NEAR(low.elastic_energy + high.elastic_energy, all.elastic_energy, 1e-9 * all.elastic_energy);
  EXPECT_NEAR(0.25 * low.displacement.x() + 0.75 * high.displacement.x(), all.displacement.x(), 1e-9);
  EXPECT_EQ(std::max(low.max_stress, high.max_stress), all.max_stress);
}

INSTANTIATE_TEST_SUITE_P(EverySolver, PulledBar, testing::Values("static", "linear"));

/// Copies count together, and the whole body has the energy of energy_of().
TEST(PartProbes, EnergiesInMotionAreThoseOfTheBodies) {
  const PartRun run(R"(
duration = 0.1
fps = 20
[[body]]
sphere = { radius = 0.05 }
bricks = 8
position = [0, 0.3, 0]
velocity = [1, 0, 0]
copies = { count = [2, 1, 1], spacing = [0.1, 0, 0] }
[[probe]]
name = "both"
[[probe]]
name = "top"
half_space = { point = [0.5, 0.5, 0.5], normal = [0, 1, 0] }
[[probe]]
name = "bottom"
half_space = { point = [0.5, 0.5, 0.5], normal = [0, -1, 0] }
)");
  double kinetic = 0;
  double elastic = 0;
  for (const Energy& energy : energies_of(run.simulation.world)) {
    kinetic += energy.kinetic;
    elastic += energy.elastic;
  }
  EXPECT_GT(kinetic, 0.1);
  EXPECT_GT(elastic, 0);
  EXPECT_NEAR(run.last(0).kinetic_energy, kinetic, 1e-12);
  EXPECT_NEAR(run.last(0).elastic_energy, elastic, 1e-9 * kinetic);
  EXPECT_NEAR(run.last(1).kinetic_energy + run.last(2).kinetic_energy, kinetic, 1e-12);
}

TEST(PartProbes, APartWithoutBricksIsNamed) {
  const std::string message =
      error_message([] { PartRun(kBar + "[[probe]]\nname = \"far\"\nbox = { min = [2, 2, 2], max = [3, 3, 3] }\n"); });
  EXPECT_NE(message.find("probe 'far': its part reaches no brick of body 1"), std::string::npos) << message;
}

TEST(PartProbes, ACacheKeepsEveryNumber) {
  ProbeSample sample;
  double next = 0;
  for (const ProbeQuantity& quantity : kProbeQuantities) {
    for (double& number : quantity.of(sample)) number = ++next;
  }
  EXPECT_EQ(next, double(kNumbersOfProbe));
  const std::vector<ProbeTrack> tracks{{.name = "one", .samples = {ProbeSample{}}},
                                       {.name = "two", .samples = {sample}}};
  CachedFrame frame;
  frame.probes = numbers_of(tracks);
  const ProbeSample read = sample_of(frame, 1);
  for (const ProbeQuantity& quantity : kProbeQuantities) {
    for (std::size_t i = 0; i < quantity.size(); ++i) EXPECT_EQ(quantity.of(read)[i], quantity.of(sample)[i]);
  }
}

}  // namespace
}  // namespace sprung
