// Seen from below: colour, and 1 + height above the ground; 0 where there is nothing.
in vec3 place;
in vec2 texture_place;
in vec3 vertex_color;
uniform float ground_height;
out vec4 result;
//!include albedo.glsl

void main() {
  vec3 root = albedo_root();
  result = vec4(root * root, 1.0 + max(place.y - ground_height, 0.0));
}
