uniform vec3 sight_height;  // of (x, y, 1) in clip space: how much the ray rises
uniform vec2 sight_slopes;  // its slopes along x and y

// Sine of the ray's elevation above the horizon; `screen_place` 0 to 1.
float rise(vec2 screen_place) {
  vec3 at = vec3(screen_place * 2.0 - 1.0, 1.0);
  return dot(sight_height, at) / length(at * vec3(sight_slopes, 1.0));
}
