// Reads the skins' surface in the SIDE x SIDE samples of a pixel.
in vec2 screen_place;
uniform sampler2D surface_color;
uniform sampler2D packed_normal;
uniform sampler2D surface_depth;
uniform vec3 end_depth;  // at (x, y, 1) of the screen; whatever is deeper has sunk into the floor
const int kSamples = SIDE * SIDE;

ivec2 sample_place(int k) { return SIDE * ivec2(gl_FragCoord.xy) + ivec2(k % SIDE, k / SIDE); }

// 1 where nothing is visible.
float sample_depth(int k) {
  float depth = texelFetch(surface_depth, sample_place(k), 0).r;
  return depth < dot(end_depth, vec3(screen_place, 1.0)) ? depth : 1.0;
}

// Of a length from 0.57 to 1. See pack_normal() of surface.frag.
vec3 sample_normal(int k) {
  vec4 bytes = texelFetch(packed_normal, sample_place(k), 0);
  vec2 place = 2.0 * (bytes.xy + bytes.zw / 255.0) - 1.0;
  float z = 1.0 - abs(place.x) - abs(place.y);
  float fold = max(-z, 0.0);
  return vec3(place.x + (place.x < 0.0 ? fold : -fold), place.y + (place.y < 0.0 ? fold : -fold), z);
}

// Linear colour, and the number of the look.
vec4 sample_paint(int k) {
  vec4 bytes = texelFetch(surface_color, sample_place(k), 0);
  return vec4(bytes.rgb * bytes.rgb, 255.0 * bytes.a);
}

#ifdef GATHERED
uniform sampler2D surface_light;
uniform float brightest_light;

// See VertexLight.
vec4 gathered_light(sampler2D stored, int k) {
  vec4 root = texelFetch(stored, sample_place(k), 0);
  return vec4(brightest_light * root.rgb * root.rgb, root.a);
}

vec4 sample_light(int k) { return gathered_light(surface_light, k); }
#else
vec4 sample_light(int k) { return vec4(0.0); }
#endif

#ifdef THROUGH
uniform sampler2D surface_through;

vec4 sample_through(int k) { return gathered_light(surface_through, k); }
#else
vec4 sample_through(int k) { return vec4(0.0); }
#endif
