"use strict";
// What stands around a take: camera, light, ground with shadows, axes with numbers.

/// 1, 2 or 5 times a power of ten, at most so much.
function round_length(most) {
  const ten = 10 ** Math.floor(Math.log10(most));
  return ten * [5, 2, 1].find((digit) => digit * ten <= most * (1 + 1e-9));
}

/// Lengths up to `longest` (m) in a unit with short numbers.
function unit_for(longest) {
  if (longest >= 1) return { name: "m", size: 1 };
  return longest >= 0.02 ? { name: "cm", size: 0.01 } : { name: "mm", size: 0.001 };
}

class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas: canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.setClearColor(0xd9dde2);
    this.renderer.gammaOutput = true;
    this.renderer.gammaFactor = 2.2;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera();
    const lamp = new THREE.DirectionalLight(0xffffff, 0.45);
    lamp.position.set(0.5, 0.7, 0.5);
    this.camera.add(lamp, lamp.target);
    this.sun = new THREE.DirectionalLight(0xffffff, 0.35);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 4;
    this.scene.add(this.camera, this.sun, this.sun.target, new THREE.HemisphereLight(0xffffff, 0x707070, 0.65));
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false;
    this.surroundings = new THREE.Group();
    this.scene.add(this.surroundings);
  }

  /// Its camera, and a ground and axes of its size.
  fit(film) {
    this.film = film;
    const [low, high] = [new THREE.Vector3(...film.low), new THREE.Vector3(...film.high)];
    const middle = low.clone().add(high).multiplyScalar(0.5);
    this.size = low.distanceTo(high);
    const away = new THREE.Vector3(0.35, 1, 0.25).normalize().multiplyScalar(2 * this.size);
    this.sun.position.copy(middle).add(away);
    this.sun.target.position.copy(middle);
    Object.assign(this.sun.shadow.camera, { left: -this.size, right: this.size, top: this.size, bottom: -this.size,
      near: 0.1 * this.size, far: 6 * this.size });
    this.sun.shadow.camera.updateProjectionMatrix();
    this.surroundings.remove(...this.surroundings.children);
    this.ground = film.ground === null ? null : this.make_ground(middle, film.ground);
    this.axes = this.make_axes(low, high);
    this.surroundings.add(this.axes);
    if (this.ground) this.surroundings.add(this.ground);
  }

  look_from_start() {
    this.camera.position.fromArray(this.film.eye);
    this.controls.target.fromArray(this.film.target);
    this.controls.update();
  }

  make_ground(middle, height) {
    const group = new THREE.Group();
    const side = 6 * this.size;
    const shadow = new THREE.Mesh(new THREE.PlaneBufferGeometry(side, side), new THREE.ShadowMaterial({ opacity: 0.26 }));
    shadow.rotation.x = -Math.PI / 2;
    shadow.receiveShadow = true;
    this.cell = round_length(0.25 * this.size);
    const half = Math.ceil(1.5 * this.size / this.cell);
    const grid = new THREE.GridHelper(2 * half * this.cell, 2 * half, 0x7d858f, 0x8f97a1);
    const snap = (value) => Math.round(value / this.cell) * this.cell;
    group.position.set(snap(middle.x), height - 1e-3 * this.size, snap(middle.z));
    group.add(grid, shadow);
    return group;
  }

  /// Along the edges of the box that the film needs, from its low corner.
  make_axes(low, high) {
    const group = new THREE.Group();
    const longest = Math.max(...high.clone().sub(low).toArray());
    const unit = unit_for(longest);
    const tick = round_length(0.3 * longest);
    const inks = [0xb03020, 0x2e7d32, 0x1a5ca8];
    ["x", "y", "z"].forEach((name, k) => {
      const end = low.clone();
      end.setComponent(k, high.getComponent(k));
      const line = new THREE.BufferGeometry().setFromPoints([low, end]);
      group.add(new THREE.Line(line, new THREE.LineBasicMaterial({ color: inks[k] })));
      const [from, to] = [low.getComponent(k), end.getComponent(k)];
      for (let row = Math.ceil((from + 0.02 * longest) / tick); row * tick <= to + 1e-9 * longest; ++row) {
        const place = low.clone();
        place.setComponent(k, row * tick);
        const digits = Math.max(0, -Math.floor(Math.log10(tick / unit.size) + 1e-9));
        group.add(this.label((row * tick / unit.size).toFixed(digits), place, inks[k]));
      }
      end.setComponent(k, to + 0.14 * longest);
      group.add(this.label(`${name}, ${unit.name}`, end, inks[k]));
    });
    return group;
  }

  label(text, place, ink) {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [256, 64];
    const pen = canvas.getContext("2d");
    pen.font = "40px sans-serif";
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.fillStyle = `#${ink.toString(16).padStart(6, "0")}`;
    pen.fillText(text, 128, 32);
    const map = new THREE.CanvasTexture(canvas);
    map.encoding = THREE.sRGBEncoding;
    const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map: map, depthTest: false, sizeAttenuation: false }));
    sprite.scale.set(0.1, 0.025, 1);
    sprite.position.copy(place);
    sprite.renderOrder = 1;  // over everything
    return sprite;
  }

  follow_window() {
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    const camera = this.camera;
    this.renderer.setPixelRatio(devicePixelRatio);
    this.renderer.setSize(width, height, false);
    camera.aspect = width / height;
    const wide = Math.max(1, this.film.aspect / camera.aspect);
    camera.fov = 360 / Math.PI * Math.atan(Math.tan(this.film.field_of_view * Math.PI / 360) * wide);
    const distance = camera.position.distanceTo(this.controls.target);
    camera.near = 0.01 * distance;
    camera.far = 2 * distance + 6 * this.size;
    camera.updateProjectionMatrix();
  }

  draw() {
    this.follow_window();
    this.renderer.render(this.scene, this.camera);
  }
}
