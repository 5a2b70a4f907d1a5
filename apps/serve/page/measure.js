// SPDX-License-Identifier: BSD-3-Clause
// Lengths by mouse or keys: a line of points, and how long it is so far. Ends, drawing and route graph get no clicks
// while it goes on.
"use strict";
const measuring = {on: false, points: [], layer: null};

const lengthAlong = points => points.slice(1).reduce((sum, p, i) => sum + Math.hypot(p.x - points[i].x, p.y - points[i].y), 0);
const measuredText = () => inUnit(lengthAlong(measuring.points));

function setMeasuring(on) {
  if (on && drawing.tool) setTool(drawing.tool);
  if (on && editor.on) setEditing(false);
  if (on) measuring.points = [];
  measuring.on = on;
  map.doubleClickZoom[on ? "disable" : "enable"]();
  byId("measure").setAttribute("aria-pressed", String(on));
  showMeasured();
  if (on) say("Click points to measure between; a double click or Escape ends, and Escape again clears.");
  else if (measuring.points.length > 1) say("Measured: " + measuredText() + ".");
}
function showMeasured() {
  putLayer(measuring, "layer");
  const at = measuring.points.map(latLng);
  if (at.length === 0) return;
  const words = elementOf("span", {}, measuredText());
  const dots = at.map(p => L.circleMarker(p, {radius: 4, color: "#0891b2", interactive: false}));
  measuring.layer = L.layerGroup([L.polyline(at, {color: "#0891b2", weight: 3, interactive: false}), ...dots]).addTo(map);
  if (at.length > 1) dots[at.length - 1].bindTooltip(words, {permanent: true, direction: "right", offset: [8, 0], className: "measured"}).openTooltip();
}
/// Does measuring take this click? The second one of a double click is at the last point and adds none.
function measures(event) {
  if (!measuring.on) return false;
  addMeasured(event.latlng);
  return true;
}
function addMeasured(at) {
  const last = measuring.points[measuring.points.length - 1], pixel = map.latLngToContainerPoint(at);
  if (last && pixel.distanceTo(map.latLngToContainerPoint(latLng(last))) < 4) return;
  measuring.points.push({x: rounded(at.lng), y: rounded(at.lat)});
  showMeasured();
  if (measuring.points.length > 1) say("Length so far: " + measuredText() + ".");
}
function measuresKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey) return false;
  if (event.key === "m") setMeasuring(!measuring.on);
  else if (event.key === "Enter" && measuring.on) addMeasured(map.getCenter());
  else if (event.key === "Escape" && measuring.on) setMeasuring(false);
  else if (event.key === "Escape" && measuring.points.length > 0 && !drawing.tool) clearMeasured();
  else return false;
  return true;
}
function clearMeasured() {
  measuring.points = [];
  showMeasured();
  say("The measured line is cleared.");
}
function wireMeasuring() {
  byId("measure").addEventListener("click", () => setMeasuring(!measuring.on));
  map.on("dblclick", () => { if (measuring.on) setMeasuring(false); });
  for (const mark of [...Object.values(marks), ...Object.values(handles)]) mark.on("click", measures);
  onMapKeys(measuresKey);
}
