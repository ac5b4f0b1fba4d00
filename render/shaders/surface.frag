// The G-buffer of a skin: the square root of its colour (fine steps in the dark), the number of its look and its normal.
// Its position follows from the depth.
in vec3 surface_normal;
in vec2 texture_place;
in vec3 vertex_color;
layout(location = 0) out vec4 surface_color;
layout(location = 1) out vec4 packed_normal;
#ifdef GATHERED
in vec4 vertex_light;
layout(location = 2) out vec4 surface_light;
#endif
#ifdef THROUGH
in vec4 vertex_through;
layout(location = 3) out vec4 surface_through;
#endif
uniform float look;
//!include albedo.glsl

// Octahedral, in two times 16 bits: llvmpipe writes four bytes faster than any other layout.
vec4 pack_normal(vec3 n) {
  n /= max(abs(n.x) + abs(n.y) + abs(n.z), 1e-6);
  vec2 fold = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  vec2 place = (0.5 + 0.5 * (n.z < 0.0 ? fold : n.xy)) * 255.0;
  return vec4(floor(place) / 255.0, fract(place));
}

#ifdef EXPOSURE
uniform int turn;  // -1: all

// When a sample is taken, in eighths of an exposure: a Bayer matrix, so that neighbours are far apart in time.
int turn_of_sample() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int either = at.x ^ at.y;
  return 4 * (either & 1) + 2 * (at.y & 1) + (either >> 1 & 1);
}
#endif

void main() {
#ifdef EXPOSURE
  if (turn >= 0 && turn != turn_of_sample()) discard;
#endif
  surface_color = vec4(albedo_root(), look / 255.0);
#ifdef GATHERED
  surface_light = vertex_light;
#endif
#ifdef THROUGH
  surface_through = vertex_through;
#endif
  packed_normal = pack_normal(gl_FrontFacing ? surface_normal : -surface_normal);
}
