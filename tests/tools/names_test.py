"""Several runs at once: each is reached by its name, from the tools and from Python."""
import os
import subprocess
import unittest
from unittest import mock

import ensonify
from live_run import BIN, LiveRun


class Names(unittest.TestCase):
    def setUp(self):
        self.bay = self.enterContext(LiveRun(name="bay"))
        self.quay = self.enterContext(LiveRun(name="quay", beside=self.bay))

    def launch(self, *words):
        """`ensonify run` of the same stubs: (exit code, standard error)."""
        done = subprocess.run([BIN / "ensonify-run", self.bay.launch, "--out", self.bay.folder / "third", *words], text=True,
                              env={**os.environ, "XDG_RUNTIME_DIR": str(self.bay.runtime)}, capture_output=True, timeout=60)
        return done.returncode, done.stderr

    def test_each_is_reached_by_its_name_and_without_one_all_are_listed(self):
        code, _, error = self.bay.tool("topic", "list")
        self.assertEqual(code, 2)
        self.assertIn("several runs are live; name one with --run NAME:\n", error)
        for name, run in (("bay", self.bay), ("quay", self.quay)):
            self.assertRegex(error, rf"\n  {name}: {run.launch}, \d+ s old, process {run.process.pid}\n")
        for name in ("bay", "quay"):
            self.assertEqual(self.bay.tool("topic", "list", "--run", name)[0], 0)
            self.assertEqual(self.bay.tool("topic", "list", env={"ENSONIFY_RUN": name})[0], 0)
        runs = {run["run"]: run for run in self.bay.json("clock", "list")}
        self.assertEqual({name: run["launch"] for name, run in runs.items()},
                         {"bay": str(self.bay.launch), "quay": str(self.quay.launch)})
        self.assertEqual(self.bay.tool("clock", "stop", "--run", "quay")[0], 0)
        self.assertEqual(self.quay.process.wait(20), 0)
        self.assertEqual(self.bay.tool("topic", "list")[0], 0)

    def test_python_finds_a_run_by_its_name(self):
        with mock.patch.dict(os.environ, {"XDG_RUNTIME_DIR": str(self.bay.runtime)}):
            os.environ.pop("ENSONIFY_RUN", None)
            self.assertEqual([run.name for run in sorted(ensonify.live_runs())], ["bay", "quay"])
            with self.assertRaisesRegex(ensonify.RunError, rf"several runs are live, name one: .*bay \({self.bay.launch}, \d+ s old\)"):
                ensonify.find_clock()
            with ensonify.Observer("quay") as run:
                self.assertEqual(run.clock, (self.quay.directory() / "clock.endpoint").read_text())

    def test_a_name_is_given_once_and_is_plain(self):
        code, error = self.launch("--name", "bay")
        self.assertEqual(code, 2)
        self.assertRegex(error, rf"^--name: bay is the name of a live run \({self.bay.launch}, .* old, process {self.bay.process.pid}\); choose")
        for words, said in ((("--name", "a b"), "is no name of a run; allowed: 1 to 40 letters"), (("--name", "run-7"), "begins the ids"),
                            (("--name", "x", "--in-process"), "excludes")):
            code, error = self.launch(*words)
            self.assertEqual(code, 2)
            self.assertIn(said, error)

    def test_a_run_says_how_it_is_reached(self):
        code, error = self.launch("--set", "pilot.finish_s=0.2", "--name", "third")
        self.assertEqual(code, 0, error)
        self.assertIn("ensonify run: tools reach this run by --run third: ensonify topic list --run third\n", error)


if __name__ == "__main__":
    unittest.main()
