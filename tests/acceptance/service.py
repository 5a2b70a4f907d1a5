# SPDX-License-Identifier: BSD-3-Clause
"""`warren serve` as a process: started, asked, stopped."""
import http.client
import json
import re
import signal
import socket
import subprocess


class Service:
    """Runs until it is closed. `line` is what it said first."""

    def __init__(self, program, *words):
        self.process = subprocess.Popen([program, "serve", *map(str, words), "--port", "0"], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.line = self.process.stdout.readline()
        found = re.fullmatch(r"listening on (http://127\.0\.0\.1:(\d+)/)\n", self.line)
        if not found:
            raise AssertionError(f"it said {self.line!r}: {self.process.communicate()[1]}")
        self.url, self.port = found[1], int(found[2])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self, number=signal.SIGTERM):
        """The exit code."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        self.said = self.process.communicate(timeout=60)[1]
        return self.process.returncode

    def connection(self):
        return http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)

    def request(self, method, target, body=None, **fields):
        """(status, fields, bytes)"""
        connection = self.connection()
        try:
            connection.request(method, target, body, {name.replace("_", "-"): value for name, value in fields.items()})
            reply = connection.getresponse()
            return reply.status, reply.headers, reply.read()
        finally:
            connection.close()

    def ask(self, **question):
        status, fields, text = self.request("POST", "/api/query", json.dumps(question))
        if status != 200:
            raise AssertionError(text)
        return json.loads(text), fields

    def socket(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=60)
