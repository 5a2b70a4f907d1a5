// SPDX-License-Identifier: BSD-3-Clause
// How a route graph is edited: by mouse and finger on the map, by keys, by the fields beside it. While it is edited,
// clicks on the map are for the graph and not for start and goal.
"use strict";
const editor = {on: false, drag: null, joining: null, ended: -1000};

function setEditing(on) {
  editor.on = on;
  editor.joining = null;
  byId("graph-edit").setAttribute("aria-pressed", String(on));
  byId("map").classList.toggle("editing", on);
  if (on) {
    if (measuring.on) setMeasuring(false);
    if (drawing.tool) setTool(drawing.tool);
    if (!map.hasLayer(graphLayer)) graphLayer.addTo(map);
    say("Click to add a node, joined to the chosen one; click a node or an edge to choose it; drag a node to move it.");
  } else {
    graph.selected = null;
    graphLayer.draw();
  }
  showGraph();
}
function choose(name, id) {
  graph.selected = name === null ? null : {name, id};
  graphLayer.draw();
  showGraph();
  if (name !== null) say(wordsOfChosen());
}
function wordsOfChosen() {
  const {name, id} = graph.selected;
  if (name === "nodes") {
    const node = graph.nodes.get(id), blocked = edgesAt(id).filter(e => (verdictOf(e) || {free: true}).free === false);
    return "Node " + id + " at " + node.at.map(written).join(", ") + ", " + edgesAt(id).length + " edges" + (blocked.length ? "; not free: " + verdictOf(blocked[0]).why : "");
  }
  const edge = graph.edges.get(id), verdict = verdictOf(edge);
  const state = !verdict ? "" : verdict.free ? ", free" + (verdict.clearance === null ? "" : ", clearance " + inUnit(verdict.clearance)) : "; not free: " + verdict.why;
  return "Edge " + edge.from + " to " + edge.to + (between(edge.from, edge.to).length > 1 ? " and back" : "") + ", " + inUnit(lengthOf(edge)) + state;
}

/// The fields and buttons beside the map.
function showGraph() {
  const blocked = blockedEdges(), chosen = graph.selected, node = chosen && chosen.name === "nodes" ? graph.nodes.get(chosen.id) : null;
  const joined = new Set([...graph.edges.values()].map(e => Math.min(e.from, e.to) + "-" + Math.max(e.from, e.to)));
  byId("graph-count").textContent = graph.nodes.size === 0 ? "No graph yet" : grouped(graph.nodes.size) + " nodes, " + grouped(graph.edges.size) + " edges each one way on " + grouped(joined.size) + " lines" + (blocked.length ? ", " + grouped(blocked.length) + " not free" : "");
  byId("graph-why").hidden = blocked.length === 0;
  if (blocked.length) byId("graph-why").textContent = "Edge " + blocked[0].from + " to " + blocked[0].to + " is not free: " + verdictOf(blocked[0]).why + ". Nothing is saved while there are such edges.";
  byId("graph-drop").hidden = blocked.length === 0;
  const there = {save: graph.edges.size, undo: graph.undo.length, redo: graph.redo.length, remove: chosen, join: node, place: node};
  for (const [name, what] of Object.entries(there)) byId("graph-" + name).disabled = !what;
  byId("graph-join").setAttribute("aria-pressed", String(editor.joining !== null));
  byId("graph-place").value = node ? node.at.join(", ") : "";
}

/// Does the editor take this click?
function takesClick(event) {
  if (!editor.on) return false;
  if (performance.now() - editor.ended < 50) return true;
  const hit = graphAt(event.containerPoint, 12), chosen = graph.selected;
  const from = editor.joining !== null ? editor.joining : event.originalEvent.shiftKey && chosen && chosen.name === "nodes" ? chosen.id : null;
  if (hit && hit.name === "nodes" && from !== null) {
    joinNodes(from, hit.id);
    editor.joining = null;
    choose("nodes", hit.id);
  } else if (hit) {
    choose(hit.name, hit.id);
  } else {
    addNode(placeOf(event.latlng), chosen && chosen.name === "nodes" ? chosen.id : undefined);
  }
  return true;
}
function beginDrag(event) {
  if (!editor.on || event.button > 0 || !event.isPrimary) return;
  const hit = graphAt(map.mouseEventToContainerPoint(event), 12);
  if (!hit || hit.name !== "nodes" || event.shiftKey) return;
  map.dragging.disable();
  editor.drag = {id: hit.id, from: map.mouseEventToContainerPoint(event), before: graph.nodes.get(hit.id), moved: false};
}
function goOnDragging(event) {
  const drag = editor.drag;
  if (!drag) return;
  const pixel = map.mouseEventToContainerPoint(event);
  if (!drag.moved && pixel.distanceTo(drag.from) < 4) return;
  drag.moved = true;
  const at = map.containerPointToLatLng(pixel);
  graph.nodes.set(drag.id, {...drag.before, at: [rounded(at.lng), rounded(at.lat)]});
  graphLayer.draw();
  checkGraph();
}
function endDrag() {
  const drag = editor.drag;
  if (!drag) return;
  editor.drag = null;
  map.dragging.enable();
  if (!drag.moved) return;
  const at = graph.nodes.get(drag.id).at;
  graph.nodes.set(drag.id, drag.before);
  moveNode(drag.id, {x: at[0], y: at[1]});
  graph.selected = {name: "nodes", id: drag.id};
  editor.ended = performance.now();  // the browser may make a click of it
  graphLayer.draw();
  showGraph();
}

/// The node after the chosen one in order of ids, or before it.
function stepNodes(way) {
  const ids = [...graph.nodes.keys()].sort((a, b) => a - b);
  if (ids.length === 0) return void say("There are no nodes.");
  const now = graph.selected && graph.selected.name === "nodes" ? ids.indexOf(graph.selected.id) : way > 0 ? -1 : 0;
  const id = ids[(now + way + ids.length) % ids.length], at = graph.nodes.get(id).at;
  choose("nodes", id);
  if (!map.getBounds().contains([at[1], at[0]])) map.panTo([at[1], at[0]], {animate: false});
}
function join() {
  const chosen = graph.selected;
  if (!chosen || chosen.name !== "nodes") return void say("Choose a node first.");
  if (editor.joining !== null && editor.joining !== chosen.id) {
    joinNodes(editor.joining, chosen.id);
    editor.joining = null;
  } else {
    editor.joining = editor.joining === null ? chosen.id : null;
    if (editor.joining !== null) say("Choose the node to join with node " + chosen.id + ".");
  }
  showGraph();
}
function nudge(step) {
  const p = pixelOf(graph.nodes.get(graph.selected.id)).add(step), at = map.containerPointToLatLng(p);
  moveNode(graph.selected.id, {x: at.lng, y: at.lat});
  say(wordsOfChosen());
}
function takesKey(event) {
  const step = undoStep(event);
  if (step) {
    step === "redo" ? redoGraph() : undoGraph();
    return true;
  }
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  const arrow = arrowStep(event), chosen = graph.selected;
  if (arrow && chosen && chosen.name === "nodes") nudge(arrow);
  else if (event.key === "n" || event.key === "p") stepNodes(event.key === "n" ? 1 : -1);
  else if (event.key === "a") addNode(placeOf(map.getCenter()), chosen && chosen.name === "nodes" ? chosen.id : undefined);
  else if (event.key === "e") join();
  else if (event.key === "Delete" || event.key === "Backspace") removeChosen();
  else if (event.key === "Escape") { editor.joining = null; choose(null); }
  else return false;
  return true;
}

async function buildGraph() {
  const body = {kind: byId("graph-kind").value}, samples = byId("graph-samples").value.trim();
  if (body.kind === "roadmap" && samples !== "") {
    if (!/^[1-9]\d{0,8}$/.test(samples)) return void say("Samples are a whole number, or nothing for as many as it takes.");
    Object.assign(body, {samples: Number(samples), neighbours: 4});
  }
  say("Building.");
  const json = await posted("api/graph", JSON.stringify(body));
  if (json) openGraph(json, "Built: ");
}
async function openGraphFile(file) {
  if (!file) return;
  if (file.size > 4 << 20) return void say(file.name + " has more than 4 MiB.");
  const json = await posted("api/graph/open", await file.text());
  if (json) openGraph(json, "Opened: ");
}
function openGraph(json, word) {
  takeGraph(json);
  setEditing(true);
  say(word + grouped(json.nodes.length) + " nodes, " + grouped(json.edges.length) + " edges" + (json.left_out ? "; " + grouped(json.left_out) + " features are left out: neither, or nodes whose id a later one has" : "") + (blockedEdges().length ? "; " + grouped(blockedEdges().length) + " edges are not free" : "") + ". Clicks edit it now; Edit ends that.");
}
async function saveGraph() {
  const body = {frame: graph.file.get("frame"), nodes: [...graph.nodes.values()], edges: [...graph.edges.values()].map(({key, ...edge}) => edge)};
  if (graph.file.has("more")) body.more = graph.file.get("more");
  const reply = await fetch("api/graph/save", {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(body)});
  const text = await reply.text();
  if (!reply.ok) return void say(JSON.parse(text).error.message);
  save("graph.geojson", "application/geo+json", text);
  say("Saved: graph.geojson.");
}
function readPlace() {
  const numbers = byId("graph-place").value.trim().split(/[\s,;]+/).map(Number);
  if (numbers.length !== 2 || !numbers.every(Number.isFinite)) return void say("A node is at x, y.");
  if (graph.selected) moveNode(graph.selected.id, {x: numbers[0], y: numbers[1]});
}
function wireGraph() {
  graph.turns = turns();  // the service's own body, which drives its edges
  const drivesCurves = world.robot.startsWith("car") && !/^car radius .* steering differential$/.test(world.robot);
  byId("graph").hidden = drivesCurves || (world.asks_roadmap && world.description.endsWith("maze"));
  const container = map.getContainer();
  container.addEventListener("pointerdown", beginDrag, true);
  window.addEventListener("pointermove", goOnDragging);
  window.addEventListener("pointerup", endDrag);
  window.addEventListener("pointercancel", endDrag);
  onMapKeys(event => editor.on && takesKey(event));
  const buttons = {build: buildGraph, undo: undoGraph, redo: redoGraph, join, remove: removeChosen, drop: removeBlocked, save: saveGraph};
  for (const [name, act] of Object.entries(buttons)) byId("graph-" + name).addEventListener("click", act);
  byId("graph-file").addEventListener("change", event => { openGraphFile(event.target.files[0]); event.target.value = ""; });
  byId("graph-edit").addEventListener("click", () => setEditing(!editor.on));
  byId("graph-kind").addEventListener("change", event => { byId("graph-samples-row").hidden = event.target.value !== "roadmap"; });
  byId("graph-place").addEventListener("change", readPlace);
  showGraph();
}
