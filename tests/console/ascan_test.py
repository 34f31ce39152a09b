"""The A-scan of a fan with one known target."""
import unittest

import numpy as np

from browser import BrowserTest
from console import fan, write_record

LINE = 0xFF32C9F9


class AScan(BrowserTest):
    def test_a_beam_has_its_target_at_its_range_with_its_level_and_another_has_none(self):
        at = self.console(write_record(self.folder / "fan.mcap", fan(target=(12, 35.04), samples=500, step_m=0.12)), "--loop")
        page = self.open(at.view)
        self.wait_for_flow(page)
        page.get_by_label("A-scan").check()
        page.get_by_label("beam", exact=True).fill("12")
        page.wait_for_selector('[data-ascan="12"]')
        title = page.locator(".ascan .stripTitle")
        self.wait_for(lambda: "strongest 120.0 dB at 35.0" in title.inner_text())
        self.assertIn("beam 12, -36.0°", title.inner_text())
        self.assertIn("dB re 1 µPa over slant range", title.inner_text())
        self.shot(page, "ascan")
        place = page.locator("[data-ascan]")
        box, range_m, level_db = (list(map(float, place.get_attribute(f"data-{key}").split())) for key in ("box", "range", "level"))
        left, top, width, height = box
        picture = self.pixels(place.locator("canvas"))
        bright = (np.abs((picture & 255).astype(int) - (LINE & 255)) < 60) & (picture >> 16 & 255 < 90) & (picture >> 24 > 100)
        rows, columns = np.nonzero(bright)
        x = left + (35.04 - range_m[0]) / (range_m[1] - range_m[0]) * width
        y = top + (level_db[1] - 120.0) / (level_db[1] - level_db[0]) * height
        peak = rows < top + (level_db[1] - 110.0) / (level_db[1] - level_db[0]) * height
        self.assertTrue(peak.any())
        self.assertLess(abs(columns[peak].mean() + 0.5 - x), 2.0)
        self.assertLess(abs(rows.min() + 0.5 - y), 2.5)
        # The cursor on the fan chooses the beam; straight down lies beam 30, with nothing but 60 dB.
        canvas = page.locator('canvas[data-topic="bow/view"]').bounding_box()
        page.mouse.move(canvas["x"] + canvas["width"] / 2, canvas["y"] + canvas["height"] / 2)
        page.wait_for_selector('[data-ascan="30"]')
        self.wait_for(lambda: "strongest 60.0 dB" in title.inner_text())
        self.assertEqual(page.get_by_label("beam", exact=True).input_value(), "30")
        self.assertEqual(self.errors, [])


if __name__ == "__main__":
    unittest.main()
