// SPDX-License-Identifier: BSD-3-Clause
// The body where it starts and ends, and the layer of the body along the path: outlines at the places that the service
// names, as far as they are seen.
"use strict";
const sweep = {bodies: null, asked: 0};
const endBodies = {start: null, goal: null};

/// A goal of any heading shows the one that the path arrives with.
function showBodyAt(end) {
  putLayer(endBodies, end);
  const place = question[end], path = answer.json && answer.json.verified ? answer.json.path : [];
  if (!place || (world.radius === 0 && world.outline.length === 0)) return;
  const state = [place.x, place.y], heading = headingShown(end) ?? (path.length ? path[path.length - 1][2] : null);
  if (turns() && heading === null) return;
  if (turns()) state.push(heading);
  const color = getComputedStyle(document.documentElement).getPropertyValue("--" + end).trim();
  endBodies[end] = L.layerGroup(bodyAt(world, state, {color, weight: 1.5, fillOpacity: 0.15, interactive: false})).addTo(map);
}

function forgetSweep() {
  ++sweep.asked;
  putLayer(sweep, "bodies");
}
async function showSweep() {
  const layer = layers.get("sweep");
  if (!layer || !layer.box.checked) return forgetSweep();
  if (!answer.id) return fillLegend(layer, [{words: answer.json && answer.json.verified ? pathUnnamed : "Shown where there is a path."}]);
  const mine = ++sweep.asked, view = viewWords(0.25, map.getZoom());
  const json = await toldOfPath(layer.account.of_path.replace("{id}", answer.id) + view, answer.json);
  if (mine !== sweep.asked) return;  // another path or place came meanwhile
  forgetSweep();
  if (json.error) return fillLegend(layer, [{words: json.error.message}]);
  drawSweep(layer, json);
}
function ringAt(json, [x, y, theta = 0]) {
  const cos = Math.cos(theta), sin = Math.sin(theta);
  return json.outline.map(([a, b]) => L.latLng(y + sin * a + cos * b, x + cos * a - sin * b));
}
/// Of a car that is a disc a line shows where it goes.
function bodyAt(json, place, style) {
  if (json.outline.length > 0) return [L.polygon(ringAt(json, place), style)];
  const at = [place[1], place[0]], body = L.circle(at, {...style, radius: json.radius});
  if (place.length < 3) return [body];
  return [body, L.polyline([at, [place[1] + json.radius * Math.sin(place[2]), place[0] + json.radius * Math.cos(place[2])]], style)];
}
function drawSweep(layer, json) {
  const color = document.documentElement.classList.contains("dark") ? "#5eead4" : "#0f766e";
  const style = {pane: "layer-sweep", color, weight: 1, opacity: 0.8, fillOpacity: 0.08, interactive: false};
  sweep.bodies = L.layerGroup(json.places.flatMap(place => bodyAt(json, place, style))).addTo(map);
  fillLegend(layer, [{color, words: world.robot + " along the path, every " + inUnit(json.apart) + " and at its end; " + grouped(json.places.length) + " in sight"}]);
}
