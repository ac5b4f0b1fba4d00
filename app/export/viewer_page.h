#pragma once
#include <string_view>

namespace sprung {

/// A page that shows a film in three dimensions in any browser with WebGL 2, by itself: what it shows is put in place
/// of kViewerFilm, a JavaScript object. Drag to turn, wheel to come nearer, space or a click on the bar to stop.
inline constexpr std::string_view kViewerFilm = "/*FILM*/";
inline constexpr std::string_view kViewerPage = R"page(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>sprung</title>
<style>
html, body { margin: 0; height: 100%; background: #d9dde2; overflow: hidden; }
canvas { width: 100%; height: 100%; display: block; touch-action: none; cursor: grab; }
input { position: fixed; left: 5%; width: 90%; bottom: 16px; }
</style>
</head>
<body>
<canvas></canvas>
<input type="range" min="0" step="any" value="0" aria-label="time">
<script>
"use strict";
const film = /*FILM*/;
const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
const canvas = document.querySelector("canvas");
const bar = document.querySelector("input");
const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
const last = film.frames - 1;
bar.max = last;

function shader(kind, text) {
  const made = gl.createShader(kind);
  gl.shaderSource(made, "#version 300 es\nprecision highp float;\n" + text);
  gl.compileShader(made);
  return made;
}
const program = gl.createProgram();
gl.attachShader(program, shader(gl.VERTEX_SHADER, `
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 color;
uniform mat4 clip_from_world;
out vec3 n;
out vec3 c;
void main() { n = normal; c = color; gl_Position = clip_from_world * vec4(position, 1.0); }`));
gl.attachShader(program, shader(gl.FRAGMENT_SHADER, `
in vec3 n;
in vec3 c;
uniform vec3 to_light;
out vec4 shade;
void main() {
  vec3 up = normalize(gl_FrontFacing ? n : -n);
  float light = 0.35 + 0.25 * up.y + 0.55 * max(dot(up, to_light), 0.0);
  shade = vec4(pow(light * pow(c, vec3(2.2)), vec3(1.0 / 2.2)), 1.0);
}`));
gl.linkProgram(program);
gl.useProgram(program);
gl.enable(gl.DEPTH_TEST);
gl.clearColor(0.851, 0.867, 0.886, 1);

function buffer(place, data) {
  const made = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, made);
  gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
  gl.enableVertexAttribArray(place);
  gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
  return made;
}
const meshes = film.meshes.map((mesh) => {
  const made = { steps: new Uint16Array(bytes(mesh.positions)), triangles: new Uint32Array(bytes(mesh.triangles)) };
  made.positions = new Float32Array(made.steps.length / film.frames);
  made.normals = new Float32Array(made.positions.length);
  made.array = gl.createVertexArray();
  gl.bindVertexArray(made.array);
  made.position_buffer = buffer(0, made.positions);
  made.normal_buffer = buffer(1, made.normals);
  buffer(2, Float32Array.from(new Uint8Array(bytes(mesh.colors)), (value) => value / 255));
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, made.triangles, gl.STATIC_DRAW);
  return made;
});

/// Between two frames in proportion.
function pose(mesh, time) {
  const frame = Math.min(Math.floor(time), Math.max(last - 1, 0));
  const share = last === 0 ? 0 : time - frame;
  const size = mesh.positions.length;
  const here = frame * size;
  const there = Math.min(frame + 1, last) * size;
  for (let i = 0; i < size; ++i) {
    const step = mesh.steps[here + i] + share * (mesh.steps[there + i] - mesh.steps[here + i]);
    mesh.positions[i] = film.low[i % 3] + step * film.step;
  }
  const p = mesh.positions;
  const n = mesh.normals.fill(0);
  for (let t = 0; t < mesh.triangles.length; t += 3) {
    const [a, b, c] = [3 * mesh.triangles[t], 3 * mesh.triangles[t + 1], 3 * mesh.triangles[t + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const k of [a, b, c]) { n[k] += x; n[k + 1] += y; n[k + 2] += z; }
  }
  gl.bindBuffer(gl.ARRAY_BUFFER, mesh.position_buffer);
  gl.bufferSubData(gl.ARRAY_BUFFER, 0, p);
  gl.bindBuffer(gl.ARRAY_BUFFER, mesh.normal_buffer);
  gl.bufferSubData(gl.ARRAY_BUFFER, 0, n);
}

const view = { azimuth: film.azimuth, elevation: film.elevation, distance: 1 };
const middle = film.low.map((low, k) => (low + film.high[k]) / 2);
const radius = Math.max(Math.hypot(...film.high.map((high, k) => high - film.low[k])) / 2, 1e-9);

function camera() {
  const [ca, sa] = [Math.cos(view.azimuth), Math.sin(view.azimuth)];
  const [ce, se] = [Math.cos(view.elevation), Math.sin(view.elevation)];
  const right = [ca, 0, -sa];
  const back = [sa * ce, se, ca * ce];
  const up = [-sa * se, ce, -ca * se];
  const aspect = canvas.width / canvas.height;
  const zoom = 3 * Math.min(1, aspect);
  const far = 3.3 * radius * view.distance;
  const [near_end, far_end] = [Math.max(far - 1.5 * radius, 0.02 * radius), far + 1.5 * radius];
  const depth = (far_end + near_end) / (far_end - near_end);
  const row = (axis) => -axis.reduce((sum, value, k) => sum + value * middle[k], 0);
  const matrix = [];
  for (let k = 0; k < 3; ++k) {
    matrix.push(right[k] * zoom / aspect, up[k] * zoom, -back[k] * depth, -back[k]);
  }
  const z = far - row(back);
  matrix.push(row(right) * zoom / aspect, row(up) * zoom, z * depth - 2 * far_end * near_end / (far_end - near_end), z);
  gl.uniformMatrix4fv(gl.getUniformLocation(program, "clip_from_world"), false, matrix);
  const light = [0.5 * right[0] + 0.7 * up[0] + 0.5 * back[0], 0.5 * right[1] + 0.7 * up[1] + 0.5 * back[1],
    0.5 * right[2] + 0.7 * up[2] + 0.5 * back[2]];
  gl.uniform3fv(gl.getUniformLocation(program, "to_light"), light);
}

let time = Number(location.hash.slice(1)) || 0;  // page.html#12 shows frame 12 (from 0) and stays there
let plays = location.hash === "";
let drawn_at = 0;
function draw(now) {
  if (plays) time = last === 0 ? 0 : (time + (now - drawn_at) / 1000 * film.fps) % last;
  drawn_at = now;
  bar.value = time;
  canvas.width = canvas.clientWidth * devicePixelRatio;
  canvas.height = canvas.clientHeight * devicePixelRatio;
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  camera();
  for (const mesh of meshes) {
    pose(mesh, Math.min(time, last));
    gl.bindVertexArray(mesh.array);
    gl.drawElements(gl.TRIANGLES, mesh.triangles.length, gl.UNSIGNED_INT, 0);
  }
  requestAnimationFrame(draw);
}
canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
canvas.addEventListener("pointermove", (event) => {
  if (!canvas.hasPointerCapture(event.pointerId)) return;
  view.azimuth -= 0.008 * event.movementX;
  view.elevation = Math.min(1.57, Math.max(-1.57, view.elevation + 0.008 * event.movementY));
});
canvas.addEventListener("wheel", (event) => {
  view.distance = Math.min(5, Math.max(0.2, view.distance * Math.exp(0.001 * event.deltaY)));
  event.preventDefault();
}, { passive: false });
bar.addEventListener("input", () => { plays = false; time = Number(bar.value); });
addEventListener("keydown", (event) => { if (event.key === " ") plays = !plays; });
requestAnimationFrame(draw);
</script>
</body>
</html>
)page";

}  // namespace sprung
