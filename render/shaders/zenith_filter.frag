// Height (1 at the top of the map, 0 at its bottom) and its square, averaged over 2 x 2 texels.
uniform sampler2D zenith_depth;
out vec4 result;

void main() {
  ivec2 corner = 2 * ivec2(gl_FragCoord.xy);
  vec2 sum = vec2(0.0);
  for (int k = 0; k < 4; ++k) {
    float height = 1.0 - texelFetch(zenith_depth, corner + ivec2(k & 1, k >> 1), 0).r;
    sum += vec2(height, height * height);
  }
  result = vec4(0.25 * sum, 0.0, 1.0);
}
