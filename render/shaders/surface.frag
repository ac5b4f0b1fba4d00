// The G-buffer of a skin: the square root of its colour (fine steps in the dark), the number of its look and its normal.
// Its position follows from the depth.
in vec3 surface_normal;
in vec2 texture_place;
in vec3 vertex_color;
layout(location = 0) out vec4 surface_color;
layout(location = 1) out vec4 packed_normal;
uniform float look;
//!include albedo.glsl

// Octahedral, in two times 16 bits: llvmpipe writes four bytes faster than any other layout.
vec4 pack_normal(vec3 n) {
  n /= max(abs(n.x) + abs(n.y) + abs(n.z), 1e-6);
  vec2 fold = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  vec2 place = (0.5 + 0.5 * (n.z < 0.0 ? fold : n.xy)) * 255.0;
  return vec4(floor(place) / 255.0, fract(place));
}

void main() {
  surface_color = vec4(albedo_root(), look / 255.0);
  packed_normal = pack_normal(gl_FrontFacing ? surface_normal : -surface_normal);
}
