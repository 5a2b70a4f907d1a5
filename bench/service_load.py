#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What does `warren serve` bear? service_load.py PROGRAM [WORLD] [--requests N] [--seconds S]

Needs Debian's wrk and slowhttptest. Serves a roadmap of 300 x 300 cells, or WORLD, and prints
- questions, tiles that are kept, and the page a second with their 50th and 99th of 100 in ms, by wrk on 64 connections;
- the least, 50th and 99th of 100 and largest ms of tiles that nobody has asked for, one after the other;
- the memory of the process before and after N requests of all kinds (default 1,000,000);
- the 99th of 100 ms of questions beside 1,000 slow sockets of slowhttptest: heads, bodies, readers, ranges.
Exit code 1 where a request fails, memory grows by more than 8 MiB, or a slow socket keeps others out."""

import argparse
import http.client
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

SLOW = {"heads": ["-H"], "bodies": ["-B"], "readers": ["-X"], "ranges": ["-R"]}
GROWTH_KIB = 8192
SCRIPT = """
local n = 0
request = function()
  n = n + 1
  {}
end
done = function(summary, latency, requests)
  local e = summary.errors
  io.write(string.format("RESULT %d %d %f %f %f\\n", summary.requests,
    e.connect + e.read + e.write + e.status + e.timeout, summary.duration / 1e6, latency:percentile(50) / 1e3, latency:percentile(99) / 1e3))
end
"""


class Service:
    def __init__(self, program, world):
        self.process = subprocess.Popen([program, "serve", world, "--port", "0"], stdout=subprocess.PIPE, text=True)
        self.port = int(re.search(r":(\d+)/", self.process.stdout.readline())[1])
        self.world = json.loads(self.ask("GET", "/api/world"))

    def ask(self, method, target, body=None, connection=None):
        one = connection or http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        one.request(method, target, body)
        reply = one.getresponse()
        text = reply.read()
        if reply.status != 200:
            raise SystemExit(f"{method} {target}: {reply.status}: {text[:200]}")
        return text

    def memory_kib(self):
        with open(f"/proc/{self.process.pid}/status", encoding="ascii") as file:
            return int(re.search(r"VmRSS:\s+(\d+)", file.read())[1])

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(timeout=30)


def place(world, draw):
    left, low, right, high = world["box"]
    return [round(draw.uniform(left + 0.6, right - 0.6)), round(draw.uniform(low + 0.6, high - 0.6))]


def tile_names(world, draw, count):
    """Any of the last five zooms."""
    levels = world["tiles"]["levels"]
    zooms = [draw.randrange(max(0, levels - 5), levels) for _ in range(count)]
    return [f"/v/{world['hash']}/tiles/{z}/{draw.randrange(2 ** z)}/{draw.randrange(2 ** z)}.png" for z in zooms]


def wrk(service, what, seconds, connections=64):
    """Requests, errors, seconds, 50th and 99th of 100 in ms."""
    with tempfile.NamedTemporaryFile("w", suffix=".lua") as script:
        script.write(SCRIPT.format(what))
        script.flush()
        said = subprocess.run(["wrk", "-t1", f"-c{connections}", f"-d{seconds}s", "-s", script.name, f"http://127.0.0.1:{service.port}"],
                              capture_output=True, text=True, check=True).stdout
    return [float(word) for word in re.search(r"RESULT (.*)", said)[1].split()]


def questions(world, draw, count=500):
    bodies = [json.dumps({"start": place(world, draw), "goal": place(world, draw), "path": False}) for _ in range(count)]
    return "local b = {" + ",".join(f"'{b}'" for b in bodies) + "}; return wrk.format('POST', '/api/query', nil, b[n % #b + 1])"


def tiles(names):
    return "local t = {" + ",".join(f"'{n}'" for n in names) + "}; return wrk.format('GET', t[n % #t + 1])"


def cold_tiles_ms(service, draw, count=500):
    connection = http.client.HTTPConnection("127.0.0.1", service.port, timeout=60)
    took = []
    for name in dict.fromkeys(tile_names(service.world, draw, count)):
        begin = time.perf_counter()
        service.ask("GET", name, connection=connection)
        took.append(1e3 * (time.perf_counter() - begin))
    return sorted(took)


def asked_ms(service, draw, seconds):
    """New connections, as a page that is opened has them."""
    took = []
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        begin = time.perf_counter()
        service.ask("POST", "/api/query", json.dumps({"start": place(service.world, draw), "goal": place(service.world, draw), "path": False}))
        took.append(1e3 * (time.perf_counter() - begin))
        time.sleep(0.01)
    return sorted(took)


def at(sorted_ms, share):
    return sorted_ms[min(len(sorted_ms) - 1, int(share * len(sorted_ms)))]


def beside_slow(service, draw, kind, seconds):
    attack = subprocess.Popen(["slowhttptest", "-c", "1000", *SLOW[kind], "-r", "500", "-i", "1", "-l", str(seconds + 4), "-x", "24", "-p", "3",
                               "-u", f"http://127.0.0.1:{service.port}/"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(3)
    took = asked_ms(service, draw, seconds)
    attack.terminate()
    attack.wait()
    return took


def load(service, seconds, draw):
    failed = 0
    kept = tile_names(service.world, draw, 64)
    for name, what in (("questions", questions(service.world, draw)), ("kept tiles", tiles(kept)), ("page", "return wrk.format('GET', '/')")):
        count, errors, took, half, most = wrk(service, what, seconds)
        failed += errors
        print(f"{name:12} {count / took:9.0f} a second, p50 {half:.2f} ms, p99 {most:.2f} ms, {errors:.0f} failed")
    cold = cold_tiles_ms(service, draw)
    print(f"{'new tiles':12} least {cold[0]:.1f} ms, p50 {at(cold, 0.5):.1f}, p99 {at(cold, 0.99):.1f}, most {cold[-1]:.1f} of {len(cold)}")
    return failed == 0


def growth(service, requests, draw):
    what = (questions(service.world, draw), tiles(tile_names(service.world, draw, 64)), "return wrk.format('GET', '/api/world')")
    for kind in what:
        wrk(service, kind, 2)
    before = service.memory_kib()
    done = 0
    while done < requests:
        for kind in what:
            done += int(wrk(service, kind, 5)[0])
    grown = service.memory_kib() - before
    print(f"{'memory':12} {before} KiB, after {done} requests {grown:+} KiB")
    return grown <= GROWTH_KIB


def slow_sockets(service, seconds, draw):
    well = True
    alone = asked_ms(service, draw, seconds)
    print(f"{'alone':12} p50 {at(alone, 0.5):.2f} ms, p99 {at(alone, 0.99):.2f} ms of {len(alone)}")
    for kind in SLOW:
        took = beside_slow(service, draw, kind, seconds)
        print(f"slow {kind:7} p50 {at(took, 0.5):.2f} ms, p99 {at(took, 0.99):.2f} ms of {len(took)}")
        well = well and len(took) > len(alone) / 4
    return well


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("world", nargs="?")
    parser.add_argument("--requests", type=int, default=1_000_000)
    parser.add_argument("--seconds", type=int, default=10)
    options = parser.parse_args()
    draw = random.Random(1)
    with tempfile.TemporaryDirectory() as folder:
        world = options.world or os.path.join(folder, "maze.roadmap")
        if not options.world:
            subprocess.run([options.program, "build", "maze:300x300,seed=5,loops=0.05", "-o", world, "--quiet"], check=True)
        service = Service(options.program, world)
        service.ask("POST", "/api/query", json.dumps({"start": place(service.world, draw), "goal": place(service.world, draw), "path": False}))
        well = [load(service, options.seconds, draw), growth(service, options.requests, draw), slow_sockets(service, options.seconds, draw)]
        well.append(service.stop() == 0)
    sys.exit(0 if all(well) else 1)


if __name__ == "__main__":
    main()
