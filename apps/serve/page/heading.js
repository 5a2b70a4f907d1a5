// SPDX-License-Identifier: BSD-3-Clause
// Which way a body that turns faces at start and goal: an arrow at each mark, which is dragged around it; keys turn it.
// A goal without a heading has a ring instead, which becomes an arrow when it is dragged.
"use strict";
const handles = {};
const handleReach = 38;  // pixels from the mark
let turned = false;

const wrapped = degrees => degrees - 360 * Math.ceil((degrees - 180) / 360);
/// Sets it in degrees, to a tenth.
function setHeading(end, degrees) {
  question[end + "Heading"] = wrapped(Math.round(10 * degrees) / 10) * Math.PI / 180;
  showEnd(end);
  ask();
}
/// What the service is asked: a start that says nothing faces along x.
const headingShown = end => question[end + "Heading"] === null && end === "start" ? 0 : question[end + "Heading"];

function makeHandle(end) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg"), shape = document.createElementNS(svg.namespaceURI, "path");
  svg.setAttribute("viewBox", "-14 -14 28 28");
  svg.append(shape);
  const icon = L.divIcon({className: "handle " + end, iconSize: [28, 28], html: svg});
  const handle = L.marker([0, 0], {icon, draggable: true, keyboard: false, title: "heading of the " + end, zIndexOffset: 100});
  handle.shape = shape;
  handle.on("drag", event => {  // towards the pointer: Leaflet's own place is without the first move
    const pressed = event.originalEvent, finger = pressed.touches && pressed.touches[0];
    const mark = map.latLngToContainerPoint(marks[end].getLatLng()), at = map.mouseEventToContainerPoint(finger || pressed);
    setHeading(end, Math.atan2(mark.y - at.y, at.x - mark.x) * 180 / Math.PI);
  });
  handle.on("dragend", () => {
    turned = true;
    setTimeout(() => { turned = false; }, 0);
  });
  return handle;
}
/// Does this click end a turn? The pointer need not be on the arrow then, so the map is told of it.
const endsTurn = () => turned;
/// Puts the arrow to where the mark and its heading are.
function showHeading(end) {
  if (!handles[end]) return;
  if (!question[end] || !turns() || !map.hasLayer(marks[end])) return void handles[end].remove();
  const heading = headingShown(end), angle = heading === null ? 0 : heading;
  const mark = map.latLngToContainerPoint(latLng(question[end]));
  putMark(handles[end], placeOf(map.containerPointToLatLng(mark.add([handleReach * Math.cos(angle), -handleReach * Math.sin(angle)]))));
  handles[end].shape.setAttribute("d", heading === null ? "M -6 0 a 6 6 0 1 0 12 0 a 6 6 0 1 0 -12 0" : "M -26 0 H 2 M 0 -7 L 12 0 L 0 7 Z");
  handles[end].shape.setAttribute("transform", "rotate(" + -angle * 180 / Math.PI + ")");
  marks[end].getElement().setAttribute("aria-label", end + (heading === null ? ", any heading" : ", heading " + shown(angle * 180 / Math.PI) + " degrees"));
}
function turnsByKey(end, event) {
  const way = {"[": 1, "{": 1, "]": -1, "}": -1}[event.key];
  if (!way || !turns() || event.ctrlKey || event.metaKey) return;
  event.preventDefault();
  event.stopPropagation();
  setHeading(end, (headingShown(end) || 0) * 180 / Math.PI + way * (event.shiftKey ? 45 : 5));
}
function wireHeadings() {
  for (const end of ["start", "goal"]) {
    handles[end] = makeHandle(end);
    marks[end].on("add", () => marks[end].getElement().addEventListener("keydown", event => turnsByKey(end, event)));
  }
  map.on("zoomend", () => { showHeading("start"); showHeading("goal"); });
}
