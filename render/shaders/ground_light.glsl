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
#endif

// Light on the ground at a place of its rectangle: the key light that `shadow` lets through, the visible sky, and light
// from bodies.
vec3 ground_light(vec4 sky, float shadow, vec2 ground_place) {
  float border = open_border(ground_place);
  sky *= border;
  vec3 key = key_irradiance * to_key.y * (1.0 - shadow);
#ifdef GATHERED
  vec4 glow = border * texture(ground_glow, ground_place);
  return key + sky_on_ground * (1.0 - max(sky.a, glow.a)) + brightest_glow * glow.rgb * glow.rgb;
#else
  // A guess by what is overhead. It is itself lit by the ground around it, so no place is quite black.
  return key + sky_on_ground * (1.0 - 0.94 * sky.a) + sky.rgb * (0.16 - 0.10 * sky.a) * open_ground_light();
#endif
}
