#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <utility>

#include "assets/models/check_mesh.h"
#include "assets/models/mesh_model.h"
#include "assets/models/ply.h"

namespace {

namespace fs = std::filesystem;
using namespace sprung::models;

void write_checked(const Toy& toy, const std::string& name, const fs::path& folder) {
  const Health health = check_mesh(toy, name);
  const fs::path file = folder / (name + ".ply");
  write_ply(toy, file);
  const Eigen::RowVector3f size = toy.positions.colwise().maxCoeff() - toy.positions.colwise().minCoeff();
  fmt::print(
      "{:8} {:6} triangles  {:.3f} x {:.3f} x {:.3f} m  {:7.1f} cm3  smallest angle {:4.1f}, {} below 20  {} kB\n",
      name, toy.triangles.rows(), size[0], size[1], size[2], 1e6 * health.volume, health.smallest_angle,
      health.thin_triangles, fs::file_size(file) / 1000);
}

/// The models named after the folder, or all of them.
void make_models(int count, char** arguments) {
  const fs::path folder = arguments[1];
  const auto wanted = [&](const std::string& name) {
    bool found = count == 2;
    for (int i = 2; i < count; ++i) found = found || name == arguments[i];
    return found;
  };
  for (const auto& make : {make_bear, make_gummy, make_octopus, make_torus, make_pudding, make_jelly, make_knot,
                           make_tentacle, make_gripper, make_wheel, make_cushion}) {
    const Model model = make();
    if (wanted(model.name)) write_checked(mesh_model(model), model.name, folder);
  }
  const std::pair<const char*, Toy (*)()> boxes[] = {{"beam", make_beam},   {"plank", make_plank},
                                                     {"taffy", make_taffy}, {"stick", make_stick},
                                                     {"flag", make_flag},   {"wall", make_wall}};
  for (const auto& [name, make] : boxes) {
    if (wanted(name)) write_checked(make(), name, folder);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) {
    fmt::print(stderr, "usage: make_models FOLDER [NAME...]\n");
    return 2;
  }
  try {
    make_models(count, arguments);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "make_models: {}\n", error.what());
    return 1;
  }
}
