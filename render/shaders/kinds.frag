// Writes as depth whether a pixel shows a skin.
in vec2 screen_place;
uniform sampler2DShadow skin_coverage;  // the fraction of four samples around a place that are nearer than a depth
uniform vec3 end_depth;

void main() {
  float end = dot(end_depth, vec3(screen_place, 1.0));
#if SIDE == 4
  vec2 step = 1.0 / vec2(textureSize(skin_coverage, 0));
  float covered = 0.0;
  for (int k = 0; k < 4; ++k) {
    covered += texture(skin_coverage, vec3(screen_place + step * vec2((k & 1) * 2 - 1, (k >> 1) * 2 - 1), end));
  }
#else
  float covered = texture(skin_coverage, vec3(screen_place, end));
#endif
  gl_FragDepth = covered > 0.0 ? SKIN : NO_SKIN;
}
