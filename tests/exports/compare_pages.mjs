// Argument: the folder of tests/exports/browser. Ends with an error where a page shows another shape than the pictures.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { Browser, difference, pixels, serve, silhouette, silhouette_of_file } from "./browser.mjs";

const folder = process.argv[2];
const [width, height] = [640, 480];
const kRows = height;
const kBackground = [0xd9, 0xdd, 0xe2];
const kFrames = [1, 7, 12];
const kModels = ["film.glb", "quantized.glb"];
const pictures = kFrames.map((frame) => silhouette_of_file(`${folder}/frames/frame_${String(frame).padStart(4, "0")}.png`));
assert(difference(pictures[0], pictures[2], width * kRows) > 0.1, "the film moves");

function expect_same(what, frame, rgba) {
  const off = difference(pictures[kFrames.indexOf(frame)], silhouette(rgba, kBackground), width * kRows);
  console.log(`${what}, frame ${frame}: silhouettes differ in ${(100 * off).toFixed(2)} % of their pixels`);
  assert(off < 0.015);
}

/// So many pixels of a colour as to see the texture.
function expect_halves(rgba) {
  let [red, green] = [0, 0];
  for (let i = 0; i < rgba.length; i += 4) {
    red += rgba[i] > 80 && rgba[i] > 3 * rgba[i + 1] && rgba[i] > 3 * rgba[i + 2];
    green += rgba[i + 1] > 80 && rgba[i + 1] > 3 * rgba[i] && rgba[i + 1] > 3 * rgba[i + 2];
  }
  console.log(`texture: ${red} red pixels, ${green} green ones`);
  assert(red > 2000 && green > 2000);
}

/// How far the vertices of an OBJ lie from the nearest of these places, m; at least as far as 1e-4 m is told as that.
function largest_gap(places, obj) {
  const near = new Map();
  const cell = (numbers, shift) => numbers.map((number, k) => Math.floor(number / 1e-4 + 0.5 * (shift >> k & 1))).join();
  for (const place of places) {
    for (let shift = 0; shift < 8; ++shift) near.set(`${shift}:${cell(place, shift)}`, place);
  }
  let largest = 0;
  for (const line of readFileSync(obj, "utf8").split("\n").filter((line) => line.startsWith("v "))) {
    const vertex = line.split(" ").slice(1, 4).map(Number);
    const gaps = [0, 1, 2, 3, 4, 5, 6, 7].map((shift) => near.get(`${shift}:${cell(vertex, shift)}`)).filter(Boolean)
      .map((place) => Math.max(...vertex.map((coordinate, k) => Math.abs(coordinate - place[k]))));
    largest = Math.max(largest, Math.min(1e-4, ...gaps));
  }
  return largest;
}

const browser = new Browser(width, height);
const server = await serve(folder);
try {
  let film;
  for (const frame of kFrames) {
    await browser.open(`file://${folder}/film.html#${frame - 1}`);
    await browser.until("posed_at >= 0 && take().meshes.length === 2");
    await browser.value('find("#view").hidden = find("#player").hidden = true');
    await browser.value("new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))");
    const png = await browser.picture();
    writeFileSync(`${folder}/page_${frame}.png`, png);
    expect_same("film.html", frame, pixels(png));
    expect_halves(pixels(png));
    film = await browser.value("(({ eye, target, field_of_view, aspect, fps }) => " +
      "({ eye, target, field_of_view, aspect, fps }))(films[0])");
  }
  await browser.open(`file://${folder}/film.html`);
  await browser.until("posed_at > 2");
  console.log("film.html plays by itself");
  for (const name of kModels) {
    await browser.open(`http://127.0.0.1:${server.address().port}/play.html?${name}`);
    await browser.until("window.show !== undefined");
    for (const frame of kFrames) {
      await browser.value(`show(${(frame - 1) / film.fps}, ${JSON.stringify(film)})`);
      const png = await browser.picture();
      writeFileSync(`${folder}/${name}_${frame}.png`, png);
      expect_same(`${name} in three.js of npm`, frame, pixels(png));
      expect_halves(pixels(png));
    }
  }
  await browser.open(`http://127.0.0.1:${server.address().port}/usd.html`);
  await browser.until("window.readers !== undefined");
  for (const reader of ["tinyusdz", "three"]) {
    const meshes = await browser.value(`readers.${reader}("film.usda")`);
    assert.deepEqual(meshes.map((mesh) => mesh.name).sort(), ["ring_1", "torus_2"]);
    const gap = largest_gap(meshes.flatMap((mesh) => mesh.places), `${folder}/skin_0001.obj`);
    console.log(`film.usda in ${reader}: vertices are off by at most ${gap.toExponential(1)} m`);
    assert(gap < 1e-6);
  }
  assert.deepEqual(browser.events, []);
} finally {
  browser.close();
  server.close();
}

const validator = createRequire(`${folder}/`)("gltf-validator");
for (const name of kModels) {
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(`${folder}/${name}`)));
  console.log(`Khronos validator ${validator.version()} of ${name}: ${issues.numErrors} errors, ` +
    `${issues.numWarnings} warnings, ${issues.numInfos} notes, ${issues.numHints} hints`);
  assert.equal(issues.numErrors + issues.numWarnings + issues.numInfos + issues.numHints, 0,
    JSON.stringify(issues.messages));
}
