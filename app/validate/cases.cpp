#include "app/validate/cases.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/scene/scene_file.h"
#include "core/error.h"
#include "core/text.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

/// An installed program has its assets next to it; any other uses those of the source tree it was built from.
fs::path experiment_folder() {
  std::error_code failure;
  const fs::path program = fs::read_symlink("/proc/self/exe", failure);
  const fs::path installed = program.parent_path().parent_path() / "share/sprung/experiments";
  for (const fs::path& folder : {installed, fs::path(SPRUNG_ASSETS) / "experiments"}) {
    if (fs::is_directory(folder, failure)) return folder;
  }
  throw Error(ErrorKind::kFailed, fmt::format("the experiments are not found in '{}'", installed.string()));
}

std::vector<fs::path> experiment_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(experiment_folder())) {
    if (is_scene_file(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

[[noreturn]] void refuse(const std::string& word) {
  const std::vector<std::string> names = case_names();
  const std::vector<std::string_view> views(names.begin(), names.end());
  throw Error(ErrorKind::kUsage, fmt::format("there is no experiment '{}'{}; see sprung validate --list", word,
                                             did_you_mean(word, views)));
}

}  // namespace

std::span<const Case> built_in_cases() {
  const auto plain = [](CaseResult (*run)(const Choice&)) {
    return [run](const Choice& choice, const Observer&) { return run(choice); };
  };
  static const std::vector<Case> cases{
      {"patch", "uniform stretch and shear of several bricks: exact at any Poisson's ratio",
       "The outer nodes of a box of bricks are displaced according to a uniform strain: three stretches and three "
       "shears, one after the other. The inner nodes move to equilibrium. They reach the uniform strain, and energy "
       "and "
       "mean stress are those of isotropic elasticity, for every model with corrections, and for plain springs at a "
       "Poisson's ratio of 1/4. The numbers are the worst of the six strains. Energy, stress and the total force on "
       "each face are exact; the force on a single corner of a sheared brick is not, because its inner diagonals also "
       "push the eight corners alternately in and out. That pattern sums to zero over every face and every edge of the "
       "brick, and the bricks around an inner node cancel it, so no inner node feels it. Convergence needs no more "
       "(the "
       "patch test).",
       plain(run_patch), draw_patch},
      {"membrane_patch", "the paper's 2D rectangle: uniform stretch and shear of several, exact at any Poisson's ratio",
       "The patch test in plane stress, with rectangles that are not square.", plain(run_membrane_patch), nullptr},
      {"membrane_stretch", "the paper's 2D rectangle: a membrane pulled at its end, exact at any Poisson's ratio",
       "Two sides slide along axes of symmetry, the far end is pulled by 10 Pa.", plain(run_membrane_stretch),
       draw_membrane_stretch},
      {"membrane_shear", "the paper's 2D rectangle: a membrane in pure shear, exact at any Poisson's ratio",
       "Tractions of 10 Pa along all four sides.", plain(run_membrane_shear), draw_membrane_shear},
      {"membrane_cantilever", "the paper's 2D rectangle: a cantilever against beam theory",
       "The rectangle calibrated in bending is accurate with one row of rectangles, where the paper's is much too "
       "stiff.",
       plain(run_membrane_cantilever), draw_membrane_cantilever},
      {"equations", "equations and unknowns of each layout of springs (the paper's Table 1)",
       "Each layout has to reproduce the classical experiments: Young's modulus along every axis, Poisson's ratio "
       "across it, and shear in every plane. The program counts the equations of each layout after symmetry. A layout "
       "with more equations than its stiffnesses can satisfy is correct at one ratio at most: 1/4 in 3D, 1/3 in 2D. "
       "The "
       "corrections add the missing unknowns.",
       plain(run_equations), nullptr},
      {"uniaxial", "large strain: one brick stretched from 0.5 to 2 times its length, sides free",
       "The calibrated brick is neo-Hookean at any strain. Springs that are linear in their true stretch form "
       "hyperelastic laws of their own, which are none of the textbook laws; all of them share E and Poisson's ratio "
       "at rest. Stretched or compressed by 10 %, bricks of springs are within 7 % of Hooke's straight line "
       "(tensile 3 %, m1 7 %); neo-Hooke and St. Venant-Kirchhoff are 9 to 16 % off, on either side of it. At "
       "twice its length tensile pulls with 1.3 E, between neo-Hooke's 0.5 E and St. Venant-Kirchhoff's 3 E; "
       "at half its length it pushes with 0.45 E, between 1.1 E and 0.19 E, where St. Venant-Kirchhoff has begun to "
       "soften. Only a test of a real material can tell which law it follows: below 10 % of strain the choice matters "
       "little, beyond it the law is part of the answer.",
       plain(run_uniaxial), nullptr},
      {"tables", "published cases from the literature: displacements, stresses, frequencies",
       "Straight, curved and twisted beams, membranes, plates, tubes and vibrations from the literature, each on one "
       "grid of bricks, in the units of its source. Stresses are those recovered at the point of the surface that the "
       "source names.",
       run_tables, nullptr},
      {"cut", "parts thinner than a brick, turned or round, and large strains",
       "What the surface cuts out of bricks. The paper's brick has a share of a full brick's stiffness, and is too "
       "stiff in bending by the square of what a part is thinner than it; the calibrated brick knows how the solid "
       "lies in "
       "it. Only its figures have a tolerance.",
       run_cut, nullptr}};
  return cases;
}

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const Case& known : built_in_cases()) names.push_back(known.name);
  try {
    for (const fs::path& file : experiment_files()) names.push_back(file.stem().string());
  } catch (const Error&) {
    return names;
  }
  return names;
}

std::vector<Case> find_cases(const std::vector<std::string>& words) {
  std::vector<Case> scenes;
  std::vector<Case> built_in;
  if (words.empty()) {
    for (const fs::path& file : experiment_files()) scenes.push_back(scene_case(file));
    built_in.assign(built_in_cases().begin(), built_in_cases().end());
  }
  for (const std::string& word : words) {
    const auto is_word = [&](const Case& known) { return known.name == word; };
    const auto known = std::find_if(built_in_cases().begin(), built_in_cases().end(), is_word);
    if (known != built_in_cases().end()) {
      built_in.push_back(*known);
    } else if (is_scene_file(word)) {
      scenes.push_back(scene_case(word));
    } else {
      const std::vector<fs::path> files = experiment_files();
      const auto file =
          std::find_if(files.begin(), files.end(), [&](const fs::path& one) { return one.stem() == word; });
      if (file == files.end()) refuse(word);
      scenes.push_back(scene_case(*file));
    }
  }
  scenes.insert(scenes.end(), built_in.begin(), built_in.end());
  return scenes;
}

}  // namespace sprung
