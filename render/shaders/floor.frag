// The floor where the bodies shade it: the background, as much darker as the light is less than in the open.
in vec2 ground_place;
uniform vec2 pixel;  // size of a pixel, of the screen
out vec4 result;
//!include ground_light.glsl
//!include sight.glsl

void main() {
  vec3 shade = ground_light(texture(ground_sky, ground_place), texture(ground_shadow, ground_place).r, ground_place);
  result = picture_color(cyclorama(rise(gl_FragCoord.xy * pixel)) * shade / open_ground_light());
}
