// Uses a page of two takes as a person would, by mouse and keys, in headless Chromium. Arguments: the page, and a folder
// for screenshots. Ends with an error where something does not happen.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { Browser, pixels } from "./browser.mjs";

const [, , page, folder] = process.argv;
const [width, height] = [1000, 640];
const browser = new Browser(width, height);
let shots = 0;

const settled = () => browser.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
const text_of = (selector) => browser.value(`document.querySelector(${JSON.stringify(selector)}).textContent`);
const frame = async () => Number((await text_of("#player output")).match(/frame (\d+)/)[1]);

async function shot(name) {
  await settled();
  const png = await browser.picture();
  writeFileSync(`${folder}/${String(++shots).padStart(2, "0")}_${name}.png`, png);
  return pixels(png);
}

/// The share of the pixels between the buttons and the time line that changed.
function changed(before, after) {
  let count = 0;
  for (let i = 4 * width * 46; i < 4 * width * (height - 46); i += 4) {
    count += Math.max(...[0, 1, 2].map((k) => Math.abs(before[i + k] - after[i + k]))) > 8;
  }
  return 4 * count / before.length;
}

async function mouse(type, x, y, more = {}) {
  await browser.send("Input.dispatchMouseEvent", { type, x, y, button: "left", clickCount: 1, ...more });
}

async function click_at(x, y) {
  await mouse("mousePressed", x, y);
  await mouse("mouseReleased", x, y);
  await settled();
}

/// The middle of an element; `share`: from its left to its right.
async function click(selector, share = 0.5) {
  const box = await browser.value(`(() => { const box = document.querySelector(${JSON.stringify(selector)})` +
    ".getBoundingClientRect(); return { x: box.x, y: box.y, width: box.width, height: box.height }; })()");
  assert(box.width > 0, `${selector} is to be seen`);
  await click_at(box.x + share * box.width, box.y + box.height / 2);
}

async function press(key, code = key) {
  const text = key.length === 1 ? key : undefined;
  await browser.send("Input.dispatchKeyEvent", { type: "keyDown", key, code, text });
  await browser.send("Input.dispatchKeyEvent", { type: "keyUp", key, code });
  await settled();
}

/// A click on a list does not open it without a display; keys choose in it as they would there.
async function choose(selector, value) {
  await browser.value(`(() => { const list = document.querySelector(${JSON.stringify(selector)});` +
    `list.value = ${JSON.stringify(value)}; list.dispatchEvent(new Event("change")); })()`);
  await settled();
}

const switch_named = (name) => browser.value(
  `[...document.querySelectorAll("#view button")].findIndex((button) => button.textContent === ${JSON.stringify(name)}) + 1`);
async function click_switch(name) {
  const row = await switch_named(name);
  assert(row > 0, `there is a button ${name}`);
  const lists = await browser.value('document.querySelectorAll("#view select").length');
  await click(`#view > :nth-child(${row + lists})`);
}

try {
  await browser.open(`file://${page}`);
  await browser.until("posed_at > 0.5");
  assert.equal(await text_of("#play"), "Pause", "plays by itself");
  await click("#play");
  const stopped = await frame();
  await new Promise((done) => setTimeout(done, 400));
  assert.equal(await frame(), stopped, "stays where it was stopped");
  await click("#player input", 0.5);
  const middle = await frame();
  assert(middle > 4 && middle < 20, `a click in the middle of the time line: frame ${middle}`);
  await press("ArrowRight");
  assert.equal(await frame(), middle + 1);
  await press("ArrowLeft");
  await press("ArrowLeft");
  assert.equal(await frame(), middle - 1);
  await press("Home");
  assert.equal(await frame(), 1);
  await press("End");
  const plain = await shot("plain");

  for (const name of ["wireframe", "bricks", "springs", "axes", "ground"]) {
    await click_switch(name);
    const seen = await shot(name);
    console.log(`${name}: changes ${(100 * changed(plain, seen)).toFixed(1)} % of the picture`);
    assert(changed(plain, seen) > 0.002, `${name} is to be seen`);
    await click_switch(name);
    assert.equal(changed(plain, await shot(`${name}_off`)), 0, `${name} goes again`);
  }
  await click_switch("skin");
  assert(changed(plain, await shot("no_skin")) > 0.03, "the skin goes");
  await press("k");

  const fields = await browser.value('[...document.querySelectorAll("#colours option")].map((option) => option.text)');
  assert.deepEqual(fields, ["own colours", "Displacement", "Speed", "Strain", "Stress"]);
  for (let row = 0; row < 4; ++row) {
    await choose("#colours", String(row));
    assert((await text_of("#legends")).startsWith(fields[row + 1]), `the legend says ${fields[row + 1]}`);
    const seen = await shot(fields[row + 1].toLowerCase());
    assert(changed(plain, seen) > 0.03, `${fields[row + 1]} is to be seen`);
  }
  const ranges = new Set();
  for (const take of ["0", "1"]) {
    await choose("#take", take);
    ranges.add(await text_of("#legends"));
    await shot(`take_${take}`);
  }
  assert.equal(ranges.size, 1, "takes share the range of their colours");
  await press("t");
  assert.equal(await browser.value('document.querySelector("#take").value'), "0", "the next take is the first again");
  await press("c");
  assert.equal(await browser.value('document.querySelector("#colours").value'), "-1");

  await press("?");
  const help = await text_of("#help");
  for (const words of ["play or pause", "a frame back or on", "next colours", "next take", "show or hide the springs"]) {
    assert(help.includes(words), `the help has: ${words}`);
  }
  await shot("help");
  await press("?");
  assert(await browser.value('document.querySelector("#help").hidden'));

  const before = await shot("before_turning");
  await mouse("mousePressed", 500, 250);
  for (let x = 500; x <= 650; x += 30) await mouse("mouseMoved", x, 260, { buttons: 1 });
  await mouse("mouseReleased", 650, 260);
  assert(changed(before, await shot("turned")) > 0.02, "the mouse turns it");
  await press("r");
  assert(changed(before, await shot("back")) < 0.005, "and r looks from the start again");

  await press("+");
  assert.equal(await browser.value('document.querySelector("#speed").value'), "2");
  await press(" ", "Space");
  assert.equal(await text_of("#play"), "Pause");
  await browser.until("time > 1");
  assert.deepEqual(browser.events, []);
  console.log(`${shots} screenshots; everything happened`);
} finally {
  browser.close();
}
