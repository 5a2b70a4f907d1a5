#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""hosts_test.py WARREN WARREN_MPI: warren-mpi over hosts, which are network namespaces joined by a bridge, with names and
temporary folders of their own; delay and loss on the wire where the kernel has netem. The answer is that of one process;
a rank that is killed on another host, and a wire that is cut, end all within 10 s: of the wire mpirun hears by its
keepalive, which it must be told (docs/file_formats.md). Needs root and iproute2."""
import json
import os
import re
import shutil
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
WORLD = "maze:20000x20000,algorithm=mst,seed=3,loops=0.01"
AGENT = """#!/bin/sh
host=${1##*.}; shift
export TMPDIR={folder}/$host
exec ip netns exec {prefix}h$host unshare -u /bin/sh -c "hostname host$host; $*"
"""


def ip(*words):
    done = subprocess.run(["ip", *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise OSError(f"ip {' '.join(words)}: {done.stderr.strip()}")


class Hosts:
    """Three of them, .1 to .3."""

    def __init__(self):
        self.prefix = f"wr{os.getpid() % 100000}"
        self.folder = tempfile.mkdtemp()
        self.numbers = (1, 2, 3)
        self.without = ""  # why the wire has neither delay nor loss
        try:
            self.join()
        except OSError:
            self.end()
            raise
        agent = os.path.join(self.folder, "agent")
        with open(agent, "w") as file:
            file.write(AGENT.replace("{folder}", self.folder).replace("{prefix}", self.prefix))
        os.chmod(agent, 0o755)

    def join(self):
        ip("link", "add", self.prefix + "br", "type", "bridge")
        ip("link", "set", self.prefix + "br", "up")
        for n in self.numbers:
            name, wire = f"{self.prefix}h{n}", f"{self.prefix}w{n}"
            os.mkdir(os.path.join(self.folder, str(n)))
            ip("netns", "add", name)
            ip("link", "add", wire, "type", "veth", "peer", "name", "eth0", "netns", name)
            ip("link", "set", wire, "master", self.prefix + "br", "up")
            ip("-n", name, "addr", "add", f"{NET}.{n}/24", "dev", "eth0")
            ip("-n", name, "link", "set", "lo", "up")
            ip("-n", name, "link", "set", "eth0", "up")
            made = subprocess.run(["tc", "-n", name, "qdisc", "add", "dev", "eth0", "root", "netem", "delay", "1ms",
                                   "loss", "0.5%"], capture_output=True, text=True)
            self.without = self.without or made.stderr.strip()

    def cut(self, number):
        ip("link", "set", f"{self.prefix}w{number}", "down")

    def mend(self, number):
        ip("link", "set", f"{self.prefix}w{number}", "up")

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
               "oob_tcp_keepalive_time": "2", "oob_tcp_keepalive_intvl": "1", "oob_tcp_keepalive_probes": "3"}
        command = ["ip", "netns", "exec", self.prefix + "h1", "mpirun", "--oversubscribe", "--bind-to", "none", "-n",
                   str(ranks_a_host * len(self.numbers)), "--host", hosts]
        for key, value in mca.items():
            command += ["--mca", key, value]
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                           TMPDIR=os.path.join(self.folder, "1"))
        return subprocess.Popen(command + [SHARED] + words, env=environment, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True)

    def end(self):
        for pids in self.ranks().values():
            for pid in pids:
                os.kill(pid, signal.SIGKILL)
        for n in self.numbers:
            subprocess.run(["ip", "netns", "del", f"{self.prefix}h{n}"], capture_output=True)
        subprocess.run(["ip", "link", "del", self.prefix + "br"], capture_output=True)
        shutil.rmtree(self.folder, ignore_errors=True)


def timeless(text):
    return {key: value for key, value in json.loads(text).items() if key not in VARIES}


class OverHosts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if os.geteuid() != 0:
            raise unittest.SkipTest("only root makes network namespaces")
        try:
            cls.hosts = Hosts()
        except OSError as error:
            raise unittest.SkipTest(f"no network namespaces here: {error}")

    @classmethod
    def tearDownClass(cls):
        cls.hosts.end()

    def test_the_answer_is_that_of_one_process(self):
        for words in (["maze:1300x400,algorithm=mst,seed=4"], ["maze:2500x2500,algorithm=mst,loops=0.1", "--memory", "90MiB"]):
            one = subprocess.run([WARREN, "solve", words[0], "--pipeline", "streamed", "--json", "-"], capture_output=True,
                                 text=True, check=True)
            process = self.hosts.start(2, ["solve", *words, "--threads", "1", "--json", "-"])
            out, err = process.communicate(timeout=300)
            self.assertEqual(process.returncode, 0, err)
            self.assertEqual(timeless(out), timeless(one.stdout))

    def test_delay_and_loss_are_on_the_wire(self):
        if self.hosts.without:
            self.skipTest(f"tc says: {self.hosts.without}")

    def ended(self, process, since):
        _, err = process.communicate(timeout=PATIENCE_S)
        self.assertNotEqual(process.returncode, 0)
        while any(self.hosts.ranks().values()):
            self.assertLess(time.monotonic() - since, PATIENCE_S, "a rank is still there")
            time.sleep(0.05)
        return err

    def running(self, at_s):
        process = self.hosts.start(1, ["solve", WORLD, "--no-path", "--threads", "1", "--quiet"])
        while sum(len(pids) for pids in self.hosts.ranks().values()) < 3:
            self.assertIsNone(process.poll(), "the run ended before all ranks were there")
            time.sleep(0.02)
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
        for host in (2, 3):
            with self.subTest(host=host):
                process = self.running(2.0)
                since = time.monotonic()
                self.hosts.cut(host)
                try:
                    self.ended(process, since)
                finally:
                    self.hosts.mend(host)
                    process.kill()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
