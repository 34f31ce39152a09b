"""A live run in a console."""
import os
import pathlib
import subprocess
import sys
import unittest

import numpy as np

from console import BIN, SOURCE, Console
from support import SystemTest
from viewer import Viewer

LAUNCH = """
ensonify: launch/1
scenario: {source}/scenarios/bay/scenario.yaml
duration_s: {seconds}
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
  bow:   {{ run: multibeam, config: {{ beams: 64, quality: 0.1 }} }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: all }} }}
"""


class Run(SystemTest):
    def console(self, *words):
        console = Console(*words, env=self.environment)
        self.addCleanup(console.stop)
        return console

    def launch(self, seconds):
        return self.write("bay.yaml", LAUNCH.format(source=SOURCE, seconds=seconds))

    def test_a_run_is_watched_commanded_and_its_exit_code_given(self):
        at = self.console(self.launch(600), "--out", self.folder / "out", "--rate", "1")
        viewer = Viewer(at.control)
        waiting = viewer.of("console_state/1").content
        self.assertEqual((waiting["kind"], waiting["state"]), ("run", "waiting"))
        running = viewer.until(lambda f: f.type == "console_state/1" and f.content["topics"], patience_s=30).content
        self.assertIn({"name": "bow/view", "type": "view/1", "publisher": "bow", "component": "multibeam"}, running["topics"])
        viewer.watch("bow/view", "clock/health", cells=256)
        view = viewer.of("view/1", patience_s=20).content
        self.assertEqual(view["level"].shape[0], 64)
        self.assertEqual(view["beam_axis"], "down")
        self.assertGreater(np.count_nonzero(view["level"]), 1000)
        self.assertGreater(view["frequency_hz"], 1e4)
        self.assertEqual(viewer.of("clock_health/1", patience_s=20).content["rate"], 1.0)

        viewer.say("console_command/1", command="pause")
        viewer.until(lambda f: f.type == "console_state/1" and f.content["state"] == "paused", patience_s=20)
        asked = self.tool("clock", "status", "--json")
        self.assertIn('"state":"paused"', asked.stdout)
        viewer.say("console_command/1", command="resume")
        viewer.until(lambda f: f.type == "console_state/1" and f.content["state"] == "running", patience_s=20)
        viewer.say("console_command/1", command="rate", rate=3)
        viewer.until(lambda f: f.type == "console_state/1" and f.content["speed"] == 3, patience_s=20)
        viewer.say("console_command/1", command="stop")
        code = at.process.wait(60)
        self.assertEqual(code, 0, at.stderr())
        self.assertTrue((self.folder / "out/run.json").exists())

    def test_watching_changes_no_byte_of_the_record(self):
        launch = self.launch(8)
        self.assertEqual(self.run_launch(launch, "--free", out="alone").code, 0)
        at = self.console(launch, "--out", self.folder / "watched", "--free")
        viewers = [Viewer(at.view), Viewer(at.view, answers=False)]
        for viewer in viewers:
            viewer.until(lambda f: f.type == "console_state/1" and f.content["topics"], patience_s=30)
            viewer.watch("bow/view", "boat/pose", "pager/health", cells=1024)
        viewers[0].of("view/1", patience_s=20)
        self.assertEqual(at.process.wait(60), 0)
        same = self.tool("compare", self.folder / "alone/run.mcap", self.folder / "watched/run.mcap")
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)

    def test_a_run_of_somebody_else_is_joined_before_it_is_there_and_outlived(self):
        at = self.console("--run", "mine")
        viewer = Viewer(at.view)
        self.assertEqual(viewer.of("console_state/1").content["message"], "no such run yet: mine")
        run = self.start_launch(self.launch(3), "--free", "--name", "mine")
        viewer.watch("bow/view", cells=64)
        viewer.of("view/1", patience_s=30)
        run.communicate(timeout=60)
        self.assertEqual(run.returncode, 0)
        viewer.until(lambda f: f.type == "console_state/1" and f.content["state"] == "ended" and "ended" in f.content["message"], patience_s=20)
        again = self.start_launch(self.launch(3), "--free", "--name", "mine")
        viewer.of("view/1", patience_s=30)
        again.communicate(timeout=60)
        self.assertTrue(at.lives())
        viewer.close()

    def test_a_run_that_fails_gives_its_exit_code(self):
        bad = self.write("bad.yaml", LAUNCH.format(source=SOURCE, seconds=2) + "expect:\n  - { name: never, eventually: { topic: bow/soundings, where: { field: ping, equals: 9999 }, within_s: 1 } }\n")
        at = self.console(bad, "--out", self.folder / "out", "--free")
        self.assertEqual(at.process.wait(60), 1)
        wrong = self.write("wrong.yaml", "ensonify: launch/1\nprocesses: 5\n")
        at = self.console(wrong, "--out", self.folder / "out2")
        self.assertEqual(at.process.wait(60), 2)

    def test_after_the_run_it_says_once_more_what_to_open_and_serves_the_record(self):
        at = self.console(self.launch(3), "--out", self.folder / "out", "--free", "--stay")
        lines = [at.process.stdout.readline() for _ in range(2)]
        self.assertEqual(lines, ["the run has ended, exit code 0; Ctrl-C ends the console\n", f"open this URL: {at.view}\n"])
        viewer = Viewer(at.view)
        state = viewer.of("console_state/1").content
        self.assertEqual((state["kind"], state["name"]), ("record", str(self.folder / "out/run.mcap")))
        viewer.watch("bow/view", cells=16)
        viewer.of("view/1", patience_s=20)
        viewer.close()

    def test_nobody_is_told_of_runs_of_others_but_their_names(self):
        run = self.start_launch(self.launch(600), "--rate", "1", "--name", "listed")
        self.wait_for_go()
        at = self.console()
        viewer = Viewer(at.view)
        state = viewer.of("console_state/1").content
        self.assertEqual(state["kind"], "")
        self.assertEqual([item["id"] for item in state["items"]], ["run:listed"])
        self.assertIn("launch/demo.yaml", state["launches"])
        viewer.say("console_open/1", id="run:listed")
        viewer.until(lambda f: f.type == "console_state/1" and f.content["name"] == "listed")
        viewer.watch("bow/view", cells=16)
        viewer.of("view/1", patience_s=30)
        viewer.close()
        run.send_signal(2)
        run.communicate(timeout=60)


if __name__ == "__main__":
    unittest.main()
