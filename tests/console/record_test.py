"""A record played in a console: what a viewer gets of it."""
import signal
import time
import unittest

import ensonify
import numpy as np

from console import STEP_M, ConsoleTest, fan, health, sides, slope_depth_m, survey, write_record
from viewer import Viewer


def level_db(view):
    """Of each cell; NaN: nothing was received."""
    value = view["level"].astype(float)
    return np.where(value > 0, view["level_floor_db"] + (value - 1) * view["level_step_db"], np.nan)


class Record(ConsoleTest):
    def test_a_picture_has_the_levels_and_places_of_its_ping(self):
        at = self.console(write_record(self.folder / "fan.mcap", fan(pings=3)), "--loop")
        viewer = Viewer(at.view)
        topics = viewer.of("console_state/1").content["topics"]
        self.assertEqual([(topic["name"], topic["type"]) for topic in topics], [("bow/view", "view/1"), ("values", "console_values/1")])
        viewer.watch("bow/view", cells=1024)
        view = viewer.of("view/1").content
        self.assertEqual(view["level"].shape, (61, 1000))
        self.assertAlmostEqual(view["cell_m"], STEP_M, 9)
        self.assertAlmostEqual(view["first_range_m"], -STEP_M / 2, 9)
        cell = round(35.1 / STEP_M)
        self.assertAlmostEqual(level_db(view)[12, cell], 120.0, delta=0.25)
        level = level_db(view)
        level[12, cell] = 60.0
        np.testing.assert_allclose(level, 60.0, atol=0.25)

        viewer.watch("bow/view", cells=250)  # four samples a cell: a quarter of the power
        view = viewer.until(lambda f: f.type == "view/1" and f.content["level"].shape[1] == 250).content
        self.assertAlmostEqual(level_db(view)[12, cell // 4], 120.0 - 6.02, delta=0.26)
        viewer.watch("bow/view", cells=250, peak=True)
        view = viewer.until(lambda f: f.type == "view/1" and f.content["peak"]).content
        self.assertAlmostEqual(level_db(view)[12, cell // 4], 120.0, delta=0.26)
        viewer.watch("bow/view", cells=1024, spreading_db=30)
        view = viewer.until(lambda f: f.type == "view/1" and f.content["added_spreading_db"] == 30).content
        self.assertAlmostEqual(level_db(view)[12, cell], 120.0 + 30 * np.log10(cell * STEP_M), delta=0.26)
        viewer.close()

    def test_every_line_comes_in_order_round_after_round(self):
        at = self.console(write_record(self.folder / "sides.mcap", sides(pings=20)), "--loop", "--rate", "10")
        viewer = Viewer(at.view)
        viewer.watch("fish/view", cells=64)
        seen = [viewer.of("view/1") for _ in range(70)]
        pings = [frame.content["ping"] for frame in seen]
        self.assertEqual(pings, list(range(pings[0], pings[0] + 70)))
        for frame in seen:
            np.testing.assert_allclose(level_db(frame.content)[0], 80 + frame.content["ping"] % 20, atol=0.25)
            np.testing.assert_allclose(level_db(frame.content)[1], 100, atol=0.25)
        stamps = np.diff([frame.content["stamp_ns"] for frame in seen])
        self.assertTrue((stamps > 0).all() and (stamps <= 2.1e8).all(), stamps)
        flow = viewer.of("console_flow/1").content["topics"][0]
        self.assertEqual(flow["lost"], 0)
        viewer.close()

    def test_it_plays_at_its_own_pace_to_its_end(self):
        at = self.console(write_record(self.folder / "sides.mcap", sides(pings=20)))
        viewer = Viewer(at.view)
        viewer.watch("fish/view", cells=64)
        viewer.of("view/1")
        began = time.monotonic()
        left = {"last line", "end"}  # small messages overtake lines
        while left:
            frame = viewer.next()
            if frame.type == "view/1" and frame.content["ping"] == 19:
                left.discard("last line")
            if frame.type == "console_state/1" and frame.content["state"] == "ended":
                left.discard("end")
        self.assertGreater(time.monotonic() - began, 1.5)
        viewer.close()

    def test_pause_resume_and_rate_of_a_record(self):
        at = self.console(write_record(self.folder / "sides.mcap", sides(pings=20)), "--loop")
        viewer = Viewer(at.control)
        viewer.watch("fish/view", cells=64)
        viewer.of("view/1")
        viewer.say("console_command/1", command="pause")
        viewer.until(lambda f: f.type == "console_state/1" and f.content["state"] == "paused")
        with self.assertRaises(AssertionError):
            viewer.until(lambda f: f.type == "view/1", most=2)  # two reports of the flow, and no line
        viewer.say("console_command/1", command="resume")
        viewer.of("view/1")
        viewer.say("console_command/1", command="rate", rate=20)
        viewer.until(lambda f: f.type == "console_state/1" and f.content["speed"] == 20)
        viewer.until(lambda f: f.type == "console_flow/1" and f.content["topics"][0]["rate_hz"] > 60)
        viewer.close()

    def cells_and_tracks(self, viewer, rows):
        """All cells, by (column, row), and all points, once the last row of the survey is there."""
        cells, points = {}, {}
        while max((row for _, row in cells), default=-1) < rows - 1:
            frame = viewer.next()
            if frame.type == "console_cells/1":
                c = frame.content
                self.assertEqual(c["cell_m"], 0.5)
                for i in range(len(c["column"])):
                    cells[c["column"][i], c["row"][i]] = c["count"][i], c["mean_depth_m"][i], c["shoalest_depth_m"][i], c["sd_m"][i]
            elif frame.type == "console_track/1":
                grown = points.setdefault(frame.content["source"], [])
                self.assertEqual(frame.content["first"], len(grown))
                grown += [tuple(point) for point in frame.content["point_enu_m"]]
                self.assertEqual(frame.content["truth"], frame.content["source"] == "boat/pose")
                self.assertAlmostEqual(np.cos(frame.content["heading_rad"]), 1.0, 9)
        return cells, points

    def test_the_chart_has_all_soundings_in_cells_and_the_tracks(self):
        at = self.console(write_record(self.folder / "survey.mcap", survey(pings=60)))
        viewer = Viewer(at.view)
        topics = [topic["name"] for topic in viewer.of("console_state/1").content["topics"]]
        self.assertIn("cells", topics)
        self.assertIn("track", topics)
        viewer.watch("cells", "track")
        cells, points = self.cells_and_tracks(viewer, 60)
        self.assertEqual(len(cells), 41 * 60)
        for (column, row), (count, mean_m, shoalest_m, sd_m) in cells.items():
            shoal_m = slope_depth_m(0.5 * column + 0.25) - (0.5 if row % 4 == 0 else 0.0)
            self.assertEqual(count, 2)
            self.assertAlmostEqual(mean_m, shoal_m + 0.125, delta=1e-4)
            self.assertAlmostEqual(shoalest_m, shoal_m, delta=1e-4)
            self.assertAlmostEqual(sd_m, 0.25 / np.sqrt(2), delta=1e-4)
        self.assertEqual(sorted(points), ["boat/pose", "nav/estimate"])
        self.assertGreater(len(points["boat/pose"]), 50)
        late = Viewer(at.view)
        late.watch("cells", "track")
        self.assertEqual(self.cells_and_tracks(late, 60)[0], cells)
        late.close()
        viewer.close()

    def test_states_are_kept_for_who_comes_later(self):
        at = self.console(write_record(self.folder / "health.mcap", sides(pings=50), health()), "--loop")
        first = Viewer(at.view)
        first.watch("nav/health", "fish/view", cells=16)
        self.assertEqual(first.of("health/1").content["message"], "<b>report</b> 0")
        late = Viewer(at.view)
        late.watch("nav/health", cells=16)
        self.assertEqual(late.of("health/1").content["state"], "degraded")
        first.close()
        late.close()

    def test_a_viewer_that_does_not_answer_is_let_be_and_the_others_go_on(self):
        at = self.console(write_record(self.folder / "sides.mcap", sides(pings=200, rate_hz=50), fan(pings=60)), "--loop")
        stuck = Viewer(at.view, answers=False)
        stuck.watch("bow/view", "fish/view", cells=1024)
        viewer = Viewer(at.view)
        viewer.watch("fish/view", cells=64)
        pings = [viewer.of("view/1").content["ping"] for _ in range(400)]
        self.assertEqual(pings, list(range(pings[0], pings[0] + 400)))
        came = []
        with self.assertRaises(TimeoutError):
            while True:
                came.append(stuck.next(patience_s=0.5))
        pictures = [frame for frame in came if frame.topic == "bow/view"]
        self.assertEqual(len(pictures), 1)  # one on its way until it has been drawn
        stuck.answers = True
        stuck.say("console_drawn/1", topic="bow/view", seq=pictures[0].seq)
        began = time.monotonic()
        self.assertEqual(stuck.of("console_state/1").content["kind"], "record")
        newest = stuck.until(lambda f: f.topic == "bow/view")
        self.assertLess(time.monotonic() - began, 3)  # 0.5 s are the goal on an idle machine
        self.assertGreater(newest.content["ping"], pictures[0].content["ping"] + 30)
        stuck.close()
        viewer.close()

    def test_a_hidden_page_is_sent_nothing(self):
        at = self.console(write_record(self.folder / "sides.mcap", sides(pings=20)), "--loop")
        viewer = Viewer(at.view)
        viewer.watch("fish/view", cells=64)
        viewer.of("view/1")
        viewer.watch("fish/view", cells=64, hidden=True)
        with self.assertRaises(TimeoutError):
            for _ in range(30):
                viewer.next(patience_s=1.5)
        viewer.watch("fish/view", cells=64)
        self.assertEqual(viewer.of("view/1", patience_s=3).topic, "fish/view")
        viewer.close()

    def test_another_record_of_the_folder_is_opened_and_nothing_beside_it(self):
        first = write_record(self.folder / "a.mcap", sides(pings=20))
        (self.folder / "deep").mkdir()
        write_record(self.folder / "deep/b.mcap", fan(pings=5))
        write_record(self.folder / ".hidden.mcap", fan(pings=5))
        (self.folder / "link.mcap").symlink_to("/etc/passwd")
        at = self.console(first, "--loop", "--folder", self.folder)
        viewer = Viewer(at.view)
        records = [item for item in viewer.of("console_state/1").content["items"] if item["kind"] == "record"]
        self.assertEqual([item["text"] for item in records], ["a.mcap", "deep/b.mcap"])
        viewer.say("console_open/1", id=records[1]["id"])
        state = viewer.until(lambda f: f.type == "console_state/1" and f.content["name"].endswith("b.mcap")).content
        self.assertEqual(state["topics"][0]["name"], "bow/view")
        viewer.watch("bow/view", cells=16)
        self.assertEqual(viewer.of("view/1").topic, "bow/view")
        viewer.close()

    def test_odd_pings_are_no_pictures_and_say_why(self):
        def odd():
            for ping, shape in enumerate(((0, 0), (3, 40), (61, 0))):
                yield "bow/ping", ensonify.Ping(stamp_ns=ping * 10**8, ping=ping, sample_period_s=1e-4, sound_speed_mps=1500.0,
                                                beam_angle_rad=np.zeros(61, "f4"), amplitude_upa=np.ones(shape, "f4"))

        at = self.console(write_record(self.folder / "odd.mcap", odd(), sides(pings=10)), "--loop")
        viewer = Viewer(at.view)
        viewer.watch("bow/view", "fish/view", cells=16)
        self.assertIn("no samples", viewer.of("console_answer/1").content["error"])
        viewer.until(lambda f: f.type == "console_answer/1" and "do not fit 61 beam angles" in f.content["error"])
        viewer.of("view/1")
        viewer.close()

    def test_heads_may_change_from_ping_to_ping(self):
        shapes = [(1024, 300), (3, 50), (64, 3000), (512, 1)]

        def changing():
            for ping in range(20):
                beams, samples = shapes[ping % 4]
                yield "bow/ping", ensonify.Ping(
                    stamp_ns=ping * 10**8, ping=ping, sample_period_s=1e-4, sound_speed_mps=1500.0 + ping, range_m=10.0 * ping,
                    beam_angle_rad=np.linspace(-1, 1, beams).astype("f4"), amplitude_upa=np.full((beams, samples), np.nan if ping == 7 else 10.0, "f4"))

        at = self.console(write_record(self.folder / "changing.mcap", changing()), "--loop")
        viewer = Viewer(at.view)
        viewer.watch("bow/view", cells=1024)
        seen = set()
        while len(seen) < 5:
            view = viewer.of("view/1").content
            beams, samples = shapes[view["ping"] % 20 % 4]
            cells = samples if samples <= 1024 else -(-samples // 3)
            self.assertEqual(view["level"].shape, (beams, cells))
            self.assertEqual(int(view["level"].max()) == 0, view["ping"] % 20 == 7)  # no finite number: nothing was received
            seen.add((beams, view["ping"] % 20 == 7))
        viewer.close()

    def test_four_records_are_open_at_most(self):
        files = [write_record(self.folder / f"{name}.mcap", sides(pings=20)) for name in "abcde"]
        at = self.console(files[0], "--loop")
        viewers = [Viewer(at.view) for _ in files]
        for viewer, file in zip(viewers[:4], files):
            viewer.say("console_open/1", id=f"record:{file}")
            viewer.until(lambda f, name=str(file): f.type == "console_state/1" and f.content["name"] == name)
        viewers[4].say("console_open/1", id=f"record:{files[4]}")
        self.assertIn("four", viewers[4].of("console_answer/1").content["error"])
        for viewer in viewers:
            viewer.close()

    def test_a_record_cut_short_is_played_as_far_as_it_goes(self):
        whole = write_record(self.folder / "whole.mcap", sides(pings=500))
        cut = self.folder / "cut.mcap"
        cut.write_bytes(whole.read_bytes()[:whole.stat().st_size // 2])
        at = self.console(cut, "--free")
        viewer = Viewer(at.view)
        viewer.watch("fish/view", cells=16)
        seen = {}  # states come before pictures
        while not {"view/1", "ended"} <= seen.keys():
            frame = viewer.next()
            seen[frame.content["state"] if frame.type == "console_state/1" else frame.type] = frame.content
        self.assertIn("byte", seen["ended"]["message"])
        viewer.close()

    def test_mistakes_on_the_command_line(self):
        import subprocess
        from console import BIN
        (self.folder / "no.mcap").write_text("this is no record")
        for words, why in ((["no.mcap"], "no.mcap"), (["absent.mcap"], "absent.mcap"), (["."], "no.mcap"), (["absent.yaml"], "no such launch file"),
                           (["--port", "70000"], "--port"), (["--run", "x", "no.mcap"], "excludes"), (["--folder", "absent"], "is no folder")):
            done = subprocess.run([BIN / "ensonify-console", *words], cwd=self.folder, capture_output=True, text=True, timeout=20)
            self.assertEqual(done.returncode, 2, (words, done))
            self.assertIn(why, done.stderr, words)

    def test_ctrl_c_ends_it(self):
        at = self.console(write_record(self.folder / "sides.mcap", sides(pings=5)))
        at.process.send_signal(signal.SIGINT)
        self.assertEqual(at.process.wait(5), 130)


if __name__ == "__main__":
    unittest.main()
