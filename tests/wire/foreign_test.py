"""docs/manual/wire.md is enough: a client that uses nothing of ours takes part in a run, over ipc and over tcp."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

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
  foreign: {run: [PYTHON, CLIENT]}
expect:
  - {name: every command arrives, count: {topic: foreign/command, min: 199, max: 201}}
  - {name: no gap, no_gap: {topic: foreign/command}}
  # From (0, -200) heading 30 degrees at 2 m/s it turns east: after 20 s it is some 30 m east and hardly farther north.
  - {name: is obeyed, eventually: {topic: auv/pose, where: {field: position_enu_m.0, above: 25}, within_s: 20}}
  - {name: turns, bounds: {topic: auv/pose, field: position_enu_m.1, max: -190}}
"""


class Foreign(unittest.TestCase):
    def run_it(self, transport, client="foreign_client.py", out_of=None):
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            text = LAUNCH
            for word, value in (("SCENARIO", SCENARIO), ("TRANSPORT", transport), ("PYTHON", sys.executable),
                                ("CLIENT", HERE / client)):
                text = text.replace(word, str(value))
            launch = pathlib.Path(folder) / "foreign.yaml"
            launch.write_text(text if out_of is None else text.replace(*out_of))
            done = subprocess.run([RUN, launch, "--free", "--json", "--quiet", "--out", pathlib.Path(folder) / "out"],
                                  capture_output=True, text=True, timeout=60)
            return done.returncode, done.stdout, done.stderr

    def test_takes_part_over_ipc_and_tcp(self):
        for transport in ("ipc", "tcp"):
            code, out, error = self.run_it(transport)
            self.assertEqual(code, 0, error + out)
            self.assertTrue(all(entry["ok"] for entry in json.loads(out)["expect"]), out)

    def test_the_expectations_can_fail(self):
        code, out, error = self.run_it("ipc", out_of=("above: 25", "above: 60"))
        self.assertEqual(code, 1, error + out)


if __name__ == "__main__":
    unittest.main()
