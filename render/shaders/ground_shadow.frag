// The fraction of the key light that bodies occlude on the ground: the coverage of what the light hits, over the disc
// through which the lamp is seen at that distance. So a shadow is sharp where a body touches and soft where it is high up.
// Rings of growing radius each have a coverage and a distance; those that lie in the disc at their own distance, and as
// far as they fill it, say how far the disc is. What is far outside of its own disc occludes nothing.
in vec2 screen_place;
uniform vec4 ground_rectangle;
uniform float ground_height;
uniform mat4 light_from_stage;
uniform float mask_texels;     // per unit of length
uniform vec2 mask_texel_size;  // in u and v
uniform float longest_way;     // to the ground, that the mask encodes
uniform sampler2D key_mask;
out vec4 result;

const int kRings = RINGS;
const int kDirections = DIRECTIONS;
const float kSmallest = 0.75;  // radius of a disc, in texels
const mat2 kGoldenTurn = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688);  // 137.5 degrees, for spirals

// Radius of the largest disc, in texels.
float reach() { return max(light_radius * longest_way * mask_texels, 2.0 * kSmallest); }

vec2 mask_place() {
  vec2 point = ground_rectangle.xy + screen_place * ground_rectangle.zw;
  return (light_from_stage * vec4(point.x, ground_height, point.y, 1.0)).xy * 0.5 + 0.5;
}

#ifdef SHADOW
// The part of a disc that lies between two radii.
float ring_of_disc(float inner, float outer, float disc) {
  vec2 part = min(vec2(inner, outer) / disc, 1.0);
  return part.y * part.y - part.x * part.x;
}

void main() {
  vec2 uv = mask_place();
  float growth = pow(reach() / kSmallest, 1.0 / float(kRings));
  float radii[kRings + 2];
  float coverages[kRings + 1];
  radii[0] = 0.0;
  radii[1] = kSmallest;
  vec2 far = vec2(0.0);  // sums of weights, and of discs
  vec2 direction = vec2(1.0, 0.0);
  for (int ring = 0; ring <= kRings; ++ring) {
    float inner = radii[ring];
    float outer = radii[ring + 1];
    float lod = log2(max(1.5 * (outer - inner), 1.0));
    float covered = 0.0;
    for (int k = 0; k < kDirections; ++k) {
      float middle = mix(inner, outer, (float(k) + 0.5) / float(kDirections));
      vec2 found = textureLod(key_mask, uv + middle * direction * mask_texel_size, lod).rg;
      float disc = max(reach() * found.g / max(found.r, 1e-4), kSmallest);
      far += found.r * ring_of_disc(inner, outer, disc) * vec2(1.0, disc);
      covered += found.r * smoothstep(0.25 * inner, 0.75 * inner + 1e-3, disc);
      direction = kGoldenTurn * direction;
    }
    coverages[ring] = covered / float(kDirections);
    if (ring < kRings) radii[ring + 2] = growth * outer;
  }
  float disc = max(far.y / max(far.x, 1e-4), kSmallest);
  float hidden = 0.0;
  for (int ring = 0; ring <= kRings; ++ring) hidden += coverages[ring] * ring_of_disc(radii[ring], radii[ring + 1], disc);
  result = vec4(hidden);
}
#else
// Writes depth only, which marks where SHADOW has to run.
void main() {
  gl_FragDepth = textureLod(key_mask, mask_place(), log2(6.0 * reach())).r > 0.0 ? SHADED : 1.0;
  result = vec4(0.0);
}
#endif
