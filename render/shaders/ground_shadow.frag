// The fraction of the key light that bodies occlude on the ground: the mask of what the light hits, averaged over the
// disc through which the lamp is seen from the ground. So a shadow is sharp where a body touches and soft where it is
// high up.
in vec2 screen_place;
uniform vec4 ground_rectangle;
uniform float ground_height;
uniform mat4 light_from_stage;
uniform float mask_texels;      // per unit of length
uniform vec2 mask_texel_size;   // in u and v
uniform float longest_way;      // to the ground, that the mask encodes
uniform float lowest_way;       // to the ground, from the lowest body
uniform float body_radius;
uniform sampler2D key_mask;
out vec4 result;

const int kSearch = SEARCH;
const int kTaps = TAPS;
const mat2 kGoldenTurn = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688);  // 137.5 degrees, for spirals

float reach() { return kLightRadius * (1.2 * body_radius + lowest_way) * mask_texels; }

vec2 mask_place() {
  vec2 point = ground_rectangle.xy + screen_place * ground_rectangle.zw;
  return (light_from_stage * vec4(point.x, ground_height, point.y, 1.0)).xy * 0.5 + 0.5;
}

#ifdef SHADOW
void main() {
  vec2 uv = mask_place();
  vec2 found = vec2(0.0);
  const float kStep = 1.0 / 255.0;  // of the mask: with low coverage rounding would make the distance arbitrary
  vec2 direction = vec2(1.0, 0.0);
  for (int k = 0; k < kSearch; ++k) {
    vec2 offset = reach() * sqrt((float(k) + 0.5) / float(kSearch)) * direction;
    vec2 hit = textureLod(key_mask, uv + offset * mask_texel_size, log2(max(0.8 * reach(), 1.0))).rg;
    found += vec2(hit.r, max(hit.g - kStep, 0.0));
    direction = kGoldenTurn * direction;
  }
  int taps = found.r > 1e-4 ? kTaps : 0;
  float radius = max(kLightRadius * longest_way * found.g / max(found.r, 1e-4) * mask_texels, 0.75);
  float lod = log2(max(0.55 * radius, 1.0));
  float hidden = 0.0;
  for (int k = 0; k < taps; ++k) {
    vec2 offset = radius * sqrt((float(k) + 0.5) / float(kTaps)) * direction;
    hidden += textureLod(key_mask, uv + offset * mask_texel_size, lod).r;
    direction = kGoldenTurn * direction;
  }
  result = vec4(hidden / float(kTaps));
}
#else
// Writes depth only, which marks where SHADOW has to run.
void main() {
  gl_FragDepth = textureLod(key_mask, mask_place(), log2(6.0 * reach())).r > 0.0 ? SHADED : 1.0;
  result = vec4(0.0);
}
#endif
