"""docs/manual/wire.md is enough: clients in Python and JavaScript that use nothing of ours take part in runs, over ipc and tcp."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import ensonify

HERE = pathlib.Path(__file__).resolve().parent
RUN = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "bin" / "ensonify-run"
SCENARIO = pathlib.Path(os.environ["ENSONIFY_SOURCE"]) / "scenarios" / "slope" / "scenario.yaml"

LAUNCH = """\
ensonify: launch/1
scenario: SCENARIO
duration_s: 20
clock: {transport: TRANSPORT}
processes:
  auv: {run: vehicle}
  foreign: {run: [PROGRAM, CLIENT]}
expect:
  - {name: every command arrives, count: {topic: foreign/command, min: 199, max: 201}}
  - {name: no gap, no_gap: {topic: foreign/command}}
  # From (0, -200) heading 30 degrees at 2 m/s it turns east: after 20 s it is some 30 m east and hardly farther north.
  - {name: is obeyed, eventually: {topic: auv/pose, where: {field: position_enu_m.0, above: 25}, within_s: 20}}
  - {name: turns, bounds: {topic: auv/pose, field: position_enu_m.1, max: -190}}
"""

LATE = """\
ensonify: launch/1
scenario: SCENARIO
duration_s: 4
processes:
  auv: {run: vehicle}
  foreign: {run: [COMMAND]}
"""

PACKAGES = ("zeromq@6.8.0", "@msgpack/msgpack@3.1.3")  # zeromq brings a built libzmq inside the package


class Foreign(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ens-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_it(self, transport, client=HERE / "foreign_client.py", program=sys.executable, out_of=None, options=()):
        text = LAUNCH
        for word, value in (("SCENARIO", SCENARIO), ("TRANSPORT", transport), ("PROGRAM", program), ("CLIENT", client)):
            text = text.replace(word, str(value))
        launch = self.folder / "foreign.yaml"
        launch.write_text(text if out_of is None else text.replace(*out_of))
        done = subprocess.run([RUN, launch, "--free", "--json", "--quiet", "--out", self.folder / transport, *options],
                              capture_output=True, text=True, timeout=60)
        return done.returncode, done.stdout, done.stderr

    def javascript(self):
        """The client beside its packages, where Node searches for them."""
        if not shutil.which("node") or not shutil.which("npm"):
            self.skipTest("node and npm are not installed")
        modules = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "npm_zeromq"
        modules.mkdir(exist_ok=True)
        if not all((modules / "node_modules" / name).is_dir() for name in ("zeromq", "@msgpack/msgpack")):
            install = subprocess.run(["npm", "install", "--prefix", modules, "--no-audit", "--no-fund", "--save-exact", *PACKAGES],
                                     capture_output=True, text=True, timeout=100)
            if install.returncode != 0:
                self.skipTest(f"npm cannot install {PACKAGES}: {install.stderr.strip().splitlines()[-1:]}")
        return shutil.copy(HERE / "foreign_client.mjs", modules)

    def test_a_javascript_client_takes_part_and_its_empty_arrays_are_read(self):
        for transport in ("ipc", "tcp"):
            record = self.folder / f"{transport}.mcap"
            code, out, error = self.run_it(transport, self.javascript(), "node", options=("--record", record))
            self.assertEqual(code, 0, error + out)
            with ensonify.Record(record) as images:
                sizes = [image["pixels"].size for _, _, image in images.messages("foreign/image")]
            self.assertEqual(sizes, [0, 2, 4] * 67)

    def test_takes_part_over_ipc_and_tcp(self):
        for transport in ("ipc", "tcp"):
            code, out, error = self.run_it(transport)
            self.assertEqual(code, 0, error + out)
            self.assertTrue(all(entry["ok"] for entry in json.loads(out)["expect"]), out)

    def test_the_expectations_can_fail(self):
        code, out, error = self.run_it("ipc", out_of=("above: 25", "above: 60"))
        self.assertEqual(code, 1, error + out)

    def said_of_lateness(self, *words):
        launch = self.folder / "late.yaml"
        launch.write_text(LATE.replace("SCENARIO", str(SCENARIO)).replace("COMMAND", ", ".join([sys.executable, str(HERE / "late_client.py"), *words])))
        out = self.folder / f"late{len(words)}"
        done = subprocess.run([RUN, launch, "--rate", "1", "--quiet", "--out", out], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        late_events = {p["name"]: p["late_events"] for p in json.loads((out / "clock.json").read_text())["participants"]}
        self.assertGreater(late_events["foreign"], 0)
        return json.loads((out / "log/foreign.log").read_text().splitlines()[-1])

    def test_who_has_a_port_for_viewers_is_told_that_the_run_waits_for_it_and_when_no_more(self):
        said = self.said_of_lateness("view")
        words = [late for _, late in said]
        self.assertEqual(words, [i % 2 == 0 for i in range(len(words))])  # told when it changes, and not again
        self.assertFalse(words[-1])
        self.assertTrue(any(late and event > 10 for event, late in said))  # events 10 to 13 take 0.8 s too long

    def test_who_has_none_is_not_told(self):
        self.assertEqual(self.said_of_lateness(), [])


if __name__ == "__main__":
    unittest.main()
