// The studio: a large warm key light, a paler sky or an environment, a warm-grey floor that blends into the background.
// Irradiances are divided by pi: a white matt surface under 1 has radiance 1.
const vec3 kKey = vec3(0.93, 0.89, 0.825);
const vec3 kGroundAlbedo = vec3(0.74, 0.722, 0.700);
const float kLightRadius = 0.11;  // of the key light, seen from a distance of 1: softness of its shadow

uniform vec3 to_key;         // unit, stage space
uniform vec3 sky_on_ground;  // without occlusion

vec3 open_ground_light() { return kKey * to_key.y + sky_on_ground; }

// The floor without any body, and the background: a function of the sine of the ray's elevation alone, so that there is
// no horizon. Brightest at the viewer's feet.
vec3 cyclorama(float rise) {
  float up = smoothstep(-0.55, 0.40, rise);
  return kGroundAlbedo * open_ground_light() * mix(vec3(1.02, 1.01, 1.0), vec3(0.62, 0.612, 0.605), up);
}
