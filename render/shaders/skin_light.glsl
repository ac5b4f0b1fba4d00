// The radiance of a point on a skin towards the eye.
uniform vec3 eye;
uniform float body_radius;
uniform float ground_height;
uniform float motion;              // of any point, away from where the light maps have it
uniform vec4 ground_rectangle;     // low corner x, z; sides
uniform sampler2D ground_light_map;      // half of the light; no mipmaps, which take several times as long to sample
uniform sampler2D far_ground_light_map;  // blurred
uniform mat4 light_from_stage;     // the key light's clip space
uniform vec2 light_texel;          // texture coordinates per unit of length, across the light
uniform sampler2DShadow key_shadow_map;
uniform sampler2D key_depth;
uniform float key_depth_range;     // units of length
uniform vec4 zenith_rectangle;     // low corner x, z; 1 / sides
uniform vec2 zenith_heights;       // low, 1 / range
uniform sampler2D zenith;

const vec3 kWindow = vec3(-0.880, 0.300, 0.368);  // towards its middle

const int kSearch = SHADOW_SEARCH;
const int kTaps = SHADOW_TAPS;
const mat2 kGoldenTurn = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688);  // 137.5 degrees, for spirals

// Of so many taps on a spiral the distance of one from the middle, as texture coordinates of the key light's map.
vec2 tap(float radius, int k, int taps) { return radius * sqrt((float(k) + 0.5) / float(taps)) * light_texel; }

// Where texels are as far apart as they are: what taps see changes evenly, not in contours.
float tap_level(float radius, int taps) {
  vec2 texels = radius * light_texel * vec2(textureSize(key_depth, 0));
  return log2(max(0.9 * max(texels.x, texels.y) / sqrt(float(taps)), 1.0));
}

// The fraction of the key light that reaches a point. The point is first moved outwards and towards the light by a small
// fraction of the body's size: soft matter is translucent that far, and the surface does not shadow itself.
float key_light(vec3 point, vec3 n, float facing) {
  vec3 moved = point + body_radius * (0.012 * n + 0.028 * to_key) + motion * to_key;
  vec3 uvd = (light_from_stage * vec4(moved, 1.0)).xyz * 0.5 + 0.5;
  float widest = 0.6 * light_radius * body_radius;
  float reach = 1.3 * widest;  // few taps leave gaps: what the filter may see, the search has seen
  float search_level = tap_level(reach, kSearch);
  int search = facing > -0.35 ? kSearch : 0;
  float open = 0.0;
  vec2 direction = vec2(1.0, 0.0);
  for (int k = 0; k < search; ++k) {
    open += textureLod(key_shadow_map, vec3(uvd.xy + tap(reach, k, kSearch) * direction, uvd.z), search_level);
    direction = kGoldenTurn * direction;
  }
  // llvmpipe skips a loop without iterations but not an `if`: only the edges of shadows pay for the filter.
  bool is_edge = open > 0.001 && open < float(kSearch) - 0.001;
  search = is_edge ? kSearch : 0;
  float way = 0.0;
  float blockers = 0.0;
  for (int k = 0; k < search; ++k) {
    float depth = textureLod(key_depth, uvd.xy + tap(reach, k, kSearch) * direction, search_level).r;
    float above = smoothstep(0.0, 0.01, uvd.z - depth);
    way += above * (uvd.z - depth);
    blockers += above;
    direction = kGoldenTurn * direction;
  }
  int taps = is_edge ? kTaps : 0;
  float radius = clamp(light_radius * key_depth_range * way / max(blockers, 1e-3), 0.02 * body_radius, widest);
  float level = tap_level(radius, kTaps);
  float lit = 0.0;
  for (int k = 0; k < taps; ++k) {
    lit += textureLod(key_shadow_map, vec3(uvd.xy + tap(radius, k, kTaps) * direction, uvd.z), level);
    direction = kGoldenTurn * direction;
  }
  return is_edge ? lit / float(kTaps) : step(0.5, open);
}

// The visible fraction of the sky above a point: the probability that the blurred heights do not exceed it (Chebyshev).
float open_sky(vec3 point, vec3 n) {
  vec3 moved = point + 0.16 * body_radius * n;
  vec2 moments = texture(zenith, (moved.xz - zenith_rectangle.xy) * zenith_rectangle.zw).rg;
  float height = (moved.y - zenith_heights.x) * zenith_heights.y;
  float variance = max(moments.y - moments.x * moments.x, 2e-4);
  float below = max(moments.x - height, 0.0);
  return variance / (variance + below * below);
}

vec3 ground_bounce(vec3 point, vec3 n) {
  float height = max(point.y - ground_height, 0.0);
  vec2 uv = (point.xz + 0.6 * height * n.xz - ground_rectangle.xy) / ground_rectangle.zw;
  vec3 near = texture(ground_light_map, uv).rgb;
  vec3 far = texture(far_ground_light_map, uv).rgb;
  return 2.0 * ground_albedo * mix(near, far, smoothstep(0.0, 0.5 * body_radius, height));
}

#ifdef ENVIRONMENT
uniform vec3 irradiance[9];             // Environment::irradiance
uniform sampler2D reflections;          // square root of the light over the brightest; a level per roughness
uniform float brightest_reflection;

vec3 sky_light(vec3 n) {
  vec3 sum = irradiance[0] + irradiance[1] * n.y + irradiance[2] * n.z + irradiance[3] * n.x;
  sum += irradiance[4] * n.x * n.y + irradiance[5] * n.y * n.z + irradiance[6] * (3.0 * n.z * n.z - 1.0);
  sum += irradiance[7] * n.x * n.z + irradiance[8] * (n.x * n.x - n.y * n.y);
  return max(sum, vec3(0.0));
}

// What a reflection sees: floor below, the environment above; the border is as soft as the surface is rough.
vec3 room(vec3 direction, vec3 floor_light, float roughness) {
  float soft = 0.04 + 0.5 * roughness;
  vec2 uv = vec2(0.5 + atan(direction.x, -direction.z) / 6.2831853, acos(clamp(direction.y, -1.0, 1.0)) / 3.1415927);
  vec3 root = textureLod(reflections, uv, 4.0 * roughness - 1.0).rgb;
  return mix(floor_light, brightest_reflection * root * root, smoothstep(-soft, soft, direction.y));
}
#else
vec3 sky_light(vec3 n) { return (0.5 + 0.5 * n.y) * sky_on_ground; }

// What a reflection sees: floor below, the background around, a ceiling with a panel and a window at the side of the key
// light; edges are as soft as the surface is rough. From above comes as much light as sky_light() has.
vec3 room(vec3 direction, vec3 floor_light, float roughness) {
  float soft = 0.04 + 0.5 * roughness;
  float ceiling = smoothstep(0.0, 0.45 + 0.5 * soft, direction.y);
  vec3 walls = mix(cyclorama(direction.y), 0.50 * sky_on_ground, ceiling);
  float panel = smoothstep(0.66 - soft, 0.66 + soft, direction.y);
  float window = smoothstep(0.86 - 0.5 * soft, 0.86 + 0.5 * soft, dot(direction, kWindow));
  vec3 above = walls + sky_on_ground * (0.60 * panel + 1.20 * window);
  return mix(floor_light, above, smoothstep(-soft, soft, direction.y));
}
#endif

float ggx(float nh, float nv, float nl, float alpha) {
  float a2 = alpha * alpha;
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float v = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
  return a2 / (d * d) * v;
}

// The finish of a Look, given by its number.
struct Finish {
  float roughness;
  float translucency;  // fraction of light that enters and leaves elsewhere
  float metal;
  float glow;  // fraction of the colour that is independent of light
};

Finish finish_of(float look) {
  vec4 is = 1.0 - min(abs(look - vec4(1.0, 2.0, 3.0, 4.0)), 1.0);  // gelatin, rubber, steel, chart
  return Finish(0.42 + dot(is, vec4(-0.20, 0.16, -0.20, 0.33)), is.x, is.z, 0.45 * is.w);
}

// Integral of the specular lobe over uniform surroundings, as a scale and a bias of the reflectance (Karis's fit).
vec2 surrounding_share(float nv, float roughness) {
  vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y;
  return vec2(-1.04 * a + r.z, 1.04 * a + r.w);
}

float power5(float x) {
  float x2 = x * x;
  return x2 * x2 * x;
}

#ifdef GATHERED
float openness(vec3 point, vec3 n, vec4 gathered) { return gathered.a; }
#else
float openness(vec3 point, vec3 n, vec4 gathered) { return open_sky(point, n); }
#endif

#ifdef THROUGH
const float kLayer = LAYER;  // constants of Layer
const float kInner = INNER;

// See Layer. What a layer reflects and lets through that, infinitely thick, would reflect `base`; `thickness`: times the
// coefficient of scattering.
void layer(vec3 base, float thickness, out vec3 reflected, out vec3 let_through) {
  vec3 thick = clamp(base / (1.0 - kInner + kInner * base), 0.004, 0.998);
  vec3 a = 0.5 * (1.0 / thick + thick);
  vec3 b = 0.5 * (1.0 / thick - thick);
  vec3 e = exp(-b * thickness);
  vec3 tangent = (1.0 - e * e) / (1.0 + e * e);
  vec3 below = a * tangent + b;
  vec3 r = tangent / below;
  vec3 t = 2.0 * b * e / (1.0 + e * e) / below;
  vec3 once = 1.0 / (1.0 - kInner * r);
  vec3 back = r + kInner * t * t * once;
  vec3 out_of_it = (1.0 - kInner) / (1.0 - kInner * back);
  reflected = out_of_it * back;
  let_through = out_of_it * t * once;
}
#endif

// `gathered`: light from around, where it was gathered by rays; `through`: what comes through the body, or
// what a metal mirrors.
vec3 skin_light(vec3 place, vec3 n, vec3 base, float look, vec4 gathered, vec4 through) {
  Finish finish = finish_of(look);
  vec3 v = normalize(eye - place);
  vec3 h = normalize(v + to_key);
  float nl = dot(n, to_key);
  float nv = max(dot(n, v), 1e-3);
  float lit = key_light(place, n, nl);

  // Subsurface scattering: light leaves a little further on, in the body's colour, and softens the edge of the shadow.
  vec3 wrap = 0.06 + (0.20 + 0.45 * finish.translucency) * base;
  vec3 soft = clamp((nl + wrap) / (1.0 + wrap), 0.0, 1.0);
  vec3 diffuse = mix(soft, soft * soft, min(2.0 * wrap, 1.0));

  float open = openness(place, n, gathered);
  vec3 bounce = ground_bounce(place, n);
#ifdef GATHERED
  vec3 surrounding = gathered.rgb;
#else
  vec3 surrounding = (0.5 - 0.5 * n.y) * bounce + 1.1 * mix(0.4, 1.0, open) * sky_light(n) + 0.06 * base * open;
#endif
  vec3 reflecting = base;
#ifdef GATHERED
  vec3 inner = vec3(0.0);
#ifdef THROUGH
  if (through.a > 0.0 && finish.metal == 0.0) {
    vec3 let_through;
    layer(base, -2.0 * kLayer * log(max(through.a, 1e-4)), reflecting, let_through);
    // What is not scattered at all shows the room behind, refracted.
    vec3 behind = room(refract(-v, n, 1.0 / 1.4), bounce, finish.roughness);
    inner = let_through * mix(through.rgb, behind, through.a * through.a);
  }
#endif
#else
  // Light from inside, most where it was on its way through thin parts: at the rim, which it colours in place of a white
  // reflection.
  vec3 inner = finish.translucency * (bounce + 0.5 * key_irradiance) * base * (0.18 + 0.55 * (1.0 - nv) * (1.0 - nv));
#endif

  vec3 reflected = room(reflect(-v, n), bounce, finish.roughness);
#ifdef THROUGH
  reflected = mix(reflected * mix(0.3, 1.0, open), reflected * (1.0 - through.a) + through.rgb, finish.metal);
#else
  reflected *= mix(0.3, 1.0, open);
#endif
  float clear = max(nl, 0.0);
  vec3 reflectance = mix(vec3(0.04), base, finish.metal);
  vec3 fresnel = reflectance + (1.0 - reflectance) * power5(1.0 - max(dot(v, h), 0.0));
  float gloss = ggx(max(dot(n, h), 0.0), nv, max(clear, 1e-3), finish.roughness * finish.roughness) * clear;
  vec2 share = surrounding_share(nv, finish.roughness);
#ifdef GATHERED
  float rim = 1.0;
#else
  float rim = 1.0 - 0.75 * finish.translucency;
#endif

  vec3 light = (1.0 - finish.metal) * (reflecting * (key_irradiance * diffuse * lit + surrounding) + inner);
  light += key_irradiance * gloss * lit * fresnel + reflected * (reflectance * share.x + rim * share.y);
  return mix(light, base, finish.glow);
}
