// SPDX-License-Identifier: BSD-3-Clause
// Tables sorted by a click on a head; what a mark of a plot stands for is shown beside the pointer.
"use strict";
const units = {ns: 1e-9, us: 1e-6, "µs": 1e-6, ms: 1e-3, s: 1, min: 60, h: 3600, KiB: 2 ** 10, MiB: 2 ** 20, GiB: 2 ** 30};
/// "1.5 ms" as 0.0015; words, and what is not known, after all numbers.
function weight(text) {
  const found = text.replaceAll(",", "").match(/^([+-]?[\d.]+(?:e[+-]?\d+)?)\s*(\S*)/i);
  return found ? Number(found[1]) * (units[found[2]] ?? 1) : Infinity;
}
function sort(table, column, descending) {
  const body = table.tBodies[0], rows = [...body.rows], text = row => row.cells[column].textContent;
  const heads = [...table.tHead.rows[0].cells];
  rows.sort((a, b) => (descending ? -1 : 1) * (weight(text(a)) - weight(text(b)) || text(a).localeCompare(text(b), "en")));
  rows.sort((a, b) => (text(a) === "-") - (text(b) === "-"));
  body.append(...rows);
  heads.forEach((head, i) => i === column ? head.setAttribute("aria-sort", descending ? "descending" : "ascending") : head.removeAttribute("aria-sort"));
}
for (const table of document.querySelectorAll("table")) {
  [...table.tHead.rows[0].cells].forEach((head, column) => {
    head.firstElementChild.addEventListener("click", () => sort(table, column, head.getAttribute("aria-sort") === "ascending"));
  });
}

const tip = document.createElement("div");
tip.id = "tip";
tip.hidden = true;
document.body.append(tip);
function nearestMark(svg, x, y) {
  let best = null, least = 24;
  for (const mark of svg.querySelectorAll("[data-tip]")) {
    const box = mark.getBoundingClientRect(), d = Math.hypot(box.x + box.width / 2 - x, box.y + box.height / 2 - y);
    if (d < least || x >= box.left && x <= box.right && y >= box.top && y <= box.bottom) { least = Math.min(d, least); best = mark; }
  }
  return best;
}
for (const svg of document.querySelectorAll(".plots svg")) {
  const show = event => {
    const mark = nearestMark(svg, event.clientX, event.clientY);
    tip.hidden = !mark;
    if (!mark) return;
    tip.textContent = mark.dataset.tip;
    tip.style.left = Math.min(event.clientX + 14, innerWidth - tip.offsetWidth - 8) + "px";
    tip.style.top = event.clientY + 14 + "px";
  };
  svg.addEventListener("pointermove", show);
  svg.addEventListener("pointerdown", show);
  svg.addEventListener("pointerleave", () => { tip.hidden = true; });
}
