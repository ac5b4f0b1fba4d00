// One triangle that covers the target; needs no buffers.
uniform float screen_depth;
out vec2 screen_place;  // 0..1

void main() {
  screen_place = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(screen_place * 2.0 - 1.0, screen_depth * 2.0 - 1.0, 1.0);
}
