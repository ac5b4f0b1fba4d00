// Runs a scene file for some seconds and prints the hash of its last state, as `sprung simulate` does:
// run_scene SCENE.toml SECONDS.
#include <sprung/app/scene/scene_file.h>
#include <sprung/core/simulation/observer.h>
#include <sprung/core/simulation/simulate.h>
#include <sprung/core/simulation/simulation.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>

int main(int count, char** words) {
  using namespace sprung;
  if (count != 3) return 2;
  Film scene = read_scene(words[1]);
  scene.duration = std::atof(words[2]);
  Simulation simulation = prepare_simulation(scene, Observer());
  const Recording recording = simulate(simulation, scene, Observer());
  std::printf("state %016" PRIx64 "\n", recording.state_hash);
}
