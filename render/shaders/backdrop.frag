// The background, and the floor in front of it where no body changes its light.
in vec2 screen_place;
out vec4 result;
//!include sight.glsl

#if defined(LEVEL) || defined(PANORAMA)
uniform vec3 sight_x;          // as sight_height
uniform vec3 sight_z;
uniform vec2 floor_end;        // sines of the elevation between which the floor goes over into the background
#ifdef PATTERN
uniform mat4 stage_from_clip;
uniform float ground_height;
uniform vec4 pattern_from_stage;  // repetitions per unit of x and z; those at the centre of the stage
uniform sampler2D pattern;

const int kTaps = 8;

// Taps along the longer side of what a pixel covers of the floor.
vec3 floor_albedo() {
  vec4 near = stage_from_clip * vec4(2.0 * screen_place - 1.0, -1.0, 1.0);
  vec4 far = stage_from_clip * vec4(2.0 * screen_place - 1.0, 1.0, 1.0);
  vec3 from = near.xyz / near.w;
  vec3 to = far.xyz / far.w;
  vec2 at = mix(from, to, (ground_height - from.y) / (to.y - from.y)).xz * pattern_from_stage.xy + pattern_from_stage.zw;
  vec2 right = dFdx(at);
  vec2 down = dFdy(at);
  bool is_wide = dot(right, right) > dot(down, down);
  vec2 along = is_wide ? right : down;
  vec2 across = is_wide ? down : right;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < kTaps; ++k) {
    float part = (float(k) + 0.5) / float(kTaps) - 0.5;
    sum += textureGrad(pattern, at + part * along, along / float(kTaps), across).rgb;
  }
  return sum / float(kTaps);
}
#else
vec3 floor_albedo() { return ground_albedo; }
#endif

#ifdef PANORAMA
uniform sampler2D panorama;
uniform float panorama_scale;

vec3 background(vec3 direction) {
  vec2 uv = vec2(0.5 + atan(direction.x, -direction.z) / 6.2831853, acos(clamp(direction.y, -1.0, 1.0)) / 3.1415927);
  return panorama_scale * textureLod(panorama, uv, 0.0).rgb;
}
#else
vec3 background(vec3 direction) { return cyclorama(direction.y); }
#endif

vec3 backdrop() {
  vec3 at = vec3(2.0 * screen_place - 1.0, 1.0);
  vec3 direction = normalize(vec3(dot(sight_x, at), dot(sight_height, at), dot(sight_z, at)));
  float far = smoothstep(floor_end.x, floor_end.y, direction.y);
  return mix(floor_albedo() * open_ground_light(), background(direction), far);
}
#else
vec3 backdrop() { return cyclorama(rise(screen_place)); }
#endif

void main() { result = vec4(picture_color(backdrop()) + picture_noise(), 1.0); }
