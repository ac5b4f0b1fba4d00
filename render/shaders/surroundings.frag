// The floor and the background in one: light and shadow where the line of sight meets the floor, else none. The floor's
// depth hides what has sunk into it.
in vec2 screen_place;
uniform mat4 clip_from_stage;
uniform mat4 stage_from_clip;
uniform vec3 eye;
uniform bool floor_in_sight;
uniform float ground_height;
uniform vec4 ground_rectangle;  // low corner x, z; sides
uniform sampler2D ground_light;
out vec4 result;

void main() {
  vec4 far = stage_from_clip * vec4(screen_place * 2.0 - 1.0, 1.0, 1.0);
  vec3 direction = normalize(far.xyz / far.w - eye);
  vec3 place = eye + direction * ((ground_height - eye.y) / min(direction.y, -1e-4));
  vec2 uv = (place.xz - ground_rectangle.xy) / ground_rectangle.zw;
  vec3 shade = textureLod(ground_light, uv, 0.0).rgb / open_ground_light();
  vec4 clip = clip_from_stage * vec4(place, 1.0);
  bool on_floor = floor_in_sight && direction.y < -1e-4;
  gl_FragDepth = on_floor ? clamp(0.5 + 0.5 * clip.z / clip.w, 0.0, 1.0) : 1.0;
  result = picture_color(cyclorama(direction) * (on_floor ? shade : vec3(1.0)));
}
