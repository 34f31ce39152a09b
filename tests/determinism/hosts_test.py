"""A launch on two hosts, which are two network namespaces with a cable between them: the record is that of one host; who
has no key, another key or an address that is not allowed gets nothing. Needs root and iproute2."""
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

import zmq
from support import BIN, SystemTest, survey

HERE, THERE, OTHER = "10.77.0.1", "10.77.0.2", "10.77.0.3"
RECORDER = "  recorder: { run: recorder, config: { file: run.mcap } }"
LAUNCH = (survey(seconds=3, more=RECORDER)
          .replace("progress_deadline_s: 0.2", f"transport: tcp, address: {HERE}, port: 20077, allow: [{THERE}]")
          .replace("head: { run: stub", "head: { run: stub, external: true, join_s: 30"))

# What a stranger asks and subscribes to, from the address given, with the keys of the file given or none; prints what came.
STRANGER = """
import json, sys, zmq
clock, live, source, keys = sys.argv[1:]
context = zmq.Context()
came = []
poller = zmq.Poller()
for kind, endpoint in ((zmq.DEALER, clock), (zmq.SUB, live)):
    socket = context.socket(kind)
    socket.linger = 0
    if keys:
        k = json.load(open(keys))
        socket.curve_serverkey = k["bound_public"].encode()
        socket.curve_publickey, socket.curve_secretkey = k["connected_public"].encode(), k["connected_secret"].encode()
    socket.connect(endpoint.replace("tcp://", f"tcp://{source}:0;"))
    if kind == zmq.DEALER:
        for request in ("status", "registry", "pause", "stop"):
            socket.send_json({"kind": request})
    else:
        socket.subscribe(b"")
    poller.register(socket, zmq.POLLIN)
for socket, _ in poller.poll(1500):
    came.append(socket.recv()[:40].decode(errors="replace"))
print(json.dumps(came))
"""


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, check=True)


class Hosts(SystemTest):
    def setUp(self):
        super().setUp()
        if os.geteuid() != 0 or not shutil.which("ip"):
            self.skipTest("two network namespaces need root and iproute2")
        self.a, self.b = f"ens{os.getpid()}a", f"ens{os.getpid()}b"
        try:
            for namespace in (self.a, self.b):
                run("ip", "netns", "add", namespace)
                self.addCleanup(subprocess.run, ["ip", "netns", "del", namespace])
            run("ip", "link", "add", "v0", "netns", self.a, "type", "veth", "peer", "name", "v0", "netns", self.b)
        except subprocess.CalledProcessError as error:
            self.skipTest(f"network namespaces are not to be had here: {error.stderr.strip()}")
        for namespace, addresses in ((self.a, (HERE,)), (self.b, (THERE, OTHER))):
            for address in addresses:
                run("ip", "-n", namespace, "addr", "add", f"{address}/24", "dev", "v0")
            for device in ("lo", "v0"):
                run("ip", "-n", namespace, "link", "set", device, "up")

    def inside(self, namespace, *words):
        return ["ip", "netns", "exec", namespace, *map(str, words)]

    def start(self, launch, out, namespace):
        """The run in namespace a, and the head in the one given."""
        whole = subprocess.Popen(self.inside(self.a, *self.command(launch, out=out)), stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, text=True, env=self.environment)
        found = None
        while not found:
            self.assertIsNone(whole.poll(), whole.poll() is not None and whole.stderr.read())
            found = next(self.runs.glob("ensonify/*/clock.endpoint"), None)
            time.sleep(0.01)
        copy = shutil.copy(found.parent / "keys.json", self.folder / f"{out}.keys.json")
        self.assertEqual((found.parent / "keys.json").stat().st_mode & 0o777, 0o600)
        endpoint = found.read_text().strip()
        self.assertEqual(endpoint, f"tcp://{HERE}:20077")
        return whole, endpoint, copy, lambda: subprocess.Popen(self.inside(
            namespace, BIN / "ensonify-stub", "--launch", launch, "--out", self.folder / out, "--name", "head",
            "--clock", endpoint, "--keys", copy), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def digest(self, whole, head, out):
        _, errors = whole.communicate(timeout=60)
        _, head_errors = head.communicate(timeout=20)
        self.assertEqual((whole.returncode, head.returncode), (0, 0), errors + head_errors)
        return hashlib.sha256((self.folder / out / "run.mcap").read_bytes()).hexdigest()

    def stranger(self, clock, live, source, keys=""):
        done = subprocess.run(self.inside(self.b, sys.executable, "-c", STRANGER, clock, live, source, keys),
                              capture_output=True, text=True, timeout=30)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_two_hosts_make_the_record_of_one_and_strangers_get_nothing(self):
        launch = self.write("hosts.yaml", LAUNCH)
        digests = []
        for out, namespace in (("one", self.a), ("two", self.b)):
            whole, _, _, start_head = self.start(launch, out, namespace)
            digests.append(self.digest(whole, start_head(), out))
        self.assertEqual(*digests)

        slow = self.write("slow.yaml", LAUNCH.replace("rate: free", "rate: 1").replace("finish_s: 3", "finish_s: 8"))
        whole, clock, keys, start_head = self.start(slow, "strangers", self.b)
        others = json.loads(pathlib.Path(keys).read_text())
        public, secret = zmq.curve_keypair()
        others.update(connected_public=public.decode(), connected_secret=secret.decode())
        forged = self.write("forged.json", json.dumps(others))
        head = start_head()
        self.wait_for_go("strangers")
        live = self.live_of(clock, keys)  # with the keys, from an allowed address, the clock answers
        self.assertTrue(live.startswith(f"tcp://{HERE}:"), live)
        for source, file in ((THERE, ""), (THERE, forged), (OTHER, keys)):
            self.assertEqual(self.stranger(clock, live, source, file), [])
        self.digest(whole, head, "strangers")
        log = (self.folder / "strangers" / "log" / "clock.log").read_text()
        self.assertIn(f'turned_away address={THERE} why="it has another key"', log)
        self.assertIn(f'turned_away address={OTHER} why="its address is not allowed"', log)

    def live_of(self, clock, keys):
        """The live endpoint of the vehicle, as who may ask is told."""
        ask = f"""
import json, os, sys
os.environ["ENSONIFY_KEYS"] = {str(keys)!r}
import ensonify
with ensonify.Observer({clock!r}) as run:
    print(next(topic["live"] for topic in run.topics() if topic["topic"] == "vehicle/pose"))
"""
        done = subprocess.run(self.inside(self.b, sys.executable, "-c", ask), capture_output=True, text=True, timeout=30)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()


if __name__ == "__main__":
    unittest.main(verbosity=2)
