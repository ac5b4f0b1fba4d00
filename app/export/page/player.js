"use strict";
// The page as a person uses it: buttons, keys, the time line, legends.

const kSpeeds = [0.1, 0.25, 0.5, 1, 2];
const find = (name) => document.querySelector(name);
const bar = find("#player input");
const stage = new Stage(find("canvas.scene"));
const takes = films.map((film) => new Take(film));
const view = { take: 0, field: films[0].shown_field, skin: true, wireframe: false, bricks: false, springs: false,
  ground: true, axes: false };
let speed = 1;
let time = 0;  // frames from the first
let plays = false;
let drawn_at = 0;
let posed_at = -1;

const take = () => takes[view.take];

function show() {
  takes.forEach((other, row) => { other.group.visible = row === view.take; });
  take().show(view);
  stage.axes.visible = view.axes;
  if (stage.ground) stage.ground.visible = view.ground;
  for (const [name, button] of Object.entries(switches)) button.setAttribute("aria-pressed", String(view[name]));
  find("#colours").value = String(view.field);
  draw_legends();
  posed_at = -1;
}

function draw_legends() {
  const shown = [];
  if (view.skin && view.field >= 0) shown.push(take().film.fields[view.field]);
  if (view.springs && take().film.springs) shown.push(take().film.springs);
  find("#legends").replaceChildren(...shown.map((legend) => {
    const figure = document.createElement("figure");
    const strip = document.createElement("canvas");
    [strip.width, strip.height] = [256, 1];
    const pen = strip.getContext("2d");
    const pixels = pen.createImageData(256, 1);
    new Uint8Array(bytes_of(legend.colors)).forEach((byte, i) => { pixels.data[4 * Math.floor(i / 3) + i % 3] = byte; });
    for (let i = 3; i < pixels.data.length; i += 4) pixels.data[i] = 255;
    pen.putImageData(pixels, 0, 0);
    const numbers = document.createElement("div");
    for (const share of [0, 0.5, 1]) {
      const number = document.createElement("span");
      number.textContent = Number((legend.low + share * (legend.high - legend.low)).toPrecision(3));
      numbers.append(number);
    }
    figure.append(legend.title, strip, numbers);
    return figure;
  }));
}

function set_plays(on) {
  plays = on && take().last > 0;
  find("#play").textContent = plays ? "Pause" : "Play";
}

function go_to(frame) {
  set_plays(false);
  time = Math.min(Math.max(frame, 0), take().last);
}

function choose_take(row) {
  const share = take().last > 0 ? time / take().last : 0;
  const old = take().film;
  view.take = (row + takes.length) % takes.length;
  time = share * take().last;
  bar.max = take().last;
  if (view.field >= take().film.fields.length) view.field = -1;
  stage.fit(take().film);
  if (take().film.target.join() !== old.target.join()) stage.look_from_start();
  list_colours();
  if (find("#take")) find("#take").value = String(view.take);
  show();
}

function choose_field(row) {
  const count = take().film.fields.length;
  view.field = row >= count ? -1 : row;
  show();
}

function set_speed(to) {
  speed = kSpeeds[Math.min(Math.max(to, 0), kSpeeds.length - 1)];
  find("#speed").value = String(speed);
}

function flip(name) {
  view[name] = !view[name];
  show();
}

// Key, button, what it does, for whom.
const kSwitches = [
  ["skin", "k", true], ["wireframe", "w", true], ["bricks", "b", true],
  ["springs", "s", films.some((film) => film.springs !== undefined)],
  ["ground", "g", films.some((film) => film.ground !== null)], ["axes", "a", true],
].filter(([, , is_there]) => is_there);
const switches = {};
const kKeys = [
  ["space", "play or pause", () => set_plays(!plays), " "],
  ["left, right", "a frame back or on", () => go_to(Math.round(time) - 1), "ArrowLeft"],
  [null, null, () => go_to(Math.round(time) + 1), "ArrowRight"],
  ["Home, End", "first or last frame", () => go_to(0), "Home"],
  [null, null, () => go_to(take().last), "End"],
  ["+, -", "faster or slower", () => set_speed(kSpeeds.indexOf(speed) + 1), "+"],
  [null, null, () => set_speed(kSpeeds.indexOf(speed) - 1), "-"],
  ...(films.some((film) => film.fields.length > 0)
    ? [["c", "next colours", () => choose_field(view.field + 1), "c"]] : []),
  ...(films.length > 1 ? [["t", "next take", () => choose_take(view.take + 1), "t"]] : []),
  ...kSwitches.map(([name, key]) => [key, `show or hide the ${name}`, () => flip(name), key]),
  ["r", "look from where the film starts", () => stage.look_from_start(), "r"],
  ["?", "these keys", () => { find("#help").hidden = !find("#help").hidden; }, "?"],
];

function add_button(text, key, action) {
  const button = document.createElement("button");
  button.textContent = text;
  button.title = `key ${key}`;
  button.addEventListener("click", action);
  find("#view").append(button);
  return button;
}

function add_choice(name, title, choices, action) {
  const list = document.createElement("select");
  [list.id, list.title] = [name, title];
  list.setAttribute("aria-label", title);
  list.append(...choices.map(([text, value]) => new Option(text, value)));
  list.addEventListener("change", () => { action(Number(list.value)); list.blur(); });
  find("#view").append(list);
}

function list_colours() {
  const own = take().film.fields.length > 0 ? "own colours" : "own colours only";
  find("#colours").replaceChildren(new Option(own, "-1"),
    ...take().film.fields.map((field, row) => new Option(field.title.split(",")[0], String(row))));
}

function make_controls() {
  if (films.length > 1) add_choice("take", "take", films.map((film, row) => [film.name, row]), choose_take);
  add_choice("colours", "colours", [], choose_field);
  list_colours();
  find("#colours").hidden = films.every((film) => film.fields.length === 0);
  for (const [name, key] of kSwitches) switches[name] = add_button(name, key, () => flip(name));
  add_button("?", "?", kKeys[kKeys.length - 1][2]);
  const table = document.createElement("table");
  for (const [key, what] of kKeys) {
    if (key === null) continue;
    const row = table.insertRow();
    row.insertCell().innerHTML = key.split(", ").map((name) => `<kbd>${name}</kbd>`).join(" ");
    row.insertCell().textContent = what;
  }
  const mouse = table.insertRow();
  mouse.insertCell().textContent = "mouse";
  mouse.insertCell().textContent = "drag to turn, wheel to zoom, right button to move";
  find("#help").append(table);
  find("#speed").append(...kSpeeds.map((value) => new Option(`${value} x`, String(value))));
  set_speed(kSpeeds.indexOf(1));
  find("#speed").addEventListener("change", (event) => { set_speed(kSpeeds.indexOf(Number(event.target.value))); event.target.blur(); });
  find("#play").addEventListener("click", (event) => { set_plays(!plays); event.target.blur(); });
  bar.addEventListener("input", () => go_to(Number(bar.value)));
  addEventListener("keydown", (event) => {
    const known = kKeys.find(([, , , key]) => key === event.key || key === event.key.toLowerCase());
    if (!known || event.ctrlKey || event.metaKey || event.altKey) return;
    known[2]();
    event.preventDefault();
  });
}

function draw(now) {
  if (plays) time = (time + (now - drawn_at) / 1000 * take().film.fps * speed) % take().last;
  drawn_at = now;
  bar.value = time;
  find("#player output").textContent = take().words(time);
  if (time !== posed_at) take().pose(time, view);
  posed_at = time;
  stage.draw();
  requestAnimationFrame(draw);
}

async function begin() {
  for (const each of takes) {
    await each.load();
    stage.scene.add(each.group);
  }
  make_controls();
  bar.max = take().last;
  find("#player").hidden = takes.every((each) => each.last === 0);
  stage.fit(take().film);
  stage.look_from_start();
  show();
  const start = location.hash.slice(1);  // page.html#12: frame 12, from 0 on, and stays there
  time = Math.min(Number(start) || 0, take().last);
  set_plays(start === "");
  requestAnimationFrame((now) => { drawn_at = now; draw(now); });
}

begin().catch((error) => {
  find("#stop").hidden = false;
  find("#stop").textContent = String(error);
});
