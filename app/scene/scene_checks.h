#pragma once
#include <string>

#include "app/scene/film.h"
#include "app/scene/scene_keys.h"
#include "app/scene/scene_mistakes.h"
#include "app/scene/toml.h"

namespace sprung {

/// Which rules between the keys of a table are broken. `path` of the table for messages: "body", "body.pin".
void check_rules(const toml::table& table, const std::string& path, std::span<const KeyRule> rules,
                 SceneMistakes& mistakes);

/// What is wrong with the values of a table taken together, each by itself being right.
void check_together(const toml::table& table, const std::string& path, const Film& scene, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const SceneBody& body, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const Box& box, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const HalfSpace& half, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const Gradient& change, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const TorusShape& ring, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const SceneObstacle& obstacle,
                    SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const Pin& pin, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const BodyForce& force, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const BodyMuscle& muscle,
                    SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const SceneWind& wind, SceneMistakes& mistakes);

template <class Owner>
void check_together(const toml::table&, const std::string&, const Owner&, SceneMistakes&) {}

}  // namespace sprung
