// Argument: the folder of tests/exports/browser. Ends with an error where a page shows another shape than the pictures.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { Browser, difference, pixels, serve, silhouette, silhouette_of_file } from "./browser.mjs";

const folder = process.argv[2];
const [width, height] = [640, 480];
const kRows = height - 50;  // above the bar of the page
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

const browser = new Browser(width, height);
const server = await serve(folder);
try {
  let film;
  for (const frame of kFrames) {
    await browser.open(`file://${folder}/film.html#${frame - 1}`);
    await browser.until("posed_at >= 0 && meshes.length === 2");
    await browser.value("new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)))");
    const png = await browser.picture();
    writeFileSync(`${folder}/page_${frame}.png`, png);
    expect_same("film.html", frame, pixels(png));
    expect_halves(pixels(png));
    film = await browser.value("({ eye: film.eye, target: film.target, field_of_view: film.field_of_view, " +
      "aspect: film.aspect, fps: film.fps })");
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
