// SPDX-License-Identifier: BSD-3-Clause
// What lies over the layers: the path, the body on it, the search's wave, start and goal, axes, measures, what the
// pointer is at.
"use strict";
const path = picture.path ? numbers(picture.path) : new Float64Array(0);  // x, y; arcs are chords
const poses = picture.poses ? numbers(picture.poses) : posesOf(path);  // x, y, theta, moment in 0 .. 1
/// Of a body that does not turn: time goes with the way.
function posesOf(path) {
  const poses = new Float64Array(2 * path.length);
  let way = 0;
  for (let i = 0; i < path.length; i += 2) {
    if (i) way += Math.hypot(path[i] - path[i - 2], path[i + 1] - path[i - 1]);
    poses.set([path[i], path[i + 1], 0, way], 2 * i);
  }
  for (let i = 3; i < poses.length; i += 4) poses[i] /= way || 1;
  return poses;
}
const motion = {share: 0, isOn: false};
const wave = {share: 1};
const measured = [];
let pointed = null;

const pathLayer = {id: "path", label: picture.pathLabel, color: picture.pathColor, shown: true, count: path.length / 2, kind: "chains", width: picture.pathWidth};
const pathSegments = new Float32Array(Math.max(0, 2 * path.length - 4));
for (let i = 0; i + 3 < path.length; i += 2) pathSegments.set(path.subarray(i, i + 4), 2 * i);
pathLayer.segments = pathSegments;

/// Points less than a pixel from the last are passed over: no eye tells, and the largest mazes have millions.
function tracePath(context) {
  context.beginPath();
  let x = Infinity, y = Infinity;
  for (let i = 0; i < path.length; i += 2) {
    const px = screenX(path[i]), py = screenY(path[i + 1]);
    if (Math.abs(px - x) + Math.abs(py - y) < 1 && i + 2 < path.length) continue;
    x = px;
    y = py;
    context.lineTo(px, py);
  }
}
function drawPath(context) {
  if (!pathLayer.shown || !path.length) return;
  const width = Math.max(pathLayer.width * shrink(), 1.4);
  context.lineJoin = context.lineCap = "round";
  for (const [color, w] of [[paper(), width < 2 ? 0 : width + 2], [inkOf(pathLayer), width]]) {
    if (w === 0) continue;
    context.strokeStyle = color;
    context.lineWidth = w;
    tracePath(context);
    context.stroke();
  }
}

/// The part of the search tree whose way is at most so long.
function drawWave(context) {
  const tree = layerOf("search_tree");
  if (!tree || wave.share >= 1 || !tree.segments.length) return;
  const limit = wave.share * picture.graph.byCost[picture.graph.byCost.length - 1], s = tree.segments, by = picture.graph.byCost;
  context.strokeStyle = tree.color;
  context.lineWidth = Math.max(2, lineWidth(tree));
  context.beginPath();
  for (let i = 0; i < by.length && by[i] <= limit; ++i) {
    context.moveTo(screenX(s[4 * i]), screenY(s[4 * i + 1]));
    context.lineTo(screenX(s[4 * i + 2]), screenY(s[4 * i + 3]));
  }
  context.stroke();
}

const turned = (from, to) => { const d = (to - from) % (2 * Math.PI); return d > Math.PI ? d - 2 * Math.PI : d < -Math.PI ? d + 2 * Math.PI : d; };
/// x, y, theta at a moment.
function poseAt(share) {
  let low = 0, high = poses.length / 4 - 1;
  while (high - low > 1) { const middle = (low + high) >> 1; if (poses[4 * middle + 3] <= share) low = middle; else high = middle; }
  const a = poses.subarray(4 * low, 4 * low + 4), b = poses.subarray(4 * high, 4 * high + 4);
  const t = b[3] > a[3] ? Math.min(1, (share - a[3]) / (b[3] - a[3])) : 0;
  return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * turned(a[2], b[2])];
}
function drawBody(context) {
  if (!poses.length || !motion.isOn) return;
  const [x, y, theta] = poseAt(motion.share), body = picture.body;
  context.save();
  context.translate(screenX(x), screenY(y));
  context.rotate(-theta);
  context.beginPath();
  const r = Math.max(body.radius * view.scale, 5);
  if (body.outline.length) body.outline.forEach(([bx, by]) => context.lineTo(bx * view.scale, -by * view.scale));
  else context.arc(0, 0, r, 0, 2 * Math.PI);
  context.closePath();
  context.fillStyle = inkOf(pathLayer) + "59";
  context.strokeStyle = inkOf(pathLayer);
  context.lineWidth = 2;
  context.fill();
  context.stroke();
  if (body.outline.length || body.heads) {
    const reach = body.outline.length ? Math.max(...body.outline.map(p => p[0])) * view.scale : r;
    context.beginPath();
    context.moveTo(0, 0);
    context.lineTo(reach, 0);
    context.stroke();
  }
  context.restore();
}

const star = r => Array.from({length: 10}, (_, i) => [(i % 2 ? 0.45 : 1) * r * Math.sin(Math.PI * i / 5), -(i % 2 ? 0.45 : 1) * r * Math.cos(Math.PI * i / 5)]);
/// Start is a disc, goal a star of five points.
function drawEnds(context) {
  for (const [name, at] of Object.entries(picture.ends)) {
    const x = screenX(at.x), y = screenY(at.y), r = 7;
    context.beginPath();
    if (name === "start") context.arc(x, y, r, 0, 2 * Math.PI);
    else for (const [dx, dy] of star(r + 2)) context.lineTo(x + dx, y + dy);
    context.closePath();
    context.fillStyle = shade(at.color);
    context.strokeStyle = paper();
    context.lineWidth = 2;
    context.fill();
    context.stroke();
  }
}

/// 1, 2 or 5 times a power of ten: at least `gap` pixels apart.
function roundStep(gap) {
  const least = gap / view.scale, power = 10 ** Math.floor(Math.log10(least));
  return power * (least <= power ? 1 : least <= 2 * power ? 2 : least <= 5 * power ? 5 : 10);
}
const places = step => Math.max(0, Math.min(12, -Math.floor(Math.log10(step) + 1e-9)));
const shownNumber = (value, step) => Number(value.toFixed(places(step))).toLocaleString("en", {maximumFractionDigits: 12, useGrouping: Math.abs(value) >= 10000});
const unitText = picture.lengthUnit ? " " + picture.lengthUnit : "";

/// Views beside each other have axes of their own.
function drawPanels(context) {
  context.font = "12px system-ui, sans-serif";
  context.fillStyle = context.strokeStyle = ink();
  context.lineWidth = 1;
  for (const {box, x, y, hasTicks} of picture.panels) {
    const px = screenX(box[0]), py = screenY(box[3]), w = (box[2] - box[0]) * view.scale, h = (box[3] - box[1]) * view.scale;
    context.strokeRect(px, py, w, h);
    context.textAlign = "center";
    if (!hasTicks) { context.fillText(y, px + w / 2, py + h + 15); continue; }
    context.fillText(x, px + w / 2, py + h + 15);
    context.textAlign = "right";
    context.fillText(y, px - 5, py + h / 2);
  }
  drawScaleBar(context, stage.clientWidth - 16, stage.clientHeight - 14);
}
function drawAxes(context) {
  if (picture.panels.length) return drawPanels(context);
  const step = roundStep(90), w = stage.clientWidth, h = stage.clientHeight, [ox, oy] = picture.origin;
  context.fillStyle = isDark() ? "#0f172ad9" : "#ffffffd9";
  context.fillRect(0, h - axisHeight, w, axisHeight);
  context.fillRect(0, 0, axisWidth, h);
  context.font = "11px system-ui, sans-serif";
  context.fillStyle = context.strokeStyle = ink();
  context.lineWidth = 1;
  context.beginPath();
  context.textAlign = "center";
  for (let x = Math.ceil((worldX(axisWidth) + ox) / step) * step; x <= worldX(w) + ox; x += step) {
    const px = Math.round(screenX(x - ox)) + 0.5;
    context.moveTo(px, h - axisHeight);
    context.lineTo(px, h - axisHeight + 5);
    context.fillText(shownNumber(x, step), px, h - 4);
  }
  context.textAlign = "right";
  for (let y = Math.ceil((worldY(h - axisHeight) + oy) / step) * step; y <= worldY(12) + oy; y += step) {
    const py = Math.round(screenY(y - oy)) + 0.5;
    context.moveTo(axisWidth - 5, py);
    context.lineTo(axisWidth, py);
    context.fillText(shownNumber(y, step), axisWidth - 7, py + 4);
  }
  context.moveTo(axisWidth + 0.5, 0);
  context.lineTo(axisWidth + 0.5, h - axisHeight - 0.5);
  context.lineTo(w, h - axisHeight - 0.5);
  context.stroke();
  drawScaleBar(context, w - 16, h - 34);
}
function drawScaleBar(context, right, y) {
  const length = roundStep(60), wide = length * view.scale, text = shownNumber(length, length) + unitText;
  context.fillStyle = isDark() ? "#0f172ad9" : "#ffffffd9";
  context.fillRect(right - wide - 8, y - 20, wide + 16, 28);
  context.fillStyle = context.strokeStyle = ink();
  context.lineWidth = 2;
  context.beginPath();
  for (const [x, dy] of [[right - wide, -4], [right - wide, 4], [right - wide, 0], [right, 0], [right, -4], [right, 4]]) context[dy === -4 ? "moveTo" : "lineTo"](x, y + dy);
  context.stroke();
  context.textAlign = "center";
  context.fillText(text, right - wide / 2, y - 7);
}

function drawMeasure(context) {
  if (!measured.length) return;
  context.strokeStyle = context.fillStyle = isDark() ? "#93c5fd" : "#1d4ed8";
  context.lineWidth = 2;
  context.setLineDash([6, 4]);
  context.beginPath();
  for (const [x, y] of measured) context.lineTo(screenX(x), screenY(y));
  context.stroke();
  context.setLineDash([]);
  for (const [x, y] of measured) context.fillRect(screenX(x) - 3, screenY(y) - 3, 6, 6);
}

function drawPointed(context) {
  if (!pointed) return;
  context.strokeStyle = isDark() ? "#fde047" : "#b45309";
  context.lineWidth = 3;
  context.beginPath();
  if (pointed.at) context.arc(screenX(pointed.at[0]), screenY(pointed.at[1]), 7, 0, 2 * Math.PI);
  else {
    context.moveTo(screenX(pointed.segment[0]), screenY(pointed.segment[1]));
    context.lineTo(screenX(pointed.segment[2]), screenY(pointed.segment[3]));
  }
  context.stroke();
}

function drawMarks() {
  const context = cleared(marks);
  drawWave(context);
  drawPath(context);
  drawBody(context);
  drawArm(context);
  drawEnds(context);
  drawPointed(context);
  drawMeasure(context);
  drawAxes(context);
}
