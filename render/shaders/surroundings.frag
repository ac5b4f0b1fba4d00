// The floor and the background in one: light and shadow where the line of sight meets the floor, else none.
in vec2 screen_place;
uniform mat4 stage_from_clip;
uniform vec3 eye;
uniform bool floor_in_sight;
uniform float ground_height;
uniform vec4 ground_rectangle;  // low corner x, z; sides
uniform sampler2D sharp_ground_light;
out vec4 result;

void main() {
  vec4 far = stage_from_clip * vec4(screen_place * 2.0 - 1.0, 1.0, 1.0);
  vec3 direction = normalize(far.xyz / far.w - eye);
  vec3 place = eye + direction * ((ground_height - eye.y) / min(direction.y, -1e-4));
  vec2 uv = (place.xz - ground_rectangle.xy) / ground_rectangle.zw;
  vec3 shade = texture(sharp_ground_light, uv).rgb / open_ground_light();
  bool on_floor = floor_in_sight && direction.y < -1e-4;
  result = picture_color(cyclorama(direction) * (on_floor ? shade : vec3(1.0)));
}
