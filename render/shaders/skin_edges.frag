// The skins again, multisampled: colours come from the picture that was shaded once a pixel. Where a triangle covers
// a pixel whose middle shows something else, the neighbour whose depth fits best lends its colour.
uniform sampler2D shaded;
uniform sampler2D shaded_depth;
out vec4 result;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(shaded, 0) - 1;
  ivec2 best = pixel;
  float misfit = abs(texelFetch(shaded_depth, pixel, 0).r - gl_FragCoord.z);
  for (int k = 0; k < 4; ++k) {
    int side = (k & 1) * 2 - 1;
    ivec2 other = clamp(pixel + (k < 2 ? ivec2(side, 0) : ivec2(0, side)), ivec2(0), last);
    float its = abs(texelFetch(shaded_depth, other, 0).r - gl_FragCoord.z);
    if (its < misfit) {
      misfit = its;
      best = other;
    }
  }
  result = texelFetch(shaded, best, 0);
}
