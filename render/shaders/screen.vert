// One triangle that covers the target; needs no buffers.
out vec2 screen_place;  // 0..1

void main() {
  screen_place = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(screen_place * 2.0 - 1.0, 1.0, 1.0);
}
