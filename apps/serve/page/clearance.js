// SPDX-License-Identifier: BSD-3-Clause
// The room around the body along the path: a chart, a place on the path by pointer or keys, and the same in words.
"use strict";
const profile = {places: [], id: null, dot: null};
const chart = {width: 280, height: 90, samples: 200};

async function showClearance() {
  if (!byId("clearance").open || !answer.id || profile.id === answer.id) return;
  const id = profile.id = answer.id;
  const json = await toldOfPath("api/path/" + id + "/clearance?samples=" + chart.samples, answer.json);
  if (id !== answer.id) return;  // another path came meanwhile
  if (json.error) return void (byId("clearance-text").textContent = json.error.message);
  const free = json.places.filter(place => place.clearance !== null);
  if (free.length === 0) return void (byId("clearance-text").textContent = "Nothing stands anywhere near.");
  profile.places = free;
  drawChart();
  const at = byId("clearance-at");
  at.max = free.length - 1;
  at.value = free.reduce((least, place, i) => place.clearance < free[least].clearance ? i : least, 0);
  showChart(true);
  showClearanceAt();
}
function forgetClearance() {
  profile.places = [];
  profile.id = null;
  putLayer(profile, "dot");
  showChart(false);
  byId("clearance-text").textContent = "";
}
/// SVG has no `hidden` of its own.
const showChart = on => { for (const id of ["clearance-at", "clearance-chart", "clearance-most", "clearance-ends"]) byId(id).toggleAttribute("hidden", !on); };
const chartX = place => chart.width * place.along / (profile.places[profile.places.length - 1].along || 1);
function drawChart() {
  const most = Math.max(...profile.places.map(place => place.clearance)) || 1;
  const line = profile.places.map(place => chartX(place).toFixed(1) + "," + (chart.height * (1 - place.clearance / most)).toFixed(1));
  byId("clearance-most").textContent = "clearance, 0 to " + inUnit(most);
  byId("clearance-end").textContent = "after " + inUnit(profile.places[profile.places.length - 1].along);
  byId("clearance-line").setAttribute("points", ["0," + chart.height, ...line, chart.width + "," + chart.height].join(" "));
}
function showClearanceAt() {
  const place = profile.places[Number(byId("clearance-at").value)];
  if (!place) return;
  const clearances = profile.places.map(p => p.clearance);
  const mean = clearances.reduce((sum, c) => sum + c, 0) / clearances.length;
  const here = inUnit(place.clearance) + " after " + inUnit(place.along);
  byId("clearance-text").textContent = here + "; least " + inUnit(Math.min(...clearances)) + ", mean " + inUnit(mean);
  byId("clearance-at").setAttribute("aria-valuetext", here);
  for (const end of ["x1", "x2"]) byId("clearance-here").setAttribute(end, chartX(place));
  const at = latLng({x: place.at[0], y: place.at[1]});
  if (profile.dot) profile.dot.setLatLng(at);
  else profile.dot = L.circleMarker(at, {radius: 6, color: "#0891b2", interactive: false}).addTo(map);
}
function wireClearance() {
  byId("clearance").addEventListener("toggle", () => {
    forgetClearance();
    showClearance();
  });
  byId("clearance-at").addEventListener("input", showClearanceAt);
  byId("clearance-chart").addEventListener("pointermove", event => {
    const box = byId("clearance-chart").getBoundingClientRect(), x = chart.width * (event.clientX - box.left) / box.width;
    const off = profile.places.map(place => Math.abs(chartX(place) - x));
    byId("clearance-at").value = off.indexOf(Math.min(...off));
    showClearanceAt();
  });
}
