#include "render/draw_frame.h"

namespace sprung {

void DrawFrame::set_common(const GlProgram& program) const {
  program.set("stage_center", space.center.cast<float>().eval());
  program.set("stage_scale", static_cast<float>(space.scale));
  program.set("to_key", to_key_light().cast<float>().eval());
  program.set("sky_on_ground", sky_on_ground);
  program.set("body_radius", static_cast<float>(body_radius));
  program.set("ground_height", static_cast<float>(ground_height));
  program.set("ground_rectangle", rectangle(light.ground.low, light.ground.sides));
  program.set("light_from_stage", light.key.clip_from_stage.cast<float>().eval());
}

Eigen::Vector4f rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& sides) {
  Eigen::Vector4f values;
  values << low.cast<float>(), sides.cast<float>();
  return values;
}

Eigen::Vector4f lookup_rectangle(const LightView& view) {
  return rectangle(view.low.head<2>(), view.sides.head<2>().cwiseInverse());
}

}  // namespace sprung
