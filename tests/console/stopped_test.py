"""Viewers that are stopped, hidden, slow or come again each second: the run's record has the same bytes."""
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

from console import SOURCE, Console
from support import SystemTest
from viewer import Viewer

LAUNCH = f"""
ensonify: launch/1
scenario: {SOURCE}/scenarios/bay/scenario.yaml
duration_s: 20
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
  bow:   {{ run: multibeam, config: {{ beams: 64, quality: 0.1, ping_rate_hz: 4, amplitude_every: 5 }} }}
  side:  {{ run: sidescan, config: {{ quality: 0.1 }} }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: all }} }}
"""
ALL = ("bow/view", "side/view_main", "boat/pose", "bow/soundings", "cells", "track", "relief", "plan", "alarms", "clock/health")
WATCHES = """
import sys
sys.path[:0] = sys.argv[2:]
from viewer import Viewer
viewer = Viewer(sys.argv[1])
viewer.watch(*%r, cells=1024)
viewer.of("view/1", patience_s=30)
print("watches", flush=True)
while True:
    viewer.next(60)
""" % (ALL,)


class Stopped(SystemTest):
    def test_no_viewer_changes_a_byte(self):
        launch = self.write("bay.yaml", LAUNCH)
        self.assertEqual(self.run_launch(launch, "--free", out="alone", timeout=100).code, 0)
        console = Console(launch, "--out", self.folder / "watched", "--rate", "2", env=self.environment)
        self.addCleanup(console.stop)
        first = Viewer(console.view)
        self.addCleanup(first.close)
        first.until(lambda f: f.type == "console_state/1" and f.content["topics"], patience_s=30)

        stopped = subprocess.Popen([sys.executable, "-c", WATCHES, console.view, *sys.path], stdout=subprocess.PIPE, text=True)
        self.addCleanup(stopped.stdout.close)
        self.addCleanup(stopped.wait)
        self.addCleanup(stopped.kill)
        self.assertEqual(stopped.stdout.readline(), "watches\n")
        os.kill(stopped.pid, signal.SIGSTOP)

        hidden = Viewer(console.view)
        self.addCleanup(hidden.close)
        hidden.watch(*ALL, cells=1024, hidden=True)
        silent = Viewer(console.view, answers=False)
        self.addCleanup(silent.close)
        silent.watch(*ALL, cells=1024)
        pictures, comings, ended = [0], [0], threading.Event()

        def comes_again():
            while not ended.wait(1.0):
                try:
                    again = Viewer(console.view)
                    again.watch(*ALL, cells=512)
                    again.of("view/1", patience_s=1)
                    again.socket.socket.shutdown(2)  # without a word
                except Exception:
                    continue  # the console has ended, or was not as quick as a second
                comings[0] += 1

        def slow():
            viewer = Viewer(console.view)
            viewer.watch(*ALL, cells=1024)
            try:
                while not ended.is_set():
                    pictures[0] += viewer.next(20).type == "view/1"
                    time.sleep(0.2)  # as a page that draws as slowly
            except Exception:
                pass  # the console has ended

        threads = [threading.Thread(target=work) for work in (comes_again, slow)]
        for thread in threads:
            thread.start()
        try:
            self.assertEqual(console.process.wait(100), 0, console.stderr())
        finally:
            ended.set()
            for thread in threads:
                thread.join(30)
        self.assertGreater(comings[0], 2)
        self.assertGreater(pictures[0], 2)
        same = self.tool("compare", self.folder / "alone/run.mcap", self.folder / "watched/run.mcap")
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)


if __name__ == "__main__":
    unittest.main()
