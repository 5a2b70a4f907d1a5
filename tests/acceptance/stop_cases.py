# SPDX-License-Identifier: BSD-3-Clause
"""Worlds that keep every planner busy for a while, and what is asked of them: every verb, every planner, every body.

`full` makes them so large that most runs take seconds; else they are as small as a test in passing can afford."""

import math
import os
import random


class Worlds:
    """Made by the program itself where it can, once, in one folder."""

    def __init__(self, program, folder, full):
        self.program, self.folder, self.full = program, folder, full

    def path(self, name):
        return os.path.join(self.folder, name)

    def made(self, name, *arguments):
        if not os.path.exists(self.path(name)):
            self.program.run(*arguments, "-o", self.path(name))
        return self.path(name)

    def written(self, name, lines):
        if not os.path.exists(self.path(name)):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.writelines(line + "\n" for line in lines)
        return self.path(name)

    def maze(self, side):
        return self.made(f"maze-{side}.walls", "generate", "maze", f"{side}x{side}")

    def polygons(self, count):
        return self.made(f"polygons-{count}.scene", "generate", "polygons", count)

    def map(self, side):
        return self.made(f"map-{side}.map", "convert", self.maze(side), "--cell", 0.25)

    def scenario(self, side, queries=300):
        """Ways in the map from everywhere to its middle; what they cost is not known, so they are refuted."""
        dice = random.Random(1)
        size = 4 * side + 1
        cells = [(4 * dice.randrange(side) + 2, 4 * dice.randrange(side) + 2) for _ in range(queries + 1)]
        rows = [f"0\t{os.path.basename(self.map(side))}\t{size}\t{size}\t{a[0]}\t{a[1]}\t{b[0]}\t{b[1]}\t1"
                for a, b in zip(cells, cells[1:])]
        return self.written(f"map-{side}.scen", ["version 1", *rows])

    def fan(self, count):
        """Walls of one point, next to each other within 1e-4 radians."""
        ends = ((1e-4 * i / count) for i in range(count))
        return self.written("fan.scene", ["bounds 0 0 10 10", "start 1 2", "goal 9 8",
                                          *(f"wall 1 5 {1 + 8 * math.cos(a)!r} {5 + 8 * math.sin(a)!r}" for a in ends)])

    def equal(self, count):
        return self.written("equal.scene", ["bounds 0 0 10 10", "start 1 2", "goal 9 8", *["wall 1 5 8 5"] * count])

    def overlapping(self, count):
        """Walls on one line, each a part of the one before."""
        begins = (1 + 7 * i / count for i in range(count))
        return self.written("overlapping.scene", ["bounds 0 0 10 10", "start 1 2", "goal 9 8",
                                                  *(f"wall {begin!r} 5 8.5 5" for begin in begins)])

    def crossing(self, count):
        dice = random.Random(1)
        walls = (" ".join(f"{dice.uniform(1, 999):.3f}" for _ in range(4)) for _ in range(count))
        return self.written("crossing.scene", ["bounds 0 0 1000 1000", "start 0.5 0.5", "goal 999.5 999.5",
                                               *(f"wall {wall}" for wall in walls)])

    def posts(self, count, robot, grid=""):
        """Short walls at random with some room between them, for bodies that turn."""
        dice = random.Random(1)
        side = 3 * math.ceil(math.sqrt(count))
        lines = [f"bounds -3 -3 {side + 3} {side + 3}", f"robot {robot}", "start -1.5 -1.5 0",
                 f"goal {side + 1.5} {side + 1.5} 0"] + ([grid] if grid else [])
        for i in range(count):
            x, y = 3 * (i % (side // 3)) + dice.uniform(0.6, 2.4), 3 * (i // (side // 3)) + dice.uniform(0.6, 2.4)
            angle = dice.uniform(0, 2 * math.pi)
            lines.append(f"wall {x:.4f} {y:.4f} {x + 0.5 * math.cos(angle):.4f} {y + 0.5 * math.sin(angle):.4f}")
        return self.written(f"posts-{count}-{robot.split()[0]}.scene", lines)

    def boxes(self, count):
        dice = random.Random(1)
        lines = ["robot puma560 radius 0.05", "start 0 -1.2 0.3 0 0 0", "goal 2 -0.4 0.6 0 0.4 0"]
        for _ in range(count):
            x, y, z = dice.uniform(0.5, 2), dice.uniform(-2, 2), dice.uniform(-1.5, 1.5)
            lines.append(f"box {x:.3f} {y:.3f} {z:.3f} {x + 0.02:.3f} {y + 0.02:.3f} {z + 0.02:.3f}")
        return self.written(f"boxes-{count}.scene", lines)

    def answer(self, world, *arguments):
        name = self.path(f"{os.path.basename(world).replace(':', '-').replace(',', '-')}-{len(arguments)}.json")
        if not os.path.exists(name):
            self.program.run("solve", world, *arguments, "--json", name)
        return name


def solve_cases(w, full):
    pick = (lambda large, small: large) if full else (lambda large, small: small)
    maze, far = f"maze:{pick('3000x3000', '700x700')}", f"maze:{pick('500x500', '150x150')}"
    polygons, many = w.polygons(pick(20000, 2000)), pick(100_000, 20_000)
    cases = [[maze], [maze, "--optimise"], [maze, "--pipeline", "plain"], [maze, "--planner", "lazy-prm"]]
    cases += [[far, "--sampler", "uniform", "--planner", planner] for planner in ("prm", "lazy-prm")]
    cases += [[far, "--planner", "prm", "--sampler", "uniform", "--pipeline", "tiled"]] if full else []
    cases += [[far, "--clearance", "0", "--planner", planner] for planner in ("visibility", "cells", "voronoi", "grid")]
    cases += [[far, "--planner", "prm", "--sampler", "uniform", "--queue", queue]
              for queue in ("lazy-heap", "sorted-array", "resorted-array")]
    cases += [[polygons, "--planner", planner] for planner in
              ("prm", "lazy-prm", "visibility", "cells", "voronoi", "grid")]
    cases += [[polygons, "--planner", "visibility", "--full"], [polygons, "--planner", "visibility", "--lazy"],
              [polygons, "--planner", "cells", "--doors", "funnel"], [polygons, "--robot", "disc 0.2", "--optimise"],
              [polygons, "--planner", "voronoi", "--objective", "clearance"]]
    for crowded in (w.fan(many), w.equal(many), w.overlapping(pick(many, 4000)), w.crossing(pick(3000, 600))):
        planners = ("lazy-prm", "prm", "visibility", "voronoi", "grid") + (() if "crossing" in crowded else ("cells",))
        cases += [[crowded, "--planner", planner] for planner in planners]
    cells = w.map(pick(500, 120))
    ends = ["--start", "0.6,0.6", "--goal", f"{pick(500, 120) - 0.4},{pick(500, 120) - 0.4}"]
    cases += [[cells, *ends, "--planner", planner]
              for planner in ("prm", "lazy-prm", "voronoi", "grid", "rrt-connect")]
    cases += [[cells, *ends, "--search", search] for search in ("bfs", "dijkstra")]
    turning = w.posts(pick(20000, 1000), "polygon -0.6 -0.1 0.6 -0.1 0.6 0.1 -0.6 0.1")
    cases += [[turning, "--planner", planner] for planner in ("prm", "lazy-prm", "rrt", "rrt-connect", "grid", "voronoi")]
    cases += [[turning, "--planner", "grid", "--angles", "720"]] if full else []
    car = w.posts(pick(5000, 400), "car radius 0.2 turning 0.5")
    cases += [[car, "--planner", planner, *more] for planner, more in
              (("prm", []), ("lazy-prm", ["--optimise"]), ("rrt", []), ("rrt-connect", ["--steering", "reeds-shepp"]))]
    arm = w.boxes(pick(20000, 500))
    cases += [[arm, "--planner", planner] for planner in ("prm", "lazy-prm", "rrt", "rrt-connect")]
    return [(["solve", *case], {"--json": "answer.json"}) for case in cases]


def pictures_of(w, name):
    """That name with each ending that this build draws: .pdf takes libharu."""
    return [name + ending for ending in (".svg", ".png", ".html") + ((".pdf",) if w.program.writes_pdf() else ())]


def picture_cases(w, full):
    """solve with pictures: the search is short, so stops fall into drawing and writing."""
    maze, polygons = f"maze:{1500 if full else 300}x{1500 if full else 300}", w.polygons(20000 if full else 2000)
    return [(["solve", world, *more], {"--json": "answer.json", "--svg": name})
            for world, more in ((maze, ["--optimise"]), (polygons, ["--planner", "cells"]))
            for name in pictures_of(w, "picture")]


def file_cases(w, full):
    side = 2000 if full else 400
    maze, polygons, cells = w.maze(side), w.polygons(20000 if full else 2000), w.map(500 if full else 120)
    ends = ["--start", "0.5,1", "--goal", f"{side + 0.5},{side}"]
    cases = [(["verify", maze, w.answer(maze, *ends, "--planner", "prm", "--sampler", "lattice")], {}),
             (["verify", polygons, w.answer(polygons, "--planner", "cells")], {})]
    for world in (maze, polygons, cells):
        cases += [(["info", world], {"--json": "info.json"})]
        cases += [(["render", world], {"-o": name}) for name in pictures_of(w, "out")]
    cases += [(["convert", maze], {"-o": name}) for name in ("out.scene", "out.npy", "out.walls", "out.wkt")]
    cases += [(["convert", polygons], {"-o": name}) for name in ("out.geojson", "out.scene")]
    cases += [(["convert", polygons, "--cell", "0.1" if full else "0.5"], {"-o": "out.map"}),
              (["convert", cells], {"-o": "out.walls"})]
    for algorithm in ("backtracker", "kruskal", "prim", "wilson", "course"):
        size = 6000 if full else 700
        cases += [(["generate", "maze", f"{size}x{size}", "--algorithm", algorithm], {"-o": "out.walls"})]
    cases += [(["generate", "polygons", 2_000_000 if full else 100_000], {"-o": "out.scene"}),
              (["generate", "polygons", 3, "--corners", 3_000_000 if full else 100_000], {"-o": "out.scene"})]
    return cases


def roadmap_cases(w, full):
    """Roadmaps that are kept: built, asked, updated, exported and looked through."""
    side = 600 if full else 150
    maze, polygons = f"maze:{side}x{side}", w.polygons(20000 if full else 2000)
    turning, arm = w.posts(5000 if full else 500, "polygon -0.6 -0.1 0.6 -0.1 0.6 0.1 -0.6 0.1"), w.boxes(500)
    many = 400_000 if full else 40_000
    few = many // 40
    cases = [(["build", world, "--planner", planner, "--samples", samples], {"-o": "out.roadmap"})
             for world, samples in ((maze, many), (polygons, many), (turning, few), (arm, few))
             for planner in ("prm", "lazy-prm")]
    cases += [(["build", f"maze:{2000 if full else 500}x{2000 if full else 500},loops=0.1"], {"-o": "out.roadmap"})]
    cases += [(["build", polygons, "--planner", planner], {"-o": "out.roadmap"})
              for planner in ("visibility", "cells", "voronoi")]
    cases += [(["solve", polygons, "--planner", "prm", "--samples", many],
               {"--save-roadmap": "out.roadmap", "--json": "answer.json", "--path": "out.csv"})]
    kept = w.made(f"kept-{many}.roadmap", "build", maze, "--samples", many)
    ends = [f"{1 + i % side},{1 + i * 7 % side}" for i in range(300)]
    lines = ["start_x,start_y,goal_x,goal_y"] + [f"{1 + i % side},{1 + i * 7 % side},{side},{1 + i % 9}"
                                                 for i in range(20_000)]
    cases += [(["query", kept], {"--json": "answer.json", "--keep": "out.roadmap"}),
              (["query", kept, "--batch", w.written(f"batch-{side}.csv", lines)], {}),
              (["query", kept, "--matrix", *[w.written(f"places-{side}.csv", ["x,y", *ends])] * 2], {}),
              (["update", kept, f"{maze},seed=2"], {"-o": "out.roadmap", "--report": "out.json"}),
              (["info", kept, "--check", "all"], {"--json": "info.json"})]
    cases += [(["export", kept], {"-o": name}) for name in ("out.geojson", "out.graphml", "out.npz", "out.gr")]
    return cases


def study_cases(w, full):
    """Their --budget is each run's, so only signals stop them."""
    polygons, maze = w.polygons(20000 if full else 1000), f"maze:{600 if full else 200}x{600 if full else 200}"
    return [(["compare", polygons, "--planners", "visibility,cells,voronoi,lazy-prm", "--seeds", "3"],
             {"--json": "out.json", "--csv": "out.csv"}),
            (["compare", maze, "--trials", "100"], {"--json": "out.json"}),
            (["scale", "--sizes", "100,400,1000"], {"--json": "out.json", "--html": "out.html"}),
            (["largest", "--budget", "2s"], {"--json": "out.json", "--svg": "out.svg"}),
            (["bench-scen", w.scenario(500 if full else 60)], {"--json": "out.json"})]
