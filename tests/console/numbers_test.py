"""Numbers over time: what a viewer gets of known ones, and where the page draws them."""
import math
import unittest

import ensonify
import numpy as np

from browser import BrowserTest
from console import ESTIMATED_ROLL_DEG, TRUE_ROLL_DEG, ConsoleTest, fan, voyage, write_record
from viewer import Viewer

TRUTH, ESTIMATE = 0xFF54B4FF, 0xFFFFE36F  # colours of the page, as pixels


class Numbers(ConsoleTest):
    def collect(self, viewer, names, last_s):
        """Time and value of each number until all of them have reached that time."""
        found = {name: ([], []) for name in names}
        while not all(times and times[-1] >= last_s for times, _ in found.values()):
            for series in viewer.of("console_values/1").content["series"]:
                times, values = found[series["name"]]
                self.assertEqual(series["first"], len(times))
                times += list(series["time_s"])
                values += list(series["value"])
        return {name: (np.array(times), np.array(values)) for name, (times, values) in found.items()}

    def test_numbers_come_with_their_times_and_a_late_viewer_gets_those_from_before(self):
        at = self.console(write_record(self.folder / "voyage.mcap", voyage()), "--rate", "10")
        names = ["boat/pose.heading_grid_rad", "boat/pose.roll_rad", "nav/estimate.roll_rad", "nav/estimate.speed_mps", "boat/pose.depth_m",
                 "boat/pose.position_enu_m.1", "echo/altitude.range_m"]
        viewer = Viewer(at.view)
        state = viewer.of("console_state/1").content
        scalars = {entry["type"]: {s["field"]: s["unit"] for s in entry["scalars"]} for entry in state["types"]}
        self.assertEqual(scalars["estimate/1"]["roll_rad"], "deg")
        self.assertEqual(scalars["altitude/1"]["range_m"], "m")
        viewer.watch("values", values=names)
        found = self.collect(viewer, names, 19.8)
        late = Viewer(at.view)
        late.watch("values", values=names)
        for name, (times, values) in self.collect(late, names, 19.8).items():
            np.testing.assert_array_equal(times, found[name][0])
            np.testing.assert_array_equal(values, found[name][1])
        times_s, heading = found["boat/pose.heading_grid_rad"]
        np.testing.assert_allclose(times_s, np.arange(100) / 5, atol=1e-6)
        np.testing.assert_allclose(heading, (200 + 9 * times_s) % 360, atol=1e-6)
        np.testing.assert_allclose(found["boat/pose.roll_rad"][1], TRUE_ROLL_DEG, atol=1e-6)
        np.testing.assert_allclose(found["boat/pose.depth_m"][1], 3.0)
        np.testing.assert_allclose(found["boat/pose.position_enu_m.1"][1], 2.0)
        times_s, roll = found["nav/estimate.roll_rad"]
        there = ~np.isnan(roll)
        np.testing.assert_allclose(roll[there], ESTIMATED_ROLL_DEG, atol=1e-6)
        self.assertEqual(there.sum(), 80)
        self.assertEqual(len(times_s[~there]), 1)  # the gap, in its middle
        self.assertTrue(8.0 < times_s[~there][0] < 12.0)
        times_s, range_m = found["echo/altitude.range_m"]
        np.testing.assert_allclose(range_m, np.where(times_s < 9.99, 30 - times_s, np.nan), atol=1e-6)
        late.close()
        viewer.close()

    def test_more_numbers_than_allowed_and_unknown_ones(self):
        at = self.console(write_record(self.folder / "voyage.mcap", voyage()), "--loop")
        viewer = Viewer(at.view)
        viewer.watch("values", values=[f"boat/pose.x{i}" for i in range(33)])
        self.assertIn("33 are too many; allowed: 32", viewer.of("console_answer/1").content["error"])
        viewer.watch("values", values=["boat/pose.nothing", "no/topic.x", "", "boat/pose", "boat/pose.depth_m"])
        series = viewer.until(lambda f: f.type == "console_values/1" and any(s["name"] == "boat/pose.depth_m" for s in f.content["series"])).content["series"]
        for one in series:
            if one["name"] == "boat/pose.nothing":
                self.assertTrue(np.isnan(one["value"]).all())
        viewer.close()


class Strips(BrowserTest):
    def test_numbers_that_differ_by_their_last_bit_have_a_strip(self):
        bits = (ensonify.Altitude(stamp_ns=i * 100_000_000, valid=True, range_m=90.0 + i % 2 * 1.5e-14) for i in range(100))
        at = self.console(write_record(self.folder / "bits.mcap", (("echo/altitude", one) for one in bits), fan()), "--rate", "10")
        page = self.open(at.view)
        page.get_by_label("numbers", exact=True).check()
        page.wait_for_selector("text=ended")
        self.wait_for(lambda: self.strip(page, "echo/altitude.range_m")[2][1] > 9.5)
        low, high = self.strip(page, "echo/altitude.range_m")[3]
        self.assertTrue(1e-3 < high - low < 0.1, (low, high))
        self.assertEqual(self.errors, [])

    def strip(self, page, name):
        """The strip's pixels, the box of its plot in them, and the times and values that it covers."""
        place = page.locator(f'[data-strip="{name}"]')
        picture = self.pixels(place.locator("canvas"))
        box, time_s, value = (list(map(float, place.get_attribute(f"data-{key}").split())) for key in ("box", "time", "value"))
        return picture, box, time_s, value

    def test_lines_are_drawn_at_their_values_estimate_beside_truth_and_a_gap_is_a_gap(self):
        at = self.console(write_record(self.folder / "voyage.mcap", voyage()), "--rate", "10")
        page = self.open(at.view)
        page.get_by_label("numbers", exact=True).check()
        page.wait_for_selector("text=ended")
        last = {"nav/estimate.roll_rad": f"{ESTIMATED_ROLL_DEG:.2f} deg", "boat/pose.roll_rad": f"{TRUE_ROLL_DEG:.2f} deg",
                "echo/altitude.range_m": "-"}  # no answer
        self.wait_for(lambda: {name: page.locator(f'[data-number="{name}"]').inner_text() for name in last} == last)
        self.wait_for(lambda: self.strip(page, "boat/pose.roll_rad")[2][1] > 19.5)
        self.shot(page, "numbers")
        picture, (left, top, width, height), (first_s, last_s), (low, high) = self.strip(page, "boat/pose.roll_rad")
        metre_x, metre_y = width / (last_s - first_s), height / (high - low)
        for colour, value_deg in ((TRUTH, TRUE_ROLL_DEG), (ESTIMATE, ESTIMATED_ROLL_DEG)):
            rows, columns = np.nonzero(picture == colour)
            self.assertGreater(len(rows), 50)
            self.assertLess(abs(rows.mean() + 0.5 - (top + (high - value_deg) * metre_y)), 1.5)
            times_s = first_s + (columns + 0.5 - left) * metre_x**-1
            self.assertLess(abs(times_s.min() - first_s), 0.3)
            self.assertGreater(times_s.max(), 19.5)
            in_gap = (times_s > 8.0) & (times_s < 11.9)
            self.assertEqual(in_gap.any(), colour == TRUTH)
        # A heading that passes north jumps: no line crosses the strip.
        picture, (left, top, width, height), (first_s, last_s), (low, high) = self.strip(page, "boat/pose.heading_grid_rad")
        _, columns = np.nonzero((picture == TRUTH) | (picture == ESTIMATE))
        self.assertLess(np.bincount(columns).max(), height / 4)
        self.assertEqual(self.errors, [])

    def test_any_number_is_added_and_removed_by_keyboard_and_the_cursor_says_its_value(self):
        at = self.console(write_record(self.folder / "voyage.mcap", voyage(gap_s=(99, 99))), "--loop", "--rate", "3")
        page = self.open(at.view)
        page.get_by_label("numbers", exact=True).check()
        page.get_by_label("add a number").select_option("boat/pose.velocity_enu_mps.2")
        page.wait_for_selector('[data-number="boat/pose.velocity_enu_mps.2"]:has-text("1.00 m/s")')
        place = page.locator('[data-strip="boat/pose.heading_grid_rad"]')
        self.wait_for(lambda: float(place.get_attribute("data-time").split()[1]) > 6)
        page.get_by_label("remove boat/pose.velocity_enu_mps.2").focus()
        page.keyboard.press("Enter")
        self.wait_for(lambda: page.locator('[data-number="boat/pose.velocity_enu_mps.2"]').count() == 0)
        box = place.bounding_box()
        left, _, width, _ = map(float, place.get_attribute("data-box").split())
        page.mouse.move(box["x"] + left + 0.5 * width, box["y"] + box["height"] / 2)
        page.wait_for_selector(".pane header:has-text(', at ')")
        header, value = page.evaluate("""() => [[...document.querySelectorAll('.pane header')].map((h) => h.textContent).find((t) => t.includes(', at ')),
          document.querySelector('[data-number="boat/pose.heading_grid_rad"]').textContent]""")
        t_s = float(header.split(", at ")[1].split()[0])
        wanted = (200 + 9 * (math.floor(t_s % 19.9 * 5) / 5)) % 360
        self.assertAlmostEqual(float(value.split()[0]), wanted, delta=1.9)
        self.assertEqual(self.errors, [])


if __name__ == "__main__":
    unittest.main()
