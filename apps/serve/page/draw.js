// SPDX-License-Identifier: BSD-3-Clause
// Walls and polygons drawn into the world and taken out of it, where the service lets that be: each change makes a new
// world, which everybody sees, and the question is asked again. The list of changes, to take them back, is this page's.
"use strict";
const drawing = {tool: null, corners: [], pixel: null, undo: [], redo: [], busy: false};
const token = () => sessionStorage.getItem("warren-token") || "";

/// The token comes behind the # of a link, which never leaves the browser, and is not kept in the address.
function takeToken() {
  const given = new URLSearchParams(location.hash.slice(1)).get("token");
  if (given) sessionStorage.setItem("warren-token", given);
}

/// Sends a change. Gives what was added and removed, with the world as it is then; nothing where it is refused, which is
/// said. One at a time: the next one may depend on the list that this one changes.
async function sendChange(change) {
  if (drawing.busy) return null;
  drawing.busy = true;
  const made = await posted("api/update", JSON.stringify(change), token() ? {Authorization: "Bearer " + token()} : {});
  if (made) await takeWorld();
  drawing.busy = false;
  return made;
}
let taken = Promise.resolve(), noticing = null;
/// Takes the world as it is now, one call after the other, so that an older world never replaces a newer one. True where
/// it is another one than before.
const takeWorld = () => taken = taken.then(fetchWorld);
/// An answer or a tile is not of this world: somebody else may have changed it. Tiles fail in bursts, which ask once.
const noticeWorld = () => noticing ||= takeWorld().finally(() => { noticing = null; });
async function fetchWorld() {
  try {
    const reply = await fetch("api/world" + withBody("?")), now = await reply.json();
    if (reply.status === 400) {  // the answer that is drawn was another body's
      forgetAnswer();
      showAnswer(null, []);
    }
    if (now.error) showBody({robot: "", radius: 0, outline: []});
    if (now.error) say(now.error.message);
    if (now.error || (now.hash === world.hash && now.robot === world.robot && now.clearance === world.clearance)) return false;
    showWorld(now);
    return true;
  } catch (error) {
    say("The service does not answer any more.");
    return false;
  }
}
/// All that lies on the map stays, the page's own lists too; where the new tiles lie elsewhere, the map follows them.
function showWorld(now) {
  const center = map.getCenter(), zoom = Math.floor(map.getZoom() + Math.log2(now.tiles.span / world.tiles.span));
  const lies = w => JSON.stringify([w.tiles.corner, w.tiles.span, w.tiles.levels, w.box]), stays = lies(now) === lies(world);
  world = now;
  if (stays) tiles.setUrl(world.tiles.url);
  else placeMap(center, zoom);
  renewLayers();
  graph.verdicts.clear();
  checkGraph();
  showBody({});
  ask();
}
/// False where the change was refused.
async function draw(change) {
  const made = await sendChange(change);
  if (!made) return false;
  if (made.before === made.hash) return true;
  drawing.undo.push({add: made.removed, remove: made.added});
  drawing.redo = [];
  showDrawing();
  return true;
}
async function stepDrawing(from, to) {
  if (from.length === 0) return;
  const made = await sendChange(from[from.length - 1]);
  if (!made) return;
  from.pop();
  to.push({add: made.removed, remove: made.added});
  showDrawing();
}

function setTool(tool) {
  drawing.tool = drawing.tool === tool ? null : tool;
  drawing.corners = [];
  if (drawing.tool) {
    if (measuring.on) setMeasuring(false);
    setEditing(false);
    say({wall: "Click the corners of the wall; a second click at the last one, or Enter, ends it.", polygon: "Click the corners; a click at the first one, or Enter, closes the polygon.", erase: "Click the wall or polygon to take away."}[drawing.tool]);
  }
  map.doubleClickZoom[drawing.tool ? "disable" : "enable"]();
  sketch.redraw();
  showDrawing();
}
function showDrawing() {
  for (const tool of ["wall", "polygon", "erase"]) byId("draw-" + tool).setAttribute("aria-pressed", String(drawing.tool === tool));
  byId("draw-undo").disabled = drawing.undo.length === 0;
  byId("draw-redo").disabled = drawing.redo.length === 0;
}
/// Ends what is being drawn: corners become walls from each to the next, or a polygon. They stay where it is refused.
async function finishDrawing() {
  const corners = drawing.corners, tool = drawing.tool, isPolygon = tool === "polygon";
  if (drawing.busy) return void say("The change before is still on its way; end this one again in a moment.");
  if (corners.length < (isPolygon ? 3 : 2)) return void say(isPolygon ? "A polygon has three corners or more." : "A wall has two ends.");
  drawing.corners = [];
  sketch.redraw();
  if (await draw({add: isPolygon ? {polygons: [corners]} : {walls: corners.slice(1).map((p, i) => [...corners[i], ...p])}})) return;
  if (drawing.tool !== tool || drawing.corners.length > 0) return;
  drawing.corners = corners;
  sketch.redraw();
}
/// Does the drawing take this click?
function drawsClick(event) {
  if (!drawing.tool) return false;
  const place = placeOf(event.latlng), near = corner => corner && pixelOf({at: corner}).distanceTo(event.containerPoint) < 10;
  if (drawing.tool === "erase") {
    const aside = map.containerPointToLatLng(event.containerPoint.add([10, 0]));
    draw({erase: [[place.x, place.y, Math.abs(aside.lng - place.x)]]});
  } else if (near(drawing.tool === "polygon" ? drawing.corners[0] : drawing.corners[drawing.corners.length - 1])) {
    finishDrawing();
  } else {
    drawing.corners.push([rounded(place.x), rounded(place.y)]);
    sketch.redraw();
  }
  return true;
}
function drawsKey(event) {
  const step = editor.on ? null : undoStep(event);
  if (step) step === "redo" ? stepDrawing(drawing.redo, drawing.undo) : stepDrawing(drawing.undo, drawing.redo);
  else if (event.key === "Enter" && drawing.corners.length > 0) finishDrawing();
  else if (event.key === "Escape" && drawing.tool) drawing.corners.length > 0 ? (drawing.corners = [], sketch.redraw()) : setTool(drawing.tool);
  else return false;
  return true;
}
/// x, y, x, y, ... in the field: what the mouse would click.
function readShape() {
  const text = byId("draw-shape").value.trim(), numbers = text.split(/[\s,;]+/).map(Number);
  if (text === "") return;
  if (numbers.length < 4 || numbers.length % 2 || !numbers.every(Number.isFinite)) return void say("Corners are x, y, x, y and so on.");
  if (drawing.tool !== "polygon") drawing.tool = "wall";
  drawing.corners = [];
  for (let i = 0; i < numbers.length; i += 2) drawing.corners.push([numbers[i], numbers[i + 1]]);
  showDrawing();
  finishDrawing();
}

/// What is being drawn.
const sketch = {
  line: null,
  redraw() {
    const points = drawing.corners.map(p => L.latLng(p[1], p[0]));
    putLayer(this, "line", points.length ? L.layerGroup([L.polyline(points, {color: "#d97706", weight: 3, dashArray: "6 4", interactive: false}), ...points.map(p => L.circleMarker(p, {radius: 4, color: "#d97706", interactive: false}))]).addTo(map) : null);
  }
};

async function saveScene() {
  const words = [];
  for (const end of ["start", "goal"]) {
    const state = question[end] && bodyOf({...question, start: question[end], goal: question[end]})[end];
    if (state) words.push(end + "=" + state.join(","));
  }
  const reply = await fetch("api/scene?" + words.join("&") + withBody("&")), text = await reply.text();
  if (!reply.ok) return void say(JSON.parse(text).error.message);
  save("world.scene", "text/plain", text);
  say("Saved: world.scene.");
}
function wireDrawing() {
  byId("drawing").hidden = !world.writable;
  for (const tool of ["wall", "polygon", "erase"]) byId("draw-" + tool).addEventListener("click", () => setTool(tool));
  byId("draw-undo").addEventListener("click", () => stepDrawing(drawing.undo, drawing.redo));
  byId("draw-redo").addEventListener("click", () => stepDrawing(drawing.redo, drawing.undo));
  byId("draw-save").addEventListener("click", saveScene);
  byId("draw-shape").addEventListener("change", readShape);
  onMapKeys(event => world.writable && drawsKey(event));
  showDrawing();
}
