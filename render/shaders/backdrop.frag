// The background, by the line of sight alone.
in vec2 screen_place;
uniform vec3 sight_height;  // of (x, y, 1) in clip space: how much the line of sight rises
uniform vec2 sight_slopes;  // how much it leans sideways, along x and y
out vec4 result;

void main() {
  vec3 at = vec3(screen_place * 2.0 - 1.0, 1.0);
  result = picture_color(cyclorama(dot(sight_height, at) / length(at * vec3(sight_slopes, 1.0))));
}
