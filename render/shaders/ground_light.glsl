uniform sampler2D ground_sky;
uniform sampler2D ground_shadow;

// Falls to 0 at the border of the ground's rectangle, beyond which no body is felt.
float open_border(vec2 ground_place) {
  vec2 border = smoothstep(0.0, 0.12, min(ground_place, 1.0 - ground_place));
  return border.x * border.y;
}

#ifdef GATHERED
uniform sampler2D ground_glow;  // see GroundGlow; square root of the light over the brightest
uniform float brightest_glow;

vec4 glow_at(vec2 ground_place) { return open_border(ground_place) * texture(ground_glow, ground_place); }
#endif

// The fraction of the sky that bodies hide; `sky` as it is stored.
float hidden_sky(vec4 sky, vec2 ground_place) {
#ifdef GATHERED
  return max(open_border(ground_place) * sky.a, glow_at(ground_place).a);
#else
  return open_border(ground_place) * sky.a;
#endif
}

// Light on the ground at a place of its rectangle: the key light that `shadow` lets through, the visible sky, and light
// from bodies.
vec3 ground_light(vec4 sky, float shadow, vec2 ground_place) {
  float hidden = hidden_sky(sky, ground_place);
  vec3 key = key_irradiance * to_key.y * (1.0 - shadow);
#ifdef GATHERED
  vec3 root = glow_at(ground_place).rgb;
  return key + sky_on_ground * (1.0 - hidden) + brightest_glow * root * root;
#else
  // A guess by what is overhead. It is itself lit by the ground around it, so no place is quite black.
  vec3 overhead = open_border(ground_place) * sky.rgb;
  return key + sky_on_ground * (1.0 - 0.94 * hidden) + overhead * (0.16 - 0.10 * hidden) * open_ground_light();
#endif
}
