#include "app/key_options.h"

#include <array>

#include "app/scene/scene_keys.h"

namespace sprung {
namespace {

constexpr std::array<KeyOption, 22> kKeyOptions{{
    {"--material", "body.material", "NAME", {.is_common = true}},
    {"--materials", "materials", "FILE.toml"},
    {"--young", "body.material.young", "20kPa", {.is_common = true}},
    {"--poisson", "body.material.poisson", "0.45"},
    {"--density", "body.material.density", "1.1g/cm3"},
    {"--damping", "body.material.damping", "0.03"},
    {"--size", "body.size", "12cm", {.is_common = true}},
    {"--bricks", "body.bricks", "N|auto", {.is_common = true}},
    {"--brick-size", "body.brick_size", "5mm"},
    {"--repair", "body.repair", "off|auto|strict"},
    {"--thickness", "body.thickness", "3mm"},
    {"--texture", "body.texture", "FILE.png", {.is_of_pictures = true}},
    {"--model", "body.model", "NAME"},
    {"--scheme", "solver.scheme", "NAME"},
    {"--integrator", "solver.scheme", "NAME"},
    {"--time-limit", "solver.time_limit", "24h"},
    {"--fps", "fps", "N", {.is_common = true}},
    {"--duration", "duration", "3s", {.is_common = true}},
    {"--resolution", "render.resolution", "WxH", {.is_of_pictures = true, .is_common = true}},
    {"--quality", "render.quality", "preview|default|high", {.is_of_pictures = true, .is_common = true}},
    {"--samples", "render.samples", "N", {.is_of_pictures = true}},
    {"--color-by", "render.color_by", "FIELD", {.is_of_pictures = true, .is_common = true}},
}};

template <class Owner>
std::string key_help(std::string_view path);

template <class Value>
std::string help_below(const Value*, std::string_view) {
  return "";
}
std::string help_below(const Material*, std::string_view rest) { return key_help<Material>(rest); }
std::string help_below(const SceneSolver*, std::string_view rest) { return key_help<SceneSolver>(rest); }
std::string help_below(const SceneRender*, std::string_view rest) { return key_help<SceneRender>(rest); }
std::string help_below(const std::vector<SceneBody>*, std::string_view rest) { return key_help<SceneBody>(rest); }

template <class Owner>
std::string key_help(std::string_view path) {
  const auto dot = path.find('.');
  const Key<Owner>* key = find_key<Owner>(path.substr(0, dot));
  if (dot == std::string_view::npos) return std::string(key->help);
  const auto below = [&](auto field) {
    return help_below(static_cast<std::remove_cvref_t<decltype(Owner{}.*field)>*>(nullptr), path.substr(dot + 1));
  };
  return std::visit(below, key->member);
}

}  // namespace

std::span<const KeyOption> key_options() { return kKeyOptions; }

std::string help_of(const KeyOption& option) { return key_help<Scene>(option.key); }

}  // namespace sprung
