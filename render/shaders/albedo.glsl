uniform vec3 base_color;  // square root of linear, as vertex_color

#ifdef TEXTURED
uniform sampler2D base_texture;

vec3 albedo_root() { return base_color * vertex_color * sqrt(texture(base_texture, texture_place).rgb); }
#else
vec3 albedo_root() { return base_color * vertex_color; }
#endif
