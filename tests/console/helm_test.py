"""The helm display: the numbers of a known mission, large."""
import unittest

from browser import BrowserTest
from console import mission, voyage, write_record


class Helm(BrowserTest):
    def big(self, page, name):
        return page.locator(f'[data-helm="{name}"]').inner_text()

    def test_cross_track_distance_heading_and_speed_are_those_of_the_messages(self):
        at = self.console(write_record(self.folder / "helm.mcap", voyage(gap_s=(99, 99)), mission()), "--rate", "4")
        page = self.open(at.view)
        page.get_by_label("helm", exact=True).check()
        self.wait_for(lambda: page.locator(".helm").count() and self.big(page, "to-go") != "-")
        early = float(self.big(page, "to-go"))
        page.wait_for_selector("text=ended")
        last_s = 19.8
        last = {"cross-track": f"{abs(-7.25 + 0.5 * last_s):.1f}", "to-go": f"{500 - 4 * last_s:.0f}",
                "heading": f"{(200 + 9 * last_s) % 360:.1f}", "speed": "4.00"}
        self.wait_for(lambda: {name: self.big(page, name) for name in last} == last)
        self.shot(page, "helm")
        self.assertLess(float(self.big(page, "to-go")), early - 8)
        text = page.locator(".pane:has(.helm)").inner_text()
        for words in ("to starboard", "to steer 123.0°", "3.50 m/s", "on_line", "line 3 of 7, <i>NW 3</i>"):
            self.assertIn(words, text)
        # 2.65 m of 5 m to the right.
        self.assertAlmostEqual(float(page.locator(".vessel").get_attribute("data-x")), 53.0, delta=0.1)
        self.assertEqual(self.errors, [])


if __name__ == "__main__":
    unittest.main()
