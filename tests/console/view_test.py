"""Pictures that heads make for viewers alone."""
import unittest

import ensonify
import numpy as np

from console import SOURCE, Console
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
  bow:   {{ run: multibeam, config: {{ beams: 48, quality: 0.1, ping_rate_hz: 2, amplitude_every: 3 }} }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: all }} }}
"""


class View(SystemTest):
    def launch(self, seconds):
        return self.write("bay.yaml", LAUNCH.format(source=SOURCE, seconds=seconds))

    def watch(self, *words):
        console = Console(*words, env=self.environment)
        self.addCleanup(console.stop)
        viewer = Viewer(console.control)
        self.addCleanup(viewer.close)
        viewer.until(lambda f: f.type == "console_state/1" and f.content["topics"], patience_s=30)
        return console, viewer

    def test_each_ping_is_shown_whatever_is_published_and_the_record_does_not_know(self):
        launch = self.launch(20)
        self.assertEqual(self.run_launch(launch, "--free", out="alone").code, 0)
        console, viewer = self.watch(launch, "--out", self.folder / "watched", "--rate", "1")
        viewer.watch("bow/view", cells=1024)
        views = [viewer.of("view/1", patience_s=20).content for _ in range(12)]
        viewer.say("console_command/1", command="rate", rate=0)
        viewer.close()
        self.assertEqual(console.process.wait(60), 0)
        first = views[0]["ping"]
        self.assertEqual([view["ping"] for view in views], list(range(first, first + 12)))
        self.assertGreater(len(views[0]["find_range_m"]), 10)
        same = self.tool("compare", self.folder / "alone/run.mcap", self.folder / "watched/run.mcap")
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)

        record = ensonify.Record(self.folder / "watched/run.mcap")
        self.assertNotIn("bow/view", record.topics())
        pings = {message.content.ping: message.content for message in record.messages("bow/ping")}
        self.assertEqual({ping % 3 for ping in pings}, {0})
        published = [view for view in views if view["ping"] in pings]
        self.assertEqual(len(published), 4)
        for view in published:
            ping = pings[view["ping"]]
            self.assertLessEqual(abs(view["position_enu_m"][0] - ping.pose_position_enu_m[0][0]), 1e-9)
            levels = view["level"].astype(float)
            shown_db = np.where(levels > 0, view["level_floor_db"] + (levels - 1) * view["level_step_db"], np.nan)
            power = ping.amplitude_upa.astype(float) ** 2
            block = -(-power.shape[1] // 1024)
            power = np.pad(power, ((0, 0), (0, levels.shape[1] * block - power.shape[1])), constant_values=np.nan)
            true_db = 10 * np.log10(np.nanmean(power.reshape(levels.shape[0], -1, block), axis=2))
            seen = levels > 1  # what is weaker stands at the floor
            self.assertGreater(seen.mean(), 0.5)
            self.assertLess(np.abs(shown_db - true_db)[seen].max(), 0.2501)

    def test_a_head_that_the_run_waits_for_shows_nothing_and_counts_it(self):
        console, viewer = self.watch(self.launch(100_000), "--out", self.folder / "out", "--rate", "5000")
        viewer.watch("bow/view", "clock/health", cells=64)

        def late(frame):
            return frame.type == "clock_health/1" and any(p["name"] == "bow" and p["late_events"] > 5 for p in frame.content["participants"])
        viewer.until(late, patience_s=40)
        viewer.until(late, patience_s=40)
        viewer.say("console_command/1", command="rate", rate=0)  # free: nothing is late any more
        shown = viewer.until(lambda f: f.type == "view/1" and f.content["left_out"] > 0, patience_s=40).content
        after = viewer.until(lambda f: f.type == "view/1" and f.content["ping"] > shown["ping"], patience_s=40).content
        self.assertGreaterEqual(after["left_out"], shown["left_out"])
        viewer.say("console_command/1", command="stop")
        self.assertEqual(console.process.wait(60), 0)


if __name__ == "__main__":
    unittest.main()
