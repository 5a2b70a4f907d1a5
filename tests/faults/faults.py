#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Small runs of the program in which the system refuses one call, or all from one on (fault_shim.cpp): memory, mappings,
writes, renames, opens, closes, threads. Never a crash, never a hang, never success without whole outputs, never a rest.

  faults.py PROGRAM SHIM [--every] [--share K/N] [--pick WORD] [--jobs N]

A clean run counts the calls first. The first calls of each kind all fail in turn, of the many later ones some, evenly
spread; with --every each of them. And a signal that comes right after a file was put into its place comes too late.
--share asks the K-th of N shares of these, dealt by their names and by WORD (without it by WARREN_PICK, which is the commit
in tools/check), and always those that ever found something (FOUND); with WARREN_SEEDS=all it asks all of them.
"""
import argparse
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

PATIENCE_S = 60
FIRST = 30  # so many calls of each kind fail in turn
SPREAD = 40  # and so many of the later ones
KINDS = ("allocation", "mapping", "writing", "renaming", "opening", "closing", "threads")
# Exit codes that say what happened: success, no path, usage, an input or output that can't be had, memory.
HONEST = {0, 66, 73, 124}
ROS_KEYS = "resolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"

# Name, words, outputs; words and outputs are files of the run's folder.
RUNS = [
    ("solve", "solve w.scene --json a.json --svg a.svg --trace a.trace --threads 1", ["a.json", "a.svg", "a.trace"]),
    ("solve and draw the path", "solve w.scene --json a.json --svg a.png --path p.csv --threads 1",
     ["a.json", "a.png", "p.csv"]),
    ("solve and hand the path on", "solve w.scene --json a.json --no-path --path p.npy --threads 1", ["a.json", "p.npy"]),
    ("solve on threads", "solve big.npy --sampler uniform --json a.json --threads 4 --progress plain", ["a.json"]),
    ("generate", "generate maze 9x9 -o m.npy", ["m.npy"]),
    ("generate what is written while made", "generate maze 9x9 --algorithm mst -o n.npy", ["n.npy"]),
    ("generate polygons", "generate polygons 4 -o p.geojson", ["p.geojson"]),
    ("convert", "convert m.yaml -o n.yaml", ["n.yaml", "n.pgm"]),
    ("convert to a picture", "convert w.scene -o w.png", ["w.png"]),
    ("convert to a page", "convert w.scene -o w.pdf", ["w.pdf"]),
    ("compare", "compare w.scene --planners prm,lazy-prm --seeds 1 --json c.json --csv c.csv --log c.log --threads 1",
     ["c.json", "c.csv", "c.log"]),
    ("scale", "scale --sizes 5,7 --repeats 1 --threads 1 --quiet --json s.json --csv s.csv --html s.html",
     ["s.json", "s.csv", "s.html"]),
    ("build", "build w.scene --samples 60 -o r.roadmap --threads 1", ["r.roadmap"]),
    ("query", "query kept.roadmap --json a.json --svg a.svg --keep k.roadmap --threads 1",
     ["a.json", "a.svg", "k.roadmap"]),
    ("solve and keep",
     "solve w.scene --planner prm --samples 60 --json a.json --save-roadmap s.roadmap --path p.csv --threads 1",
     ["a.json", "s.roadmap", "p.csv"]),
    ("query a table", "query kept.roadmap --matrix w.csv w.csv --trace t.json --threads 1", ["t.json"]),
    ("update", "update kept.roadmap w.scene -o u.roadmap --report u.json --threads 1", ["u.roadmap", "u.json"]),
    ("export", "export kept.roadmap -o x.gr", ["x.gr", "x.co"]),
]
# What the system refused when a fault was found, and its runs: all such calls fail in every share.
FOUND = [
    ("convert", "renaming"),  # left the image of a map without its YAML
    ("convert", "closing"),  # said of what was in its place that it was not written
    ("update", "renaming"),  # left a roadmap without its report
    ("export", "renaming"),  # left a graph without its coordinates
    ("solve and hand the path on", "renaming"),  # left a path beside an answer that was not written
    ("solve on threads", "threads"),  # asked for a thread again in each loop
    ("query", "stopping"),  # a signal between two files kept the second from its place
    ("convert to a page", "allocation"),  # libharu crashed
    ("generate polygons", "allocation"),  # a note was told before a failure
]
TIMES = re.compile(r'"(stages_s|solve_s|peak_memory_bytes|threads|time_s|seconds|machine|memory_bytes)')


def writes_pdf(program: str, folder: Path) -> bool:
    """Was libharu there when it was built?"""
    return subprocess.run([program, "convert", "maze:2x2", "-o", str(folder / "page.pdf")], capture_output=True).returncode == 0


def prepare(program: str, folder: Path) -> None:
    for words in ("generate maze 5x5 -o w.scene", "generate maze 60x60 -o big.npy",
                  "build w.scene --samples 60 --planner lazy-prm -o kept.roadmap"):
        subprocess.run([program, *words.split()], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    (folder / "w.csv").write_text("x,y\n1,1\n5,5\n")
    (folder / "m.pgm").write_text("P2\n3 3\n255\n0 0 0\n255 255 255\n0 0 0\n")
    (folder / "m.yaml").write_text("image: m.pgm\n" + ROS_KEYS)


def whole(path: Path, clean: bytes) -> bool:
    """Is the file as long and as well-formed as that of the clean run? Times in it may differ."""
    data = path.read_bytes()
    if path.suffix in (".json", ".trace"):
        ours, theirs = json.loads(data), json.loads(clean)
        return type(ours) is type(theirs) and (not isinstance(ours, dict) or list(ours) == list(theirs)) and (
            path.suffix == ".trace" or ours.get("path") == theirs.get("path"))
    if path.suffix in (".csv", ".log"):
        return data.count(b"\n") == clean.count(b"\n")
    if path.suffix == ".html":
        return data.startswith(b"<!DOCTYPE html>") and data.endswith(b"</html>\n")
    return data == clean


class Campaign:
    def __init__(self, program: str, shim: str, scratch: Path):
        self.program, self.shim, self.scratch = program, shim, scratch
        self.inputs = scratch / "inputs"
        self.inputs.mkdir()
        prepare(program, self.inputs)
        self.clean: dict[str, dict[str, bytes]] = {}
        self.counts: dict[str, dict[str, int]] = {}

    def start(self, folder: Path, words: str, **environment: str) -> subprocess.CompletedProcess:
        shutil.copytree(self.inputs, folder)
        return subprocess.run([self.program, *words.split()], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                              timeout=PATIENCE_S, env=dict(os.environ, LD_PRELOAD=self.shim, **environment))

    def count(self, name: str, words: str, outputs: list[str]) -> None:
        folder = self.scratch / name
        run = self.start(folder, words, WARREN_FAULT_COUNTS=str(self.scratch / "counts"))
        if run.returncode != 0:
            raise SystemExit(f"{words}: {run.returncode} without any fault: {run.stderr.decode()}")
        self.clean[name] = {output: (folder / output).read_bytes() for output in outputs}
        lines = (self.scratch / "counts").read_text().split("\n")
        self.counts[name] = {kind: int(number) for kind, number in (line.split() for line in lines if line)}

    def faults(self, name: str, options: argparse.Namespace) -> list[str]:
        faults = []
        for kind in KINDS:
            total = self.counts[name][kind]
            chosen = list(range(1, total + 1))
            if not options.every and (name, kind) not in FOUND and total > FIRST + SPREAD:
                later = total - FIRST
                chosen = chosen[:FIRST] + [FIRST + 1 + i * later // SPREAD for i in range(SPREAD)]
            for number in chosen:
                faults += [f"{kind}:{number}", f"{kind}:{number}+"]
        faults += [f"stopping:{number + 1}" for number in range(self.counts[name]["renaming"])]
        share, shares = options.share
        return [fault for fault in faults if zlib.crc32(f"{options.pick} {name} {fault}".encode()) % shares == share - 1
                or (name, fault.split(":")[0]) in FOUND]

    def complaint(self, name: str, words: str, outputs: list[str], fault: str) -> str:
        """What is wrong with a run in which that call failed; empty: nothing."""
        folder = self.scratch / f"{name} {fault}"
        try:
            run = self.start(folder, words, WARREN_FAULT=fault)
        except subprocess.TimeoutExpired:
            return "hangs"
        lines = run.stderr.decode(errors="replace").strip().split("\n")
        said = "\n".join(line for line in lines if "progress" not in words or line.startswith("warren: "))
        if run.returncode not in ({0} if fault.startswith("stopping") else HONEST):
            return f"exit code {run.returncode}: {said}"
        tells = "solve" in name or name in ("compare", "scale", "query")
        is_answer = run.returncode == 124 and tells  # which says that it was stopped
        if run.returncode != 0 and not is_answer and (not said.startswith("warren: ") or "\n" in said):
            return f"exit code {run.returncode} with other than one line: {said!r}"
        for path in folder.iterdir():
            if path.name.endswith(".part"):
                return f"exit code {run.returncode} leaves {path.name}"
        for path in self.inputs.iterdir():
            if (folder / path.name).read_bytes() != path.read_bytes():
                return f"{path.name} was changed"
        missing = [output for output in outputs if not (folder / output).exists()]
        if name in ("convert", "update", "export") and 0 < len(missing) < len(outputs):
            return f"exit code {run.returncode} leaves half of what belongs together, without {missing[0]}"
        for output in outputs:
            there = (folder / output).exists()
            if run.returncode == 0 and not there:
                return f"success without {output}"
            if there and run.returncode == 0 and not whole(folder / output, self.clean[name][output]):
                return f"{output} is not whole"
        shutil.rmtree(folder)
        return ""


def share_of(text: str) -> tuple[int, int]:
    share, shares = map(int, text.split("/"))
    if not 1 <= share <= shares:
        raise ValueError(text)
    return share, shares


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("shim")
    parser.add_argument("--every", action="store_true", help="each call, not some of the later ones")
    parser.add_argument("--share", type=share_of, default=(1, 1), metavar="K/N", help="the K-th of N shares alone")
    parser.add_argument("--pick", default=os.environ.get("WARREN_PICK", ""), metavar="WORD", help="which deals the shares")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    if os.environ.get("WARREN_SEEDS") == "all":
        options.share = (1, 1)
    complaints = []
    with tempfile.TemporaryDirectory(prefix="warren_faults_") as scratch:
        campaign = Campaign(os.path.abspath(options.program), os.path.abspath(options.shim), Path(scratch))
        jobs = []
        for run in RUNS:
            if run[0] == "convert to a page" and not writes_pdf(options.program, Path(scratch)):
                continue
            campaign.count(*run)
            jobs += [(*run, fault) for fault in campaign.faults(run[0], options)]
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for job, complaint in zip(jobs, pool.map(lambda job: campaign.complaint(*job), jobs)):
                if complaint:
                    complaints.append(f"WARREN_FAULT={job[3]} warren {job[1]}: {complaint}")
        for name, counts in campaign.counts.items():
            print(f"{name}: " + ", ".join(f"{kind} {number}" for kind, number in counts.items() if number))
    share, shares = options.share
    print(f"{len(jobs)} faults, {len(complaints)} complaints" +
          (f"; again: --share {share}/{shares} --pick '{options.pick}'{' --every' * options.every}" if shares > 1 else ""))
    print("\n".join(complaints[:40]))
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
