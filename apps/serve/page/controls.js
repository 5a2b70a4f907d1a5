// SPDX-License-Identifier: BSD-3-Clause
// Everything around the map: fields, buttons, keys, the link that holds all of it, and what people take along. Words of
// files and of the service become text, never markup.
"use strict";
const marks = {};

const say = text => { byId("status").textContent = text; };

function fillTable(id, rows) {
  byId(id).tBodies[0].replaceChildren(...rows.map(([name, value]) => elementOf("tr", {}, elementOf("th", {}, name), elementOf("td", {}, String(value)))));
}
function asTime(ms) {
  if (ms < 0.9995) return (1000 * ms).toFixed(0) + " µs";
  const [time, unit] = ms < 999.5 ? [ms, " ms"] : [ms / 1000, " s"];
  return (time < 99.95 ? time.toPrecision(3) : grouped(time.toFixed(0))) + unit;
}

// Links of these stages, and CPU times, are in an answer, too.
const stageSums = ["read", "generate", "index", "sample", "neighbours", "connect", "graph", "reduce", "search", "optimise", "verify"];
const timeWords = {queue: "waiting", work: "work in all", "there and back": "with the network"};
function showAnswer(json, times) {
  showSearch();
  const rows = [];
  if (json) {
    const add = (name, value) => { if (value !== null && value !== undefined) rows.push([name, typeof value === "number" ? grouped(value) : value]); };
    add("length", json.verified ? shown(json.length) : null);
    add("cost", json.verified && json.price ? shown(json.cost) : null);
    for (const [part, cost] of Object.entries(json.verified && json.price || {})) if (cost > 0) add("of it " + part, shown(cost));
    add("other ways", json.alternatives && json.alternatives.length || null);
    add("clearance", json.verified && json.min_clearance !== null ? shown(json.min_clearance) : null);
    add("points", json.path_points || (json.path.length || null));
    add("verified", json.verified ? "yes" : null);
    add("planner", json.planner);
    add("milestones", json.roadmap.milestones || null);
    for (const [name, count] of Object.entries(json.counters)) if (count > 0) add(name.replaceAll("_", " "), count);
  }
  fillTable("figures", rows);
  const stages = json ? Object.entries(json.stages_s).filter(([name, s]) => s > 0 && stageSums.includes(name)).map(([name, s]) => [name, 1000 * s]) : [];
  fillTable("times", [...stages, ...times].map(([name, ms]) => [timeWords[name] || name, asTime(ms)]));
  const blocked = json && json.blocked && json.blocked.free_place ? json.blocked : null;
  const move = byId("move");
  move.hidden = !blocked;
  if (blocked) {
    move.textContent = "Move the " + blocked.end + " to where it fits, " + inUnit(blocked.distance) + " away";
    move.onclick = () => { setEnd(blocked.end, {x: blocked.free_place[0], y: blocked.free_place[1]}); };
  }
  for (const id of ["save-geojson", "save-csv"]) byId(id).disabled = !(json && json.verified);
  if (!json) showSweep();  // its words say why there is none
  byId("save-json").disabled = !json;
  byId("copy-command").disabled = !question.start || !question.goal;
}

/// Where an end is, in its field: x, y and of a body that turns its heading in degrees.
function fieldText(end) {
  const place = question[end], heading = question[end + "Heading"];
  if (!place) return "";
  return place.x + ", " + place.y + (turns() && heading !== null ? ", " + written(heading * 180 / Math.PI) : "");
}
function setEnd(end, place, keepsField) {
  question[end] = place && {x: rounded(place.x), y: rounded(place.y)};
  showEnd(end, keepsField);
  ask();
}
function showEnd(end, keepsField) {
  putMark(marks[end], question[end]);
  showHeading(end);
  showBodyAt(end);
  if (!keepsField) byId(end).value = fieldText(end);
  if (!question.start || !question.goal) {
    forgetAnswer();
    showAnswer(null, []);
    say(question.start ? "Click where to go." : question.goal ? "Click where to start." : "Click where to start, then where to go.");
  }
  keepLink();
}
function readField(end) {
  const text = byId(end).value.trim();
  const numbers = text.split(/[\s,;]+/).map(Number);
  if (text === "") return void setEnd(end, null);
  if (numbers.length < 2 || numbers.length > (turns() ? 3 : 2) || !numbers.every(Number.isFinite)) {
    return void say("The " + end + " is x, y" + (turns() ? " and degrees" : "") + ".");
  }
  question[end + "Heading"] = numbers.length > 2 ? numbers[2] * Math.PI / 180 : null;
  question[end] = {x: numbers[0], y: numbers[1]};  // as it was written
  showEnd(end, true);
  ask();
}

// The link: everything behind the #, so that it never leaves the browser. An end that is empty is none; where the link
// has neither, they are the world's own.
function linkText() {
  const words = [], at = map.getCenter();
  const state = end => question[end] ? stateOf(question[end], question[end + "Heading"]).join(",") : "";
  for (const end of ["start", "goal"]) words.push(end + "=" + state(end));
  for (const part of ["robot", "clearance", "planner"]) if (question[part]) words.push(part + "=" + encodeURIComponent(question[part]));
  for (const [word, text] of Object.entries(question.asked)) if (text) words.push(word + "=" + encodeURIComponent(text));
  if (question.optimise) words.push("optimise=1");
  if (shownLayers()) words.push("layers=" + shownLayers());
  if (hiddenParts()) words.push("hide=" + hiddenParts());
  words.push("at=" + [rounded(at.lng), rounded(at.lat), Number(map.getZoom().toFixed(3))].join(","));
  return "#" + words.join("&");
}
/// The address follows, at once but for long drags: browsers stop pages that write it hundreds of times in some seconds.
/// So 25 times at a stretch, then twice a second, the last time for sure.
const linkWrites = {left: 25, counted: 0, timer: null};
function keepLink() {
  const now = performance.now();
  linkWrites.left = Math.min(25, linkWrites.left + (now - linkWrites.counted) / 500);
  linkWrites.counted = now;
  if (linkWrites.left < 1) {
    linkWrites.timer ||= setTimeout(() => { linkWrites.timer = null; keepLink(); }, 500);
    return;
  }
  linkWrites.left -= 1;
  history.replaceState(null, "", linkText());
}
let linksTaken = 0;
async function takeLink() {
  const words = new URLSearchParams(location.hash.slice(1)), number = ++linksTaken;
  const body = ["robot", "clearance"].map(part => world.opened_as !== "roadmap" && words.get(part) || "");  // a roadmap's body stays
  if (body.some(word => word)) fitWhole({animate: false});  // another body is drawn where it is seen
  await takeBody(...body);
  if (number !== linksTaken) return;  // a newer one came meanwhile
  readLink(words);
  showQuestion();
}
function readLink(words) {
  const numbers = name => (words.get(name) || "").split(",").filter(word => word !== "").map(Number);
  for (const end of ["start", "goal"]) {
    const state = numbers(end);
    const isState = state.length >= 2 && state.length <= world.state_size && state.every(Number.isFinite);
    question[end] = isState ? {x: state[0], y: state[1]} : null;
    question[end + "Heading"] = isState && state.length > 2 ? state[2] : null;
  }
  if (!words.has("start") && !words.has("goal")) takeOwnEnds();
  question.planner = world.planners.includes(words.get("planner")) ? words.get("planner") : "";
  question.optimise = words.get("optimise") === "1";
  for (const word in question.asked) question.asked[word] = world.opened_as === "world" && words.get(word) || "";
  takeLayers(words.get("layers"));
  hideParts(words.get("hide"));
  const at = numbers("at");
  const isNear = at.length === 3 && at.every(Number.isFinite) && map.whole.pad(2).contains([at[1], at[0]]);  // else nothing would be seen
  if (isNear) map.setView([at[1], at[0]], at[2], {animate: false});
  else fitWhole({animate: false});
}
// What moves: the service's own body, where the fields say nothing.
const withBody = mark => ["robot", "clearance"].filter(part => question[part]).map((part, i) => (i ? "&" : mark) + part + "=" + encodeURIComponent(question[part])).join("");
async function takeBody(robot, clearance) {
  if (robot === question.robot && clearance === question.clearance) return false;
  Object.assign(question, {robot, clearance});
  return takeWorld();
}
async function readBody() {
  if (!await takeBody(byId("robot").value.trim(), byId("clearance-asked").value.trim())) ask();
  keepLink();
}
/// Leaves what somebody types.
function fillField(id, text) {
  const field = byId(id), isTyped = field === document.activeElement && field.value !== (field.dataset.filled || "");
  if (!isTyped || field.value.trim() === text) field.value = field.dataset.filled = text;
}
/// other: what of the world is of the body that is asked; of one that can't be, nothing is drawn.
function showBody(other) {
  Object.assign(world, other);
  if (map) showGround();
  byId("about").textContent = [world.description, ...(world.robot ? [world.robot] : []), ...(world.clearance > 0 ? ["clearance " + shown(world.clearance)] : [])].join(", ");
  fillField("robot", question.robot);
  fillField("clearance-asked", question.clearance);
  byId("planner").replaceChildren(new Option("usual", ""), ...world.planners.map(planner => new Option(planner, planner)));
  byId("planners").hidden = world.planners.length === 0;
  if (!world.planners.includes(question.planner)) question.planner = "";
  byId("planner").value = question.planner;
  for (const end of ["start", "goal"]) {
    byId(end).placeholder = turns() ? (end === "start" ? "x, y, degrees" : "x, y, degrees or none") : "x, y";
    if (marks[end]) showEnd(end, byId(end) === document.activeElement);
  }
}
/// The world's own ends, where it has some.
function takeOwnEnds() {
  for (const end of ["start", "goal"]) {
    const state = world[end];
    if (state.length < 2) continue;
    question[end] = {x: state[0], y: state[1]};
    question[end + "Heading"] = state.length > 2 && turns() ? state[2] : null;
  }
}
function showQuestion() {
  byId("planner").value = question.planner;
  byId("optimise").checked = question.optimise;
  for (const word in question.asked) byId(word).value = question.asked[word];
  if (Object.values(question.asked).some(text => text)) byId("more").open = true;
  showEnd("start");
  showEnd("goal");
  ask();
}

// What people take along.
const quoted = word => /^[-\w.,:=/+@%]+$/.test(word) ? word : "'" + word.replaceAll("'", "'\\''") + "'";
const isDrawn = () => world.changed && !world.cells_writable;  // cells of a map are no scene
function commandText() {
  const words = ["warren", world.opened_as === "roadmap" && !isDrawn() ? "query" : "solve", isDrawn() ? "world.scene" : world.source];
  if (world.opened_as === "world") {  // of a body that was refused: as it was asked
    const robot = world.robot || question.robot || byId("robot").placeholder;
    const clearance = world.robot ? String(world.clearance) : question.clearance || byId("clearance-asked").placeholder;
    if (robot) words.push("--robot", robot);
    words.push("--clearance", clearance);
  }
  words.push("--start", stateOf(question.start, question.startHeading === null ? 0 : question.startHeading).join(","));
  words.push("--goal", stateOf(question.goal, question.goalHeading).join(","));
  if (question.planner) words.push("--planner", question.planner);
  const asked = askedOptions(question.asked), own = world.options;  // in pairs; of two words for one thing the page's counts
  for (let i = 0; i < own.length; i += 2) if (own[i] === "--area" || !asked.includes(own[i])) words.push(own[i], own[i + 1]);
  words.push(...asked);
  if (question.optimise) words.push("--optimise");
  return words.map(quoted).join(" ");
}
async function copy(text) {
  const field = byId("copied");
  field.value = text;
  field.hidden = false;
  field.select();
  try {
    await navigator.clipboard.writeText(text);
  } catch (error) {  // it is there to be copied by hand
  }
}
function save(name, type, text) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], {type}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
/// make(answer, path): the states of the path, those of a long one as points. Where the service has let the path go,
/// the question is asked anew first.
async function savePath(make) {
  const of = answer.json, asked = answer.asked;
  if (of.path.length > 0) return make(of, asDriven(of.path));
  if (!answer.id) return void say(pathUnnamed);
  let reply, json;
  try {
    reply = await fetch("api/path/" + answer.id);
    json = await reply.json();
  } catch (error) {
    return void say("The service does not answer any more.");
  }
  if (reply.ok) looked(reply, of);
  if (reply.ok) return make(of, json.chains.flat());
  if (reply.status === 413) return void say("This path has more points than the page saves; the line of Copy as command writes it, with --path FILE.");
  if (reply.status !== 404) return void say(json.error.message);
  if (of !== answer.json && asked === answer.asked) return savePath(make);  // it was asked anew meanwhile
  if (looked(reply, of)) lost.saving = {asked, make};
  else if (of === answer.json) say("The service does not keep this path, so it can't be saved.");
}
function saveGeojson(of, path) {
  const line = path.length === 1 ? [path[0], path[0]] : path;
  const properties = {frame: "map", length: of.length, planner: of.planner};
  if (path[0].length === 3) properties.theta = line.map(p => p[2]);
  save("path.geojson", "application/geo+json", JSON.stringify({type: "Feature", geometry: {type: "LineString", coordinates: line.map(p => [p[0], p[1]])}, properties}) + "\n");
}
function saveCsv(of, path) {
  let along = 0;
  const rows = path.map((p, i) => {
    if (i > 0) along += Math.hypot(p[0] - path[i - 1][0], p[1] - path[i - 1][1]);
    return along + "," + p.join(",");
  });
  save("path.csv", "text/csv", (path[0].length === 3 ? "s,x,y,theta\n" : "s,x,y\n") + rows.join("\n") + "\n");
}

function setDark(on) {
  document.documentElement.classList.toggle("dark", on);
  byId("dark").setAttribute("aria-pressed", String(on));
  graphLayer.draw();
  showSweep();
  for (const end of ["start", "goal"]) showBodyAt(end);
  for (const line of [pathLine.line, pathLine.others]) if (line) line.setStyle({color: pathColor()});
}
function wireControls() {
  byId("question").addEventListener("submit", event => { event.preventDefault(); ask(); });
  for (const end of ["start", "goal"]) byId(end).addEventListener("change", () => readField(end));
  byId("planner").addEventListener("change", event => { question.planner = event.target.value; keepLink(); ask(); });
  for (const id of ["robot", "clearance-asked"]) byId(id).addEventListener("change", readBody);
  for (const word in question.asked) byId(word).addEventListener("change", event => { question.asked[word] = event.target.value.trim(); keepLink(); ask(); });
  byId("optimise").addEventListener("change", event => { question.optimise = event.target.checked; keepLink(); ask(); });
  byId("swap").addEventListener("click", () => {
    for (const part of ["", "Heading"]) [question["start" + part], question["goal" + part]] = [question["goal" + part], question["start" + part]];
    showQuestion();
  });
  byId("clear").addEventListener("click", () => { question.start = question.goal = question.startHeading = question.goalHeading = null; showQuestion(); });
  byId("copy-command").addEventListener("click", () => {
    copy(commandText());
    if (world.changed) say(isDrawn() ? "The command asks the scene that is drawn; save it as world.scene." : "The command asks the file, without the cells that were changed.");
  });
  byId("copy-link").addEventListener("click", () => copy(location.origin + location.pathname + linkText()));
  byId("save-geojson").addEventListener("click", () => savePath(saveGeojson));
  byId("save-csv").addEventListener("click", () => savePath(saveCsv));
  byId("save-json").addEventListener("click", () => save("answer.json", "application/json", answer.text));
  byId("whole").addEventListener("click", () => fitWhole());
  byId("dark").addEventListener("click", () => setDark(!document.documentElement.classList.contains("dark")));
  for (const part of parts) byId("show-" + part).addEventListener("change", () => { showParts(); keepLink(); });
}
function wireMap() {
  for (const end of ["start", "goal"]) marks[end] = makeMark(end, place => setEnd(end, place));
  map.on("click", event => endsTurn() || measures(event) || drawsClick(event) || takesClick(event) || setEnd(question.start && !event.originalEvent.shiftKey ? "goal" : "start", placeOf(event.latlng)));
  map.on("moveend", keepLink);
  byId("map").addEventListener("keydown", event => {
    const end = {s: "start", g: "goal"}[event.key];
    if (end && !event.ctrlKey && !event.metaKey && !event.altKey) setEnd(end, placeOf(map.getCenter()));
  });
  window.addEventListener("hashchange", () => { takeToken(); takeLink(); });
}
async function begin() {
  takeToken();
  world = await (await fetch("api/world")).json();
  const name = world.source.split("/").pop();
  document.title = name + " – warren";
  byId("title").textContent = name;
  byId("robot").placeholder = world.robot;
  byId("clearance-asked").placeholder = String(world.clearance);
  for (const row of document.querySelectorAll(".of-body")) row.hidden = world.opened_as === "roadmap";
  showBody({});
  setDark(matchMedia("(prefers-color-scheme: dark)").matches);
  openMap();
  wireLayers();
  wireControls();
  wireMap();
  wireHeadings();
  wireMeasuring();
  wireClearance();
  wireGraph();
  wireDrawing();
  takeLink();
}
begin();
