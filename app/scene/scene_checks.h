#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/scene/scene_fields.h"

namespace sprung {

/// The location of a mistake in a table: the table itself, a key, or one row of a key's array.
struct KeyLocation {
  std::string_view key{};
  int row = -1;
};

using Report = std::function<void(KeyLocation place, std::string text)>;

/// Reports which rules between the keys of a table the given keys break. `path` of the table for messages: "body.pin".
void check_rules(const std::vector<KeyRule>& rules, const std::vector<std::string_view>& given, const std::string& path,
                 const Report& report);

/// Reports what is wrong with the combination of a table's values, each valid by itself.
void check_table(const Film& film, const std::string& path, const Report& report);
void check_table(const SceneBody& body, const std::string& path, const Report& report);
void check_table(const Box& box, const std::string& path, const Report& report);
void check_table(const HalfSpace& half, const std::string& path, const Report& report);
void check_table(const Gradient& gradient, const std::string& path, const Report& report);
void check_table(const TorusShape& torus, const std::string& path, const Report& report);
void check_table(const SceneObstacle& obstacle, const std::string& path, const Report& report);
void check_table(const Pin& pin, const std::string& path, const Report& report);
void check_table(const BodyForce& force, const std::string& path, const Report& report);
void check_table(const BodyMuscle& muscle, const std::string& path, const Report& report);
void check_table(const SceneWind& wind, const std::string& path, const Report& report);
void check_table(const Material& material, const std::string& path, const Report& report);
void check_table(const LibraryMaterial& material, const std::string& path, const Report& report);

template <class Owner>
void check_table(const Owner&, const std::string&, const Report&) {}

}  // namespace sprung
