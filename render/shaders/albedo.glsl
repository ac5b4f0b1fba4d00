uniform vec3 base_color;  // linear
uniform sampler2D base_texture;

vec3 albedo() { return base_color * vertex_color * texture(base_texture, texture_place).rgb; }
