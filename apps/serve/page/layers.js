// SPDX-License-Identifier: BSD-3-Clause
// Layers above the world, as the service draws them: a check box each with what its colours mean, or why this world
// has none.
"use strict";
const layers = new Map();  // by name: its account in `world`, and its elements and tiles on this page

function elementOf(kind, properties, ...children) {
  const element = Object.assign(document.createElement(kind), properties);
  element.append(...children);
  return element;
}
function makeLayer(account) {
  const id = "layer-" + account.name, pane = map.createPane(id);
  pane.style.zIndex = 210 + layers.size;
  pane.style.pointerEvents = "none";
  const layer = {account, tiles: null, row: elementOf("div", {className: "row"}), box: elementOf("input", {type: "checkbox", id}), words: elementOf("ul", {className: "legend " + account.name, id: id + "-legend"})};
  layer.box.setAttribute("aria-describedby", layer.words.id);
  layer.words.setAttribute("aria-live", "polite");
  layer.box.addEventListener("change", () => { showLayer(layer); keepLink(); });
  layer.row.append(elementOf("label", {}, layer.box, " " + account.name));
  return layer;
}
/// Screen readers read it out when it changes, so it does so only where it says something else.
function fillLegend(layer, entries) {
  const text = JSON.stringify(entries);
  if (text === layer.text) return;
  layer.text = text;
  layer.words.replaceChildren(...entries.map(({color, words}) => {
    const line = elementOf("li", {}, words.replace(/(\d) (?=\d{3}(?!\d))/g, "$1\u00a0"));  // no line ends in a number
    if (color) line.prepend(elementOf("span", {className: "ink"}));
    if (color) line.firstChild.style.background = color;
    return line;
  }));
}
/// Of a layer that goes out from the start: with the start of the last answer.
const withStart = (account, address) => account.of_start ? address + "?from=" + answer.start : address;
async function showLegend(layer) {
  const account = layer.account, start = answer.start;
  const told = await fetch(withStart(account, account.legend)).then(reply => reply.json(), () => ({error: {message: "The service does not answer any more."}}));
  if (account !== layer.account || !layer.box.checked || (account.of_start && start !== answer.start)) return;
  const far = account.from_zoom > 0 && map.getZoom() < account.from_zoom && !told.error ? [{words: "Zoom in to see it."}] : [];
  fillLegend(layer, told.error ? [{words: told.error.message}] : [...told, ...far]);
}
function showLayer(layer) {
  const {account, box} = layer, t = world.tiles;
  putLayer(layer, "tiles");
  layer.shownFrom = answer.start;
  box.disabled = !account.there;
  if (!account.there) box.checked = false;
  fillLegend(layer, account.there ? [] : [{words: "None: " + account.why + "."}]);
  if (account.of_path) return void showSweep();
  if (!box.checked) return;
  if (account.of_start && !answer.start) return fillLegend(layer, [{words: "Shown where there is an answer."}]);
  layer.tiles = L.tileLayer(withStart(account, account.url), {pane: "layer-" + account.name, tileSize: t.pixels, minZoom: account.from_zoom > 0 ? account.from_zoom : -3, maxZoom: t.levels,
                                          minNativeZoom: 0, maxNativeZoom: t.levels - 1, bounds: map.whole, noWrap: true, keepBuffer: 1, updateInterval: 60, className: "layer " + account.name});
  layer.tiles.on("tileerror", async () => {
    if (!await noticeWorld()) say("A part of the layer " + account.name + " was not drawn; move or zoom to ask again.");
  });
  layer.tiles.addTo(map);
  showLegend(layer);
}
/// After another answer, or none.
function showSearch() {
  const layer = layers.get("search");
  if (layer && layer.shownFrom !== answer.start) showLayer(layer);
}
/// Those of the world as it is now.
function renewLayers() {
  for (const account of world.layers) {
    if (!layers.has(account.name)) layers.set(account.name, makeLayer(account));
    const layer = layers.get(account.name);
    layer.account = account;
    byId(account.there ? "layers" : "layers-none").append(layer.row, layer.words);
    showLayer(layer);
  }
  const none = world.layers.filter(account => !account.there).length;
  byId("layers-folded").hidden = none === 0;
  byId("layers-none-count").textContent = "Not for this world (" + none + ")";
}
/// For the link: the names of those that are shown.
const shownLayers = () => [...layers].filter(([, layer]) => layer.box.checked).map(([name]) => name).join(",");
function takeLayers(names) {
  for (const [name, layer] of layers) {
    const isShown = (names || "").split(",").includes(name);
    if (isShown === layer.box.checked) continue;
    layer.box.checked = isShown;
    showLayer(layer);
  }
}
function wireLayers() {
  renewLayers();
  map.on("moveend", showSweep);
  map.on("zoomend", () => { for (const layer of layers.values()) if (layer.tiles && layer.account.from_zoom > 0) showLegend(layer); });
}
