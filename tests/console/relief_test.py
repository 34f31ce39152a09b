"""The chart's relief: shade and contours of a known seabed, latitude and longitude of places."""
import math
import re
import time
import unittest

import numpy as np

from browser import BrowserTest
from console import CHART_ORIGIN, seabed_chart, voyage, write_record
from viewer import Viewer

WGS84_A_M, WGS84_F = 6378137.0, 1 / 298.257223563


def radii_m(latitude_deg):
    """Of curvature, in the meridian and across it, WGS 84."""
    e2 = WGS84_F * (2 - WGS84_F)
    w2 = 1 - e2 * math.sin(math.radians(latitude_deg)) ** 2
    return WGS84_A_M * (1 - e2) / w2**1.5, WGS84_A_M / math.sqrt(w2)


class Relief(BrowserTest):
    def play(self):
        return self.console(write_record(self.folder / "chart.mcap", seabed_chart(), voyage()), "--rate", "4")

    def test_a_viewer_that_comes_after_the_chart_gets_its_relief(self):
        at = self.play()
        early = Viewer(at.view)
        early.watch("boat/pose")
        early.until(lambda f: f.topic == "boat/pose" and f.content["stamp_ns"] > 2e9)
        viewer = Viewer(at.view)
        viewer.watch("relief")
        relief = viewer.of("console_relief/1").content
        self.assertEqual(relief["shade"].shape, (41, 41))
        # Light from the north-west at 45 degrees falls on a plane that faces east, four times as steep.
        east = -0.1 * relief["exaggeration"]
        shade = 1 + 254 * (0.5 * east + math.sqrt(0.5)) / math.hypot(1, east)
        np.testing.assert_allclose(relief["shade"], shade, atol=1)
        self.assertEqual(relief["contour_step_m"], 5.0)
        for depth_m, (x0, _, x1, _) in zip(relief["contour_depth_m"], relief["contour_m"]):
            self.assertEqual(depth_m % 5, 0)
            self.assertAlmostEqual(30 + 0.1 * x0, depth_m, delta=0.01)
            self.assertAlmostEqual(30 + 0.1 * x1, depth_m, delta=0.01)
        self.assertEqual(set(relief["contour_depth_m"][(relief["contour_depth_m"] > 10) & (relief["contour_depth_m"] < 50)]), {15, 20, 25, 30, 35, 40, 45})
        viewer.close()
        early.close()

    def test_contours_lie_where_the_depth_is_theirs_and_the_cursor_has_latitude_and_longitude(self):
        page = self.open(self.play().view)
        page.wait_for_selector("text=contours of the chart every 5 m", timeout=15_000)
        page.wait_for_selector("text=ended", timeout=15_000)
        chart = page.locator(".map").bounding_box()
        for _ in range(14):  # the track is a point: out of it
            page.mouse.move(chart["x"] + chart["width"] / 2, chart["y"] + chart["height"] / 2)
            page.mouse.wheel(0, 240)
            time.sleep(0.3)
            page.mouse.move(chart["x"] + 3 * chart["width"] / 4, chart["y"] + chart["height"] / 3)
            line = page.locator(".pane:has(.map) .cursor").inner_text()
            if "east" in line and float(line.split("east ")[1].split()[0]) > 60:
                break
        time.sleep(0.5)
        self.shot(page, "relief")
        meridian_m, across_m = radii_m(CHART_ORIGIN[0])
        contours = 0
        for part in np.linspace(0.3, 0.9, 61):
            page.mouse.move(chart["x"] + part * chart["width"], chart["y"] + chart["height"] / 3)
            time.sleep(0.03)
            line = page.locator(".pane:has(.map) .cursor").inner_text()
            found = re.match(r"(\d+)° ([\d.]+)' N, (\d+)° ([\d.]+)' W; east (-?[\d.]+) m, north (-?[\d.]+) m", line)
            self.assertTrue(found, line)
            latitude_deg, longitude_deg = float(found[1]) + float(found[2]) / 60, -float(found[3]) - float(found[4]) / 60
            east_m, north_m = float(found[5]), float(found[6])
            # Within 300 m of the origin the ellipsoid is a sphere with its radii, but for millimetres.
            self.assertAlmostEqual(math.radians(latitude_deg - CHART_ORIGIN[0]) * meridian_m, north_m, delta=0.3)
            self.assertAlmostEqual(math.radians(longitude_deg - CHART_ORIGIN[1]) * across_m * math.cos(math.radians(latitude_deg)), east_m, delta=0.3)
            if "contour" in line.split("north")[1]:
                depth_m = float(line.split("contour ")[1].split()[0])
                self.assertEqual(depth_m % 5, 0)
                self.assertLess(abs(30 + 0.1 * east_m - depth_m), 0.6)
                contours += 1
        self.assertGreater(contours, 2)
        picture = self.pixels(page.locator(".map canvas").first)
        self.assertGreater(len(np.unique(picture)), 2)  # not blank
        self.assertEqual(self.errors, [])


if __name__ == "__main__":
    unittest.main()
