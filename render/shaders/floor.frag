// The floor where bodies change its light: the backdrop times a factor, or the shares of the light.
in vec2 ground_place;
uniform sampler2D backdrop;
uniform sampler2D ground_tint;
out vec4 result;
//!include ground_light.glsl

vec3 behind() { return texelFetch(backdrop, ivec2(gl_FragCoord.xy), 0).rgb; }

void main() {
#if defined(SHARES) || defined(LIGHT)
  vec4 sky = textureLod(ground_sky, ground_place, 0.0);
  float shadow = textureLod(ground_shadow, ground_place, 0.0).r;
#endif
#if defined(SHARES)
  result = vec4(1.0 - shadow, 1.0 - hidden_sky(sky, ground_place), 1.0, 1.0);
#elif defined(LIGHT)
  result = vec4(behind() * ground_light(sky, shadow, ground_place) / open_ground_light(), 1.0);
#else
  result = vec4(2.0 * behind() * texture(ground_tint, ground_place).rgb + picture_noise(), 1.0);
#endif
}
