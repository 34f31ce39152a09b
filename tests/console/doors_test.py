"""Who may enter a console, and what it does with those who should not."""
import gzip
import http.client
import json
import socket
import struct
import time
import unittest

from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from console import ConsoleTest, fan, write_record
from viewer import Viewer

HANDSHAKE = ("GET /live HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")


class Doors(ConsoleTest):
    def setUp(self):
        super().setUp()
        self.record = write_record(self.folder / "fan.mcap", fan(pings=5))
        self.at = self.console(self.record, "--loop")

    def tearDown(self):
        """Whatever a test did, the next viewer is served."""
        viewer = Viewer(self.at.view)
        viewer.watch("bow/view", cells=64)
        self.assertEqual(viewer.of("view/1").topic, "bow/view")
        viewer.close()
        self.assertTrue(self.at.lives())

    def request(self, path="/", method="GET", host=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.at.port, timeout=5)
        connection.putrequest(method, path, skip_host=True)
        connection.putheader("Host", host or f"127.0.0.1:{self.at.port}")
        for name, value in headers.items():
            connection.putheader(name, value)
        connection.endheaders()
        response = connection.getresponse()
        body = response.read().decode()
        connection.close()
        return response, body

    def test_the_page_and_nothing_else_is_served_and_asks_nobody_else(self):
        response, body = self.request()
        self.assertEqual(response.status, 200)
        self.assertIn("default-src 'none'", response.headers["Content-Security-Policy"])
        self.assertNotIn("//", body.replace("<!doctype", "").split("<body>")[0].replace("data:,", ""))
        for secret in (self.at.view, self.at.control):
            self.assertNotIn(secret.split("#")[1], body)
        for path in ("/console.js", "/console.css", "/licences.txt"):
            response, text = self.request(path)
            self.assertEqual(response.status, 200, path)
            self.assertGreater(len(text), 500)
        self.assertIn("preact", self.request("/licences.txt")[1])
        connection = http.client.HTTPConnection("127.0.0.1", self.at.port, timeout=5)
        loaded = 0
        for path in ("/", "/console.js", "/console.css"):
            connection.request("GET", path, headers={"Accept-Encoding": "gzip, deflate, br"})
            packed = connection.getresponse().read()
            self.assertEqual(gzip.decompress(packed).decode(), self.request(path)[1])
            loaded += len(packed)
        connection.close()
        self.assertLess(loaded, 300_000)
        for path in ("/../etc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd", "/etc/passwd", f"/{self.record}", "/console.js/.."):
            self.assertIn(self.request(path)[0].status, (400, 404), path)

    def test_foreign_hosts_origins_and_methods_are_refused(self):
        self.assertEqual(self.request(host="evil.example")[0].status, 421)
        self.assertEqual(self.request(host=f"evil.example:{self.at.port}")[0].status, 421)
        self.assertEqual(self.request(Origin="http://evil.example")[0].status, 403)
        self.assertEqual(self.request(method="POST")[0].status, 405)
        self.assertEqual(self.request("/live")[0].status, 404)
        with self.assertRaises(InvalidStatus) as refused:
            connect(f"ws://127.0.0.1:{self.at.port}/live", origin="http://evil.example")
        self.assertEqual(refused.exception.response.status_code, 403)

    def closed_for(self, socket_, why):
        with self.assertRaises(ConnectionClosed) as closed:
            for _ in range(100):
                socket_.recv(timeout=5)
        self.assertEqual(closed.exception.rcvd.code, 1008)
        self.assertIn(why, closed.exception.rcvd.reason)

    def test_without_a_token_nobody_enters(self):
        for first in ({"type": "console_enter/1", "token": "0" * 32}, {"type": "console_enter/1"}, {"type": "console_watch/1"}):
            with connect(f"ws://127.0.0.1:{self.at.port}/live") as line:
                line.send(json.dumps(first))
                self.closed_for(line, "no token of this console")
        with connect(f"ws://127.0.0.1:{self.at.port}/live") as line:
            self.closed_for(line, "within 2 s")
        self.at.stop()
        self.assertIn("without a token", self.at.stderr())
        self.at = self.console(self.record, "--loop")

    def answer(self, viewer):
        return viewer.of("console_answer/1").content["error"]

    def test_the_url_to_view_commands_nothing(self):
        viewer = Viewer(self.at.view)
        self.assertFalse(viewer.of("console_state/1").content["may_control"])
        viewer.say("console_command/1", command="stop")
        self.assertIn("to view only", self.answer(viewer))
        viewer.close()
        master = Viewer(self.at.control)
        self.assertTrue(master.of("console_state/1").content["may_control"])
        master.say("console_command/1", command="explode")
        self.assertIn("allowed: pause, resume, rate, stop", self.answer(master))
        master.close()

    def test_what_a_viewer_says_wrong_is_answered_with_what_is_allowed(self):
        viewer = Viewer(self.at.control)
        viewer.of("console_state/1")
        for said, why in (("[]", "key type"), ("{", "JSON"), ('{"type": 3}', "key type"), ('{"type": "pose/1"}', "allowed: console_watch/1"),
                          ('{"type": "console_watch/1", "topics": [{"topic": "bow/view", "cells": 5}]}', "allowed: 16 to 1024"),
                          ('{"type": "console_watch/1", "topics": 5}', "list"), ('{"type": "console_open/1", "id": "record:/etc/passwd"}', "list"),
                          ('{"type": "console_open/1", "id": "record:../x.mcap"}', "list"), ("[" * 30_000 + "]" * 30_000, "deep"),
                          ('{"type": "console_command/1", "command": "rate", "rate": 1e999}', "")):
            viewer.socket.send(said)
            self.assertIn(why, self.answer(viewer), said[:80])
        viewer.close()

    def test_floods_end_by_themselves(self):
        viewer = Viewer(self.at.view)
        viewer.of("console_state/1")
        for _ in range(2000):
            viewer.say("console_watch/1", topics=[])
        viewer.until(lambda f: f.type == "console_answer/1" and "50 messages" in f.content["error"], most=5000)
        viewer.close()
        for too_much in ("x" * 70_000, b"\x00\x01"):
            viewer = Viewer(self.at.view)
            viewer.socket.send(too_much)
            with self.assertRaises(ConnectionClosed):
                for _ in range(100):
                    viewer.next()

    def test_sixteen_viewers_are_the_most(self):
        viewers = [Viewer(self.at.view) for _ in range(16)]
        for viewer in viewers:
            viewer.of("console_state/1")
        with connect(f"ws://127.0.0.1:{self.at.port}/live") as late:
            self.closed_for(late, "16 viewers")
        for viewer in viewers:
            viewer.close()
        time.sleep(0.3)

    def test_broken_and_silent_connections(self):
        def raw(data=b""):
            line = socket.create_connection(("127.0.0.1", self.at.port), timeout=5)
            line.sendall(data)
            return line

        silent = [raw() for _ in range(100)]
        half = raw(HANDSHAKE.format(port=self.at.port).encode()[:60])
        noise = raw(bytes(range(256)) * 50)
        large = raw(HANDSHAKE.format(port=self.at.port).encode())
        self.assertIn(b"101", large.recv(1000))
        large.sendall(b"\x82\xff" + struct.pack(">Q", 2 << 30) + b"\x00\x00\x00\x00" + b"x" * 1000)  # a frame of 2 GB
        self.assertEqual(self.request()[0].status, 200)
        slow = raw(b"GET / HT")
        began = time.monotonic()
        slow.settimeout(15)
        self.assertEqual(slow.recv(100), b"")  # given up within 10 s
        self.assertLess(time.monotonic() - began, 12)
        for line in [*silent, half, noise, large, slow]:
            line.close()


if __name__ == "__main__":
    unittest.main()
