// SPDX-License-Identifier: BSD-3-Clause
// What the pointer, fingers and keys do; what the pointer is at is told below the picture.
"use strict";
const readout = document.getElementById("readout");
const held = new Map();  // pointers that are down
let pinch = null, isMeasuring = false, moves = 0;
const obstacles = layers.filter(l => l.obstacle && l.segments);
const solids = layers.filter(l => l.obstacle && l.kind === "areas");
const place = event => { const box = marks.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };

function distanceToSegment(x, y, s, i) {
  const dx = s[i + 2] - s[i], dy = s[i + 3] - s[i + 1], sq = dx * dx + dy * dy;
  const t = sq > 0 ? Math.min(1, Math.max(0, ((x - s[i]) * dx + (y - s[i + 1]) * dy) / sq)) : 0;
  return Math.hypot(x - s[i] - t * dx, y - s[i + 1] - t * dy);
}

/// The nearest of the layer's items within `most` of a place: [distance, index].
function nearest(layer, x, y, most) {
  const tiles = tilesOf(layer), s = layer.segments;
  let best = [most, -1];
  tiles.within(x - most, y - most, x + most, y + most, (from, to) => {
    for (let k = from; k < to; ++k) {
      const i = tiles.items[k];
      const d = s ? distanceToSegment(x, y, s, 4 * i) : Math.hypot(layer.xy[2 * i] - x, layer.xy[2 * i + 1] - y);
      if (d < best[0]) best = [d, i];
    }
  });
  return best;
}

function isInside(layer, x, y) {
  let winding = 0;
  const {xy, first} = layer;
  for (let c = 0; c + 1 < first.length; ++c) {
    for (let i = first[c]; i < first[c + 1]; ++i) {
      const j = i + 1 < first[c + 1] ? i + 1 : first[c], ay = xy[2 * i + 1], by = xy[2 * j + 1];
      if ((ay <= y) === (by <= y)) continue;
      if (xy[2 * i] + (y - ay) / (by - ay) * (xy[2 * j] - xy[2 * i]) > x) winding += by > ay ? 1 : -1;
    }
  }
  return winding !== 0;
}

/// From a place to the nearest obstacle; null where there is none.
function clearance(x, y) {
  let best = null;
  for (const layer of obstacles) {
    const farthest = Math.hypot(boxX1 - boxX0, boxY1 - boxY0) * 2;
    for (let most = tilesOf(layer).size; most < 2 * farthest; most *= 3) {
      const [d, i] = nearest(layer, x, y, most);
      if (i >= 0) { best = best === null ? d : Math.min(best, d); break; }
    }
  }
  return best;
}

function thingAt(x, y) {
  const graph = picture.graph, milestones = layerOf("milestones"), edges = layerOf("edges");
  if (milestones && milestones.shown) {
    const [, i] = nearest(milestones, x, y, 9 / view.scale);
    if (i >= 0) {
      const cost = graph.cost && graph.cost[i] >= 0 ? `, ${lengthText(graph.cost[i])} from the root of the search` : "";
      return {at: [milestones.xy[2 * i], milestones.xy[2 * i + 1]], text: `milestone ${i}${cost}`};
    }
  }
  if (edges && edges.shown && edges.count) {
    const [, i] = nearest(edges, x, y, 6 / view.scale), s = edges.segments;
    if (i >= 0) return {segment: s.slice(4 * i, 4 * i + 4), text: `edge ${graph.ends[2 * i]} to ${graph.ends[2 * i + 1]}, ${lengthText(Math.hypot(s[4 * i] - s[4 * i + 2], s[4 * i + 1] - s[4 * i + 3]))}`};
  }
  return null;
}

const precision = () => 1 / view.scale;
const lengthText = length => shownNumber(length, Math.max(precision() / 100, Math.min(precision(), length > 0 ? 10 ** Math.floor(Math.log10(length) - 2) : 1))) + unitText;
/// In one of several views beside each other; "" outside of them and where it looks into depth.
function placeInPanel(wx, wy) {
  const panel = picture.panels.find(({box}) => wx >= box[0] && wx <= box[2] && wy >= box[1] && wy <= box[3]);
  if (!panel || !panel.hasTicks) return panel ? panel.y : "";
  return `${panel.x} ${shownNumber(wx - panel.origin[0], precision())}, ${panel.y} ${shownNumber(wy - panel.origin[1], precision())}`;
}
function tell(x, y) {
  if (picture.panels.length) {
    readout.textContent = [placeInPanel(x, y), ...isMeasuring && measured.length ? [`measured ${lengthText(measuredLength())}`] : []].join("  ·  ");
    return;
  }
  const words = [`x ${shownNumber(x + picture.origin[0], precision())}, y ${shownNumber(y + picture.origin[1], precision())}${unitText}`];
  const solid = solids.find(layer => isInside(layer, x, y)), room = solid ? null : clearance(x, y);
  if (solid) words.push(`inside ${solid.label}`);
  else if (room !== null) words.push(`clearance ${lengthText(room)}`);
  pointed = thingAt(x, y);
  if (pointed) words.push(pointed.text);
  if (isMeasuring && measured.length) words.push(`measured ${lengthText(measuredLength())}`);
  readout.textContent = words.join("  ·  ");
}
const measuredLength = () => measured.reduce((sum, p, i) => i ? sum + Math.hypot(p[0] - measured[i - 1][0], p[1] - measured[i - 1][1]) : 0, 0);

marks.addEventListener("wheel", event => {
  event.preventDefault();
  view.held = true;
  zoomAt(...place(event), Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)));
}, {passive: false});
marks.addEventListener("pointerdown", event => {
  marks.setPointerCapture(event.pointerId);
  held.set(event.pointerId, place(event));
  moves = held.size === 1 ? 0 : 99;
  marks.classList.add("held");
  pinch = null;
});
function released(event) {
  if (!held.delete(event.pointerId)) return;
  pinch = null;
  if (held.size === 0) marks.classList.remove("held");
  if (event.type === "pointerup" && moves < 4 && isMeasuring) {
    const [px, py] = place(event);
    measured.push([worldX(px), worldY(py)]);
    tell(worldX(px), worldY(py));
    redraw("marks");
  }
}
for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) marks.addEventListener(end, released);
marks.addEventListener("pointermove", event => {
  const now = place(event), before = held.get(event.pointerId);
  if (!before) {
    tell(worldX(now[0]), worldY(now[1]));
    return redraw("marks");
  }
  moves += Math.abs(now[0] - before[0]) + Math.abs(now[1] - before[1]);
  held.set(event.pointerId, now);
  view.held = true;
  if (held.size === 1) return pan(now[0] - before[0], now[1] - before[1]);
  const [a, b] = [...held.values()], apart = Math.hypot(a[0] - b[0], a[1] - b[1]), middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  if (pinch) {
    pan(middle[0] - pinch.middle[0], middle[1] - pinch.middle[1]);
    zoomAt(...middle, apart / Math.max(1, pinch.apart));
  }
  pinch = {apart, middle};
});
marks.addEventListener("pointerleave", () => { pointed = null; redraw("marks"); });
marks.addEventListener("dblclick", () => { if (!isMeasuring) { fit(); redraw(); } });
new ResizeObserver(() => { if (view.isFitted) fit(); redraw(); }).observe(stage);
