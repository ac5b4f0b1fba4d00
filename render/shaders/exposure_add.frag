// A part of an exposure's light, to be added up.
uniform sampler2D exposure;
uniform float part;
out vec4 result;

void main() {
  vec4 light = texelFetch(exposure, ivec2(gl_FragCoord.xy), 0);
  result = part * (TRANSPARENT == 1 ? vec4(light.rgb * light.a, light.a) : light);
}
