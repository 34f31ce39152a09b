"""An agent that steers by pings holds a contour; without pings it does not; and with it in the loop runs repeat."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["ENSONIFY_SOURCE"])
BIN = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "bin"


class Agent(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ens-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_it(self, name, *options):
        """(exit code, verdicts by name)."""
        path = f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"  # python3 of the launch file is this one
        done = subprocess.run([BIN / "ensonify-run", SOURCE / "launch" / "agent.yaml", "--free", "--quiet", "--json", "--out",
                               self.folder / name, *options], capture_output=True, text=True, timeout=300,
                              env={**os.environ, "PATH": path})
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return done.returncode, {entry["name"]: entry["ok"] for entry in json.loads(done.stdout)["expect"]}

    def test_it_follows_the_contour_by_its_pings_and_repeats(self):
        records = [self.folder / f"{name}.mcap" for name in ("first", "second")]
        for record in records:
            code, verdicts = self.run_it(record.stem, "--record", record)
            self.assertEqual((code, verdicts), (0, {"stays on the contour": True, "gets on": True}))
        self.assertGreater(records[0].stat().st_size, 1_000_000)
        compared = subprocess.run([BIN / "ensonify-compare", *records], capture_output=True, text=True)
        self.assertEqual(compared.returncode, 0, compared.stdout + compared.stderr)
        self.assertEqual(records[0].read_bytes(), records[1].read_bytes())

    def test_with_the_pings_zeroed_it_fails_the_assertion(self):
        code, verdicts = self.run_it("blind", "--arg", "blind=true")
        self.assertEqual((code, verdicts), (1, {"stays on the contour": False, "gets on": True}))


if __name__ == "__main__":
    unittest.main()
