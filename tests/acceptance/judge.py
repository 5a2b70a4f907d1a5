#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""An independent judge of `warren solve`: mazes made elsewhere, paths checked elsewhere, promises taken at their word.

    judge.py PROGRAM [--full] [--only WORD] [--keep FOLDER]

Each claim below is one function whose name says what is promised; it raises Failure where the promise is broken. The
quick mode takes well under a minute; --full runs the sizes and counts that the project is measured by, and holds stops
to 0.2 s. Needs Python 3 and nothing else. Exit code 1 if a claim failed.
"""

import argparse
import math
import random
import shutil
import sys
import time
import traceback

sys.dont_write_bytecode = True  # the checkout stays as it is

import exact_checker
import funnel
import interruptions
import maze_maker as maker
from program import Failure, Program, read_answer, without_times

PLANNERS = ("prm", "lazy-prm")


def ends_of(world):
    """Options that say what a plain wall list leaves open."""
    return ["--start", "%r,%r" % world.start, "--goal", "%r,%r" % world.goal, "--clearance", repr(world.clearance)]


def judged(program, world, *options, with_ends=False, comments=False, threads=2):
    """Solves a world at these options and checks every word of the answer. Returns the answer."""
    file = program.write(maker.text(world, with_ends, comments))
    ends = [] if with_ends else ends_of(world)
    answer = read_answer(program.solve(file, *ends, "--threads", threads, *options))
    try:
        confirm(world, answer)
    except Failure as failure:
        shown = " ".join(map(str, [file, *ends, "--threads", threads, *options]))
        raise Failure(f"{failure}\n      solve {shown}") from None
    return answer


def confirm(world, answer):
    """A solved answer: verified, from start to goal, free, and its figures right."""
    if answer["status"] != "solved" or answer["verified"] is not True:
        raise Failure(f"status {answer['status']}, verified {answer['verified']}")
    if answer["start"] != list(world.start) or answer["goal"] != list(world.goal):
        raise Failure(f"start {answer['start']} and goal {answer['goal']}, not {world.start} and {world.goal}")
    if answer["clearance"] != world.clearance or answer["contact"] != "blocked":
        raise Failure(f"clearance {answer['clearance']}, contact {answer['contact']}")
    walls = exact_checker.Walls(world.walls)
    wrong, least = exact_checker.check_path(walls, answer["path"], world.start, world.goal, world.clearance,
                                            max(2.0 * world.clearance, 1.5 * answer["min_clearance"]))
    if wrong:
        raise Failure(wrong)
    length = exact_checker.length_of(answer["path"])
    if not math.isclose(length, answer["length"], rel_tol=1e-12):
        raise Failure(f"length {answer['length']!r}, the path's is {length!r}")
    if not math.isclose(least, answer["min_clearance"], rel_tol=1e-9):
        raise Failure(f"min_clearance {answer['min_clearance']!r}, the path's is {least!r}")


# ---- claims: a path in any maze ------------------------------------------------------------------------------------


def uniform_auto_solves_every_5x7(program, full):
    count = 100 if full else 25
    for planner in PLANNERS:
        for seed in range(count):
            world = maker.wall_list(maker.make_maze(5, 7, seed), hint=True)
            judged(program, world, "--planner", planner, "--sampler", "uniform", "--seed", seed)
    return f"{count} of {count}, both planners"


def uniform_auto_solves_large_mazes(program, full):
    sizes = ((41, 20), (101, 20)) if full else ((41, 2),)
    for side, count in sizes:
        for planner in PLANNERS:
            for seed in range(count):
                world = maker.wall_list(maker.make_maze(side, side, seed), hint=True)
                judged(program, world, "--planner", planner, "--sampler", "uniform", "--seed", seed)
    return ", ".join(f"{side}x{side}: {count} of {count}" for side, count in sizes)


def lattice_is_the_shortest_walk_over_cell_centres(program, full):
    sizes = ((5, 7, 40), (21, 33, 10), (101, 101, 10 if full else 1))
    for rows, cols, count in sizes:
        for seed in range(count):
            loops = (0.0, 0.0, 0.1, 0.5)[seed % 4]
            maze = maker.make_maze(rows, cols, seed, loops=loops)
            world = maker.wall_list(maze, hint=True, unit_outline=seed % 2 == 0)
            for planner in PLANNERS:
                answer = judged(program, world, "--planner", planner)
                expected = float(len(maker.cell_path(maze)))
                if answer["sampler"] != "lattice" or answer["length"] != expected:
                    raise Failure(f"{rows}x{cols} seed {seed} loops {loops} {planner}: sampler {answer['sampler']}, "
                                  f"length {answer['length']!r}, the shortest walk is {expected!r}")
    return f"{sum(count for _, _, count in sizes)} mazes, both planners"


def mazes_written_by_others_are_solved_alike(program, full):
    """Any order, cut, direction and place of the walls, at default options."""
    rng = random.Random(7)
    ways = {
        "plain": lambda w: w,
        "shuffled": lambda w: maker.shuffled(w, rng),
        "turned round": lambda w: maker.turned_round(w, rng),
        "merged": maker.merged,
        "split": lambda w: maker.split(w, rng),
        "shifted by 1e6": lambda w: maker.moved(w, shift=(1e6, 1e6)),
        "shifted by -1e6": lambda w: maker.moved(w, shift=(-1e6, 12345.678)),
        "turned by 30 degrees": lambda w: maker.moved(w, angle_rad=math.radians(30)),
        "1e-3 the size": lambda w: maker.moved(w, scale=1e-3),
        "1e3 the size": lambda w: maker.moved(w, scale=1e3),
        "all at once": lambda w: maker.moved(maker.split(maker.turned_round(maker.shuffled(maker.merged(w), rng), rng), rng),
                                             1e3, math.radians(211), (1e6, -2e6)),
    }
    sides = (9, 21, 41) if full else (9,)
    for name, way in ways.items():
        for side in sides:
            for seed, loops in enumerate((0.0, 0.2)):
                world = way(maker.wall_list(maker.make_maze(side, side + 2, seed, loops=loops), unit_outline=seed == 0))
                for planner in PLANNERS + (None,):
                    options = ["--planner", planner] if planner else []
                    try:
                        judged(program, world, *options, with_ends=seed == 1, comments=seed == 1)
                    except Failure as failure:
                        raise Failure(f"{name}, {side}x{side + 2}, loops {loops}: {failure}") from None
    return f"{len(ways)} ways of writing, sides {sides}"


def a_hint_allows_the_lattice_however_walls_are_cut(program, full):
    rng = random.Random(11)
    maze = maker.make_maze(21, 21, 3)
    for way in (maker.shuffled, maker.turned_round, maker.merged):
        world = way(maker.wall_list(maze, hint=True), rng)
        for planner in PLANNERS:
            answer = judged(program, world, "--planner", planner, with_ends=True)
            if answer["sampler"] != "lattice" or answer["length"] != float(len(maker.cell_path(maze))):
                raise Failure(f"{way.__name__}: sampler {answer['sampler']}, length {answer['length']}")
    return "shuffled, turned round, merged"


def standard_input_is_a_file_like_any_other(program, full):
    world = maker.wall_list(maker.make_maze(9, 9, 1))
    text = maker.text(world, with_ends=True)
    answers = []
    for feed in (text, text.replace("\n", "\r\n"), "\ufeff" + text, text.rstrip("\n"), text.replace(" ", "\t")):
        answer = read_answer(program.solve("-", feed=feed.encode()))
        confirm(world, answer)
        answers.append(answer["path"])
    if any(path != answers[0] for path in answers):
        raise Failure("line ends, a byte order mark or tabs change the path")
    return "line feeds, CRLF, byte order mark, no last line end, tabs"


# ---- claims: how good, how equal ------------------------------------------------------------------------------------


def optimise_comes_within_half_a_per_cent_of_the_optimum(program, full):
    sizes = ((5, 7, 20), (21, 21, 10), (41, 41, 20), (101, 101, 3)) if full else ((5, 7, 5), (15, 17, 2))
    worst, raw = 0.0, {}
    for rows, cols, count in sizes:
        for seed in range(count):
            maze = maker.make_maze(rows, cols, seed)
            world = maker.wall_list(maze, hint=True)
            best = funnel.optimum(maker.cell_path(maze), exact_checker.Walls(world.walls), world.start, world.goal,
                                  world.clearance)
            for sampler in ("lattice", "uniform"):
                for planner in PLANNERS:
                    answer = judged(program, world, "--planner", planner, "--sampler", sampler, "--optimise")
                    worst = max(worst, check_optimised(answer, best, f"{rows}x{cols} seed {seed} {planner} {sampler}"))
                    raw.setdefault(sampler, []).append(answer["raw_length"] / best - 1.0)
    raws = ", ".join(f"{name} {100 * sum(v) / len(v):.1f} %" for name, v in raw.items())
    return f"worst {100 * worst:.4f} % over; before --optimise {raws}"


def check_optimised(answer, best, shown):
    if answer["raw_length"] is None or answer["raw_length"] < answer["length"]:
        raise Failure(f"{shown}: raw_length {answer['raw_length']}, length {answer['length']}")
    over = answer["length"] / best - 1.0
    if not -1e-8 <= over <= 0.005:
        raise Failure(f"{shown}: length {answer['length']!r}, the optimum is {best!r}: {100 * over:.4f} % over")
    return over


def threads_change_times_alone(program, full):
    rng = random.Random(5)
    side = 101 if full else 25
    worlds = [maker.wall_list(maker.make_maze(side, side, 2), hint=True),
              maker.moved(maker.split(maker.wall_list(maker.make_maze(side, side, 3, loops=0.1)), rng), 1.0, 0.5)]
    cases = [(world, planner, sampler, optimise) for world in worlds for planner in PLANNERS
             for sampler in ("lattice", "uniform", "halton") for optimise in ([], ["--optimise"])
             if world.hint or sampler != "lattice"]
    for world, planner, sampler, optimise in cases:
        file = program.write(maker.text(world))
        options = [*ends_of(world), "--planner", planner, "--sampler", sampler, *optimise]
        texts = {n: without_times(program.solve(file, *options, "--threads", n)) for n in (1, 2, 3, 8)}
        for n, text in texts.items():
            if text != texts[1]:
                at = next((i for i, (a, b) in enumerate(zip(text, texts[1])) if a != b), min(len(text), len(texts[1])))
                raise Failure(f"1 and {n} threads differ: …{texts[1][max(0, at - 60):at + 30]}… and …"
                              f"{text[max(0, at - 60):at + 30]}…\n      solve {file} {' '.join(options)}")
    return f"{len(cases)} cases, 1 2 3 8 threads"


# ---- claims: no path, and stopping ----------------------------------------------------------------------------------


def walled_off(maze):
    """Closes a door in the middle of the only way."""
    cells = maker.cell_path(maze)
    maze.close(cells[len(cells) // 2], cells[len(cells) // 2 + 1])
    return maze


def no_path_is_an_answer(program, full):
    def expect(world, status, *options):
        file = program.write(maker.text(world))
        answer = read_answer(program.solve(file, *ends_of(world), *options, code=1))
        if answer["status"] not in status or answer["verified"] is not False or answer["path"]:
            raise Failure(f"status {answer['status']}, not {status}, verified {answer['verified']}: solve {file} "
                          f"{' '.join(ends_of(world) + list(options))}")
        if answer["status"] == "not_connected" and "components" not in answer:
            raise Failure(f"not_connected without components: solve {file} {' '.join(ends_of(world) + list(options))}")

    for seed in range(4):
        grid = maker.wall_list(walled_off(maker.make_maze(7, 9, seed)), hint=True)
        turned = maker.moved(grid, angle_rad=0.5)
        for planner in PLANNERS:
            expect(grid, ("infeasible",), "--planner", planner)
            expect(grid, ("infeasible",), "--planner", planner, "--sampler", "uniform")
            expect(turned, ("not_connected",), "--planner", planner, "--samples", "2000")
    free = maker.wall_list(maker.make_maze(7, 9, 1), hint=True)
    for ends, status in (({"start": (1.5, 1.5)}, "start_blocked"), ({"goal": (9.45, 3.0)}, "goal_blocked")):
        expect(maker.replace(free, **ends), (status,))
    expect(maker.replace(free, clearance=0.6), ("start_blocked", "infeasible"))
    return "infeasible, not_connected, start_blocked, goal_blocked"


def auto_gives_up_by_itself(program, full):
    """No knob and no budget: a world without a path still ends, with not_connected."""
    world = maker.moved(maker.wall_list(walled_off(maker.make_maze(5, 7, 1))), angle_rad=0.5)
    file = program.write(maker.text(world))
    shown = []
    for planner in PLANNERS if full else PLANNERS[1:]:
        begin = time.monotonic()
        answer = read_answer(program.solve(file, *ends_of(world), "--planner", planner, code=1))
        if answer["status"] != "not_connected":
            raise Failure(f"status {answer['status']}: solve {file} {' '.join(ends_of(world))}")
        shown.append(f"{planner} {time.monotonic() - begin:.1f} s, {answer['counters']['samples']} samples")
    return "; ".join(shown)


def budgets_are_kept(program, full):
    cases = [["maze:6000x6000"], ["maze:1000x1000", "--sampler", "uniform", "--planner", "prm"]]
    late = [interruptions.check_budget(program, case, budget_s, full)
            for case in (cases if full else cases[:1]) for budget_s in ((0.2, 0.6, 1.5) if full else (0.2,))]
    if full:
        text = program.folder + "/big.walls"
        program.run("generate", "maze", "2000x2000", "-o", text)
        late += [interruptions.check_budget(program, [text, "--start", "0.5,1", "--goal", "2000.5,2000"], 0.3, full)]
    return f"ended at most {max(late):.2f} s after the budget"


def signals_stop_it_in_every_stage(program, full):
    side, moments = (3000, 8) if full else (300, 3)
    cases = [[f"maze:{side}x{side}", "--planner", "prm"], [f"maze:{side}x{side}", "--planner", "lazy-prm", "--optimise"]]
    if full:
        cases += [["maze:400x400", "--sampler", "uniform", "--planner", planner] for planner in PLANNERS]
        cases += [[f"maze:{side}x{side},algorithm={name}"] for name in ("kruskal", "prim", "wilson", "course")]
        text = program.folder + "/read.walls"
        program.run("generate", "maze", "2000x2000", "-o", text)
        cases += [[text, "--start", "0.5,1", "--goal", "2000.5,2000", "--planner", "prm", "--sampler", "uniform"]]
    worst, late = {}, []
    for case in cases:
        begin = time.monotonic()
        code, took, _ = program.interrupt(["solve", *case, "--json", "-"], 20.0)
        length_s = 20.0 if took is not None else max(0.05, time.monotonic() - begin)
        try:
            for stage, seconds in interruptions.check_signals(program, case, length_s, moments, full).items():
                worst[stage] = max(worst.get(stage, 0.0), seconds)
        except Failure as failure:
            late.append(str(failure))
    if late:
        raise Failure("\n      ".join(late))
    return ", ".join(f"{stage} {1e3 * seconds:.0f} ms" for stage, seconds in worst.items())


def silent_input_can_be_interrupted(program, full):
    interruptions.check_silent_input(program, full)
    return "budget and SIGINT while standard input says nothing"


CLAIMS = (
    uniform_auto_solves_every_5x7,
    uniform_auto_solves_large_mazes,
    lattice_is_the_shortest_walk_over_cell_centres,
    mazes_written_by_others_are_solved_alike,
    a_hint_allows_the_lattice_however_walls_are_cut,
    standard_input_is_a_file_like_any_other,
    optimise_comes_within_half_a_per_cent_of_the_optimum,
    threads_change_times_alone,
    no_path_is_an_answer,
    auto_gives_up_by_itself,
    budgets_are_kept,
    signals_stop_it_in_every_stage,
    silent_input_can_be_interrupted,
)


def judge(program, claims, full):
    """Number of claims that failed."""
    failed = 0
    for claim in claims:
        begin, runs = time.monotonic(), program.runs
        try:
            verdict, said = "ok", claim(program, full)
        except Failure as failure:
            verdict, said = "FAILED", str(failure)
        except Exception:  # the judge's own bug, or an answer too odd to read
            verdict, said = "FAILED", traceback.format_exc()
        failed += verdict == "FAILED"
        print(f"{verdict:6}  {claim.__name__} ({program.runs - runs} runs, {time.monotonic() - begin:.1f} s)\n"
              f"      {said}", flush=True)
    return failed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="the built warren")
    parser.add_argument("--full", action="store_true", help="all sizes and counts, and 0.2 s for stops")
    parser.add_argument("--only", default="", help="only claims with this word in their name")
    parser.add_argument("--keep", help="folder for the worlds (a new one below /tmp otherwise)")
    options = parser.parse_args()
    claims = [claim for claim in CLAIMS if options.only in claim.__name__]
    if not claims:
        parser.error("no claim has that word in its name")
    program = Program(options.program, options.keep)
    failed = judge(program, claims, options.full)
    print(f"{len(claims) - failed} of {len(claims)} claims hold")
    if not failed and not options.keep:
        shutil.rmtree(program.folder)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
