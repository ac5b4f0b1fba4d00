#pragma once
#include <toml++/toml.h>

#include <string>

#include "app/scene/scene.h"
#include "app/scene/scene_mistakes.h"

namespace sprung {

/// What is wrong with the keys of a table taken together, each by itself being right: one of two is needed, two exclude
/// each other, one refers to another. `path` of the table for messages: "body", "body.pin".
void check_together(const toml::table& table, const std::string& path, const Scene& scene, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const SceneBody& body, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const Box& box, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const Pin& pin, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const Probe& probe, SceneMistakes& mistakes);
void check_together(const toml::table& table, const std::string& path, const Gate& gate, SceneMistakes& mistakes);

template <class Owner>
void check_together(const toml::table&, const std::string&, const Owner&, SceneMistakes&) {}

}  // namespace sprung
