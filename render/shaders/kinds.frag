// Whether a pixel shows a skin, as a depth.
in vec2 screen_place;
uniform sampler2DShadow skin_coverage;  // the share of a pixel's samples that are nearer than a depth
uniform vec3 end_depth;

void main() {
  float covered = texture(skin_coverage, vec3(screen_place, dot(end_depth, vec3(screen_place, 1.0))));
  gl_FragDepth = covered > 0.0 ? SKIN : NO_SKIN;
}
