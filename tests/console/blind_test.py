"""--blind: nothing that crosses the socket holds the truth."""
import unittest

import ensonify
import numpy as np

from console import SOURCE, Console
from support import SystemTest
from viewer import Frame, Viewer

ACTUAL_M, MEASURED_M = (1.53170625, 0.27190625, 0.81330625), (1.5, 0.25, 0.8)
SEED = 730250617
LAUNCH = """
ensonify: launch/1
scenario: scenario.yaml
duration_s: 10
processes:
  boat:  { run: vehicle }
  nav:   { run: navigation }
  pilot: { run: autopilot }
  pager: { run: terrain_pager }
  bow:   { run: multibeam, config: { beams: 48, quality: 0.1, ping_rate_hz: 4 } }
  side:  { run: sidescan, config: { quality: 0.1, labels: masks } }
  recorder: { run: recorder, config: { file: run.mcap, topics: all } }
"""
MADE = ("cells", "track", "alarms", "values", "relief", "log")


class Sniffer(Viewer):
    """Keeps all bytes that it is sent."""

    def __init__(self, url):
        self.data = []
        super().__init__(url)

    def next(self, patience_s=5.0):
        self.data.append(self.socket.recv(timeout=patience_s))
        frame = Frame(self.data[-1])
        if frame.type not in ("console_state/1", "console_answer/1"):
            self.say("console_drawn/1", topic=frame.topic, seq=frame.seq)
        return frame


def doubles(data):
    """Every eight bytes of it as a number, in either order of bytes."""
    for offset in range(8):
        part = data[offset:offset + (len(data) - offset) // 8 * 8]
        for order in "<>":
            yield np.frombuffer(part, order + "f8")


def holds_doubles(data, truth):
    return sum(int(np.isin(numbers, truth).sum()) for numbers in doubles(data))


def holds_pairs(data, pairs):
    """How many of these two floats, one behind the other, it holds anywhere."""
    keys = np.unique(np.ascontiguousarray(pairs, "<f4").reshape(-1, 2).view("<u8").ravel())
    return sum(int(np.isin(np.frombuffer(data[o:o + (len(data) - o) // 8 * 8], "<u8"), keys).sum()) for o in range(8))


class Blind(SystemTest):
    def watch_all(self, *words):
        """All that a viewer can have of a run, and its record."""
        scenario = (SOURCE / "scenarios/bay/scenario.yaml").read_text()
        scenario = scenario.replace("seed: 20250601", f"seed: {SEED}").replace(
            "actual: { position_m: [1.5, 0.2, 0.8] }", f"actual: {{ position_m: {list(ACTUAL_M)} }}\n        measured: {{ position_m: {list(MEASURED_M)} }}")
        self.write("scenario.yaml", scenario)
        launch = self.write("bay.yaml", LAUNCH)
        console = Console(launch, "--out", self.folder / "out", "--rate", "2", *words, env=self.environment)
        self.addCleanup(console.stop)
        viewer = Sniffer(console.view)
        self.addCleanup(viewer.close)
        state = viewer.until(lambda f: f.type == "console_state/1" and f.content["topics"], patience_s=30).content
        topics = [topic["name"] for topic in state["topics"]]
        viewer.watch(*topics[:64], values=["boat/pose.heading_grid_rad", "boat/pose.position_enu_m.0", "nav/estimate.heading_grid_rad"], cells=1024)
        try:
            while True:
                viewer.next(20)
        except Exception:  # the console ends with its run
            pass
        self.assertEqual(console.process.wait(60), 0)
        return b"".join(viewer.data), state, ensonify.Record(self.folder / "out/run.mcap")

    def truth(self, record):
        poses = [message.content for message in record.messages("boat/pose")]
        self.assertGreater(len(poses), 500)
        numbers = np.array([[*p.position_enu_m, *p.enu_from_body, *p.velocity_enu_mps] for p in poses])
        numbers = numbers[(np.abs(numbers) > 1e-6) & (numbers % 1 != 0)]  # whole ones are the mission's: its lines, its speed
        estimates = [message.content for message in record.messages("nav/estimate")]
        known = np.array([[*e.position_enu_m, *e.enu_from_body, *e.velocity_enu_mps] for e in estimates])
        return np.setdiff1d(numbers, np.append(known, [1.0, -1.0])), np.array([p.position_enu_m[:2] for p in poses])

    def heights(self, record):
        """Neighbours of the seabed that differ; those that stand in the chart are given."""
        chart = next(iter(record.messages("pager/chart"))).content.height_m
        pairs = []
        for message in record.messages("pager/tile"):
            rows = message.content.height_m[::16]
            pairs.append(np.stack([rows[:, :-1].ravel(), rows[:, 1:].ravel()], axis=1))
        pairs = np.concatenate(pairs)
        return pairs[np.isfinite(pairs).all(axis=1) & (pairs[:, 0] != pairs[:, 1]) & ~np.isin(pairs[:, 0], chart)]

    def test_no_truth_crosses_the_socket(self):
        data, state, record = self.watch_all("--blind")
        self.assertGreater(len(data), 200_000)
        types = {topic["type"] for topic in state["topics"]}
        self.assertLessEqual({"view/1", "soundings/1", "estimate/1", "console_track/1", "console_relief/1"}, types)
        self.assertFalse(types & {"pose/1", "tile/1", "labels/1", "health/1", "clock_health/1", "console_log/1"})
        self.assertEqual(state["items"], [])
        numbers, places = self.truth(record)
        self.assertEqual(holds_doubles(data, numbers), 0)
        self.assertEqual(holds_pairs(data, places), 0)
        self.assertEqual(holds_pairs(data, self.heights(record)), 0)
        self.assertEqual(holds_doubles(data, np.array(ACTUAL_M)), 0)
        for word in (str(SEED), *map(str, ACTUAL_M)):
            self.assertNotIn(word.encode(), data)
        self.assertEqual(holds_doubles(data, np.array([float(SEED)])), 0)

    def test_without_it_the_same_search_finds_the_truth(self):
        data, state, record = self.watch_all()
        self.assertIn("pose/1", {topic["type"] for topic in state["topics"]})
        numbers, _ = self.truth(record)
        self.assertGreater(holds_doubles(data, numbers), 100)
        heights = self.heights(record)[:1000]
        self.assertGreater(holds_pairs(b"..." + heights.astype("<f4").tobytes(), heights), 900)


if __name__ == "__main__":
    unittest.main()
