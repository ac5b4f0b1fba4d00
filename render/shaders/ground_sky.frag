// The fraction of the sky that bodies occlude from each point of the ground (a), and the light that they reflect down
// instead (rgb).
// A horizontal disc of radius b at height h fills F = b^2 / (b^2 + h^2) of the cosine-weighted hemisphere; rings of
// growing radius, each with the coverage and the height found in it, add up to the body's underside.
in vec2 screen_place;
uniform vec4 ground_rectangle;     // x, z of the low corner; side lengths
uniform vec4 underside_rectangle;  // 1 / side lengths in zw
uniform sampler2D underside;       // coverage, coverage * height over its range
uniform vec2 underside_heights;    // above the ground: low, range
uniform sampler2D underside_color;
uniform float body_radius;
uniform float underside_texels;
out vec4 result;

const int kRings = 5;
const int kDirections = 8;
const mat2 kTurn = mat2(0.7071068, 0.7071068, -0.7071068, 0.7071068);  // 45 degrees

float disc(float b, float h) { return b * b / (b * b + h * h + 1e-9); }

void main() {
  vec2 point = ground_rectangle.xy + screen_place * ground_rectangle.zw;
  float inner = 0.0;
  float outer = 0.04 * body_radius;
  float hidden = 0.0;
  for (int ring = 0; ring <= kRings; ++ring) {
    float middle = ring == 0 ? 0.0 : sqrt(inner * outer);
    float width = 0.7 * (outer - inner) * underside_rectangle.z * underside_texels;
    float lod = log2(max(width, 1.0));
    int count = ring == 0 ? 1 : kDirections;
    float share = 0.0;
    vec2 direction = (ring & 1) == 0 ? vec2(1.0, 0.0) : vec2(0.9238795, 0.3826834);
    for (int k = 0; k < count; ++k) {
      vec2 uv = (point + middle * direction - underside_rectangle.xy) * underside_rectangle.zw;
      vec2 found = textureLod(underside, uv, lod).rg;
      float height = max(underside_heights.x + underside_heights.y * found.g / max(found.r, 1e-4), 0.0);
      share += found.r * (disc(outer, height) - disc(inner, height));
      direction = kTurn * direction;
    }
    hidden += share / float(count);
    inner = outer;
    outer *= 2.4;
  }
  hidden = clamp(hidden, 0.0, 1.0);

  // The mean colour overhead; it fades out beyond the body.
  vec2 uv = (point - underside_rectangle.xy) * underside_rectangle.zw;
  float lod = log2(max(1.2 * body_radius * underside_rectangle.z * underside_texels, 1.0));
  vec4 overhead = textureLod(underside_color, uv, lod);
  result = vec4(hidden * overhead.rgb / (overhead.a + 0.05), hidden);
}
