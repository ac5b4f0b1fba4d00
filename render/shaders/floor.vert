// The rectangle of the ground where bodies change the light.
uniform vec4 ground_rectangle;  // low corner x, z; sides
uniform float ground_height;
uniform mat4 clip_from_stage;
out vec2 ground_place;  // 0..1

void main() {
  ground_place = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 point = ground_rectangle.xy + ground_place * ground_rectangle.zw;
  gl_Position = clip_from_stage * vec4(point.x, ground_height, point.y, 1.0);
}
