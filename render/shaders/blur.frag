// Gaussian along one axis; `reach` is three standard deviations, in texture coordinates.
in vec2 screen_place;
uniform sampler2D source;
uniform vec2 reach;
out vec4 result;

const int kHalf = 8;

void main() {
  vec4 sum = vec4(0.0);
  float weight = 0.0;
  for (int k = -kHalf; k <= kHalf; ++k) {
    float t = float(k) / float(kHalf);
    float w = exp(-4.5 * t * t);
    sum += w * texture(source, screen_place + t * reach);
    weight += w;
  }
  result = sum / weight;
}
