# SPDX-License-Identifier: BSD-3-Clause
"""service_test.py WARREN: `warren serve` as its clients see it, the polite and the others."""
import http.client
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from service import Service

WARREN = sys.argv.pop(1)
TOWN = "bounds 0 0 100 60\nwall 10 10 50 40\npolygon 60 10 90 10 90 50 60 50\nstart 5 30\ngoal 95 30\n"


class ServiceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.town = cls.path("town.scene")
        with open(cls.town, "w", encoding="utf-8") as file:
            file.write(TOWN)
        cls.roadmap = cls.path("maze.roadmap")
        subprocess.run([WARREN, "build", "maze:300x300,seed=5,loops=0.05", "-o", cls.roadmap, "--quiet"], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)

    def said(self, *words, code=0, feed=None):
        done = subprocess.run([WARREN, *map(str, words)], capture_output=True, text=True, input=feed, timeout=300)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout if code == 0 else done.stderr

    def test_it_ends_with_0_at_sigterm_and_sigint(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            service = Service(WARREN, self.town)
            self.assertEqual(service.request("GET", "/api/health")[0], 200)
            began = time.monotonic()
            self.assertEqual(service.stop(number), 0)
            self.assertLess(time.monotonic() - began, 10)
            self.assertEqual(service.said, "")

    def test_it_ends_while_it_works(self):
        with Service(WARREN, "maze:200x200", "--robot", "disc 0.2") as service:
            asked = threading.Thread(target=lambda: self.ask_in_vain(service))
            asked.start()
            while b"warren_requests_working 1" not in service.request("GET", "/api/metrics")[2] and asked.is_alive():
                pass
            self.assertEqual(service.stop(), 0)
            asked.join()

    @staticmethod
    def ask_in_vain(service):
        try:
            service.ask(start=[1, 1], goal=[200, 200], planner="voronoi")
        except (OSError, http.client.HTTPException, AssertionError):  # it was stopped
            pass

    def test_answers_are_those_of_solve(self):
        with Service(WARREN, self.town) as service:
            for planner in (None, "cells", "voronoi", "lazy-prm"):
                words = ["--planner", planner] if planner else []
                expected = json.loads(self.said("solve", self.town, "--start", "3,3", "--goal", "97,55", *words, "--json", "-"))
                more = {"planner": planner} if planner else {}
                answer, _ = service.ask(start=[3, 3], goal=[97, 55], **more)
                for key in ("schema", "status", "length", "min_clearance", "planner", "counters", "path"):
                    self.assertEqual(answer[key], expected[key], key)
                self.assertEqual(list(answer), list(expected))

    def test_answers_are_those_of_query_and_can_be_verified(self):
        with Service(WARREN, self.roadmap) as service:
            expected = json.loads(self.said("query", self.roadmap, "--start", "1,1", "--goal", "300,17", "--json", "-"))
            answer, fields = service.ask(start=[1, 1], goal=[300, 17])
            self.assertEqual(answer["path"], expected["path"])
            self.assertEqual(answer["length"], expected["length"])
            with open(self.path("answer.json"), "w", encoding="utf-8") as file:
                json.dump(answer, file)
            self.said("verify", "maze:300x300,seed=5,loops=0.05", self.path("answer.json"))
            status, _, text = service.request("GET", "/api/path/" + fields["Warren-Path"])
            self.assertEqual(status, 200)
            self.assertEqual(json.loads(text)["chains"], [answer["path"]])

    def test_a_batch_is_that_of_query(self):
        lines = "".join(json.dumps({"id": i, "start": [1 + i % 300, 1], "goal": [300, 1 + 7 * i % 300]}) + "\n" for i in range(500))
        expected = self.said("query", self.roadmap, "--batch", "-", feed=lines)
        with Service(WARREN, self.roadmap) as service:
            status, fields, text = service.request("POST", "/api/query/batch", lines)
            self.assertEqual(status, 200, text)
            self.assertEqual(fields["Content-Type"], "application/x-ndjson")
            self.assertEqual(text.decode(), expected)
            status, _, text = service.request("POST", "/api/query/batch?lengths_only=1", lines)
            self.assertEqual(text.decode(), self.said("query", self.roadmap, "--batch", "-", "--lengths-only", feed=lines))

    def test_others_are_answered_beside_slow_clients(self):
        with Service(WARREN, self.town) as service:
            slow = []
            for i in range(400):
                slow.append(service.socket())
                slow[-1].send(b"POST /api/query HTTP/1.1\r\nHost: 127.0.0.1" if i % 2 else b"G")
                if i % 50 == 0:
                    self.assertEqual(service.ask(start=[3, 3], goal=[97, 55])[0]["status"], "solved")
            figures = service.request("GET", "/api/metrics")[2].decode()
            self.assertRegex(figures, r"\nwarren_connections (1\d\d|2[0-4]\d|25[0-6])\n")
            self.assertRegex(figures, r"\nwarren_connections_gave_way_total [1-9]\d\d?\n")
            for one in slow:
                one.close()

    def test_attacks_are_refused(self):
        with Service(WARREN, self.town) as service:
            host = f"127.0.0.1:{service.port}"
            for method, target, fields, body, status in (
                    ("GET", "/", {"Host": "evil.example"}, None, 403),
                    ("GET", "/", {"Host": f"evil.example:{service.port}"}, None, 403),
                    ("POST", "/api/query", {"Host": host, "Origin": "http://evil.example"}, "{}", 403),
                    ("POST", "/api/query", {"Host": host, "Origin": "null"}, "{}", 403),
                    ("GET", "/..%2f..%2fetc%2fpasswd", {"Host": host}, None, 404),
                    ("GET", "//etc/passwd", {"Host": host}, None, 404),
                    ("GET", "/" + 3000 * "a", {"Host": host}, None, 414),
                    ("GET", "/", {"Host": host, "X": 9000 * "a"}, None, 431),
                    ("POST", "/api/query", {"Host": host}, 70000 * " ", 413),
                    ("POST", "/api/query", {"Host": host}, 60000 * "[", 400),
                    ("POST", "/api/query", {"Host": host}, '{"start":' + 60000 * "[", 400),
                    ("POST", "/api/query", {"Host": host}, '{"start": [1e999, 1]}', 400),
                    ("GET", "/tiles/99/0/0.png", {"Host": host}, None, 404),
                    ("GET", "/tiles/1/-1/0.png", {"Host": host}, None, 404)):
                with self.subTest(target=target[:40], fields=str(fields)[:80]):
                    connection = service.connection()
                    connection.request(method, target, body, fields)
                    reply = connection.getresponse()
                    self.assertEqual(reply.status, status)
                    error = json.loads(reply.read())["error"]
                    self.assertEqual(list(error), ["code", "where", "message"])
                    connection.close()
            self.assertEqual(service.request("GET", "/api/health")[0], 200)

    def test_what_can_not_be_served_is_refused_in_one_line(self):
        arm = self.path("arm.scene")
        with open(arm, "w", encoding="utf-8") as file:
            file.write("robot puma560 radius 0.05\nsphere 1 1 1 0.1\n")
        self.assertIn("arms move in space", self.said("serve", arm, code=2))
        self.assertIn("--robot: the roadmap was built with its own", self.said("serve", self.roadmap, "--robot", "point", code=2))
        self.assertIn("--world: is for a roadmap", self.said("serve", self.town, "--world", self.town, code=2))
        self.assertIn("--port", self.said("serve", self.town, "--port", "65536", code=2))
        self.assertIn("nowhere", self.said("serve", self.town, "--listen", "nowhere", code=2))
        self.assertIn("gone.scene", self.said("serve", self.path("gone.scene"), code=66))
        with Service(WARREN, self.town) as service:
            self.assertIn(f"--port: {service.port} of", self.said("serve", self.town, "--port", service.port, code=2))

    def test_behind_a_proxy_it_is_asked_under_its_public_address(self):
        with Service(WARREN, self.town, "--public-url", "https://planner.example.org/robots/", "--public-url", "http://robot.local:81") as service:
            body = json.dumps({"start": [3, 3], "goal": [97, 55]})
            for path, host, origin, status in (
                    ("/api/query", "planner.example.org", "https://planner.example.org", 200),
                    ("/robots/api/query", "planner.example.org", "https://planner.example.org", 200),
                    ("/api/query", f"127.0.0.1:{service.port}", "https://planner.example.org", 200),
                    ("/api/query", "robot.local:81", "http://robot.local:81", 200),
                    ("/api/query", "planner.example.org", "http://planner.example.org", 403),
                    ("/api/query", "other.example.org", "https://planner.example.org", 403)):
                with self.subTest(path=path, host=host, origin=origin):
                    connection = service.connection()
                    connection.request("POST", path, body, {"Host": host, "Origin": origin})
                    self.assertEqual(connection.getresponse().status, status)
                    connection.close()
        self.assertIn("--public-url: 'planner.example.org'", self.said("serve", self.town, "--public-url", "planner.example.org", code=2))

    def test_a_closed_terminal_ends_it_and_it_says_so(self):
        process = subprocess.Popen([WARREN, "serve", self.town, "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        process.stdout.readline()
        process.send_signal(signal.SIGHUP)
        self.assertIn("the terminal was closed", process.communicate(timeout=60)[1])
        self.assertEqual(process.returncode, 129)

    def test_other_addresses_only_with_a_warning(self):
        process = subprocess.Popen([WARREN, "serve", self.town, "--port", "0", "--listen", "0.0.0.0"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.assertTrue(process.stdout.readline().startswith("listening on http://0.0.0.0:"))
        process.send_signal(signal.SIGTERM)
        self.assertIn("warning: whoever reaches this address", process.communicate(timeout=60)[1])
        self.assertEqual(process.returncode, 0)


if __name__ == "__main__":
    unittest.main()
