// Position, id, normal and UV of a skin, and where it is one frame earlier and later.
in vec3 place;
in vec3 place_before;
in vec3 place_after;
in vec3 surface_normal;
in vec2 texture_place;
layout(location = 0) out vec4 place_and_id;
layout(location = 1) out vec4 normal_and_u;
layout(location = 2) out vec4 before_and_v;
layout(location = 3) out vec4 after;
uniform float id;

void main() {
  place_and_id = vec4(place, id);
  normal_and_u = vec4(gl_FrontFacing ? surface_normal : -surface_normal, texture_place.x);
  before_and_v = vec4(place_before, texture_place.y);
  after = vec4(place_after, 0.0);
}
