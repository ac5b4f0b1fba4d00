// The background, by the line of sight alone.
in vec2 screen_place;
out vec4 result;
//!include sight.glsl

void main() { result = picture_color(cyclorama(rise(screen_place))); }
