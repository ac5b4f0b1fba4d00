// The kind of each pixel, as a depth: inside a skin, at an edge of one, elsewhere.
//!include pixel.glsl
uniform float smooth_depth;  // change of depth along a smooth surface, within a pixel

void main() {
  float nearest = 1.0;
  float farthest = 0.0;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < kSamples; ++k) {
    float depth = sample_depth(k);
    nearest = min(nearest, depth);
    farthest = max(farthest, depth);
    sum += sample_normal(k);
  }
  // The steps of depth shrink with the square of the distance from 1.
  bool is_even = farthest - nearest < smooth_depth * (1.0 - nearest) * (1.0 - nearest);
  bool is_smooth = dot(sum, sum) > 0.9 * float(kSamples * kSamples);
  gl_FragDepth = nearest == 1.0 ? NO_SKIN : farthest < 1.0 && is_even && is_smooth ? INSIDE : EDGE;
}
