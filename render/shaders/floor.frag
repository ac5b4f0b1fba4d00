// The floor where the bodies shade it: the background, as much darker as the light is less than in the open.
in vec2 ground_place;
in vec3 place;
uniform vec3 eye;
out vec4 result;
//!include ground_light.glsl

void main() {
  vec3 shade = ground_light(texture(ground_sky, ground_place), texture(ground_shadow, ground_place).r, ground_place);
  result = picture_color(cyclorama(normalize(place - eye).y) * shade / open_ground_light());
}
