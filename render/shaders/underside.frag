// The colour seen from below; 0 for the background.
in vec2 texture_place;
in vec3 vertex_color;
out vec4 result;
//!include albedo.glsl

void main() {
  vec3 root = albedo_root();
  result = vec4(root * root, 1.0);
}
