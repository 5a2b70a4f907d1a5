// SPDX-License-Identifier: BSD-3-Clause
// Planners that get better with time: while one is at work its paths are drawn as they come, the older the fainter; beside
// its answer a slider shows them again. A new question ends the one before.
"use strict";
const better = {watch: null, abort: null, ways: [], lines: null};
const getsBetter = planner => ["rrt-star", "informed-rrt-star", "anytime"].includes(planner);
const betterBudget = 3000;  // milliseconds

/// What goes with the question beside its body; nothing for planners with one answer.
function beginWatching() {
  hideWays();
  better.ways = [];
  if (!getsBetter(question.planner)) return {};
  better.watch = "page-" + Math.random().toString(36).slice(2);
  better.abort = new AbortController();
  watchWays(better.watch);
  return {watch: better.watch};
}
function endWatching() {
  better.watch = better.abort = null;
}
async function watchWays(name) {
  for (let from = 0; better.watch === name;) {
    await new Promise(ready => setTimeout(ready, 200));
    try {
      const told = await (await fetch("api/progress?watch=" + name + "&from=" + from)).json();
      if (!told.running) continue;  // not yet, or no more
      from = told.first + told.improvements.length;
      if (better.watch !== name || told.improvements.length === 0) continue;
      better.ways.push(...told.improvements);
      clearPath();
      drawWays(better.ways.length);
      say(wayInWords(better.ways[better.ways.length - 1]) + " until now.");
    } catch (error) {
      return;  // the question itself says that the service is gone
    }
  }
}
function wayInWords(way) {
  const gap = way.lower_bound ? 100 * Math.max(0, way.cost / way.lower_bound - 1) : null;
  return "Length " + inUnit(way.length) + (gap === null ? "" : ", at most " + Number(gap.toPrecision(2)) + " % more than the best");
}
/// The first `count` of them: the last one plainly, some before it faintly.
function drawWays(count) {
  hideLines();
  const shownWays = better.ways.slice(Math.max(0, count - 8), count);
  better.lines = L.layerGroup(shownWays.map((way, i) => {
    const newest = i + 1 === shownWays.length, points = way.chains.map(chain => chain.map(p => L.latLng(p[1], p[0])));
    return L.polyline(points, {color: pathColor(), weight: newest ? 3 : 2, opacity: newest ? 0.9 : 0.1 + 0.4 * i / shownWays.length, interactive: false});
  })).addTo(map);
}
const hideLines = () => putLayer(better, "lines");
function hideWays() {
  hideLines();
  byId("better").hidden = true;
}
/// Beside the answer: at the right end of the slider is its own path.
function showWays(json) {
  hideWays();
  if (!json.verified || better.ways.length === 0) return;
  const slider = byId("better-at");
  byId("better").hidden = false;
  slider.max = slider.value = better.ways.length;
  showWayAt(better.ways.length);
}
function showWayAt(i) {
  const way = better.ways[i];
  if (way) drawWays(i + 1);
  else hideLines();
  if (pathLine.line) pathLine.line.setStyle({opacity: way ? 0.15 : 0.9});
  const words = way ? wayInWords(way) + ", by " + way.by + " after " + shown(way.seconds) + " s, turn " + way.iterations : "The answer's own path.";
  byId("better-text").textContent = words;
  byId("better-at").setAttribute("aria-valuetext", words);
}
document.addEventListener("DOMContentLoaded", () => byId("better-at").addEventListener("input", event => showWayAt(Number(event.target.value))));
