// What the key light hits before the ground: coverage, and coverage times the remaining distance to the ground over the
// longest one.
uniform sampler2D key_depth;
uniform vec4 height_from_light;  // height above the ground of (u, v, depth, 1)
uniform float longest_way;
out vec4 result;

void main() {
  ivec2 corner = 2 * ivec2(gl_FragCoord.xy);
  vec2 size = vec2(textureSize(key_depth, 0));
  vec2 sum = vec2(0.0);
  for (int k = 0; k < 4; ++k) {
    ivec2 texel = corner + ivec2(k & 1, k >> 1);
    float depth = texelFetch(key_depth, texel, 0).r;
    float height = dot(height_from_light, vec4((vec2(texel) + 0.5) / size, depth, 1.0));
    if (depth < 1.0 && height > -1e-3) sum += vec2(1.0, max(height, 0.0) / (to_key.y * longest_way));
  }
  result = vec4(0.25 * sum, 0.0, 1.0);
}
