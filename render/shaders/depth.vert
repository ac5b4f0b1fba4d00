layout(location = 0) in vec3 position;

uniform vec3 stage_center;
uniform float stage_scale;
uniform mat4 clip_from_stage;

void main() {
  vec3 place = (position - stage_center) * stage_scale;
  gl_Position = clip_from_stage * vec4(place, 1.0);
}
