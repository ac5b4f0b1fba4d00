// The light that the skins send to the eye. Inside a skin a pixel is shaded once, by the mean of its samples. At EDGES
// the samples that show the same surface are shaded together, and alpha is the share of the pixel that shows a skin.
uniform mat4 stage_from_clip;
uniform sampler2D surface_color;
out vec4 result;
//!include pixel.glsl
//!include skin_light.glsl

const float kSameNormal = 0.7;  // cosine
const float kSameDepth = 0.03;  // of the body's radius

struct Surface {  // sums over samples
  vec3 color;
  vec3 normal;
  float depth;
  float share;
};

vec3 sample_color(int k) {
  vec3 root = texelFetch(surface_color, sample_place(k), 0).rgb;
  return root * root;
}

vec3 picture_light(Surface s) {
  vec4 place = stage_from_clip * vec4(vec3(screen_place, s.depth / s.share) * 2.0 - 1.0, 1.0);
  vec3 n = dot(s.normal, s.normal) > 1e-3 ? s.normal : eye - place.xyz / place.w;  // a surface without normals
  return skin_light(place.xyz / place.w, normalize(n), s.color / s.share);
}

#ifdef EDGES
// Distance along the camera's axis.
float distance_of(float depth) { return 1.0 / (stage_from_clip[2].w * (2.0 * depth - 1.0) + stage_from_clip[3].w); }

bool fits(Surface s, float depth, vec3 n) {
  return s.share == 0.0 ||
         (dot(n, s.normal) > kSameNormal * s.share &&
          abs(distance_of(depth) - distance_of(s.depth / s.share)) < kSameDepth * body_radius);
}

void main() {
  int left = 0;  // samples to be shaded, bit by bit
  for (int k = 0; k < kSamples; ++k) left |= sample_depth(k) < 1.0 ? 1 << k : 0;
  vec3 sum = vec3(0.0);
  float covered = 0.0;
  while (left != 0) {
    Surface s = Surface(vec3(0.0), vec3(0.0), 0.0, 0.0);
    for (int k = 0; k < kSamples; ++k) {
      vec3 n = sample_normal(k);
      float depth = sample_depth(k);
      if ((left >> k & 1) == 0 || !fits(s, depth, n)) continue;
      left ^= 1 << k;
      s = Surface(s.color + sample_color(k), s.normal + n, s.depth + depth, s.share + 1.0);
    }
    sum += s.share * srgb_from_linear(tone_map(picture_light(s)));
    covered += s.share;
  }
  result = vec4(sum / max(covered, 1.0) + picture_noise(), covered / float(kSamples));
}
#else
void main() {
  Surface s = Surface(vec3(0.0), vec3(0.0), 0.0, float(kSamples));
  for (int k = 0; k < kSamples; ++k) {
    s.color += sample_color(k);
    s.normal += sample_normal(k);
    s.depth += texelFetch(surface_depth, sample_place(k), 0).r;
  }
  result = picture_color(picture_light(s));
}
#endif
