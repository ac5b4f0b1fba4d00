#if defined(MAPPED)
in float map_coordinate;
uniform sampler2D base_texture;

vec3 albedo_root() {
  bool is_line = map_coordinate > 1.5;
  float coordinate = clamp(is_line ? map_coordinate - 2.0 : map_coordinate, 0.0, 1.0);
  return (is_line ? 0.74 : 1.0) * texture(base_texture, vec2((0.5 + 255.0 * coordinate) / 256.0, 0.5)).rgb;
}
#elif defined(TEXTURED)
uniform vec3 base_color;  // square root of linear, as vertex_color
uniform sampler2D base_texture;

vec3 albedo_root() { return base_color * vertex_color * sqrt(texture(base_texture, texture_place).rgb); }
#else
uniform vec3 base_color;  // square root of linear, as vertex_color

vec3 albedo_root() { return base_color * vertex_color; }
#endif
