# SPDX-License-Identifier: BSD-3-Clause
"""writable_service_test.py WARREN: `warren serve --writable` as its clients see it: many ask while the world changes, and each answer
is verified in the world that it names; tokens; the saved scene."""
import json
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest

from service import Service

WARREN = sys.argv.pop(1)
TOWN = "bounds 0 0 100 60\nwall 10 10 50 40\npolygon 60 10 90 10 90 50 60 50\nstart 5 30\ngoal 95 30\n"
TOKEN = "a-token-of-20-letters"


class WritableServiceTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.town = self.write("town.scene", TOWN)
        self.token = self.write("token", TOKEN + "\n")

    def write(self, name, text):
        path = os.path.join(self.folder.name, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def run_program(self, *words):
        return subprocess.run([WARREN, *words], capture_output=True, text=True, timeout=300)

    @staticmethod
    def update(service, change, **fields):
        status, _, text = service.request("POST", "/api/update", json.dumps(change), **fields)
        return status, json.loads(text)

    def scene(self, service, name):
        return self.write(name, service.request("GET", "/api/scene")[2].decode())

    def test_each_answer_is_right_in_the_world_that_it_names(self):
        with Service(WARREN, self.town, "--writable") as service:
            hashes, answers, lock = {}, {}, threading.Lock()
            hashes[service.ask()[0]["world"]["hash"]] = self.town
            done = threading.Event()

            def ask():
                while not done.is_set():
                    answer, _ = service.ask()
                    with lock:
                        answers[answer["world"]["hash"], answer["length"]] = answer
            clients = [threading.Thread(target=ask) for _ in range(8)]
            for client in clients:
                client.start()
            for i in range(30):
                x = 51 + i % 8
                status, said = self.update(service, {"add": {"walls": [[x, 0, x, 30 + i]]}})
                self.assertEqual(status, 200, said)
                hashes[said["hash"]] = self.scene(service, f"{said['hash']}.scene")
                while i < 8 and not any(name == said["hash"] for name, _ in list(answers)) and clients[0].is_alive():
                    time.sleep(0.001)  # the clients may be slow; later they ask beside changes
            done.set()
            for client in clients:
                client.join()
            self.assertGreater(len({name for name, _ in answers}), 3)
            judged = 0
            for (name, _), answer in answers.items():
                self.assertIn(name, hashes)
                if answer["status"] != "solved":
                    continue
                file = self.write("answer.json", json.dumps(answer))
                told = self.run_program("verify", hashes[name], file)
                self.assertEqual(told.returncode, 0, told.stderr)
                judged += 1
            self.assertGreater(judged, 2)

    def test_the_saved_scene_gives_the_same_answer(self):
        with Service(WARREN, self.town, "--robot", "disc 1.5", "--writable") as service:
            self.update(service, {"add": {"polygons": [[[51, 5], [58, 5], [55, 50]]]}})
            answer, _ = service.ask(start=[3, 3], goal=[97, 55])
            text = service.request("GET", "/api/scene?start=3,3&goal=97,55")[2].decode()
            told = self.run_program("solve", self.write("saved.scene", text), "--json", "-")
            again = json.loads(told.stdout)
            for key in ("robot", "clearance", "start", "goal", "length", "path"):
                self.assertEqual(again[key], answer[key], key)
            self.assertEqual(again["world"]["hash"], answer["world"]["hash"])

    def test_who_does_not_know_the_token_changes_nothing(self):
        change = {"add": {"walls": [[55, 0, 55, 59]]}}
        with Service(WARREN, self.town, "--writable", "--token-file", self.token) as service:
            self.assertEqual(self.update(service, change)[0], 401)
            self.assertEqual(self.update(service, change, Authorization="Bearer " + TOKEN.upper())[0], 403)
            self.assertEqual(self.update(service, change, Authorization="Bearer " + TOKEN)[0], 200)
            self.assertEqual(service.request("GET", "/api/update")[0], 405)
        with Service(WARREN, self.town) as service:
            status, said = self.update(service, change)
            self.assertEqual((status, said["error"]["code"]), (403, "read_only"))
            self.assertFalse(json.loads(service.request("GET", "/api/world")[2])["writable"])

    def test_a_page_of_somebody_else_changes_nothing(self):
        with Service(WARREN, self.town, "--writable") as service:
            status, said = self.update(service, {"add": {"walls": [[55, 0, 55, 59]]}}, Origin="http://evil.example")
            self.assertEqual((status, said["error"]["code"]), (403, "forbidden"))

    def test_words_that_would_open_it_to_everybody_are_refused(self):
        for words, said in ((["--listen", "0.0.0.0", "--writable"], "--token-file"),
                            (["--token-file", self.token], "is for --writable")):
            told = self.run_program("serve", self.town, "--port", "0", *words)
            self.assertEqual(told.returncode, 2, told.stderr)
            self.assertIn(said, told.stderr)
        for text in ("short\n", "sixteen letters !\n", ""):
            told = self.run_program("serve", self.town, "--port", "0", "--writable", "--token-file", self.write("bad", text))
            self.assertEqual(told.returncode, 65, told.stderr)
            self.assertIn("16 to 256 letters", told.stderr)


if __name__ == "__main__":
    unittest.main()
