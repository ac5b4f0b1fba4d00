// What a skin is, before any light: the square root of its colour (fine steps in the dark) and its normal. The depth
// says where.
in vec3 surface_normal;
in vec2 texture_place;
in vec3 vertex_color;
layout(location = 0) out vec4 surface_color;
layout(location = 1) out vec4 packed_normal;
//!include albedo.glsl

void main() {
  surface_color = vec4(albedo_root(), 1.0);
  packed_normal = vec4(0.5 + 0.5 * (gl_FrontFacing ? surface_normal : -surface_normal), 0.0);
}
