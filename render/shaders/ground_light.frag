// Half of the light on the ground, at low resolution, for its reflection on the bodies.
in vec2 screen_place;
out vec4 result;
//!include ground_light.glsl

void main() {
  float shadow = textureLod(ground_shadow, screen_place, SHADOW_LOD).r;
  result = vec4(0.5 * ground_light(texture(ground_sky, screen_place), shadow, screen_place), 1.0);
}
