#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""hosts_test.py WARREN WARREN_MPI: warren-mpi over hosts, which are network namespaces with names and temporary folders of
their own, joined by a wire that delays and loses (wire.py). The answer is that of one process; a rank that is killed on
another host, and a wire that is cut, end all within 10 s: of the wire mpirun hears by its keepalive, which it must be told
(docs/file_formats.md). Needs root, iproute2 and TAP devices."""
import atexit
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

WARREN, SHARED = (os.path.abspath(p) for p in sys.argv[1:3])
VARIES = ("stages_s", "solve_s", "peak_memory_bytes", "threads", "ranks")
NET = "10.213.77"
PATIENCE_S = 10
MENDED_S = 3  # mpirun gives a silent host five, by its keepalive below
BY_RANK_0 = ["maze:1300x400,algorithm=mst,seed=4"]
BY_ALL = ["maze:600x600,algorithm=mst,loops=0.3", "--memory", "32MiB"]
WORLD = "maze:20000x20000,algorithm=mst,seed=3,loops=0.01"
DELAY_S, LOSS = 0.001, 0.005  # one way, of a frame
AGENT = """#!/bin/sh
host=${1##*.}; shift
export TMPDIR={folder}/$host
exec ip netns exec {prefix}h$host unshare -u /bin/sh -c "hostname host$host; $*"
"""
# Nobody listens at that port: one frame there, one back, and as many again a second later where one of them is lost.
REFUSED = """
import socket, sys, time
for _ in range(200):
    since = time.monotonic()
    try:
        socket.create_connection((sys.argv[1], 9))
    except ConnectionRefusedError:
        print(time.monotonic() - since)
"""


class Hosts:
    """Three of them, .1 to .3."""

    def __init__(self):
        self.numbers = (1, 2, 3)
        self.folder = tempfile.mkdtemp(prefix="wr")
        self.prefix = os.path.basename(self.folder)
        program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "wire.py")
        self.wire = subprocess.Popen([sys.executable, "-B", program, self.folder, NET, *map(str, self.numbers)],
                                     stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        atexit.register(self.end)
        if not self.wire.stdout.readline():
            raise OSError("the wire could not be made")
        agent = os.path.join(self.folder, "agent")
        with open(agent, "w") as file:
            file.write(AGENT.replace("{folder}", self.folder).replace("{prefix}", self.prefix))
        os.chmod(agent, 0o755)

    def end(self):
        """Returns when the wire has removed all."""
        self.wire.stdin.close()
        self.wire.stdout.read()
        self.wire.wait()

    def tell(self, *words):
        """What became of all frames so far: `forwarded`, `lost` and `cut`."""
        print(*words, file=self.wire.stdin, flush=True)
        return json.loads(self.wire.stdout.readline())

    def run(self, number, *words):
        return subprocess.run(["ip", "netns", "exec", f"{self.prefix}h{number}", *words], capture_output=True, text=True,
                              check=True).stdout

    def sent_again(self):
        """Segments, as the hosts' kernels count them."""
        total = 0
        for number in self.numbers:
            names, values = (line.split() for line in self.run(number, "cat", "/proc/net/snmp").splitlines()
                             if line.startswith("Tcp:"))
            total += int(values[names.index("RetransSegs")])
        return total

    def ranks(self):
        """Processes of warren-mpi by host."""
        found = {n: [] for n in self.numbers}
        for n in self.numbers:
            listed = subprocess.run(["ip", "netns", "pids", f"{self.prefix}h{n}"], capture_output=True, text=True)
            for pid in listed.stdout.split():
                try:
                    if os.path.realpath(f"/proc/{pid}/exe") == SHARED:
                        found[n].append(int(pid))
                except OSError:
                    pass
        return found

    def start(self, ranks_a_host, words):
        hosts = ",".join(f"{NET}.{n}:{ranks_a_host}" for n in self.numbers)
        mca = {"plm_rsh_agent": os.path.join(self.folder, "agent"), "btl": "tcp,self", "pml": "ob1",
               "btl_tcp_if_include": NET + ".0/24", "oob_tcp_if_include": NET + ".0/24",
               "oob_tcp_keepalive_time": "1", "oob_tcp_keepalive_intvl": "1", "oob_tcp_keepalive_probes": "4"}
        command = ["ip", "netns", "exec", self.prefix + "h1", "mpirun", "--oversubscribe", "--bind-to", "none", "-n",
                   str(ranks_a_host * len(self.numbers)), "--host", hosts]
        for key, value in mca.items():
            command += ["--mca", key, value]
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                           TMPDIR=os.path.join(self.folder, "1"))
        return subprocess.Popen(command + [SHARED] + words, env=environment, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)


def timeless(text):
    return {key: value for key, value in json.loads(text).items() if key not in VARIES}


class OverHosts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if os.geteuid() != 0:
            raise unittest.SkipTest("only root makes network namespaces")
        try:
            os.close(os.open("/dev/net/tun", os.O_RDWR))
        except OSError as error:
            raise unittest.SkipTest(f"no TAP devices here, of which hosts and their wire are made: {error}")
        cls.hosts = Hosts()

    def setUp(self):
        self.hosts.tell("delay", DELAY_S)
        self.hosts.tell("lose", LOSS, 0)

    def test_delay_and_loss_are_on_the_wire(self):
        for delay_s in (DELAY_S, 0.01):
            with self.subTest(delay_s=delay_s):
                self.hosts.tell("delay", delay_s)
                before, again = self.hosts.tell("lose", LOSS, 0), self.hosts.sent_again()
                trips = self.hosts.run(1, sys.executable, "-c", REFUSED, f"{NET}.2").split()
                self.assertEqual(len(trips), 200)
                self.assertGreaterEqual(min(float(trip_s) for trip_s in trips), 2 * delay_s)
                self.assertGreater(self.hosts.tell("count")["lost"], before["lost"])
                self.assertGreater(self.hosts.sent_again(), again)

    def same(self, words, process):
        one = subprocess.run([WARREN, "solve", words[0], "--pipeline", "streamed", "--json", "-"], capture_output=True, text=True,
                             check=True)
        out, err = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, err)
        self.assertEqual(timeless(out), timeless(one.stdout))

    def solve(self, words):
        return self.hosts.start(2, ["solve", *words, "--threads", "1", "--json", "-"])

    def test_the_answer_is_that_of_one_process(self):
        """Searched by rank 0 and by all, over a good wire, and over a slow one that loses in bursts."""
        larger = ["maze:2500x2500,algorithm=mst,loops=0.1", "--memory", "90MiB"]
        for delay_s, loss, burst_s, words in ((DELAY_S, LOSS, 0, BY_RANK_0), (DELAY_S, LOSS, 0, larger),
                                              (0.02, 0.01, 0.02, BY_RANK_0), (0.005, 0.01, 0.005, BY_ALL)):
            with self.subTest(delay_s=delay_s, loss=loss, burst_s=burst_s, words=words):
                self.hosts.tell("delay", delay_s)
                before = self.hosts.tell("lose", loss, burst_s)
                self.same(words, self.solve(words))
                self.assertGreater(self.hosts.tell("count")["lost"], before["lost"])

    def test_a_wire_that_is_mended_in_time_changes_nothing(self):
        self.hosts.tell("delay", 0.005)
        for host, at_s in ((1, 0.0), (3, 2.0)):
            with self.subTest(host=host, at_s=at_s):
                process = self.when_all_are_there(self.solve(BY_ALL), 6)
                time.sleep(at_s)
                before = self.hosts.tell("cut", host)
                time.sleep(MENDED_S)
                after = self.hosts.tell("mend", host)
                self.assertGreater(after["cut"], before["cut"])
                self.same(BY_ALL, process)

    def ended(self, process, since):
        _, err = process.communicate(timeout=PATIENCE_S)
        self.assertNotEqual(process.returncode, 0)
        while any(self.hosts.ranks().values()):
            self.assertLess(time.monotonic() - since, PATIENCE_S, "a rank is still there")
            time.sleep(0.05)
        return err

    def when_all_are_there(self, process, ranks):
        while sum(len(pids) for pids in self.hosts.ranks().values()) < ranks:
            self.assertIsNone(process.poll(), "the run ended before all ranks were there")
            time.sleep(0.02)
        return process

    def running(self, at_s):
        process = self.hosts.start(1, ["solve", WORLD, "--no-path", "--threads", "1", "--quiet"])
        self.when_all_are_there(process, 3)
        time.sleep(at_s)
        return process

    def test_a_rank_that_is_killed_on_any_host_ends_all(self):
        """Of what survivors on other hosts say mpirun loses some while it ends."""
        named = set()
        for host in self.hosts.numbers:
            for at_s in (0.3, 2.0, 5.0):
                with self.subTest(host=host, at_s=at_s):
                    process = self.running(at_s)
                    since = time.monotonic()
                    for pid in self.hosts.ranks()[host]:
                        os.kill(pid, signal.SIGKILL)
                    err = self.ended(process, since)
                    named.update(re.findall(r"stopped while it was at '(\w+)'", err))
        self.assertTrue(named, "no survivor named a stage")

    def test_a_wire_that_is_cut_ends_all(self):
        for host in self.hosts.numbers:
            with self.subTest(host=host):
                process = self.running(2.0)
                since = time.monotonic()
                self.hosts.tell("cut", host)
                try:
                    self.ended(process, since)
                finally:
                    self.hosts.tell("mend", host)
                    process.kill()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
