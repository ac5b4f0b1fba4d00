// The light of a pixel through a lens: of all whose circle of confusion contains it, each thinned out by its circle's
// area. What is farther away spreads as wide as the pixel's own light does: it stays behind what is in focus, and is seen
// through the edge of what is near. Rings of growing radius make the samples dense where circles are small.
in vec2 screen_place;
uniform sampler2D exposure;
uniform sampler2D circles;
uniform float largest;  // circle, in heights of the picture
uniform float part;
out vec4 result;

const int kRings = RINGS;
const int kDirections = DIRECTIONS;
const mat2 kGoldenTurn = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688);  // 137.5 degrees, for spirals

vec4 light_at(vec2 place) {
  vec4 light = textureLod(exposure, place, 0.0);
  return TRANSPARENT == 1 ? vec4(light.rgb * light.a, light.a) : light;
}

float circle_at(vec2 place) { return clamp(textureLod(circles, place, 0.0).r, -largest, largest); }

void main() {
  vec2 size = vec2(textureSize(circles, 0));
  float inner = 0.6 / size.y;
  float here = circle_at(screen_place);
  float weights = inner * inner / max(here * here, inner * inner);
  vec4 sum = weights * light_at(screen_place);
  float growth = pow(max(largest / inner, 1.0), 1.0 / float(kRings));
  float noise = even_noise();  // so that edges are not seen several times
  vec2 direction = vec2(cos(6.2831853 * noise), sin(6.2831853 * noise));
  for (int ring = 0; ring < kRings; ++ring) {
    float outer = growth * inner;
    for (int k = 0; k < kDirections; ++k) {
      float radius = mix(inner, outer, (float(k) + noise) / float(kDirections));
      vec2 place = screen_place + radius * direction * vec2(size.y / size.x, 1.0);
      float circle = circle_at(place);
      float spread = abs(circle > here ? here : circle);
      float reached = clamp((spread - radius) * size.y + 0.5, 0.0, 1.0);
      float weight = reached * (outer * outer - inner * inner) / (float(kDirections) * max(spread * spread, inner * inner));
      sum += weight * light_at(place);
      weights += weight;
      direction = kGoldenTurn * direction;
    }
    inner = outer;
  }
  result = part * sum / weights;
}
