// SPDX-License-Identifier: BSD-3-Clause
// Buttons, sliders, layers, keys; light and dark, and paper.
"use strict";
const $ = id => document.getElementById(id);
const calm = matchMedia("(prefers-reduced-motion: reduce)"), night = matchMedia("(prefers-color-scheme: dark)");

/// An element with its attributes: never markup, whatever names are.
function made(tag, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}
function swatch(layer) {
  const color = layer.groups ? layer.colors[0] : layer.color ? inkOf(layer) : "#888888";
  const area = ["rect", {x: 3, y: 2, width: 22, height: 10, fill: color}], corners = star(7).map(([x, y]) => `${14 + x} ${7 + y}`);
  const shape = {dots: ["circle", {cx: 14, cy: 7, r: 3.5, fill: color}], areas: area, image: area, start: ["circle", {cx: 14, cy: 7, r: 5.5, fill: color}],
    goal: ["path", {d: `M${corners.join("L")}z`, fill: color}]}[layer.kind] ?? ["path", {d: "M2 7h24", stroke: color, "stroke-width": 3}];
  const sample = made("svg", {viewBox: "0 0 28 14", "aria-hidden": true});
  sample.append(made(...shape));
  return sample;
}
function rowOf(layer, label) {
  const row = document.createElement("label"), box = document.createElement("input"), name = document.createElement("span");
  row.className = "layer";
  box.type = "checkbox";
  name.textContent = label;
  row.append(box, swatch(layer), name);
  return {row, box};
}
function listLayers() {
  const rows = [...layers, ...path.length ? [pathLayer] : []].map(layer => {
    const {row, box} = rowOf(layer, layer.label), count = document.createElement("span");
    box.name = layer.id;
    box.checked = layer.shown;
    box.addEventListener("change", () => { layer.shown = box.checked; redraw(); });
    count.className = "count";
    count.textContent = layer.count ? layer.count.toLocaleString("en") : "";
    row.append(count);
    return row;
  });
  const ends = Object.entries(picture.ends).map(([name, at]) => {
    const {row, box} = rowOf({kind: name, color: at.color}, name);
    box.disabled = true;
    box.style.visibility = "hidden";
    return row;
  });
  $("layers").replaceChildren(...rows, ...ends);
}

function setTheme(dark) {
  document.documentElement.classList.toggle("dark", dark);
  $("dark").setAttribute("aria-pressed", dark);
  listLayers();
  redraw();
}
function setMeasuring(on) {
  isMeasuring = on;
  measured.length = 0;
  $("measure").setAttribute("aria-pressed", on);
  marks.classList.toggle("measures", on);
  readout.textContent = on ? "click along what is to be measured; Esc ends it" : "";
  redraw("marks");
}

function showMotion() {
  if (arm) {
    $("motion").value = motion.share * 1000;
    $("moment").textContent = `${(motion.share * 100).toFixed(0)} % of the way in joint space`;
    return redraw("marks");
  }
  if (!poses.length) return;
  const [x, y, theta] = poseAt(motion.share), length = motion.share * 100;
  const heading = picture.body.outline.length || picture.body.heads ? `, heading ${((theta * 180 / Math.PI + 540) % 360 - 180).toFixed(1)}°` : "";
  $("motion").value = motion.share * 1000;
  $("moment").textContent = `${length.toFixed(0)} % at x ${shownNumber(x + picture.origin[0], precision())}, y ${shownNumber(y + picture.origin[1], precision())}${heading}`;
  redraw("marks");
}
const canMove = arm ? arm.moments.length > 1 : poses.length > 0;
let playing = 0;
function play() {
  if (playing || !canMove) { cancelAnimationFrame(playing); playing = 0; $("play").setAttribute("aria-pressed", false); return; }
  if (motion.share >= 1) motion.share = 0;
  motion.isOn = true;
  $("play").setAttribute("aria-pressed", true);
  let before = performance.now();
  const lasts = calm.matches ? 20000 : 8000;
  const step = now => {
    motion.share = Math.min(1, motion.share + (now - before) / lasts);
    before = now;
    showMotion();
    if (motion.share < 1) playing = requestAnimationFrame(step);
    else { playing = 0; $("play").setAttribute("aria-pressed", false); }
  };
  playing = requestAnimationFrame(step);
}
function showWave() {
  const by = picture.graph.byCost, limit = wave.share * by[by.length - 1];
  let reached = 0;
  while (reached < by.length && by[reached] <= limit) ++reached;
  $("reached").textContent = wave.share >= 1 ? `all ${by.length.toLocaleString("en")} that were reached` : `ways of up to ${lengthText(limit)}: ${reached.toLocaleString("en")} of ${by.length.toLocaleString("en")}`;
  layerOf("search_tree").shown = wave.share >= 1;
  redraw();
}

const actions = {"+": () => zoomAt(stage.clientWidth / 2, stage.clientHeight / 2, 1.4), "-": () => zoomAt(stage.clientWidth / 2, stage.clientHeight / 2, 1 / 1.4),
  "0": () => { fit(); redraw(); }, "m": () => setMeasuring(!isMeasuring), "d": () => setTheme(!isDark()), " ": play, "Escape": () => setMeasuring(false),
  "ArrowLeft": () => pan(60, 0), "ArrowRight": () => pan(-60, 0), "ArrowUp": () => pan(0, 60), "ArrowDown": () => pan(0, -60)};
actions["="] = actions["+"];
actions["Home"] = actions["0"];
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("input, button") && (event.key === " " || event.key.startsWith("Arrow"))) return;
  const action = actions[event.key];
  if (!action) return;
  event.preventDefault();
  action();
});
for (const [id, key] of [["closer", "+"], ["farther", "-"], ["whole", "0"], ["measure", "m"], ["dark", "d"], ["play", " "]]) $(id).addEventListener("click", actions[key]);
$("motion").addEventListener("input", event => { motion.isOn = true; motion.share = event.target.value / 1000; showMotion(); });
$("wave").addEventListener("input", event => { wave.share = event.target.value / 1000; showWave(); });
night.addEventListener("change", event => setTheme(event.matches));
addEventListener("beforeprint", () => { $("dark").dataset.was = isDark(); setTheme(false); drawStill(); drawMarks(); });
addEventListener("afterprint", () => setTheme($("dark").dataset.was === "true"));

$("title").textContent = picture.title;
$("about").textContent = picture.about;
$("player").hidden = !canMove;
$("turning").hidden = !arm;
$("turn").addEventListener("input", event => { arm.turned = event.target.value * Math.PI / 180; redraw("marks"); });
$("search").hidden = !picture.graph?.byCost?.length;
if (!$("search").hidden) showWave();
setTheme(night.matches);
