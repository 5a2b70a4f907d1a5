#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""From a click to the path on the screen: service_click.py PROGRAM WORLD [--pairs N]

Needs Debian's chromium, chromium-driver and python3-selenium. Serves WORLD, a roadmap say, and shows the whole of it in a headless
Chromium. For N random pairs of places (default 30) it clicks the start, then the goal, and takes the milliseconds from this second
click's event until two frames after the path was drawn. Prints median and worst of it, of its parts (question, view of the path, the
browser's own work), of points and of the process's CPU. The page's own first question, which may wait for what others don't, is not in it."""

import argparse
import os
import random
import statistics
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
for folder in ("browser", "acceptance"):
    sys.path.insert(0, os.path.join(HERE, "..", "tests", folder))
from browser import start  # noqa: E402
from service import Service  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402

WATCH = """
window.clicked = 0;
window.drawn = null;
document.addEventListener("click", event => { window.clicked = event.timeStamp; window.drawn = null; performance.clearResourceTimings(); }, true);
const draw = window.drawChains;
window.drawChains = chains => {
  const begun = performance.now();
  draw(chains);
  const points = chains.reduce((sum, chain) => sum + chain.length, 0);
  const told = performance.now();
  requestAnimationFrame(() => requestAnimationFrame(() => {
    const took = name => performance.getEntriesByType("resource").filter(e => e.name.includes(name)).reduce((sum, e) => sum + e.duration, 0);
    window.drawn = {whole: performance.now() - window.clicked, question: took("/api/query"), view: took("/api/path"),
                    lines: told - begun, frames: performance.now() - told, seen: points};
  }));
};
"""


def cpu_ms(pid):
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        words = file.read().rsplit(")", 1)[1].split()
    return 1e3 * (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def waited(holds, seconds=60.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = holds()
        if value:
            return value
        time.sleep(0.02)
    raise SystemExit("the page does not draw the path")


def figures(browser, pid, draw):
    """Of a click on a new goal; nothing where no path is to be had."""
    browser.execute_script("byId('clear').click()")
    size = browser.execute_script("const p = a => map.latLngToContainerPoint(a), s = map.whole; return [p(s.getNorthWest()), p(s.getSouthEast())].map(q => [q.x, q.y])")
    box = browser.execute_script("const b = map.getContainer().getBoundingClientRect(); return [b.width / 2, b.height / 2]")
    element = browser.find_element(By.ID, "map")
    places = [[round(draw.uniform(size[0][k] + 3, size[1][k] - 3) - box[k]) for k in range(2)] for _ in range(2)]
    ActionChains(browser).move_to_element_with_offset(element, *places[0]).click().perform()
    before = cpu_ms(pid)
    ActionChains(browser).move_to_element_with_offset(element, *places[1]).click().perform()
    waited(lambda: browser.execute_script("return window.drawn || document.getElementById('status').textContent.includes('fit')"))
    found = browser.execute_script("return window.drawn")
    if found is None:
        return None
    points = browser.execute_script("return answer.json.path_points || answer.json.path.length")
    rest = found["whole"] - found["question"] - found["view"]
    return {"click to path": found["whole"], "question": found["question"], "view": found["view"], "browser": rest, "of it lines": found["lines"],
            "of it frames": found["frames"], "server CPU": cpu_ms(pid) - before, "points": points, "points drawn": found["seen"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("world")
    parser.add_argument("--pairs", type=int, default=30)
    options = parser.parse_args()
    draw = random.Random(5)
    with tempfile.TemporaryDirectory() as folder, Service(options.program, options.world) as service:
        browser = start(folder)
        try:
            browser.get(service.url)
            waited(lambda: browser.execute_script("return world !== null && map !== null && map._loaded === true && !tiles._loading"))
            waited(lambda: "Solved" in browser.find_element(By.ID, "status").text)
            browser.execute_script(WATCH)
            rows = [figures(browser, service.process.pid, draw) for _ in range(options.pairs)]
        finally:
            browser.quit()
    rows = [row for row in rows if row]
    print(f"{'':14} {'median':>9} {'worst':>9}   (ms, {len(rows)} pairs)")
    for name in rows[0]:
        values = [row[name] for row in rows]
        print(f"{name:14} {statistics.median(values):9.0f} {max(values):9.0f}")


if __name__ == "__main__":
    main()
