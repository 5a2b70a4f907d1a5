// SPDX-License-Identifier: BSD-3-Clause
// What the page shows. Coordinates are relative to picture.origin, y up; a layer has segments (x, y, x, y), dots (x, y)
// or chains of points that are filled.
"use strict";
const picture = JSON.parse(document.getElementById("picture").textContent);

function numbers({type, data}) {
  const text = atob(data), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new {u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, i32: Int32Array, f32: Float32Array, f64: Float64Array}[type](bytes.buffer);
}

/// Buckets of items by their middles, so that what lies near a place or in a window is found without a look at all.
/// reach: the farthest that an item extends from its middle.
class Tiles {
  constructor(count, middle, reach) {
    this.reach = reach;
    const box = picture.box, aim = 24;
    this.size = Math.max(Math.sqrt((box[2] - box[0]) * (box[3] - box[1]) * aim / Math.max(count, 1)), Math.max(box[2] - box[0], box[3] - box[1]) / 2048) || 1;
    this.columns = Math.max(1, Math.ceil((box[2] - box[0]) / this.size));
    this.rows = Math.max(1, Math.ceil((box[3] - box[1]) / this.size));
    this.first = new Uint32Array(this.columns * this.rows + 1);
    const of = new Uint32Array(count);
    for (let i = 0; i < count; ++i) {
      of[i] = this.tile(...middle(i));
      ++this.first[of[i] + 1];
    }
    for (let t = 1; t < this.first.length; ++t) this.first[t] += this.first[t - 1];
    const next = this.first.slice();
    this.items = new Uint32Array(count);
    for (let i = 0; i < count; ++i) this.items[next[of[i]]++] = i;
  }
  column(x) { return Math.min(this.columns - 1, Math.max(0, Math.floor((x - picture.box[0]) / this.size))); }
  row(y) { return Math.min(this.rows - 1, Math.max(0, Math.floor((y - picture.box[1]) / this.size))); }
  tile(x, y) { return this.row(y) * this.columns + this.column(x); }
  /// visit(from, to): ranges of `items` that may reach into the window.
  within(x0, y0, x1, y1, visit) {
    const c0 = this.column(x0 - this.reach), c1 = this.column(x1 + this.reach);
    for (let r = this.row(y0 - this.reach); r <= this.row(y1 + this.reach); ++r) {
      visit(this.first[r * this.columns + c0], this.first[r * this.columns + c1 + 1]);
    }
  }
}

function segmentsOfChains(xy, first, closed) {
  let count = 0;
  for (let c = 0; c + 1 < first.length; ++c) count += first[c + 1] - first[c] - (closed ? 0 : 1);
  const out = new Float32Array(4 * count);
  let k = 0;
  for (let c = 0; c + 1 < first.length; ++c) {
    for (let i = first[c]; i + (closed ? 0 : 1) < first[c + 1]; ++i) {
      const j = i + 1 < first[c + 1] ? i + 1 : first[c];
      out.set([xy[2 * i], xy[2 * i + 1], xy[2 * j], xy[2 * j + 1]], k);
      k += 4;
    }
  }
  return out;
}

function prepared(layer) {
  if (layer.xy) layer.xy = numbers(layer.xy);
  if (layer.first) layer.first = numbers(layer.first);
  if (layer.kind === "chains" || layer.kind === "areas") layer.segments = segmentsOfChains(layer.xy, layer.first, layer.kind === "areas" || layer.closed);
  if (layer.kind === "chains" && layer.opacities && !layer.closed) {  // the chain that each segment is of
    layer.chainOf = new Uint32Array(layer.segments.length / 4);
    for (let c = 0; c + 1 < layer.first.length; ++c) layer.chainOf.fill(c, layer.first[c] - c, layer.first[c + 1] - c - 1);
  }
  if (layer.kind === "segments") layer.segments = layer.xy;
  return layer;
}

/// Made when first needed: of layers that are all in view, nobody asks for tiles.
function tilesOf(layer) {
  if (layer.tiles) return layer.tiles;
  const s = layer.segments;
  if (!s) return layer.tiles = new Tiles(layer.xy.length / 2, i => [layer.xy[2 * i], layer.xy[2 * i + 1]], 0);
  let reach = 0;
  for (let i = 0; i < s.length; i += 4) reach = Math.max(reach, Math.abs(s[i] - s[i + 2]), Math.abs(s[i + 1] - s[i + 3]));
  return layer.tiles = new Tiles(s.length / 4, i => [(s[4 * i] + s[4 * i + 2]) / 2, (s[4 * i + 1] + s[4 * i + 3]) / 2], reach / 2);
}

/// Milestones, edges and the search's tree share their states.
function layersOfGraph(graph) {
  graph.states = numbers(graph.states);
  graph.ends = numbers(graph.edges);
  graph.component = numbers(graph.component);
  graph.parent = graph.parent ? numbers(graph.parent) : null;
  const at = new Float32Array(2 * graph.ends.length);
  if (!graph.hasRoadmap) return graph.parent ? [treeOf(graph)] : [];
  graph.ends.forEach((v, i) => { at[2 * i] = graph.states[2 * v]; at[2 * i + 1] = graph.states[2 * v + 1]; });
  const made = [{id: "edges", kind: "segments", segments: at, width: graph.widths.edges, label: "roadmap edges", groups: i => graph.component[graph.ends[2 * i]]},
    {id: "milestones", kind: "dots", xy: graph.states, width: graph.widths.milestones, label: "milestones", groups: i => graph.component[i]}];
  for (const layer of made) layer.colors = graph.colors;
  if (graph.parent) made.splice(1, 0, treeOf(graph));
  return made;
}

/// cost: the length of the way from the root of the tree that a state is in; -1: none reached it.
function treeOf(graph) {
  const {states, parent} = graph, n = parent.length;
  const cost = new Float64Array(n).fill(-1), chain = [], child = [];
  const step = (v, p) => Math.hypot(states[2 * v] - states[2 * p], states[2 * v + 1] - states[2 * p + 1]);
  for (let v = 0; v < n; ++v) {
    if (parent[v] < 0) continue;
    for (let w = v; cost[w] < 0; w = parent[w]) {
      if (parent[w] < 0 || parent[w] === w) { cost[w] = 0; break; }
      chain.push(w);
    }
    while (chain.length) { const w = chain.pop(); cost[w] = cost[parent[w]] + step(w, parent[w]); }
    if (parent[v] !== v) child.push(v);
  }
  child.sort((a, b) => cost[a] - cost[b] || a - b);
  const segments = new Float32Array(4 * child.length);
  child.forEach((v, i) => segments.set([states[2 * v], states[2 * v + 1], states[2 * parent[v]], states[2 * parent[v] + 1]], 4 * i));
  graph.cost = cost;
  graph.byCost = Float64Array.from(child, v => cost[v]);
  return {id: "search_tree", kind: "segments", segments, width: graph.widths.search_tree, color: graph.treeColor, label: "search tree"};
}

const layers = picture.layers.map(prepared);
if (picture.graph) {
  const walls = layers.findIndex(l => l.id === "walls");
  layers.splice(walls < 0 ? layers.length : walls, 0, ...layersOfGraph(picture.graph));
}
for (const layer of layers) {
  layer.shown = layer.shown ?? true;
  layer.count = layer.count ?? (layer.kind === "image" ? 0 : layer.kind === "dots" ? layer.xy.length / 2 : layer.kind === "segments" ? layer.segments.length / 4 : layer.first.length - 1);
}
for (let i = layers.length; i-- > 0;) if (layers[i].kind !== "image" && layers[i].count === 0) layers.splice(i, 1);
const layerOf = id => layers.find(l => l.id === id);
