// The floor where the bodies shade it: what the background is multiplied with.
in vec2 ground_place;
uniform sampler2D ground_tint;
out vec4 result;

void main() { result = texture(ground_tint, ground_place); }
