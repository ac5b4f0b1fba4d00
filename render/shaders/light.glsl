// A key light, a sky or an environment, and a warm-grey floor that blends into the background: see Lighting. Irradiances
// are divided by pi: a white matt surface under 1 has radiance 1.
uniform vec3 to_key;          // unit, stage space
uniform vec3 key_irradiance;  // of a surface that faces the key light
uniform float light_radius;   // of the key light, seen from a distance of 1: softness of its shadow
uniform vec3 far_off;         // the background high up, over the floor
uniform vec3 sky_on_ground;   // without occlusion
uniform vec3 ground_albedo;   // on the whole

vec3 open_ground_light() { return key_irradiance * to_key.y + sky_on_ground; }

// The floor without any body, and the background: a function of the sine of the ray's elevation alone, so that there is
// no horizon. Brightest at the viewer's feet.
vec3 cyclorama(float rise) {
  float up = smoothstep(-0.55, 0.40, rise);
  return ground_albedo * open_ground_light() * mix(vec3(1.02, 1.01, 1.0), far_off, up);
}
