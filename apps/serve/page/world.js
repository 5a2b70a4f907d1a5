// SPDX-License-Identifier: BSD-3-Clause
// The world as tiles between axes, start and goal as marks that can be dragged, the path as a line. A place is {x, y} of the world;
// Leaflet has it as latitude y and longitude x.
"use strict";
const byId = id => document.getElementById(id);
const latLng = p => L.latLng(p.y, p.x);
const placeOf = at => ({x: at.lng, y: at.lat});
let world = null;  // what /api/world says
let map = null;
let tiles = null;
const pathLine = {line: null, others: null, id: null, whole: true, asked: 0};

/// Digits that a pixel can tell; none in mazes whose cells are pixels or less, where that is the middle of a cell.
function digits() {
  const pixel = world.tiles.span / world.tiles.pixels / 2 ** Math.max(0, map.getZoom());
  return Math.min(12, Math.max(0, Math.ceil(-Math.log10(pixel))));
}
/// A length as it is told, in the world's unit.
const inUnit = length => shown(length) + (world.unit ? " " + world.unit : "");
const rounded = number => Number(number.toFixed(digits()));

/// Where the world's places lie among its tiles.
function crsOfWorld() {
  const t = world.tiles, scale = t.pixels / t.span;
  return L.extend({}, L.CRS.Simple, {transformation: new L.Transformation(scale, -t.corner[0] * scale, -scale, t.corner[1] * scale)});
}
function addTiles() {
  const t = world.tiles, [left, low, right, high] = world.box;
  map.whole = L.latLngBounds([low, left], [high, right]);
  tiles = L.tileLayer(t.url, {tileSize: t.pixels, minZoom: -3, maxZoom: t.levels, minNativeZoom: 0, maxNativeZoom: t.levels - 1,
                              bounds: map.whole, noWrap: true, keepBuffer: 1, updateInterval: 60, className: "tiles"});
  tiles.on("tileerror", noticeWorld);
  showParts();
}
// What lies on the map without being a layer, each with a box.
const parts = ["world", "ground", "path"];
let ground = null;  // what is dear or forbidden
function showParts() {
  for (const [part, drawn] of [["world", tiles], ["ground", ground], ["path", pathLine.line], ["path", pathLine.others]]) {
    if (drawn) byId("show-" + part).checked ? drawn.addTo(map) : drawn.remove();
  }
}
/// Prices and forbidden areas of this body, under all that is drawn later.
function showGround() {
  if (ground) ground.remove();
  const areas = world.ground.map(area => [area, area.chains.map(chain => chain.map(([x, y]) => L.latLng(y, x)))]);
  ground = L.layerGroup(areas.map(([area, rings]) => L.polygon(rings, {pane: "tilePane", stroke: false, fillColor: area.color, fillOpacity: area.opacity, fillRule: "evenodd", interactive: false})));
  byId("ground-box").hidden = byId("ground-legend").hidden = areas.length === 0;
  byId("ground-legend").replaceChildren(...world.ground.filter(area => area.label).map(area => {
    const ink = elementOf("span", {className: "ink"});
    Object.assign(ink.style, {backgroundColor: area.color, opacity: Math.max(0.15, area.opacity)});
    return elementOf("li", {}, ink, area.label + (area.chains.length ? "" : ", too fine to be drawn here"));
  }));
  showParts();
}
/// For the link: the names of those that are not shown.
const hiddenParts = () => parts.filter(part => !byId("show-" + part).checked).join(",");
function hideParts(names) {
  for (const part of parts) byId("show-" + part).checked = !(names || "").split(",").includes(part);
  showParts();
}
/// Of a world whose tiles lie elsewhere: what is on the map is placed anew.
function placeMap(center, zoom) {
  tiles.remove();
  map.options.crs = crsOfWorld();
  map.options.maxZoom = world.tiles.levels;
  map.setView(center, zoom, {reset: true});
  addTiles();
  for (const end of ["start", "goal"]) showHeading(end);  // by pixels, which are others at the same zoom
}
/// Its box fills the window but for the axes and arrows that reach beyond it: zooms need not be whole.
function fitWhole(options) {
  const zoom = map.getBoundsZoom(map.whole, false, L.point(56, 40)), pixels = place => map.project(place, zoom);
  const low = pixels(map.whole.getSouthWest()), high = pixels(map.whole.getNorthEast());
  const room = {left: 44, top: 12, right: 12, bottom: 28};
  for (const end of ["start", "goal"].filter(end => question[end] && turns())) {
    const mark = pixels(latLng(question[end])), angle = headingShown(end) || 0, reach = handleReach + 16;
    const x = mark.x + reach * Math.cos(angle), y = mark.y - reach * Math.sin(angle);
    const beyond = {left: low.x - x, top: high.y - y, right: x - high.x, bottom: y - low.y};
    for (const side in room) room[side] = Math.max(room[side], beyond[side]);
  }
  map.fitBounds(map.whole, {paddingTopLeft: [room.left, room.top], paddingBottomRight: [room.right, room.bottom], ...options});
}

// Axes along the left and the lower edge, and a bar of a round length, in the world's unit.
const ScaleBar = L.Control.Scale.extend({
  _updateMetric(most) {
    const ten = 10 ** Math.floor(Math.log10(most)), length = ten * [5, 2, 1].find(k => k === 1 || k * ten <= most);
    this._updateScale(this._mScale, inUnit(length), length / most);
  }
});
/// Multiples of the least of 1, 2, 5, 10, ... that leaves room between them, as [number, text].
function ticksBetween(low, high, pixels) {
  const least = 80 * (high - low) / pixels, ten = 10 ** Math.floor(Math.log10(least));
  const step = ten * [1, 2, 5, 10].find(k => k === 10 || k * ten >= least), places = Math.min(100, Math.max(0, -Math.floor(Math.log10(step))));
  const first = Math.ceil(low / step), count = Math.min(pixels / 40, Math.floor(high / step) - first + 1);
  return Array.from({length: Math.max(0, count)}, (_, i) => [(first + i) * step, grouped(Number(((first + i) * step).toFixed(places)))]);
}
function drawAxes(axes) {
  const size = map.getSize(), low = placeOf(map.containerPointToLatLng([0, size.y])), high = placeOf(map.containerPointToLatLng([size.x, 0]));
  const marks = (axis, edge, ticks, pixelOf, least) => ticks.map(([at, words]) => [pixelOf(at), words]).filter(([pixel]) => pixel > least).map(([pixel, words]) => {
    const tick = Object.assign(document.createElement("span"), {className: axis, textContent: words});
    tick.style[edge] = pixel + "px";
    return tick;
  });
  const x = marks("x", "left", ticksBetween(low.x, high.x, size.x), at => map.latLngToContainerPoint([low.y, at]).x, 24);
  const y = marks("y", "top", ticksBetween(low.y, high.y, size.y), at => map.latLngToContainerPoint([at, low.x]).y, 84);  // below the buttons
  axes.replaceChildren(...x, ...y);
}
function addAxes() {
  const axes = Object.assign(document.createElement("div"), {className: "axes"});
  axes.setAttribute("aria-hidden", "true");
  map.getContainer().append(axes);
  map.on("move resize viewreset", () => drawAxes(axes));
}
function openMap() {
  map = L.map("map", {crs: crsOfWorld(), minZoom: -3, maxZoom: world.tiles.levels, zoomSnap: 0, attributionControl: false, preferCanvas: true});
  L.control.attribution({prefix: false}).addAttribution('<a href="leaflet-license.txt">Leaflet</a>').addTo(map);
  new ScaleBar({imperial: false}).addTo(map);
  addAxes();
  addTiles();
  showGround();
  map.on("mousemove", e => { byId("readout").textContent = rounded(e.latlng.lng) + ", " + rounded(e.latlng.lat) + (world.unit ? " " + world.unit : ""); });
  map.on("moveend", showSeenPath);
  new ResizeObserver(() => map.invalidateSize({pan: false})).observe(map.getContainer());  // windows are not all that resizes it
}

/// Keys on the map that are taken are nobody else's.
function onMapKeys(takes) {
  map.getContainer().addEventListener("keydown", event => {
    if (!takes(event)) return;
    event.preventDefault();
    event.stopPropagation();
  }, true);
}
/// Pixels that an arrow's key stands for, with shift more.
function arrowStep(event) {
  const way = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
  return way && L.point(way).multiplyBy(event.shiftKey ? 40 : 8);
}
/// "undo" and "redo" by the usual keys.
function undoStep(event) {
  const key = event.ctrlKey || event.metaKey ? event.key.toLowerCase() : "";
  return key === "y" || (key === "z" && event.shiftKey) ? "redo" : key === "z" ? "undo" : null;
}
/// A mark of that name; moved(place, is_over) is called while it is dragged, and at the end.
function makeMark(name, moved) {
  const icon = L.divIcon({className: "mark " + name, iconSize: [22, 22]});
  const mark = L.marker([0, 0], {icon, draggable: true, autoPan: true, keyboard: true, title: name, alt: name});
  mark.on("drag", () => moved(placeOf(mark.getLatLng()), false));
  mark.on("dragend", () => moved(placeOf(mark.getLatLng()), true));
  mark.on("add", () => mark.getElement().addEventListener("keydown", event => {
    const step = arrowStep(event);
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    moved(placeOf(map.containerPointToLatLng(map.latLngToContainerPoint(mark.getLatLng()).add(step))), true);
  }));
  return mark;
}
function putMark(mark, place) {
  if (!place) return void mark.remove();
  mark.setLatLng(latLng(place));
  if (!map.hasLayer(mark)) mark.addTo(map);
}

/// In place of the layer of that name, if there is one.
function putLayer(holder, name, layer = null) {
  if (holder[name]) holder[name].remove();
  holder[name] = layer;
}
function clearPath() {
  putLayer(pathLine, "line");
  putLayer(pathLine, "others");
  pathLine.id = null;
  ++pathLine.asked;
}
function drawChains(chains) {
  const points = chains.map(chain => chain.map(p => L.latLng(p[1], p[0])));
  putLayer(pathLine, "line", L.polyline(points, {color: pathColor(), weight: 4, opacity: 0.9, smoothFactor: 0.2, interactive: false}));
  showParts();
}
/// The cheapest of each other class, thinner.
function showOtherWays(ways) {
  if (ways.length === 0) return;
  pathLine.others = L.polyline(ways.map(way => way.path.map(p => L.latLng(p[1], p[0]))), {color: pathColor(), weight: 2.5, opacity: 0.5, interactive: false});
  showParts();
}
const pathColor = () => document.documentElement.classList.contains("dark") ? "#ff6b81" : "#c8102e";
/// Of a car, its poses and those between them on its arcs, a chord of at most 5 degrees apart; of others, the path.
function asDriven(path) {
  if (!world.robot.startsWith("car") || path.length === 0) return path;
  const within = angle => Math.atan2(Math.sin(angle), Math.cos(angle)), driven = [path[0]];
  for (let i = 1; i < path.length; ++i) {
    const [x, y, theta] = path[i - 1], dx = path[i][0] - x, dy = path[i][1] - y;
    const turn = within(path[i][2] - theta), parts = Math.ceil(Math.abs(turn) * 36 / Math.PI - 1e-9);
    for (let k = 1; k < parts; ++k) {
      const t = k / parts, share = Math.sin(t * turn / 2) / Math.sin(turn / 2), back = (t - 1) * turn / 2;
      const c = share * Math.cos(back), s = share * Math.sin(back);
      driven.push([x + c * dx - s * dy, y + s * dx + c * dy, within(theta + t * turn)]);
    }
    driven.push(path[i]);
  }
  return driven;
}
/// points: all of them where the answer listed them, else they are fetched by what is seen.
function showPath(points, id) {
  ++pathLine.asked;
  pathLine.id = id;
  pathLine.whole = points.length > 0;
  if (pathLine.whole) return drawChains([points]);
  showSeenPath();
}
/// Of a request for what is seen, and so much of it around.
function viewWords(around, zoom) {
  const seen = map.getBounds().pad(around);
  return "?z=" + zoom + "&bbox=" + [seen.getWest(), seen.getSouth(), seen.getEast(), seen.getNorth()].join(",");
}
async function showSeenPath() {
  if (pathLine.whole || !pathLine.id) return;
  const mine = ++pathLine.asked, zoom = map.getZoom() - 1;  // the line is wider than two pixels
  const told = await toldOfPath("api/path/" + pathLine.id + viewWords(0.5, zoom), answer.json);
  // Of what is refused, what was seen stays; else another path or view may have come meanwhile.
  if (!told.error && mine === pathLine.asked) drawChains(told.chains);
}
