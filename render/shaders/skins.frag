// The light of the skins. Samples of a pixel at about the same depth and with about the same normal are shaded once, by
// their mean: usually all of them, except at edges and creases. alpha is the fraction of the pixel that shows a skin.
uniform mat4 stage_from_clip;
uniform vec4 distance_terms;
out vec4 result;
//!include pixel.glsl
//!include skin_light.glsl

const float kSameDepth = 0.05;  // of the body's radius
const float kSameWay = 0.6;     // square of a cosine

struct Surface {  // sums over samples
  vec3 color;
  vec3 normal;
  float depth;
  float look;
  vec4 light;  // as sample_light()
  vec4 through;
  float share;
};

vec3 picture_light(Surface s) {
  vec4 place = stage_from_clip * vec4(vec3(screen_place, s.depth / s.share) * 2.0 - 1.0, 1.0);
  vec3 n = dot(s.normal, s.normal) > 1e-3 ? s.normal : eye - place.xyz / place.w;  // no normals, or opposite ones
  n = normalize(n);
  vec3 point = place.xyz / place.w;
#ifdef SHARES
  return vec3(key_light(point, n, dot(n, to_key)), openness(point, n, s.light / s.share), 0.0);
#else
  return skin_light(point, n, s.color / s.share, round(s.look / s.share), s.light / s.share, s.through / s.share);
#endif
}

// Along the camera's axis.
float distance_of(float depth) {
  return (distance_terms.x * depth + distance_terms.y) / (distance_terms.z * depth + distance_terms.w);
}

bool fits(Surface s, float depth, vec3 normal) {
  float along = dot(s.normal, normal);
  bool is_same_way = along > 0.0 && along * along > kSameWay * dot(s.normal, s.normal) * dot(normal, normal);
  bool is_as_far = abs(distance_of(depth) - distance_of(s.depth / s.share)) < kSameDepth * body_radius;
  return s.share == 0.0 || (is_as_far && is_same_way);
}

void main() {
  float depths[kSamples];
  int left = 0;  // bits of the samples not yet shaded
  for (int k = 0; k < kSamples; ++k) {
    depths[k] = sample_depth(k);
    left |= depths[k] < 1.0 ? 1 << k : 0;
  }
  vec3 normals[kSamples];
  vec4 paints[kSamples];  // colour and look
  vec4 lights[kSamples];
  vec4 throughs[kSamples];
  for (int k = 0; k < kSamples; ++k) {
    normals[k] = sample_normal(k);
    paints[k] = sample_paint(k);
    lights[k] = sample_light(k);
    throughs[k] = sample_through(k);
  }
  vec3 sum = vec3(0.0);
  float covered = 0.0;
  while (left != 0) {
    Surface s = Surface(vec3(0.0), vec3(0.0), 0.0, 0.0, vec4(0.0), vec4(0.0), 0.0);
    for (int k = 0; k < kSamples; ++k) {
      bool is_in = (left >> k & 1) != 0 && fits(s, depths[k], normals[k]);
      float w = is_in ? 1.0 : 0.0;
      left ^= is_in ? 1 << k : 0;
      s = Surface(s.color + w * paints[k].rgb, s.normal + w * normals[k], s.depth + w * depths[k], s.look + w * paints[k].a,
                  s.light + w * lights[k], s.through + w * throughs[k], s.share + w);
    }
    sum += s.share * picture_color(picture_light(s));
    covered += s.share;
  }
  result = vec4(sum / max(covered, 1.0) + picture_noise(), covered / float(kSamples));
}
