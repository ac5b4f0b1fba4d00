// The mean light of all exposures as a picture.
uniform sampler2D mean_light;
out vec4 result;

void main() {
  vec4 light = texelFetch(mean_light, ivec2(gl_FragCoord.xy), 0);
  float alpha = TRANSPARENT == 1 ? light.a : 1.0;
  result = vec4(picture_color(light.rgb / max(alpha, 1e-3)) + picture_noise(), alpha);
}
