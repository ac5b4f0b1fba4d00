// Position, id and normal of a skin.
in vec3 place;
in vec3 surface_normal;
layout(location = 0) out vec4 place_and_id;
layout(location = 1) out vec4 normal;
uniform float id;

void main() {
  place_and_id = vec4(place, id);
  normal = vec4(gl_FrontFacing ? surface_normal : -surface_normal, 0.0);
}
