// The background; depends on the view ray alone.
in vec2 screen_place;
out vec4 result;
//!include sight.glsl

void main() { result = vec4(picture_color(cyclorama(rise(screen_place))) + picture_noise(), 1.0); }
