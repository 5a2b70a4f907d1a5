// SPDX-License-Identifier: BSD-3-Clause
// The question, and the answer to it. While an answer is under way the latest question waits, so that a drag asks as
// often as answers come.
"use strict";
const question = {robot: "", clearance: "", asked: {price: "", unknown: "", tolerance: "", ways: ""}, start: null, goal: null, planner: "", optimise: false, startHeading: null, goalHeading: null};
const answer = {text: null, json: null, id: null, start: null, asked: null};  // asked: the question, as it was sent
// The path that the service had let go last, and the answer that it was of; what shall be saved when it is there again.
const lost = {id: null, json: null, saving: null};
let asking = false;
let askAgain = false;

const turns = () => world.state_size === 3;
function stateOf(place, heading) {
  const state = [place.x, place.y];
  if (turns() && heading !== null) state.push(heading);
  return state;
}
function bodyOf(q) {
  const body = {start: stateOf(q.start, q.startHeading === null ? 0 : q.startHeading), goal: stateOf(q.goal, q.goalHeading), optimise: q.optimise};
  if (q.planner) body.planner = q.planner;
  if (getsBetter(q.planner)) body.budget_ms = betterBudget;
  if (q.robot) body.robot = q.robot;
  if (q.clearance) body.clearance = Number(q.clearance);
  const {price, unknown, tolerance, ways} = q.asked, prices = [];
  if (price) prices.push("clearance-price " + price.replaceAll(",", " "));
  if (unknown) prices.push("unknown " + unknown);
  if (prices.length) body.prices = prices;
  if (tolerance) body.goal_tolerance = tolerance === "inf" ? "inf" : Number(tolerance);
  if (ways) body.alternatives = Number(ways);
  return body;
}
/// The same as options of the command line.
function askedOptions(asked) {
  const options = {price: "--clearance-price", unknown: "--unknown", tolerance: "--goal-tolerance", ways: "--alternatives"};
  return Object.keys(options).filter(word => asked[word]).flatMap(word => [options[word], asked[word].replace(/[\s,]+/g, ",")]);
}

/// Milliseconds by name, as Server-Timing has them.
function serverTimes(reply) {
  return (reply.headers.get("Server-Timing") || "").split(",").map(part => {
    const [name, time] = part.trim().split(";dur=");
    return [name, Number(time)];
  }).filter(([name]) => name);
}

async function ask() {
  if (!question.start || !question.goal) return;
  if (asking) {
    if (better.abort) better.abort.abort();  // it would take all its time
    return void (askAgain = true);
  }
  asking = true;
  await taken;  // another body, another world
  askAgain = false;
  if (!question.start || !question.goal) return void (asking = false);  // taken away meanwhile
  const began = performance.now(), asked = JSON.stringify(bodyOf(question));
  try {
    const body = JSON.stringify({...JSON.parse(asked), ...beginWatching()}), signal = better.abort ? better.abort.signal : undefined;
    const reply = await fetch("api/query", {method: "POST", headers: {"Content-Type": "application/json"}, body, signal});
    const text = await reply.text();
    endWatching();
    take(reply, text, performance.now() - began, asked);
  } catch (error) {
    if (error.name !== "AbortError") {
      forgetAnswer();
      showAnswer(null, []);
      say("The service does not answer any more.");
    }
  }
  endWatching();
  asking = false;
  if (askAgain) {
    askAgain = false;
    ask();
  }
}
function forgetAnswer() {
  clearPath();
  hideWays();
  forgetClearance();
  forgetSweep();
  answer.text = answer.json = answer.id = answer.start = answer.asked = null;
  tellWhy([]);
}
function tellWhy(lines) {
  byId("why").replaceChildren(...lines.map(words => elementOf("li", {}, words)));
  byId("why").hidden = lines.length === 0;
}
/// The question once more, for what stood in the way and what would likely help.
async function askWhy(asked) {
  const of = answer.json;
  let json;
  try {
    json = await (await fetch("api/query", {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify({...JSON.parse(asked), explain: true})})).json();
  } catch (error) {
    return;  // the answer stands; the next question says that the service is gone
  }
  if (of !== answer.json || !json.explained) return;
  const gap = json.components, lines = [];
  if (gap) lines.push("The gap between what start and goal reach is " + inUnit(gap.nearest_gap) + " wide.");
  for (const hint of json.explained.hints) lines.push(hint.options.length ? "On the command line " + hint.options.join(" ") + " might help: " + hint.why + "." : "What might help: " + hint.why + ".");
  tellWhy(lines);
}
function take(reply, text, passed, asked) {
  const json = JSON.parse(text), saving = lost.saving;
  lost.saving = null;
  if (json.world && json.world.hash !== world.hash) noticeWorld();
  forgetAnswer();
  if (!question.start || !question.goal) return;  // taken away meanwhile
  if (json.error) {
    say(json.error.message);
    return showAnswer(null, []);
  }
  answer.text = text;
  answer.json = json;
  answer.asked = asked;
  answer.start = json.status === "start_blocked" ? null : json.start.slice(0, 2).join(",");
  answer.id = reply.headers.get("Warren-Path");
  if (answer.id || json.verified) showPath(asDriven(json.path).map(p => [p[0], p[1]]), answer.id);
  showOtherWays(json.alternatives || []);
  say(inWords(json) + (json.verified && !answer.id ? ". " + pathUnnamed : ""));
  showWays(json);
  showAnswer(json, [...serverTimes(reply), ["there and back", passed]]);
  showClearance();
  showSweep();
  showBodyAt("goal");  // as it arrives, where any heading will do
  if (json.status === "not_connected" && !askAgain) askWhy(asked);
  if (saving && saving.asked === asked && json.verified) savePath(saving.make);
}

/// Some proxies leave the field Warren-Path out. Then the points that the answer lists are drawn, and no more can be asked.
const pathUnnamed = "What stands between here and the service leaves out the field Warren-Path, so no more of this path can be seen.";

/// Each look at the path of an answer ends here. The service keeps the last paths alone: where it let this one go, the
/// question is asked anew, but once until it is seen, for a path that is too large is never kept. True where another
/// answer is under way.
function looked(reply, json) {
  if (json !== answer.json) return false;
  if (json === lost.json) return asking;
  if (reply.ok) lost.id = null;
  if (reply.status !== 404) return false;
  const asksAnew = lost.id !== answer.id;
  lost.id = answer.id;
  lost.json = json;
  if (asksAnew) ask();
  else say("The service does not keep this path, so no more of it can be seen.");
  return asksAnew;
}

/// What the service tells of the path of an answer, as JSON; of one that it does not tell, an error.
async function toldOfPath(address, of) {
  try {
    const reply = await fetch(address);
    looked(reply, of);
    return await reply.json();
  } catch (error) {
    return {error: {message: "The service does not answer any more."}};
  }
}

/// As the program writes numbers: six significant digits, and all before the point.
const written = number => String(Math.abs(number) >= 1e6 && Math.abs(number) < 1e15 ? Math.round(number) : Number(number.toPrecision(6)));
/// What is before the point in groups of three, as the program groups counts; no line ends between them.
const grouped = text => String(text).replace(/^(-?)(\d+)/, (_, sign, whole) => sign + whole.replace(/\B(?=(\d{3})+$)/g, "\u00a0"));
const shown = number => grouped(written(number));
function inWords(json) {
  const reached = json.goal_reached && json.goal_reached.distance > 0 ? ", " + inUnit(json.goal_reached.distance) + " from the goal" : "";
  if (json.status === "solved") return "Solved: " + inUnit(json.length) + (json.optimal ? ", the shortest there is" : "") + reached;
  if (json.status === "start_blocked") return "The body does not fit at the start" + reason(json);
  if (json.status === "goal_blocked") return "The body does not fit at the goal" + reason(json);
  if (json.status === "not_connected") return "No path was found.";
  if (json.status === "infeasible") return "There is no path.";
  return json.status;
}
function reason(json) {
  if (!json.blocked) return ".";
  return ": " + json.blocked.by + (json.blocked.hint ? "; " + json.blocked.hint : "") + ".";
}
