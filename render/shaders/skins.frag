// The light that the skins send to the eye. The samples of a pixel that are about as far away are shaded together, by
// their mean: inside a skin that is all of them. alpha is the share of the pixel that shows a skin.
uniform mat4 stage_from_clip;
out vec4 result;
//!include pixel.glsl
//!include skin_light.glsl

const float kSameDepth = 0.05;  // of the body's radius

struct Surface {  // sums over samples
  vec3 color;
  vec3 normal;
  float depth;
  float share;
};

vec3 picture_light(Surface s) {
  vec4 place = stage_from_clip * vec4(vec3(screen_place, s.depth / s.share) * 2.0 - 1.0, 1.0);
  vec3 n = dot(s.normal, s.normal) > 1e-3 ? s.normal : eye - place.xyz / place.w;  // no normals, or opposite ones
  return skin_light(place.xyz / place.w, normalize(n), s.color / s.share);
}

// Distance along the camera's axis.
float distance_of(float depth) { return 1.0 / (stage_from_clip[2].w * (2.0 * depth - 1.0) + stage_from_clip[3].w); }

bool fits(Surface s, float depth) {
  return s.share == 0.0 || abs(distance_of(depth) - distance_of(s.depth / s.share)) < kSameDepth * body_radius;
}

void main() {
  float depths[kSamples];
  int left = 0;  // samples to be shaded, bit by bit
  for (int k = 0; k < kSamples; ++k) {
    depths[k] = sample_depth(k);
    left |= depths[k] < 1.0 ? 1 << k : 0;
  }
  vec3 normals[kSamples];
  vec3 colors[kSamples];
  for (int k = 0; k < kSamples; ++k) {
    normals[k] = sample_normal(k);
    colors[k] = sample_color(k);
  }
  vec3 sum = vec3(0.0);
  float covered = 0.0;
  while (left != 0) {
    Surface s = Surface(vec3(0.0), vec3(0.0), 0.0, 0.0);
    for (int k = 0; k < kSamples; ++k) {
      bool is_in = (left >> k & 1) != 0 && fits(s, depths[k]);
      float w = is_in ? 1.0 : 0.0;
      left ^= is_in ? 1 << k : 0;
      s = Surface(s.color + w * colors[k], s.normal + w * normals[k], s.depth + w * depths[k], s.share + w);
    }
    sum += s.share * srgb_from_linear(tone_map(picture_light(s)));
    covered += s.share;
  }
  result = vec4(sum / max(covered, 1.0) + picture_noise(), covered / float(kSamples));
}
