// A skin in stage space: the centre of the motion is the origin, its radius 1.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 color;  // square root of linear
layout(location = 9) in float opacity;
#ifdef GATHERED
layout(location = 7) in vec4 light;
out vec4 vertex_light;
#endif
#ifdef THROUGH
layout(location = 8) in vec4 through;
out vec4 vertex_through;
#endif
#ifdef MAPPED
layout(location = 4) in float coordinate;
out float map_coordinate;
#endif

uniform vec3 stage_center;  // m
uniform float stage_scale;  // 1/m
uniform mat4 clip_from_stage;
uniform float min_opacity;  // of what is drawn

out vec3 place;
out vec3 surface_normal;
out vec2 texture_place;
out vec3 vertex_color;

void main() {
#ifdef MAPPED
  map_coordinate = coordinate;
#endif
  place = (position - stage_center) * stage_scale;
  surface_normal = normal * inversesqrt(max(dot(normal, normal), 1e-30));
  texture_place = vec2(uv.x, 1.0 - uv.y);  // v runs up, rows of pictures run down
  vertex_color = color.rgb;
#ifdef GATHERED
  vertex_light = light;
#endif
#ifdef THROUGH
  vertex_through = through;
#endif
  gl_Position = opacity < min_opacity ? vec4(0.0, 0.0, 2.0, 1.0) : clip_from_stage * vec4(place, 1.0);
}
