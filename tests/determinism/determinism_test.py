"""The promise: the same scenario, seed and binary give the same bytes, however fast, with whatever delays, on one core or
two, in one process or many. And the controls that show these comparisons can fail."""
import hashlib
import json
import os
import shutil
import struct
import subprocess
import unittest

import ensonify
import zmq
from support import SOURCE, SystemTest, bay, survey

RUNS = int(os.environ.get("ENSONIFY_DETERMINISM_RUNS", "20"))

def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


class SurveyBytes(SystemTest):
    """Real components: rays, echoes, noise, navigation, tiles."""

    def record(self, name, *options, prefix=()):
        launch = self.write("short.yaml", bay(seconds=6))
        done = subprocess.run([*prefix, *self.command(launch, *options, out=name)], capture_output=True, text=True,
                              env=self.environment, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / name / "run.mcap"

    def first(self):
        return self.kept("first.mcap", lambda: self.record("first"))

    def test_every_way_of_running_gives_the_same_file(self):
        first = self.first()
        wanted = digest(first)
        with ensonify.Record(first) as record:
            pings = sum(1 for _ in record.messages("bow/ping"))
        self.assertGreaterEqual(pings, 50)  # 6 s at 10 Hz, less the first moments and the last flight
        self.assertLessEqual(pings, 60)
        for i in range(RUNS - 1):
            self.assertEqual(digest(self.record(f"free{i}")), wanted, "free run")
            shutil.rmtree(self.folder / f"free{i}")
        self.assertEqual(digest(self.record("paced", "--rate", "3")), wanted, "paced")
        self.assertEqual(digest(self.record("one_core", prefix=("taskset", "-c", "0"))), wanted, "one core")
        self.assertEqual(digest(self.record("local", "--in-process")), wanted, "in one process")
        other = self.record("seed", "--set", "seed=7")
        self.assertNotEqual(digest(other), wanted, "another seed must differ")
        differs = self.tool("compare", first, other)
        self.assertEqual(differs.returncode, 6, differs.stdout + differs.stderr)

    def test_the_record_holds_nothing_of_this_machine(self):
        data = self.first().read_bytes()
        for secret in ("/ensonify-test-", str(SOURCE), "/home/", "/tmp/"):
            self.assertFalse(secret.encode() in data, secret)


class Disturbed(SystemTest):
    """Stubs with random wall-clock pauses before every event."""
    JITTER = {name: "jitter_ms: 3" for name in ("vehicle", "navigation", "pilot", "head", "consumer")}
    RECORDER = "  recorder: { run: recorder, config: { file: run.mcap } }"

    def arrival_order(self, run):
        """The order in which an observer of two publishers' live planes sees their messages."""
        context = zmq.Context()
        self.addCleanup(context.destroy, 0)
        endpoint = None
        while not endpoint:
            for path in self.runs.glob("ensonify/*/clock.endpoint"):
                endpoint = path.read_text()
        clock = context.socket(zmq.DEALER)
        clock.connect(endpoint)
        topics = []
        while not topics:
            clock.send_json({"kind": "registry"})
            topics = clock.recv_json()["topics"]
        seen = context.socket(zmq.SUB)
        seen.set_hwm(0)
        for topic in topics:
            if topic["topic"] in ("vehicle/pose", "navigation/estimate"):
                seen.connect(topic["live"])
                seen.subscribe(topic["topic"].encode() + b"\0")
        order = []
        while run.poll() is None:
            if seen.poll(20):
                frames = seen.recv_multipart()
                order.append((frames[0], struct.unpack_from("<Q", frames[1], 32)[0]))
        return order

    def test_random_delays_change_the_arrival_order_and_not_a_byte(self):
        calm = self.run_launch(survey(seconds=2, more=self.RECORDER), out="calm")
        self.assertEqual(calm.code, 0, calm.stderr)
        # Jitter is part of the launch text that a record keeps, so disturbed runs are compared with one another byte by
        # byte, and with the calm one message by message.
        launch = self.write("disturbed.yaml", survey(seconds=2, more=self.RECORDER, **self.JITTER))
        orders, digests = [], set()
        for i in range(3):
            run = self.start_launch(launch, out=f"d{i}")
            orders.append(self.arrival_order(run))
            _, errors = run.communicate(timeout=60)
            self.assertEqual(run.returncode, 0, errors)
            digests.add(digest(self.folder / f"d{i}" / "run.mcap"))
        self.assertEqual(len(digests), 1)
        self.assertTrue(orders[0] != orders[1] or orders[1] != orders[2], "the delays did not disturb anything")
        same = self.tool("compare", self.folder / "calm" / "run.mcap", self.folder / "d0" / "run.mcap")
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)


class Controls(SystemTest):
    """`compare` finds what it should between whole runs; a planted bit is found in components/record's own test."""

    def test_a_time_shift_and_a_lost_message_are_found(self):
        more = "  recorder: { run: recorder, config: { file: run.mcap } }"
        shifted = survey(seconds=1, more=more)
        records = []
        # The head's events shifted by its rate; a consumer's messages that stop early.
        for name, text in (("whole", shifted), ("shift", shifted.replace("rate_hz: 20, out", "rate_hz: 40, out").replace("hz: 20, bytes", "hz: 40, bytes")),
                           ("short", survey(seconds=2, more=more))):
            result = self.run_launch(text, out=name)
            self.assertEqual(result.code, 0, result.stderr)
            records.append(result.out / "run.mcap")
        self.assertEqual(self.first_difference(records[0], records[1])["topic"], "head/ping")
        self.assertGreater(self.first_difference(records[0], records[2])["t_sim_ns"], 1_900_000_000)

    def first_difference(self, a, b):
        found = self.tool("compare", "--json", a, b)
        self.assertEqual(found.returncode, 6, found.stdout + found.stderr)
        return json.loads(found.stdout)["first"]


if __name__ == "__main__":
    unittest.main(verbosity=2)
