#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""mpi_test.py WARREN WARREN_MPI DEATH_SHIM: warren-mpi under mpirun, on this machine alone. The oracle is `warren solve --pipeline
streamed`: the same files but for times and ranks. Whatever dies, ends or is refused ends all, in time and in words."""
import json
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

WARREN, SHARED, SHIM = (os.path.abspath(p) for p in sys.argv[1:4])
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_btl_vader_single_copy_mechanism="none", OMPI_MCA_rmaps_base_oversubscribe="1")
VARIES = ("stages_s", "solve_s", "peak_memory_bytes", "threads", "ranks")
PATIENCE_S = 10


def mpirun(ranks, words, program=None):
    return ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks), program or SHARED] + words


def start(command):
    return subprocess.Popen(command, env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def run(command, patience=300):
    process = start(command)
    out, err = process.communicate(timeout=patience)
    return process.returncode, out, err


def timeless(text):
    answer = json.loads(text)
    return json.dumps({key: value for key, value in answer.items() if key not in VARIES})


def close(source, target):
    """An array of a maze's walls with one more, in the middle from side to side."""
    with open(source, "rb") as file:
        head, walls = file.read(128), file.read()
    right, top = struct.unpack("<f", walls[8:12])[0], struct.unpack("<f", walls[20:24])[0]
    middle = (top + 0.5) // 2 + 0.5
    count = len(walls) // 16
    with open(target, "wb") as file:
        file.write(head.replace(b"(%d, 4)" % count, b"(%d, 4)" % (count + 1)).rstrip().ljust(127) + b"\n")
        file.write(walls + struct.pack("<4f", 0.5, middle, right, middle))


def ranks_of(process):
    """The processes of a run, by rank."""
    found = {}
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        try:
            with open(f"/proc/{name}/status") as status:
                fields = dict(line.split(":\t", 1) for line in status if ":\t" in line)
            if int(fields["PPid"]) != process.pid or fields["State"].startswith("Z"):
                continue
            with open(f"/proc/{name}/environ", "rb") as environ:
                words = dict(word.split(b"=", 1) for word in environ.read().split(b"\0") if b"=" in word)
            found[int(words[b"OMPI_COMM_WORLD_RANK"])] = int(name)
        except (OSError, KeyError, ValueError):
            continue
    return found


def is_gone(pid):
    try:
        with open(f"/proc/{pid}/status") as status:
            return any(line.startswith("State:\tZ") for line in status)
    except OSError:
        return True


class Answers(unittest.TestCase):
    def same(self, world, words, ranks, threads, expected=0, alone=()):
        """alone: further words for the one process."""
        with tempfile.TemporaryDirectory() as folder:
            mine, theirs = (os.path.join(folder, name) for name in ("one", "many"))
            code, _, err = run([WARREN, "solve", world, "--pipeline", "streamed", "--json", mine + ".json", *alone] +
                               [word.replace("FILE", mine) for word in words])
            self.assertEqual(code, expected, err)
            code, _, err = run(mpirun(ranks, ["solve", world, "--threads", str(threads), "--json", theirs + ".json"] +
                                      [word.replace("FILE", theirs) for word in words]))
            self.assertEqual(code, expected, err)
            with open(mine + ".json") as a, open(theirs + ".json") as b:
                a, b = a.read(), b.read()
            self.assertEqual(json.loads(b)["ranks"], ranks)
            self.assertEqual(timeless(a), timeless(b))
            if words:
                with open(mine + ".npy", "rb") as a, open(theirs + ".npy", "rb") as b:
                    self.assertEqual(a.read(), b.read())

    def test_any_ranks_and_threads_give_the_same_files(self):
        worlds = ["maze:1x1,algorithm=mst", "maze:63x64,algorithm=mst", "maze:257x65,algorithm=mst,loops=0.1",
                  "maze:1000x1000,algorithm=mst,seed=4,loops=0.01", "maze:2100x700,algorithm=mst,seed=5"]
        for number, world in enumerate(worlds):
            for ranks in (1, 2, 3, 5, 8):
                with self.subTest(world=world, ranks=ranks):
                    self.same(world, ["--no-path", "--path", "FILE.npy"] if (number + ranks) % 2 else [], ranks,
                              1 + ranks % 2)

    def test_what_rank_0_does_not_hold_all_search_and_what_nobody_holds_is_refused(self):
        world = "maze:2500x2500,algorithm=mst,seed=1,loops=0.1"
        code, one, err = run([WARREN, "solve", world, "--pipeline", "streamed", "--no-path", "--json", "-"])
        self.assertEqual(code, 0, err)
        ask = ["solve", world, "--no-path", "--threads", "1", "--json", "-", "--memory"]
        for ranks in (4, 7):
            code, out, err = run(mpirun(ranks, ask + ["80MiB"]))
            self.assertEqual(code, 0, err)
            self.assertEqual(timeless(out), timeless(one))
            self.assertEqual(json.loads(out)["stages_s"]["graph"], 0.0, "rank 0 held the overlay")
        code, out, err = run(mpirun(4, ask + ["46MiB"]))
        self.assertEqual((code, json.loads(out)["status"]), (124, "stopped"), err)
        self.assertRegex(err, r"warren-mpi: rank \d would need [\d.]+ MiB more for its share of the search")

    def test_files_are_read_by_bands(self):
        """One process reads an array by its cells only where its memory does not hold the walls, which then suffices for a
        path, not to measure the gap."""
        with tempfile.TemporaryDirectory() as folder:
            for number, (size, loops) in enumerate((("300x300", 0.1), ("1500x1000", 0.01), ("2100x700", 0))):
                made = os.path.join(folder, "made.npy")
                self.generate(size, "--seed", number + 1, "--loops", loops, "-o", made)
                closed = os.path.join(folder, "closed.npy")
                close(made, closed)
                for world in (made, closed):
                    packed = world.replace(".npy", ".maze")
                    code, _, err = run([WARREN, "convert", world, "-o", packed])
                    self.assertEqual(code, 0, err)
                    files = (packed, world) if world == made and size != "300x300" else (packed,)
                    for at, (file, ranks) in enumerate((f, r) for f in files for r in (1, 2, 3, 5, 8)):
                        with self.subTest(file=file, size=size, ranks=ranks):
                            words = ["--no-path", "--path", "FILE.npy"] if at % 3 == 0 and world == made else []
                            self.same(file, words, ranks, 1 + (at + number) % 2, 0 if world == made else 1,
                                      ["--memory", "32MiB"] if file == world else [])

    def generate(self, size, *words):
        code, _, err = run([WARREN, "generate", "maze", size, "--algorithm", "mst"] + [str(word) for word in words])
        self.assertEqual(code, 0, err)

    def test_files_that_rank_0_does_not_hold_are_searched_by_all(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "a.maze")
            self.generate("2500x2500", "--loops", 0.1, "-o", file)
            code, one, err = run([WARREN, "solve", file, "--pipeline", "streamed", "--no-path", "--json", "-"])
            self.assertEqual(code, 0, err)
            code, out, err = run(mpirun(4, ["solve", file, "--no-path", "--threads", "1", "--json", "-", "--memory", "80MiB"]))
            self.assertEqual(code, 0, err)
            self.assertEqual(timeless(out), timeless(one))
            self.assertEqual(json.loads(out)["stages_s"]["graph"], 0.0, "rank 0 held the overlay")

    def test_scale_tells_of_each_run(self):
        code, out, err = run(mpirun(3, ["scale", "--side", "600", "--ranks", "1,2,3", "--json", "-"]))
        self.assertEqual(code, 0, err)
        runs = json.loads(out)["runs"]
        self.assertEqual([(r["scaling"], r["ranks"], r["rows"]) for r in runs],
                         [("strong", 1, 600), ("strong", 2, 600), ("strong", 3, 600), ("weak", 1, 600),
                          ("weak", 2, 1200), ("weak", 3, 1800)])
        self.assertEqual(len({r["length"] for r in runs if r["scaling"] == "strong"}), 1)
        for r in runs:
            self.assertEqual(len(r["by_rank"]), r["ranks"])
            self.assertEqual(sum(rank["bytes_sent"] for rank in r["by_rank"]), r["bytes_sent"])
            self.assertLessEqual(sum(r["bytes_by_request"].values()), r["bytes_sent"])
            self.assertEqual(r["bytes_sent"] == 0, r["ranks"] == 1)


class Faults(unittest.TestCase):
    WORLD = "maze:9000x9000,algorithm=mst,seed=3,loops=0.01"

    def ends(self, process, pids, since):
        out, err = process.communicate(timeout=PATIENCE_S)
        self.assertLess(time.monotonic() - since, PATIENCE_S)
        self.assertNotEqual(process.returncode, 0)
        while not all(is_gone(pid) for pid in pids):
            self.assertLess(time.monotonic() - since, PATIENCE_S, "a rank is still there")
            time.sleep(0.05)
        return out, err

    def test_a_rank_that_dies_ends_all_and_a_survivor_names_the_stage(self):
        named = set()
        for number in range(9):
            killed = number % 3
            process = start(mpirun(3, ["solve", self.WORLD, "--no-path", "--threads", "1", "--quiet"]))
            while len(ranks_of(process)) < 3:
                time.sleep(0.01)
            time.sleep(random.uniform(0.5, 5.0))
            pids = ranks_of(process)
            if len(pids) < 3:
                process.communicate()
                continue
            since = time.monotonic()
            os.kill(pids[killed], signal.SIGKILL)
            _, err = self.ends(process, pids.values(), since)
            lines = [line for line in err.splitlines() if "stopped while it was at '" in line]
            self.assertTrue(lines, f"rank {killed} was killed, and no survivor said a word:\n{err}")
            named.update(line.split("'")[1] for line in lines)
        self.assertTrue(named, "no run lived long enough")

    def test_each_rank_that_dies_in_each_stage_ends_all(self):
        """Killed from within, by their messages: the stages' numbers are those of apps/distributed/rank_protocol.hpp. Where rank 0 does not
        hold the overlay, the search is one in rounds. The ranks are asked one after the other to join and to gather."""
        held = ["maze:900x300,algorithm=mst,seed=3"]
        shared = ["maze:2500x2500,algorithm=mst,seed=3,loops=0.1", "--memory", "80MiB"]
        stages = (("generate", 0, held), ("connect", 2, held), ("rounds", 4, shared), ("expand", 5, held),
                  ("verify", 6, held))
        for stage, number, world in stages:
            for killed in range(3):
                with self.subTest(stage=stage, killed=killed), tempfile.TemporaryDirectory() as folder:
                    preload = ["LD_PRELOAD=" + SHIM, f"WARREN_DEATH={killed}:{number}", "WARREN_EVENTS=" + folder,
                               SHARED, "solve"]
                    process = start(mpirun(3, preload + world + ["--no-path", "--threads", "1", "--quiet"], "env"))
                    since = time.monotonic()
                    _, err = self.ends(process, [], since)
                    self.assertIn(f"stopped while it was at '{stage}'", err)
                    self.assertNotIn(f"rank {killed} of 3: stopped", err)

    def test_the_launcher_that_is_killed_ends_all(self):
        for which in (signal.SIGKILL, signal.SIGTERM):
            process = start(mpirun(3, ["solve", self.WORLD, "--no-path", "--threads", "1", "--quiet"]))
            while len(ranks_of(process)) < 3:
                time.sleep(0.01)
            time.sleep(1.0)
            pids = list(ranks_of(process).values())
            since = time.monotonic()
            process.send_signal(which)
            self.ends(process, pids, since)

    def test_budget_and_memory_end_all_with_their_code(self):
        for words in (["--budget", "300ms"], ["--memory", "25MiB"]):
            with self.subTest(words=words):
                code, out, err = run(mpirun(3, ["solve", self.WORLD, "--no-path", "--json", "-"] + words), 60)
                self.assertEqual(code, 124, err)
                self.assertEqual(json.loads(out)["status"], "stopped")

    def test_a_stop_before_the_search_names_its_stage_once(self):
        """No budget at all ends a run where the file is opened, or the ranks compare what they see."""
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "a.maze")
            code, _, err = run([WARREN, "generate", "maze", "300x300", "-o", file])
            self.assertEqual(code, 0, err)
            for words in (["solve", file], ["solve", "maze:300x300,algorithm=mst"], ["scale", "--side", "300"]):
                for ranks in (1, 3):
                    with self.subTest(words=words, ranks=ranks):
                        code, _, err = run(mpirun(ranks, words + ["--budget", "1us", "--quiet"]), 60)
                        self.assertEqual(code, 124, err)
                        lines = [line for line in err.splitlines() if "stopped while it was at '" in line]
                        self.assertEqual(len(lines), 1, err)
                        self.assertRegex(lines[0], rf"rank 0 of {ranks}: .* at '[a-z ]+': the time budget ended")
                        if file in words:
                            self.assertIn("at 'read'", lines[0])

    def test_an_interrupt_before_the_search_is_told_by_the_rank_that_heard_it(self):
        """Rank 2 is silent for a while where the ranks compare what they see of the world: the second that each says. What
        a launcher makes of a rank above 0 that ends all is its own affair."""
        for rank, stage in ((0, "read"), (1, "(read|the start)")):
            with self.subTest(rank=rank), tempfile.TemporaryDirectory() as folder:
                preload = ["LD_PRELOAD=" + SHIM, "WARREN_SILENCE=2:1", "WARREN_EVENTS=" + folder, SHARED]
                process = start(mpirun(3, preload + ["solve", "maze:300x300,algorithm=mst", "--quiet"], "env"))
                while not os.path.exists(os.path.join(folder, "2")):
                    self.assertIsNone(process.poll(), "it ended before")
                    time.sleep(0.01)
                pids = ranks_of(process)
                os.kill(pids[rank], signal.SIGINT)
                line = rf"warren-mpi: rank {rank} of 3: stopped while it was at '{stage}': interrupted"
                read = ""
                while not re.search(line, read):
                    more = process.stderr.readline()
                    self.assertTrue(more, f"there is no such line:\n{read}")
                    read += more
                open(os.path.join(folder, "go"), "w").close()
                if rank > 0:
                    process.kill()
                process.communicate(timeout=60)
                self.assertEqual(process.returncode, 130 if rank == 0 else -signal.SIGKILL)
                while not all(is_gone(pid) for pid in pids.values()):
                    time.sleep(0.05)

    def test_ranks_that_were_given_other_words_refuse_each_other(self):
        other = ["-n", "1", SHARED, "solve", "maze:300x300,algorithm=mst,seed=2"]
        code, out, err = run(mpirun(2, ["solve", "maze:300x300,algorithm=mst,seed=1", ":"] + other), 60)
        self.assertEqual(code, 65, err)
        self.assertIn("rank 2: is another program or was given other words", err)

    def test_ranks_that_see_other_files_refuse_each_other(self):
        with tempfile.TemporaryDirectory() as top:
            folders = [os.path.join(top, name) for name in ("here", "there")]
            for seed, folder in enumerate(folders):
                os.mkdir(folder)
                for kind in ("maze", "npy"):
                    code, _, err = run([WARREN, "generate", "maze", "700x300", "--seed", str(seed), "-o",
                                        os.path.join(folder, "a." + kind)])
                    self.assertEqual(code, 0, err)
            there = {kind: os.path.join(folders[1], "a." + kind) for kind in ("maze", "npy")}

            def refused(kind, code, *said, others=1):
                words = ["solve", "a." + kind]
                hosts = ["-wdir", folders[0], SHARED] + words + [":", "-n", str(others), "-wdir", folders[1], SHARED] + words
                command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", "2"] + hosts
                found, _, err = run(command, 60)
                self.assertEqual(found, code, err)
                lines = [line for line in err.splitlines() if line.startswith("warren-mpi:")]
                self.assertEqual(len(lines), 1, err)
                for text in said:
                    self.assertIn(text, lines[0])

            refused("maze", 65, "rank 2: does not see what rank 0 sees", "checksums")
            refused("npy", 65, "rank 2: ")
            for kind, file in there.items():
                with open(file, "r+b") as changed:
                    changed.truncate(os.path.getsize(file) - 16)
                refused(kind, 65, "rank 2: does not see what rank 0 sees", "bytes")
                os.remove(file)
                refused(kind, 65, "rank 2: does not see what rank 0 sees", "can't be read: No such file")
                os.remove(os.path.join(folders[0], "a." + kind))
                refused(kind, 66, "can't be read: No such file")
                with open(file, "wb") as empty:
                    empty.write(b"x")
                refused(kind, 65, "rank 2: does not see what rank 0 sees", "can't be read: No such file")

    def test_damaged_rows_are_told_by_the_rank_that_reads_them(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "a.maze")
            code, _, err = run([WARREN, "generate", "maze", "1000x300", "-o", file])
            self.assertEqual(code, 0, err)
            with open(file, "r+b") as damaged:
                damaged.seek(64 + 600 * 75 + 3)
                damaged.write(b"\x5a\xa5")
            # The rank above reads the rows below its own, too, and whoever is the first to fail is heard.
            for ranks, telling in ((2, "1"), (4, "[23]"), (8, "[57]")):
                code, _, err = run(mpirun(ranks, ["solve", file]), 60)
                self.assertEqual(code, 65, err)
                self.assertRegex(err, f"rank {telling}: {re.escape(file)}: rows 512 to 767: are damaged")

    def test_ranks_of_another_build_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = shutil.copy(SHARED, os.path.join(folder, "warren-mpi"))
            with open(copy, "ab") as program:
                program.write(b"\0")
            words = ["solve", "maze:300x300,algorithm=mst"]
            code, _, err = run(mpirun(1, words + [":", "-n", "1", copy] + words), 60)
            self.assertEqual(code, 65, err)
            self.assertIn("another program", err)

    def test_what_cannot_be_asked_is_refused_once(self):
        for words, code in ((["solve", "maze:30x30"], 2), (["solve", "/dev/null"], 2), (["solve", "/no/such.maze"], 66),
                            (["solve", SHARED], 2), (["solve", "maze:30x30,algorithm=mst", "--explain"], 2),
                            (["solve", "maze:30x30,algorithm=mst", "--no-such"], 2), (["dance"], 2),
                            (["solve", "maze:30x30,algorithm=mst", "--json", "/no/folder/a.json"], 73)):
            with self.subTest(words=words):
                found, _, err = run(mpirun(3, words), 60)
                self.assertEqual(found, code, err)
                self.assertEqual(sum(line.startswith("warren-mpi:") for line in err.splitlines()), 1, err)

    def test_each_command_tells_its_options(self):
        for words in (["solve", "--help"], ["scale", "--help"], ["solve", "--help", "all"], ["scale", "--help", "all"]):
            with self.subTest(words=words):
                found, out, err = run(mpirun(2, words), 60)
                self.assertEqual(found, 0, err)
                self.assertIn("Usage: warren " + words[0], out)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
