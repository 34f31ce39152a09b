"""Colours for all eyes; axe-core by day, dusk and night; keyboard, touch and what stays over a reload."""
import os
import pathlib
import re
import unittest

import ensonify
import numpy as np

from browser import BrowserTest
from console import fan, health, mission, seabed_chart, sides, survey, write_record

LAYOUTS = ("survey", "sidescan", "imaging", "navigation", "helm")
SIZES = {"desk": (1500, 900), "tablet": (1024, 768)}
AXE = pathlib.Path(os.environ["ENSONIFY_BIN"]).parent / "web/node_modules/axe-core/axe.min.js"

# What is seen without one kind of cones, in linear sRGB [Machado2009], severity 1.
SEEN_WITH = {
    "all cones": np.eye(3),
    "protanopia": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]),
    "deuteranopia": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]),
    "tritanopia": np.array([[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]),
}


def lightness(rgb, seen):
    """CIE L* of sRGB colours, D65."""
    part = rgb / 255.0
    linear = np.where(part <= 0.04045, part / 12.92, ((part + 0.055) / 1.055) ** 2.4)
    y = np.clip(linear @ seen.T, 0, 1) @ [0.2126, 0.7152, 0.0722]
    return np.where(y > 216 / 24389, 116 * np.cbrt(y) - 16, y * 24389 / 27)


class Light(BrowserTest):
    def record(self):
        declares = {head: ensonify.HeadDeclaration(kind=kind) for head, kind in (("bow", "multibeam"), ("fish", "sidescan"))}
        streams = (fan(pings=200), sides(pings=200), survey(pings=400), mission(), health(), seabed_chart())
        return write_record(self.folder / "all.mcap", *streams, declares=declares)

    def play(self, width=1500, height=900, **more):
        at = self.console(self.record(), "--loop")
        page = self.open(at.control, width, height, **more)
        page.wait_for_selector("canvas.picture", timeout=15_000)
        return page

    def choose(self, page, label, value):
        page.get_by_label(label, exact=True).select_option(value)

    def bar(self, page, label):
        picture = self.pixels(page.locator(f'canvas.bar[aria-label="{label}"]').first)[0]
        return np.stack([(picture >> shift) & 255 for shift in (0, 8, 16)], axis=1).astype(float)

    def test_colours_grow_by_even_lightness_and_grow_for_colour_blind_eyes(self):
        page = self.play()
        self.wait_for_flow(page, 2)
        depth, level = "colours from the least depth to the greatest", "colours of levels"
        maps = {"depth": self.bar(page, depth)[::-1]}
        for topic in ("bow/view", "fish/view"):
            maps[topic] = self.pixels(page.locator(f'.pane:has(canvas[data-topic="{topic}"]) canvas.bar'))[0]
            maps[topic] = np.stack([(maps[topic] >> shift) & 255 for shift in (0, 8, 16)], axis=1).astype(float)
        self.assertFalse(np.array_equal(maps["bow/view"], maps["fish/view"]))
        for name, rgb in maps.items():
            self.assertEqual(len(rgb), 256)
            steps = np.diff(lightness(rgb, SEEN_WITH["all cones"])[::17])
            self.assertLess(steps.max() / steps.min(), 1.15, name)
            for eyes, seen in SEEN_WITH.items():
                seen_lightness = lightness(rgb, seen)
                self.assertGreater(np.diff(seen_lightness[::17]).min(), 3.0, (name, eyes))
                self.assertGreater(np.diff(seen_lightness[::3]).min(), 0.0, (name, eyes))
        shoal, deep = maps["depth"][-1], maps["depth"][0]
        self.assertGreater(shoal[0], shoal[2])  # warm
        self.assertLess(deep[0], deep[2])
        self.choose(page, "colours", "rainbow")
        self.wait_for(lambda: not np.array_equal(self.bar(page, depth)[::-1], maps["depth"]))
        shoal, deep = self.bar(page, depth)[[10, 240]]
        self.assertGreater(shoal[0], 2 * shoal[2])  # red
        self.assertGreater(deep[2], 1.5 * deep[0])  # blue
        np.testing.assert_array_equal(self.bar(page, level), self.bar(page, depth)[::-1])
        self.assertEqual(self.errors, [])

    def test_axe_finds_nothing_by_day_and_dusk_and_at_night_only_contrast(self):
        page = self.play()
        self.wait_for_flow(page, 2)
        page.evaluate(AXE.read_text())
        for light in ("day", "dusk", "night"):
            self.choose(page, "light", light)
            for layout in LAYOUTS:
                self.choose(page, "layout", layout)
                result = page.evaluate("axe.run()")
                found = result["violations"]
                self.assertIn("color-contrast", [rule["id"] for rule in result["passes"] + found])  # it did look
                rules = {rule["id"]: [node["html"][:120] for node in rule["nodes"]][:3] for rule in found}
                if light == "night":
                    rules.pop("color-contrast", None)
                self.assertEqual(rules, {}, (light, layout))

    def test_all_is_done_by_keyboard(self):
        page = self.play()
        self.wait_for_flow(page, 2)
        page.keyboard.press("?")
        listed = [row.inner_text().split("\t")[0] for row in page.locator("dialog tr").all()]
        self.assertIn("Space", listed)
        page.keyboard.press("Escape")
        self.wait_for(lambda: not page.locator("dialog").is_visible())
        panes = lambda: page.locator(".pane h2").all_inner_texts()  # noqa: E731
        before = panes()
        page.keyboard.press("1")
        self.wait_for(lambda: len(panes()) == len(before) - 1)
        page.keyboard.press("1")
        self.wait_for(lambda: sorted(panes()) == sorted(before))
        page.keyboard.press("l")
        self.assertEqual(page.evaluate("document.documentElement.dataset.light"), "night")
        page.keyboard.press("v")
        self.wait_for(lambda: page.get_by_label("layout", exact=True).input_value() == "sidescan")
        self.wait_for(lambda: panes()[:2] == ["fish/view", "chart"])  # the record says which head is a sidescan
        page.keyboard.press(" ")
        page.wait_for_selector("text=resume")
        page.keyboard.press(" ")
        page.wait_for_selector("text=pause")
        self.choose(page, "layout", "survey")
        picture = page.locator('canvas[data-topic="bow/view"]')
        picture.focus()
        line = page.locator('.pane:has(canvas[data-topic="bow/view"]) .cursor')

        def pressed():  # the pane is new: until its first picture is there, there is nothing to walk on
            page.keyboard.press("Shift+ArrowDown")
            return re.search(r"range \d", line.inner_text())

        self.wait_for(pressed)
        first = line.inner_text()
        page.keyboard.press("ArrowDown")
        self.wait_for(lambda: line.inner_text() != first)
        page.locator(".map").focus()
        chart = page.locator(".pane:has(.map) .cursor")
        page.keyboard.press("m")
        self.wait_for(lambda: "east" in chart.inner_text())
        east_m = lambda: float(chart.inner_text().split("east ")[1].split()[0])  # noqa: E731
        before_m = east_m()
        page.keyboard.press("ArrowRight")
        self.wait_for(lambda: east_m() > before_m + 1)
        page.keyboard.press("m")
        self.wait_for(lambda: "ruler" in chart.inner_text())
        self.assertRegex(chart.inner_text(), r"ruler \d+\.\d m, grid bearing (90|89|91)\.\d°")
        # Everything that can be clicked can be reached by Tab.
        reachable = page.evaluate("""() => [...document.querySelectorAll('button, select, input')].filter((e) => e.offsetParent && e.tabIndex < 0).length""")
        self.assertEqual(reachable, 0)
        self.assertEqual(self.errors, [])

    def test_what_fingers_touch_is_large_enough(self):
        page = self.play(*SIZES["tablet"], has_touch=True, is_mobile=True)
        self.wait_for_flow(page, 1)
        for layout in LAYOUTS:
            self.choose(page, "layout", layout)
            page.wait_for_timeout(200)
            touched = page.evaluate("""() => [...document.querySelectorAll('button, select, input:not([type=checkbox]), label:has(input[type=checkbox])')]
              .filter((e) => e.offsetParent).map((e) => [e.outerHTML.slice(0, 80), e.getBoundingClientRect().width, e.getBoundingClientRect().height])""")
            self.assertGreater(len(touched), 8)
            self.assertEqual([one for one in touched if min(one[1:]) < 40], [], layout)

    def test_choices_are_there_again_after_a_reload(self):
        page = self.play()
        self.choose(page, "light", "day")
        self.choose(page, "colours", "rainbow")
        self.choose(page, "layout", "navigation")
        page.get_by_label("helm", exact=True).check()
        page.get_by_label("colours by").select_option("sd")
        page.reload()
        page.wait_for_selector(".helm", timeout=15_000)
        self.assertEqual(page.evaluate("document.documentElement.dataset.light"), "day")
        for label, value in (("colours", "rainbow"), ("layout", "navigation"), ("colours by", "sd")):
            self.assertEqual(page.get_by_label(label, exact=True).input_value(), value)
        self.assertEqual(page.locator(".pane h2").all_inner_texts()[:3], ["chart", "numbers", "helm"])
        page.evaluate("localStorage.setItem('light', '\"<b>\"'); localStorage.setItem('panes', '7'); localStorage.setItem('layout', '{')")
        page.reload()
        page.wait_for_selector("canvas.picture", timeout=15_000)
        self.assertEqual(page.evaluate("document.documentElement.dataset.light"), "dusk")
        self.assertEqual(self.errors, [])


if __name__ == "__main__":
    unittest.main()
