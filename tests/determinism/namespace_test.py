"""One head in another network namespace, over TCP: the record is that of a run on one machine."""
import asyncio
import hashlib
import os
import subprocess
import sys
import threading
import unittest
from pathlib import Path

import zmq
from other_namespace import tcp_to_unix, unix_to_tcp
from support import BIN, SystemTest, survey

RECORDER = "  recorder: { run: recorder, config: { file: run.mcap } }"
LAUNCH = (survey(seconds=3, more=RECORDER).replace("progress_deadline_s: 0.2", "transport: tcp, keys: false")
          .replace("head: { run: stub", "head: { run: stub, external: true, join_s: 30"))


class OtherNamespace(SystemTest):
    def setUp(self):
        super().setUp()
        self.loop = asyncio.new_event_loop()
        threading.Thread(target=self.loop.run_forever, daemon=True).start()
        self.addCleanup(self.loop.call_soon_threadsafe, self.loop.stop)
        self.sockets = self.folder / "s"
        self.sockets.mkdir()

    def here(self, coroutine):
        asyncio.run_coroutine_threadsafe(coroutine, self.loop).result(10)

    def reach_from_there(self, there, port):
        """127.0.0.1:port over there is 127.0.0.1:port here."""
        self.here(unix_to_tcp(str(self.sockets / f"{port}.sock"), port))
        self.send(there, f"out {port}")

    def reach_from_here(self, there, port):
        self.send(there, f"in {port}")
        self.here(tcp_to_unix(port, str(self.sockets / f"in.{port}.sock")))

    def send(self, there, line):
        there.stdin.write(line + "\n")
        there.stdin.flush()
        self.assertEqual(there.stdout.readline().strip(), "done")

    def digest_of_run(self, launch, out, elsewhere):
        run = self.start_launch(launch, out=out)
        endpoint_file = None
        while not endpoint_file:
            self.assertIsNone(run.poll(), run.poll() is not None and run.stderr.read())
            endpoint_file = next(self.runs.glob("ensonify/*/clock.endpoint"), None)
        endpoint = endpoint_file.read_text().strip()
        command = [str(BIN / "ensonify-stub"), "--launch", str(launch), "--out", str(self.folder / out), "--name", "head",
                   "--clock", endpoint, "--run-dir", str(self.folder)]
        if elsewhere:
            head = self.start_elsewhere(command, endpoint)
        else:
            head = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        _, errors = run.communicate(timeout=60)
        head.communicate(timeout=20)
        self.assertEqual((run.returncode, head.returncode), (0, 0), errors)
        return hashlib.sha256((self.folder / out / "run.mcap").read_bytes()).hexdigest()

    def start_elsewhere(self, command, clock):
        there = subprocess.Popen([sys.executable, str(Path(__file__).with_name("other_namespace.py")), str(self.sockets),
                                  *command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        word = there.stdout.readline().split()
        if not word:
            for pid, _ in self.processes():
                os.kill(pid, 9)
            self.skipTest("network namespaces are not to be had here (needs root)")
        self.assertNotEqual(os.readlink(f"/proc/{word[1]}/ns/net"), os.readlink("/proc/self/ns/net"))
        self.reach_from_there(there, int(clock.rsplit(":", 1)[1]))
        self.send(there, "start")
        for topic, endpoint in self.endpoints(clock).items():
            port = int(endpoint.rsplit(":", 1)[1])
            if topic == "vehicle/pose":
                self.reach_from_there(there, port)
            elif topic == "head/ping":
                self.assertIn(port, range(20000, 21000))
                self.reach_from_here(there, port)
        there.stdin.close()
        there.stdin = None
        return there

    def endpoints(self, clock):
        context = zmq.Context()
        query = context.socket(zmq.DEALER)
        query.linger = 0
        query.connect(clock)
        topics = []
        while not topics:  # known once everybody has said hello
            query.send_json({"kind": "registry"})
            topics = query.recv_json()["topics"]
        context.destroy(0)
        return {topic["topic"]: topic["sync"] for topic in topics if topic["sync"]}  # the clock's own has a live plane only

    def test_the_record_is_the_same_as_with_the_head_on_this_side(self):
        launch = self.write("tcp.yaml", LAUNCH)
        here = self.digest_of_run(launch, "here", elsewhere=False)
        there = self.digest_of_run(launch, "there", elsewhere=True)
        self.assertEqual(here, there)


if __name__ == "__main__":
    unittest.main(verbosity=2)
