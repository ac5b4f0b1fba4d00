// Radius of the circle of confusion in heights of the picture, negative before the focus: it grows with the distance.
uniform vec3 lens;  // radius of a point at infinity, distance of the focus, 1 for a parallel projection
uniform vec4 distance_terms;
out vec4 result;
//!include pixel.glsl

void main() {
  float depth = min(dot(end_depth, vec3(screen_place, 1.0)), 1.0);
  for (int k = 0; k < kSamples; ++k) depth = min(depth, sample_depth(k));
  float away = (distance_terms.x * depth + distance_terms.y) / (distance_terms.z * depth + distance_terms.w);
  result = vec4(lens.x * (away - lens.y) / mix(away, lens.y, lens.z));
}
