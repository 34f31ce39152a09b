"""What any tool may say to a clock: everything is answered, nothing that it says ends or spoils the run."""
import json
import os
import pathlib
import unittest

import zmq
from live_run import LiveRun

PATIENCE_MS = 5000


class Stranger:
    """A DEALER to a run's clock; without an id ZeroMQ makes one up, of 5 bytes that begin with NUL."""

    def __init__(self, run, identity=None):
        self.context = zmq.Context()
        self.socket = self.context.socket(zmq.DEALER)
        self.socket.setsockopt(zmq.RCVTIMEO, PATIENCE_MS)
        if identity is not None:
            self.socket.setsockopt(zmq.IDENTITY, identity)
        self.socket.connect((run.directory() / "clock.endpoint").read_text().strip())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.context.destroy(linger=0)

    def ask(self, what):
        self.socket.send(what if isinstance(what, bytes) else json.dumps(what).encode())
        return json.loads(self.socket.recv())


class Strangers(unittest.TestCase):
    IDS = (None, b"\xff\xfe\x00binary", b"z")

    def state(self, stranger):
        return stranger.ask({"kind": "status"})["state"]

    def test_nobody_outside_the_run_says_failed_bye_proven_or_done(self):
        with LiveRun() as run:
            for identity in self.IDS:
                with Stranger(run, identity) as stranger:
                    for what in ({"kind": "failed", "code": 5, "message": "x"}, {"kind": "failed"}, {"kind": "bye"},
                                 {"kind": "proven", "tokens": ["e0"]}, b"D" + bytes(25), b"D"):
                        answer = stranger.ask(what)
                        self.assertEqual(answer["error"], "only for processes that have joined the run", what)
                        self.assertEqual(self.state(stranger), "running")
            run.tool("clock", "stop")
            self.assertEqual(run.process.wait(20), 0)

    def test_every_malformed_request_is_answered(self):
        with LiveRun() as run, Stranger(run) as stranger:
            for what, error in ((b"", "unknown request"), (b"{", "unknown request"), (b"G", "unknown request"), (b"\xff\xfe", "unknown request"),
                                ({"kind": 5}, "unknown request"), ({"kind": "hurry"}, "unknown request"), ([1], "unknown request"),
                                ({"kind": "get", "what": 5}, "what: is not text"), ({"kind": "get", "what": "x"}, "no such fact"),
                                ({"kind": "step"}, "ns: is not an integer"), ({"kind": "step", "ns": "1"}, "ns: is not an integer"),
                                ({"kind": "step", "ns": 0}, "ns: is not an integer"), ({"kind": "step", "ns": 1.5}, "ns: is not an integer"),
                                ({"kind": "step", "ns": 2**63 - 1}, "ns: is not an integer"), ({"kind": "step", "ns": 2**64 - 1}, "ns: is not"),
                                ({"kind": "step", "ns": 10**30}, "ns: is not"), ({"kind": "step", "ns": None}, "ns: is not"),
                                (b'{"kind":"rate","rate":NaN}', "unknown request"), (b'{"kind":"rate","rate":1e999}', "unknown request"),
                                ({"kind": "rate"}, "rate: is neither"), ({"kind": "rate", "rate": "fast"}, "rate: is neither"),
                                ({"kind": "rate", "rate": -1}, "rate: is neither"), ({"kind": "rate", "rate": 1e300}, "rate: is neither"),
                                ({"kind": "rate", "rate": 1e-300}, "rate: is neither"), ({"kind": "rate", "rate": True}, "rate: is neither")):
                answer = stranger.ask(what)
                self.assertIn(error, answer["error"], what)
                self.assertFalse(answer["ok"])
            self.assertEqual(self.state(stranger), "running")

    def test_a_stranger_that_says_hello_is_refused(self):
        with LiveRun() as run:
            for identity, hello in ((None, {"name": "z"}), (b"z", {"name": "z", "out": [], "in": [], "sync": "", "live": ""}), (b"z", {})):
                with Stranger(run, identity) as stranger:
                    self.assertEqual(stranger.ask({"kind": "hello", **hello})["kind"], "refused")
                    self.assertEqual(self.state(stranger), "running")

    def test_one_that_asks_and_never_reads_costs_the_run_nothing(self):
        with LiveRun() as run, Stranger(run) as stranger, Stranger(run) as other:
            pid = next(int(entry.name) for entry in pathlib.Path("/proc").iterdir()
                       if entry.name.isdigit() and self.is_clock_of(run, entry))
            before = self.resident_mb(pid)
            for _ in range(60_000):  # answers of 1 kB each: 60 MB if all were kept
                stranger.socket.send(b'{"kind":"status"}')
            stranger.socket.send(b'{"kind":"rate","rate":2.0}')
            while other.ask({"kind": "status"})["rate"] != 2.0:  # all were heard; the test's time limit bounds it
                pass
            self.assertLess(self.resident_mb(pid) - before, 30)

    @staticmethod
    def is_clock_of(run, entry):
        try:
            line = (entry / "cmdline").read_bytes()
        except OSError:
            return False
        return b"ensonify-conductor" in line.split(b"\0")[0] and str(run.folder).encode() in line

    @staticmethod
    def resident_mb(pid):
        return int(pathlib.Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


if __name__ == "__main__":
    unittest.main()
