#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""wire.py FOLDER NET HOST...: hosts, which are network namespaces with the address NET.HOST at eth0 and a temporary folder
FOLDER/HOST, and the wire that joins them. The wire is a switch in user space, so that delay and loss need nothing of the
kernel but TAP devices: each eth0 is one, and what it sends is read here, and written to the host whose number is the last
byte of the destination, or to all others, a delay later, unless it is lost. No frame overtakes another.

Says `ready`, and answers each line of the standard input by what became of all frames so far, as JSON:
  delay SECONDS             each frame's from now on, one way; 0 at first
  lose PROBABILITY SECONDS  that a frame is lost, with all that its host sends so long after it, by a generator that begins anew
  cut HOST, mend HOST       nothing reaches or leaves it
  count
Where its input ends, however the writer ended, it kills all that runs on the hosts and removes them and FOLDER. Needs root
and iproute2."""
import collections
import fcntl
import json
import os
import random
import select
import shutil
import signal
import struct
import subprocess
import sys
import time

TUNSETIFF, IFF_TAP, IFF_NO_PI = 0x400454CA, 0x0002, 0x1000
LONGEST_FRAME = 2048  # of an MTU of 1500


def ip(*words):
    done = subprocess.run(["ip", *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise OSError(f"ip {' '.join(words)}: {done.stderr.strip()}")
    return done.stdout


def make_host(namespace, address, number):
    """The wire's end of its eth0, whose life is that of the device."""
    ip("netns", "add", namespace)
    tap = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK)
    named = fcntl.ioctl(tap, TUNSETIFF, struct.pack("16sH22x", b"warren%d", IFF_TAP | IFF_NO_PI))
    ip("link", "set", named[:16].rstrip(b"\0").decode(), "netns", namespace, "name", "eth0")
    # Without addrgenmode the kernel sends frames of IPv6 that nobody asked for.
    ip("-n", namespace, "link", "set", "eth0", "address", f"02:00:00:00:00:{number:02x}", "addrgenmode", "none")
    ip("-n", namespace, "addr", "add", f"{address}/24", "dev", "eth0")
    ip("-n", namespace, "link", "set", "lo", "up")
    ip("-n", namespace, "link", "set", "eth0", "up")
    return tap


def remove_host(namespace):
    """A process may start another before it dies, so they are asked for until there are none."""
    while pids := subprocess.run(["ip", "netns", "pids", namespace], capture_output=True, text=True).stdout.split():
        for pid in pids:
            try:
                os.kill(int(pid), signal.SIGKILL)
            except ProcessLookupError:
                pass
        time.sleep(0.01)
    subprocess.run(["ip", "netns", "del", namespace], capture_output=True)


class Wire:
    def __init__(self, taps):
        self.taps = taps  # by the host's number
        self.delay_s = 0.0
        self.under_way = collections.deque()  # (when it arrives, where, frame)
        self.severed = set()
        self.counts = {"forwarded": 0, "lost": 0, "cut": 0}
        self.lose(0.0, 0.0)

    def lose(self, probability, burst_s):
        self.probability, self.burst_s = probability, burst_s
        self.loses_until = dict.fromkeys(self.taps, 0.0)  # by sender
        self.generator = random.Random(1)

    def obey(self, verb, *values):
        if verb == "delay":
            self.delay_s = float(values[0])
        elif verb == "lose":
            self.lose(float(values[0]), float(values[1]))
        elif verb == "cut":
            self.severed.add(int(values[0]))
        elif verb == "mend":
            self.severed.discard(int(values[0]))

    def loses(self, sender, now):
        if now < self.loses_until[sender]:
            return True
        lost = self.generator.random() < self.probability
        if lost:
            self.loses_until[sender] = now + self.burst_s
        return lost

    def take(self, sender):
        frame, now = os.read(self.taps[sender], LONGEST_FRAME), time.monotonic()
        for receiver in self.taps if frame[0] & 1 else (frame[5],):  # 1: a frame for many
            if receiver == sender:
                continue
            if sender in self.severed or receiver in self.severed:
                self.counts["cut"] += 1
            elif self.loses(sender, now):
                self.counts["lost"] += 1
            else:
                self.under_way.append((now + self.delay_s, receiver, frame))

    def deliver(self):
        """Seconds to the next frame; None: there is none."""
        while self.under_way:
            remaining_s = self.under_way[0][0] - time.monotonic()
            if remaining_s > 0:
                return remaining_s
            _, receiver, frame = self.under_way.popleft()
            os.write(self.taps[receiver], frame)
            self.counts["forwarded"] += 1
        return None

    def run(self):
        senders = {tap: number for number, tap in self.taps.items()}
        while True:
            ready, _, _ = select.select([sys.stdin, *senders], [], [], self.deliver())
            for source in ready:
                if source is not sys.stdin:
                    self.take(senders[source])
                elif line := source.readline():
                    self.obey(*line.split())
                    print(json.dumps(self.counts), flush=True)
                else:
                    return


def main(folder, net, *numbers):
    # Whoever ends the test, with all its children or all its terminal, does not end this before it has cleaned up.
    if os.fork() > 0:
        os._exit(0)
    os.setsid()
    namespaces = {int(number): f"{os.path.basename(folder)}h{number}" for number in numbers}
    try:
        for number in numbers:
            os.mkdir(os.path.join(folder, number))
        wire = Wire({n: make_host(namespace, f"{net}.{n}", n) for n, namespace in namespaces.items()})
        print("ready", flush=True)
        wire.run()
    finally:
        for namespace in namespaces.values():
            remove_host(namespace)
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
