// SPDX-License-Identifier: BSD-3-Clause
// From the world to the screen and back, and the layers drawn. Few lines are stroked; many are counted into pixels,
// which takes milliseconds where strokes take seconds.
"use strict";
const still = document.getElementById("still"), marks = document.getElementById("marks"), stage = document.getElementById("stage");
const view = {x: 0, y: 0, scale: 1, isFitted: true};  // the world's point in the middle, CSS pixels a world unit; the whole, in windows of any size
const [boxX0, boxY0, boxX1, boxY1] = picture.box;
const ratio = () => Math.min(window.devicePixelRatio || 1, 3);
/// Of inks that a dark paper swallows, what stands for them there.
const darkInks = {"#1e293b": "#cbd5e1", "#d9dde3": "#475569", "#66717f": "#94a3b8", "#c8102e": "#fb7185", "#0072b2": "#7dd3fc", "#6a0dad": "#d8b4fe", "#fae0c1": "#4a3527", "#bec5cf": "#475569", "#6e798a": "#94a3b8"};
const isDark = () => document.documentElement.classList.contains("dark");
const shade = color => isDark() && darkInks[color] || color;
const inkOf = layer => shade(layer.color);
const paper = () => isDark() ? "#0f172a" : "#ffffff";
const ink = () => isDark() ? "#e2e8f0" : "#1e293b";

const screenX = x => (x - view.x) * view.scale + stage.clientWidth / 2;
const screenY = y => stage.clientHeight / 2 - (y - view.y) * view.scale;
const worldX = px => (px - stage.clientWidth / 2) / view.scale + view.x;
const worldY = py => (stage.clientHeight / 2 - py) / view.scale + view.y;

const axisWidth = 50, axisHeight = 20;
function fit() {
  view.scale = fitted();
  view.x = (boxX0 + boxX1) / 2 - axisWidth / 2 / view.scale;
  view.y = (boxY0 + boxY1) / 2 - axisHeight / 2 / view.scale;
  view.isFitted = true;
}
const fitted = () => Math.max(1e-12, Math.min((stage.clientWidth - axisWidth - 12) / (boxX1 - boxX0 || 1), (stage.clientHeight - axisHeight - 12) / (boxY1 - boxY0 || 1)));

/// Keeps the place under (px, py) where it is. Neither lost in the distance nor deeper than the numbers reach.
function zoomAt(px, py, factor) {
  const x = worldX(px), y = worldY(py);
  view.scale = Math.min(Math.max(view.scale * factor, fitted() / 4), fitted() * 4096);
  view.x = x - (px - stage.clientWidth / 2) / view.scale;
  view.y = y - (stage.clientHeight / 2 - py) / view.scale;
  moved();
}
function pan(dx, dy) {
  view.x -= dx / view.scale;
  view.y += dy / view.scale;
  moved();
}
/// Some of the world stays in view.
function moved() {
  view.x = Math.min(Math.max(view.x, boxX0), boxX1);
  view.y = Math.min(Math.max(view.y, boxY0), boxY1);
  view.isFitted = false;
  redraw();
}

/// Widths are pixels where a unit of the world has twenty; where it has fewer, lines get finer.
const shrink = () => Math.min(1, picture.unit * view.scale / 20);
const lineWidth = layer => Math.max(layer.width * shrink(), 0.9);
const isMany = 20000;

/// The layer's items that may be in view; null: all are.
function inView(layer) {
  const x0 = worldX(0), x1 = worldX(stage.clientWidth), y0 = worldY(stage.clientHeight), y1 = worldY(0);
  if (x0 <= boxX0 && x1 >= boxX1 && y0 <= boxY0 && y1 >= boxY1) return null;
  const tiles = tilesOf(layer), ranges = [];
  let count = 0;
  tiles.within(x0, y0, x1, y1, (from, to) => { ranges.push([from, to]); count += to - from; });
  const items = new Uint32Array(count);
  let k = 0;
  for (const [from, to] of ranges) { items.set(tiles.items.subarray(from, to), k); k += to - from; }
  return items;
}
const sizeOf = layer => layer.segments ? layer.segments.length / 4 : layer.xy.length / 2;

/// A path for each colour, or for each chain that has an opacity of its own; add(path, item).
function byColor(layer, items, add) {
  const paths = new Map();
  for (let k = 0; k < (items ? items.length : sizeOf(layer)); ++k) {
    const i = items ? items[k] : k, group = layer.chainOf ? layer.chainOf[i] : layer.groups ? layer.groups(i) : -1;
    if (!paths.has(group)) paths.set(group, new Path2D());
    add(paths.get(group), i);
  }
  return [...paths].map(([group, path]) => [group < 0 || layer.chainOf ? inkOf(layer) : layer.colors[group], path, group]);
}
function strokeFew(context, layer, items) {
  const s = layer.segments;
  context.lineWidth = lineWidth(layer);
  context.lineCap = "round";
  for (const [color, path, group] of byColor(layer, items, (path, i) => {
    path.moveTo(screenX(s[4 * i]), screenY(s[4 * i + 1]));
    path.lineTo(screenX(s[4 * i + 2]) + 0.01, screenY(s[4 * i + 3]));  // a dot has no length, and would not be drawn
  })) {
    if (layer.chainOf) context.globalAlpha = (layer.opacity ?? 1) * layer.opacities[group];
    context.strokeStyle = color;
    context.stroke(path);
  }
}
function dotFew(context, layer, items) {
  const r = Math.max(0.5 * layer.width * shrink(), 0.8);
  for (const [color, path] of byColor(layer, items, (path, i) => {
    const x = screenX(layer.xy[2 * i]), y = screenY(layer.xy[2 * i + 1]);
    path.moveTo(x + r, y);
    path.arc(x, y, r, 0, 2 * Math.PI);
  })) {
    context.fillStyle = color;
    context.fill(path);
  }
}

/// How much ink each pixel gets: the length of the lines in it times their width, at most all of it.
function countMany(context, layer, items) {
  const k = ratio(), w = still.width, h = still.height, amount = new Float32Array(w * h), s = layer.segments;
  const scale = k * view.scale, x0 = k * screenX(0), y0 = k * screenY(0), xy = s ?? layer.xy;
  const wide = k * Math.max(layer.width * shrink(), 0.3), count = items ? items.length : sizeOf(layer);
  for (let n = 0; n < count; ++n) {
    const i = (s ? 4 : 2) * (items ? items[n] : n);
    let x = x0 + scale * xy[i], y = y0 - scale * xy[i + 1], steps = 1, dx = 0, dy = 0, ink = wide * wide;
    if (s) {
      dx = scale * (s[i + 2] - s[i]);
      dy = scale * (s[i + 1] - s[i + 3]);
      const far = Math.max(Math.abs(dx), Math.abs(dy));
      if (far > 1e5) continue;
      steps = Math.max(1, Math.ceil(far));
      ink = wide * Math.sqrt(dx * dx + dy * dy) / steps;
      dx /= steps;
      dy /= steps;
      x += dx / 2;
      y += dy / 2;
    }
    for (; steps > 0; --steps, x += dx, y += dy) if (x >= 0 && y >= 0 && x < w && y < h) amount[(y | 0) * w + (x | 0)] += ink;
  }
  putInk(context, amount, w, h, layer.groups ? layer.colors[0] : inkOf(layer));
}

function putInk(context, amount, w, h, color) {
  const cell = new OffscreenCanvas(w, h), shade = cell.getContext("2d"), image = shade.createImageData(w, h), to = image.data;
  const [r, g, b] = [1, 3, 5].map(i => parseInt(color.slice(i, i + 2), 16));
  for (let i = 0, j = 0; i < amount.length; ++i, j += 4) {
    if (amount[i] === 0) continue;
    to[j] = r; to[j + 1] = g; to[j + 2] = b;
    to[j + 3] = 255 * Math.min(amount[i], 1);
  }
  shade.putImageData(image, 0, 0);
  context.save();
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.drawImage(cell, 0, 0);
  context.restore();
}

/// One path, or one a chain where each has an opacity of its own.
function pathsOf(layer) {
  const paths = [];
  for (let c = 0; c + 1 < layer.first.length; ++c) {
    if (c === 0 || layer.opacities) paths.push(new Path2D());
    const path = paths[paths.length - 1];
    for (let i = layer.first[c]; i < layer.first[c + 1]; ++i) path[i === layer.first[c] ? "moveTo" : "lineTo"](layer.xy[2 * i], layer.xy[2 * i + 1]);
    path.closePath();
  }
  return paths;
}
function fillAreas(context, layer) {
  layer.paths ??= pathsOf(layer);
  context.save();
  context.translate(stage.clientWidth / 2 - view.x * view.scale, stage.clientHeight / 2 + view.y * view.scale);
  context.scale(view.scale, -view.scale);
  context.fillStyle = inkOf(layer);
  context.lineWidth = Math.max(layer.width, 1) / view.scale;
  context.strokeStyle = shade(layer.outline ?? layer.color);
  layer.paths.forEach((path, i) => {
    context.globalAlpha = (layer.opacity ?? 1) * (layer.opacities?.[i] ?? 1);
    context.fill(path, "nonzero");
    if (layer.outline) context.stroke(path);
  });
  context.restore();
}

function drawImage(context, layer) {
  if (!layer.image) {
    layer.image = new Image();
    layer.image.onload = redraw;
    layer.image.src = layer.href;
  }
  if (!layer.image.complete) return;
  const [x0, y0, x1, y1] = layer.box;
  context.imageSmoothingEnabled = view.scale < 2 * fitted();
  const place = [screenX(x0), screenY(y1), (x1 - x0) * view.scale, (y1 - y0) * view.scale];
  if (isDark() && layer.isOpaque) {  // white, which becomes black, shall be the page's paper
    context.fillStyle = paper();
    context.fillRect(...place);
    context.globalCompositeOperation = "screen";
  }
  context.filter = isDark() ? "invert(1) hue-rotate(180deg)" : "none";
  context.drawImage(layer.image, ...place);
  context.filter = "none";
  context.globalCompositeOperation = "source-over";
}

function drawLayer(context, layer) {
  context.globalAlpha = layer.opacity ?? 1;
  if (layer.kind === "image") drawImage(context, layer);
  else if (layer.kind === "areas") fillAreas(context, layer);
  else {
    const items = inView(layer), draw = (items ? items.length : sizeOf(layer)) > isMany ? countMany : layer.segments ? strokeFew : dotFew;
    draw(context, layer, items);
  }
  context.globalAlpha = 1;
}

function cleared(canvas) {
  const k = ratio(), w = Math.max(1, Math.round(k * stage.clientWidth)), h = Math.max(1, Math.round(k * stage.clientHeight));
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  const context = canvas.getContext("2d");
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, w, h);
  context.setTransform(k, 0, 0, k, 0, 0);
  return context;
}

/// What was drawn last, and where: while the view moves fast over a large world, it moves along.
const drawn = {canvas: new OffscreenCanvas(1, 1), view: null, took: 0, timer: 0};
function drawStill() {
  const begin = performance.now(), context = cleared(still);
  context.fillStyle = paper();
  context.fillRect(0, 0, stage.clientWidth, stage.clientHeight);
  for (const layer of layers) if (layer.shown) drawLayer(context, layer);
  drawn.took = performance.now() - begin;
  drawn.view = {...view};
  if (drawn.took < 20) return;
  drawn.canvas.width = still.width;
  drawn.canvas.height = still.height;
  drawn.canvas.getContext("2d").drawImage(still, 0, 0);
}
function shiftStill() {
  const context = cleared(still), old = drawn.view, zoom = view.scale / old.scale;
  context.fillStyle = paper();
  context.fillRect(0, 0, stage.clientWidth, stage.clientHeight);
  const w = drawn.canvas.width / ratio(), h = drawn.canvas.height / ratio();
  context.drawImage(drawn.canvas, screenX(old.x) - zoom * w / 2, screenY(old.y) - zoom * h / 2, zoom * w, zoom * h);
}

let asked = false, changed = true;
/// Once a frame. `what`: "marks" where the layers stay as they are.
function redraw(what) {
  if (what !== "marks") changed = true;
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    if (changed && drawn.view && drawn.took > 20 && view.held) {
      shiftStill();
      clearTimeout(drawn.timer);
      drawn.timer = setTimeout(() => { view.held = false; redraw(); }, 120);
    } else if (changed) {
      drawStill();
      changed = false;
    }
    drawMarks();
    document.documentElement.dataset.drawn = Math.round(drawn.took);
  });
}
