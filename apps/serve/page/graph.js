// SPDX-License-Identifier: BSD-3-Clause
// The route graph as people edit it: nodes by id, edges by key (their id; files may give that twice, then one of the
// page's), every change with its way back, what the service says of each
// edge, and the layer that draws them. An edge stands for one way; two that lead to and fro are drawn as one line.
// What a file says beside places and ends (`more`) is a text that is handed back as it came.
"use strict";
const graph = {nodes: new Map(), edges: new Map(), file: new Map([["frame", "map"]]), undo: [], redo: [], verdicts: new Map(), selected: null};

const headingOf = node => node.theta === undefined ? null : node.theta;
function edgeNumbers(edge) {
  const a = graph.nodes.get(edge.from), b = graph.nodes.get(edge.to);
  return graph.turns ? [...a.at, headingOf(a), ...b.at, headingOf(b)] : [...a.at, ...b.at];
}
/// What the service said of the edge as it lies now; undefined while nobody knows.
const verdictOf = edge => graph.verdicts.get(edgeNumbers(edge).join());
const edgesAt = id => [...graph.edges.values()].filter(e => e.from === id || e.to === id);
const between = (a, b) => [...graph.edges.values()].filter(e => (e.from === a && e.to === b) || (e.from === b && e.to === a));
const freshId = () => Math.max(-1, ...graph.nodes.keys(), ...graph.edges.keys()) + 1;
function lengthOf(edge) {
  const a = graph.nodes.get(edge.from).at, b = graph.nodes.get(edge.to).at;
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}

/// Sets each [name, id, value]; no value takes it away. Gives the change that takes it back.
function applyChange(change) {
  const back = [];
  for (const [name, id, value] of change) {
    back.unshift([name, id, graph[name].get(id)]);
    if (value === undefined) graph[name].delete(id);
    else graph[name].set(id, value);
  }
  const chosen = graph.selected;
  if (chosen && !graph[chosen.name].has(chosen.id)) graph.selected = null;
  return back;
}
function changeGraph(change) {
  if (change.length === 0) return;
  graph.undo.push(applyChange(change));
  graph.redo = [];
  graphChanged();
}
function stepGraph(from, to) {
  if (from.length === 0) return void say("There is nothing to take back.");
  to.push(applyChange(from.pop()));
  graphChanged();
}
const undoGraph = () => stepGraph(graph.undo, graph.redo);
const redoGraph = () => stepGraph(graph.redo, graph.undo);
function graphChanged() {
  graphLayer.draw();
  showGraph();
  checkGraph();
}

/// All edges are replaced: one change, so that it can be taken back.
function takeGraph(json) {
  json.edges.forEach((edge, i) => { edge.verdict = json.verdicts[i]; });
  const change = [];
  for (const id of graph.edges.keys()) change.push(["edges", id, undefined]);
  for (const id of graph.nodes.keys()) change.push(["nodes", id, undefined]);
  for (const node of json.nodes) change.push(["nodes", node.id, node]);
  const all = [...json.nodes, ...json.edges], taken = new Set();
  let next = all.reduce((most, {id}) => Math.max(most, id), -1) + 1;
  for (const {verdict, ...edge} of json.edges) {
    const key = taken.has(edge.id) ? next++ : edge.id;
    taken.add(key);
    change.push(["edges", key, {...edge, key}]);
  }
  change.push(["file", "frame", json.frame], ["file", "more", json.more || undefined]);
  graph.undo.push(applyChange(change));
  graph.redo = [];
  graph.selected = null;
  for (const {verdict, ...edge} of json.edges) graph.verdicts.set(edgeNumbers(edge).join(), verdict);
  graphChanged();
}

let checking = false;
/// Asks about the edges that nobody has asked about, some thousand at a time.
async function checkGraph() {
  if (checking) return;
  const asked = new Map();
  for (const edge of graph.edges.values()) if (!verdictOf(edge) && asked.size < 2000) asked.set(edgeNumbers(edge).join(), edgeNumbers(edge));
  if (asked.size === 0) return;
  checking = true;
  const hash = world.hash;
  const json = await posted("api/check", JSON.stringify({edges: [...asked.values()]}));
  checking = false;
  if (world.hash !== hash) return checkGraph();  // of a world that is no more
  if (!json) return;
  if (graph.verdicts.size > 200000) graph.verdicts.clear();
  [...asked.keys()].forEach((key, i) => graph.verdicts.set(key, json.edges[i]));
  graphLayer.draw();
  showGraph();
  checkGraph();
}
/// What the service answers, as JSON; nothing where it refuses, which is said.
async function posted(place, body, fields = {}) {
  try {
    const reply = await fetch(place, {method: "POST", headers: {"Content-Type": "application/json", ...fields}, body});
    const json = await reply.json();
    if (!json.error) return json;
    say(json.error.message);
  } catch (error) {
    say("The service does not answer any more.");
  }
  return null;
}

// Changes that people make.
function addNode(place, joinTo) {
  const node = {id: freshId(), at: [rounded(place.x), rounded(place.y)]};
  const change = [["nodes", node.id, node]];
  if (joinTo !== undefined) change.push(...newEdges(joinTo, node.id, node.id + 1));
  changeGraph(change);
  choose("nodes", node.id);
}
function newEdges(a, b, id) {
  const change = [["edges", id, {id, key: id, from: a, to: b}]];
  if (!byId("graph-one-way").checked) change.push(["edges", id + 1, {id: id + 1, key: id + 1, from: b, to: a}]);
  return change;
}
function joinNodes(a, b) {
  if (a === b) return;
  if (between(a, b).length > 0) return void say("Nodes " + a + " and " + b + " are joined already.");
  changeGraph(newEdges(a, b, freshId()));
}
/// The costs that were lengths become those of the new place; others are somebody's word and stay.
function moveNode(id, place) {
  const old = graph.nodes.get(id), edges = edgesAt(id);
  const lengths = edges.map(edge => edge.cost === undefined || Math.abs(edge.cost - lengthOf(edge)) <= 1e-6 * edge.cost);
  const change = [["nodes", id, {...old, at: [rounded(place.x), rounded(place.y)]}]];
  edges.forEach((edge, i) => { if (lengths[i]) { const {cost, ...rest} = edge; change.push(["edges", edge.key, rest]); } });
  changeGraph(change);
}
function removeChosen() {
  const chosen = graph.selected;
  if (!chosen) return void say("Choose a node or an edge first.");
  if (chosen.name === "edges") {
    const edge = graph.edges.get(chosen.id);
    return changeGraph(between(edge.from, edge.to).map(e => ["edges", e.key, undefined]));
  }
  changeGraph([...edgesAt(chosen.id).map(e => ["edges", e.key, undefined]), ["nodes", chosen.id, undefined]]);
}
const blockedEdges = () => [...graph.edges.values()].filter(edge => { const v = verdictOf(edge); return v && !v.free; });
const removeBlocked = () => changeGraph(blockedEdges().map(edge => ["edges", edge.key, undefined]));

/// Draws on a canvas over the world, in its pixels.
const GraphLayer = L.Layer.extend({
  onAdd() {
    this.canvas = L.DomUtil.create("canvas", "graph leaflet-zoom-hide", this.getPane());
    this.canvas.setAttribute("aria-hidden", "true");
    this.draw();
  },
  onRemove() { this.canvas.remove(); },
  getEvents() { return {moveend: this.draw, zoomend: this.draw, viewreset: this.draw, resize: this.draw}; },
  draw() {
    if (!this._map) return;
    const size = map.getSize(), ratio = window.devicePixelRatio || 1;
    this.canvas.width = size.x * ratio;
    this.canvas.height = size.y * ratio;
    this.canvas.style.width = size.x + "px";
    this.canvas.style.height = size.y + "px";
    L.DomUtil.setPosition(this.canvas, map.containerPointToLayerPoint([0, 0]));
    const pen = this.canvas.getContext("2d");
    pen.scale(ratio, ratio);
    this.drawEdges(pen);
    this.drawNodes(pen);
  },
  drawEdges(pen) {
    const style = getComputedStyle(document.documentElement), color = name => style.getPropertyValue(name);
    const chosen = graph.selected && graph.selected.name === "edges" ? graph.selected.id : null;
    const groups = {free: [], unknown: [], blocked: [], chosen: []};
    for (const edge of graph.edges.values()) {
      const verdict = verdictOf(edge);
      groups[!verdict ? "unknown" : verdict.free ? "free" : "blocked"].push(edge);
      if (edge.key === chosen) groups.chosen.push(edge);
    }
    const looks = {chosen: [color("--chosen"), 9, []], free: [color("--edge"), 2.5, []], unknown: [color("--faint"), 2, [4, 4]], blocked: [color("--bad"), 4, [9, 4]]};
    for (const name of ["chosen", "free", "unknown", "blocked"]) {
      [pen.strokeStyle, pen.lineWidth] = looks[name];
      pen.setLineDash(looks[name][2]);
      pen.beginPath();
      for (const edge of groups[name]) {
        const a = pixelOf(graph.nodes.get(edge.from)), b = pixelOf(graph.nodes.get(edge.to));
        pen.moveTo(a.x, a.y);
        pen.lineTo(b.x, b.y);
      }
      pen.stroke();
    }
    pen.setLineDash([]);
  },
  drawNodes(pen) {
    const style = getComputedStyle(document.documentElement), color = name => style.getPropertyValue(name);
    const size = map.getSize(), radius = graph.nodes.size > 3000 ? 3 : 5;
    pen.strokeStyle = color("--paper");
    pen.lineWidth = 1.5;
    for (const node of graph.nodes.values()) {
      const p = pixelOf(node), isChosen = graph.selected && graph.selected.name === "nodes" && graph.selected.id === node.id;
      if (p.x < -20 || p.y < -20 || p.x > size.x + 20 || p.y > size.y + 20) continue;
      const disc = (name, wide) => {
        pen.fillStyle = color(name);
        pen.beginPath();
        pen.arc(p.x, p.y, wide, 0, 2 * Math.PI);
        pen.fill();
      };
      if (isChosen) disc("--chosen", radius + 6);
      disc("--node", radius);
      pen.stroke();
    }
  }
});
const pixelOf = node => map.latLngToContainerPoint([node.at[1], node.at[0]]);
const graphLayer = new GraphLayer();

/// The node within reach of a pixel, else the edge; nothing where there is neither.
function graphAt(pixel, reach) {
  let best = null, least = reach;
  for (const node of graph.nodes.values()) {
    const away = pixelOf(node).distanceTo(pixel);
    if (away <= least) [best, least] = [{name: "nodes", id: node.id}, away];
  }
  if (best) return best;
  least = reach / 2;
  for (const edge of graph.edges.values()) {
    const away = L.LineUtil.pointToSegmentDistance(pixel, pixelOf(graph.nodes.get(edge.from)), pixelOf(graph.nodes.get(edge.to)));
    if (away < least) [best, least] = [{name: "edges", id: edge.key}, away];
  }
  return best;
}
