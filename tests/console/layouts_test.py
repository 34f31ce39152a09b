"""Every layout with a survey and with an imaging head, by day, dusk and night, on a desk and on a tablet. Screenshots go to ENSONIFY_SHOTS."""
import io
import os
import unittest

import numpy as np
from PIL import Image

from browser import BrowserTest
from console import SOURCE, Console
from support import SystemTest

SURVEY = f"""
ensonify: launch/1
scenario: {SOURCE}/scenarios/bay/scenario.yaml
duration_s: 45
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
  bow:   {{ run: multibeam, config: {{ beams: 96, quality: 0.15, range_m: 60, ping_rate_hz: 2, amplitude_every: 1 }} }}
  side:  {{ run: sidescan, config: {{ quality: 0.15 }} }}
  recorder: {{ run: recorder, config: {{ file: survey.mcap, topics: all }} }}
"""
IMAGING = f"""
ensonify: launch/1
scenario: {SOURCE}/scenarios/boulders/scenario.yaml
duration_s: 10
processes:
  auv:   {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager, config: {{ feed_margin_m: 60 }} }}
  eye:   {{ run: forward_looking, config: {{ range_m: 30, most_samples: 600, ping_rate_hz: 2, quality: 0.5 }} }}
  recorder: {{ run: recorder, config: {{ file: imaging.mcap, topics: all }} }}
"""
PANES = {
    "survey": ["bow/view", "side/view_main", "chart", "health"],
    "sidescan": ["side/view_main", "chart", "health"],
    "imaging": ["eye/view", "chart", "health"],
    "navigation": ["chart", "numbers", "logs", "health"],
    "helm": ["helm", "chart", "health"],
}
SIZES = {"desk": (1440, 900), "tablet": (1024, 768)}
MOST_AT_NIGHT = 45  # of 255, any channel of any pixel
# Controls that stand over one another, or that their pane cuts off.
HIDDEN = """() => [...document.querySelectorAll('.pane button, .pane select, .pane input, nav button, nav select, nav input')].filter((e) => e.offsetParent).filter((e) => {
  const box = e.getBoundingClientRect(), at = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
  return !e.closest('.strips, .scroll') && at !== e && !e.contains(at);
}).map((e) => e.outerHTML.slice(0, 90))"""


class Layouts(SystemTest, BrowserTest):
    def record(self, launch, name):
        done = self.run_launch(launch, "--free", out=name, timeout=200)
        self.assertEqual(done.code, 0, done.stderr)
        return self.folder / name

    def shown(self, page):
        return np.array(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))

    def choose(self, page, label, value):
        page.get_by_label(label, exact=True).select_option(value)

    def check(self, page, name, size, seconds):
        """Its panes are there with pictures in them; nothing that can be clicked is hidden; it is light by day, dark at dusk and darker at night."""
        self.assertEqual(page.locator(".pane h2").all_inner_texts(), PANES[name.split("_")[0]])
        page.wait_for_timeout(1000 * seconds)  # for who looks at the screenshots
        for canvas in page.locator("canvas.picture").all():
            self.wait_for(lambda: len(np.unique(self.pixels(canvas))) > 20)
        self.assertEqual(page.evaluate(HIDDEN), [], (name, size))
        for light in ("day", "dusk", "night"):
            self.choose(page, "light", light)
            page.wait_for_timeout(400)
            seen = self.shown(page)
            bar = np.median(seen[:40])
            self.assertTrue(bar > 200 if light == "day" else bar < 60, (name, size, light, bar))
            chart = page.locator(".map").bounding_box()
            part = seen[int(chart["y"]):int(chart["y"] + chart["height"]), int(chart["x"]):int(chart["x"] + chart["width"])]
            self.assertGreater(len(np.unique(part.reshape(-1, 3), axis=0)), 20, (name, size, light))
            if light == "night":
                self.assertEqual(seen.max(), MOST_AT_NIGHT)  # text is as bright as it may be
            if light != "dusk":
                self.shot(page, f"{name}_{light}_{size}")

    def play(self, record, size, rate):
        width, height = SIZES[size]
        at = Console(record, "--loop", "--rate", rate, env=self.environment)
        self.addCleanup(at.stop)
        page = self.open(at.control, width, height, has_touch=size == "tablet", is_mobile=size == "tablet")
        self.wait_for_flow(page)
        return page

    def test_a_survey_in_every_layout(self):
        record = self.record(SURVEY, "survey")
        for size in SIZES:
            page = self.play(record, size, 4)
            for name in PANES:
                if name == "imaging":
                    continue
                self.choose(page, "layout", name)
                self.check(page, name, size, 8 if os.environ.get("ENSONIFY_SHOTS") else 1)
            self.assertEqual(self.errors, [])

    def test_an_imaging_head_to_scale_and_as_a_rectangle(self):
        record = self.record(IMAGING, "imaging")
        for size in SIZES:
            page = self.play(record, size, 1)
            self.choose(page, "layout", "imaging")
            self.check(page, "imaging", size, 1)
            to_scale = self.picture(page, "eye/view")
            page.get_by_label("rectangular", exact=True).check()
            self.check(page, "imaging_rectangular", size, 1)
            # A fan leaves corners empty, a rectangle nothing but what lies before the first sample.
            empty = to_scale[0, 0]
            self.assertEqual(to_scale[-1, 0], empty)
            self.assertGreater((to_scale == empty).mean(), 0.2)
            self.assertLess((self.picture(page, "eye/view") == empty).mean(), 0.1)
            self.assertEqual(self.errors, [])


if __name__ == "__main__":
    unittest.main()
