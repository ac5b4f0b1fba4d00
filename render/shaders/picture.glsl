vec3 srgb_from_linear(vec3 c) {
  return mix(c * 12.92, 1.055 * pow(max(c, vec3(1e-6)), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

// After Khronos PBR Neutral: keeps the hue and the lightness that the artist gave, and rolls off only the highlights.
vec3 tone_map(vec3 c) {
  const float kShoulder = 0.8 - 0.02;
  const float kDesaturation = 0.15;
  float low = min(c.r, min(c.g, c.b));
  c -= low < 0.04 ? low - 12.5 * low * low : 0.02;  // half of the original's: its darks are too colourful for soft light
  float peak = max(c.r, max(c.g, c.b));
  if (peak < kShoulder) return c;
  float room = 1.0 - kShoulder;
  float new_peak = 1.0 - room * room / (peak + room - kShoulder);
  c *= new_peak / peak;
  float g = 1.0 - 1.0 / (kDesaturation * (peak - new_peak) + 1.0);
  return mix(c, vec3(new_peak), g);
}

// Triangular noise of one level, the same in every run: hides the steps of wide, soft gradients. An integer hash (pcg)
// of the pixel; its halves are two uniform numbers.
float picture_noise() {
  uvec2 p = uvec2(gl_FragCoord.xy);
  uint state = (p.x + 8192u * p.y + 0x9e3779b9u) * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  word = (word >> 22u) ^ word;
  return (float(word >> 16u) + float(word & 0xffffu) - 65535.0) * (0.75 / 65536.0 / 255.0);
}

// Linear light to what is stored.
vec4 picture_color(vec3 light) { return vec4(srgb_from_linear(tone_map(light)) + picture_noise(), 1.0); }
