// Half of how much lighter the floor looks than without bodies: a factor of the background. Exact where the background
// is as bright as below, and within one level elsewhere, since it nearly is.
in vec2 screen_place;
out vec4 result;
//!include ground_light.glsl

void main() {
  vec3 open = open_ground_light();
  vec3 share = ground_light(texture(ground_sky, screen_place), textureLod(ground_shadow, screen_place, 0.0).r, screen_place) / open;
  vec3 background = cyclorama(-0.2);
  result = vec4(0.5 * picture_color(background * share) / picture_color(background), 1.0);
}
