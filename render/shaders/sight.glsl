uniform vec3 sight_height;  // of (x, y, 1) in clip space: how much the line of sight rises
uniform vec2 sight_slopes;  // how much it leans sideways, along x and y

// Sine of the line of sight's rise above the horizon; `screen_place` 0 to 1.
float rise(vec2 screen_place) {
  vec3 at = vec3(screen_place * 2.0 - 1.0, 1.0);
  return dot(sight_height, at) / length(at * vec3(sight_slopes, 1.0));
}
