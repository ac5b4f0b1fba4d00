// The floor where bodies change its light: a factor of the background.
in vec2 ground_place;
uniform sampler2D ground_tint;
out vec4 result;

void main() { result = texture(ground_tint, ground_place); }
