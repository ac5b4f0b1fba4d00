// A skin in stage space, now, one frame earlier and one later.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 5) in vec3 earlier;
layout(location = 6) in vec3 later;

uniform vec3 stage_center;  // m
uniform float stage_scale;  // 1/m
uniform mat4 clip_from_stage;

out vec3 place;
out vec3 place_before;
out vec3 place_after;
out vec3 surface_normal;
out vec2 texture_place;

vec3 in_stage(vec3 point) { return (point - stage_center) * stage_scale; }

void main() {
  place = in_stage(position);
  place_before = in_stage(earlier);
  place_after = in_stage(later);
  surface_normal = normal * inversesqrt(max(dot(normal, normal), 1e-30));
  texture_place = uv;
  gl_Position = clip_from_stage * vec4(place, 1.0);
}
