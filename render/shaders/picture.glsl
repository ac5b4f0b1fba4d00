// The power 1 / 2.4 of sRGB by three square roots, which is faster; the error is at most 0.012 of a level.
vec3 srgb_from_linear(vec3 c) {
  vec3 half_power = sqrt(max(c, vec3(0.0)));
  vec3 quarter = sqrt(half_power);
  vec3 root = 0.642374 * half_power + 0.712102 * quarter - 0.336867 * sqrt(quarter) - 0.0175663 * c;
  return mix(c * 12.92, root, step(0.0031308, c));
}

// After Khronos PBR Neutral: keeps the hue and the lightness that the artist gave, and rolls off only the highlights.
vec3 tone_map(vec3 c) {
  const float kShoulder = 0.8 - 0.02;
  const float kDesaturation = 0.15;
  float low = min(c.r, min(c.g, c.b));
  c -= low < 0.04 ? low - 12.5 * low * low : 0.02;  // half of the original's, whose darks are too saturated for soft light
  float peak = max(c.r, max(c.g, c.b));
  if (peak < kShoulder) return c;
  float room = 1.0 - kShoulder;
  float new_peak = 1.0 - room * room / (peak + room - kShoulder);
  c *= new_peak / peak;
  float g = 1.0 - 1.0 / (kDesaturation * (peak - new_peak) + 1.0);
  return mix(c, vec3(new_peak), g);
}

// Uniform noise from 0 to 1, the same in every run: that of Jimenez, "Next Generation Post Processing in Call of Duty"
// (2014).
float even_noise() { return fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715)))); }

// Triangular noise of one level, which dithers wide, soft gradients.
float picture_noise() {
#ifdef EXPOSURE
  return 0.0;
#endif
  float even = even_noise();
  float side = 2.0 * even - 1.0;
  return sign(side) * (1.0 - sqrt(1.0 - abs(side))) * (0.75 / 255.0);
}

// Linear light to stored colour; an exposure stores the light itself.
#ifdef EXPOSURE
vec3 picture_color(vec3 light) { return light; }
#else
vec3 picture_color(vec3 light) { return srgb_from_linear(tone_map(light)); }
#endif
