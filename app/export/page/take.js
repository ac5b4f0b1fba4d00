"use strict";
// A film of the page: its meshes, bricks and springs in three.js, and their shapes and colours at any time.

const bytes_of = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
const linear = (byte) => {
  const share = byte / 255;
  return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
};

/// Colours from 0 (low) to 255 (high), linear, three numbers each.
const linear_colors = (legend) => Float32Array.from(new Uint8Array(bytes_of(legend.colors)), linear);

/// The places of some points in every frame, or in a single one where they stay.
class Track {
  constructor(film, text) {
    this.film = film;
    this.steps = new Uint16Array(bytes_of(text));
  }

  /// Between two frames in proportion.
  place(places, time) {
    const { low, step } = this.film;
    const [here, there, share] = between(time, this.steps.length / places.length);
    for (let i = 0; i < places.length; ++i) {
      const from = this.steps[here * places.length + i];
      places[i] = low[i % 3] + (from + share * (this.steps[there * places.length + i] - from)) * step;
    }
  }
}

/// The frames (of so many) before and after a time, and how far it is from one to the other.
function between(time, frames) {
  const frame = Math.min(Math.floor(time), Math.max(frames - 2, 0));
  return [frame, Math.min(frame + 1, frames - 1), Math.min(time - frame, 1)];
}

/// Vertices in bricks: what their nodes have, by trilinear weights.
class Embedded {
  constructor(bricks, mesh) {
    this.corners = bricks;
    this.brick = new Uint32Array(bytes_of(mesh.brick));
    this.local = new Float32Array(bytes_of(mesh.local));
  }

  /// `width` numbers for each vertex from as many for each node; `clamped`: those outside of their brick as on its border.
  mix(of_nodes, of_vertices, width, clamped) {
    const { brick, corners, local } = this;
    const inside = clamped ? (coordinate) => Math.min(1, Math.max(0, coordinate)) : (coordinate) => coordinate;
    of_vertices.fill(0);
    for (let row = 0; row < brick.length; ++row) {
      const [x, y, z] = [inside(local[3 * row]), inside(local[3 * row + 1]), inside(local[3 * row + 2])];
      for (let corner = 0; corner < 8; ++corner) {
        const weight = (corner & 1 ? x : 1 - x) * (corner & 2 ? y : 1 - y) * (corner & 4 ? z : 1 - z);
        const node = corners[8 * brick[row] + corner] * width;
        for (let k = 0; k < width; ++k) of_vertices[row * width + k] += weight * of_nodes[node + k];
      }
    }
  }
}

/// Vertices that lie together with one normal are one to the light, however often a mesh has them: the first of each.
function first_alike(positions, normals) {
  const known = new Map();
  return Uint32Array.from({ length: positions.count }, (_, row) => {
    const place = [positions.getX(row), positions.getY(row), positions.getZ(row)];
    const key = [...place, normals.getX(row), normals.getY(row), normals.getZ(row)].join();
    if (!known.has(key)) known.set(key, row);
    return known.get(key);
  });
}

/// A mesh of the model, carried by bricks or an obstacle; its parts share their vertices.
class MovingMesh {
  constructor(film, node, mesh, bricks) {
    this.parts = [];
    node.traverse((part) => { if (part.isMesh) this.parts.push(part); });
    const { position, normal } = this.parts[0].geometry.attributes;
    [this.positions, this.normals] = [position, normal];
    this.embedded = mesh.brick ? new Embedded(bricks, mesh) : null;
    this.track = mesh.obstacle ? new Track(film, mesh.obstacle) : null;
    this.alike = first_alike(position, normal);
    for (const part of this.parts) {
      part.frustumCulled = false;
      part.castShadow = true;
      part.userData.own = part.material;
    }
  }

  pose(time, nodes) {
    if (this.embedded) this.embedded.mix(nodes, this.positions.array, 3, false);
    else this.track.place(this.positions.array, time);
    this.positions.needsUpdate = true;
    this.turn_normals();
  }

  turn_normals() {
    const p = this.positions.array;
    const n = this.normals.array.fill(0);
    for (const part of this.parts) {
      const triangles = part.geometry.index.array;
      for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
        const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
        const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
        const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
        for (const corner of [triangles[t], triangles[t + 1], triangles[t + 2]]) {
          const k = 3 * this.alike[corner];
          n[k] += x; n[k + 1] += y; n[k + 2] += z;
        }
      }
    }
    this.alike.forEach((first, row) => {
      if (first !== row) n.copyWithin(3 * row, 3 * first, 3 * first + 3);
    });
    this.normals.needsUpdate = true;
  }

  /// `field`: a row of the film's fields; -1: its own colours.
  dress(field, wireframe) {
    const is_mapped = field >= 0 && this.embedded !== null;
    if (is_mapped && !this.colors) {
      this.colors = new THREE.BufferAttribute(new Float32Array(this.positions.array.length), 3);
      this.values = new Float32Array(this.positions.count);
      this.chart = new THREE.MeshLambertMaterial({ vertexColors: THREE.VertexColors, side: THREE.DoubleSide });
    }
    for (const part of this.parts) {
      part.material = is_mapped ? this.chart : part.userData.own;
      part.material.wireframe = wireframe;
      if (!("own_colors" in part.userData)) part.userData.own_colors = part.geometry.attributes.color;
      const colors = is_mapped ? this.colors : part.userData.own_colors;
      if (colors) part.geometry.setAttribute("color", colors); else part.geometry.deleteAttribute("color");
    }
  }

  /// `of_nodes`: rows of the palette.
  paint(of_nodes, palette) {
    if (!this.embedded) return;
    this.embedded.mix(of_nodes, this.values, 1, true);
    this.values.forEach((value, row) => {
      const color = 3 * Math.round(value);
      this.colors.array.set(palette.subarray(color, color + 3), 3 * row);
    });
    this.colors.needsUpdate = true;
  }
}

/// Lines between nodes: the edges of the bricks, or the springs, coloured by their stretch.
class NodeLines {
  constructor(pairs, springs) {
    this.pairs = new Uint32Array(bytes_of(pairs));
    this.positions = new THREE.BufferAttribute(new Float32Array(3 * this.pairs.length), 3);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", this.positions);
    let material = new THREE.LineBasicMaterial({ color: 0x20262e });
    if (springs) {
      this.rest = new Float32Array(bytes_of(springs.rest));
      this.reach = springs.high / 100;
      this.palette = linear_colors(springs);
      this.colors = new THREE.BufferAttribute(new Float32Array(3 * this.pairs.length), 3);
      geometry.setAttribute("color", this.colors);
      material = new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors });
    }
    this.object = new THREE.LineSegments(geometry, material);
    this.object.frustumCulled = false;
  }

  pose(nodes) {
    const p = this.positions.array;
    this.pairs.forEach((node, end) => {
      for (let k = 0; k < 3; ++k) p[3 * end + k] = nodes[3 * node + k];
    });
    this.positions.needsUpdate = true;
    if (!this.rest) return;
    this.rest.forEach((rest, row) => {
      const at = 6 * row;
      const length = Math.hypot(p[at + 3] - p[at], p[at + 4] - p[at + 1], p[at + 5] - p[at + 2]);
      const share = 0.5 + 0.5 * (length / rest - 1) / this.reach;
      const color = 3 * Math.round(255 * Math.min(1, Math.max(0, share)));
      for (const end of [at, at + 3]) this.colors.array.set(this.palette.subarray(color, color + 3), end);
    });
    this.colors.needsUpdate = true;
  }
}

class Take {
  constructor(film) {
    this.film = film;
    this.last = film.frames - 1;
    this.palettes = film.fields.map(linear_colors);
    this.fields = film.fields.map((field) => new Uint8Array(bytes_of(field.steps)));
    this.track = new Track(film, film.nodes);
    this.nodes = new Float32Array(this.track.steps.length / film.frames);
    this.values = new Float32Array(this.nodes.length / 3);
    this.group = new THREE.Group();
    this.group.visible = false;
  }

  async load() {
    const model = await new Promise((resolve, reject) => {
      new THREE.GLTFLoader().parse(bytes_of(this.film.model), "", resolve, reject);
    });
    const bricks = new Uint32Array(bytes_of(this.film.bricks));
    const nodes = await Promise.all(this.film.meshes.map((_, row) => model.parser.getDependency("node", row)));
    this.meshes = nodes.map((node, row) => new MovingMesh(this.film, node, this.film.meshes[row], bricks));
    this.skins = model.scene;
    this.bricks = new NodeLines(this.film.edges, null);
    this.springs = this.film.springs ? new NodeLines(this.film.springs.pairs, this.film.springs) : null;
    this.group.add(this.skins, this.bricks.object);
    if (this.springs) this.group.add(this.springs.object);
  }

  show(view) {
    this.skins.visible = view.skin;
    for (const mesh of this.meshes) mesh.dress(view.field, view.wireframe);
    this.bricks.object.visible = view.bricks;
    if (this.springs) this.springs.object.visible = view.springs;
  }

  pose(time, view) {
    this.track.place(this.nodes, time);
    if (view.skin) {
      for (const mesh of this.meshes) mesh.pose(time, this.nodes);
      if (view.field >= 0) this.paint(view.field, time);
    }
    if (view.bricks) this.bricks.pose(this.nodes);
    if (view.springs && this.springs) this.springs.pose(this.nodes);
  }

  paint(field, time) {
    const steps = this.fields[field];
    const count = this.values.length;
    const [here, there, share] = between(time, steps.length / count);
    for (let node = 0; node < count; ++node) {
      const from = steps[here * count + node];
      this.values[node] = from + share * (steps[there * count + node] - from);
    }
    for (const mesh of this.meshes) mesh.paint(this.values, this.palettes[field]);
  }

  /// What is under the time line: "0.42 s   frame 11".
  words(time) {
    const frame = Math.round(time);
    const at = this.film.at[frame];
    const moments = { time_s: () => `${at.toFixed(2)} s`, load: () => `load ${(100 * at).toFixed(0)} %`, mode: () => `mode ${at}` };
    const moment = (moments[this.film.progress] ?? moments.time_s)();
    return `${moment}   frame ${this.film.first_frame + frame * this.film.frame_step}`;
  }
}
