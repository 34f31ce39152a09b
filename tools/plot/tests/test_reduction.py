"""Reduction of soundings: readings of a gauge, grids of separations, and what is refused of both."""
import contextlib
import io
import os
import tempfile
import types
import unittest

import numpy as np
from osgeo import gdal, osr

from ensonify_plot import reduction
from ensonify_plot.main import main
from ensonify_plot.errors import UserError

try:
    import synthetic_record
except ImportError:
    synthetic_record = None

NOON_S = 1748779200  # 2025-06-01T12:00:00Z
PLANE = "ncols 3\nnrows 2\nxllcorner -30\nyllcorner -20\ncellsize 20\nNODATA_value -9999\n47 48 49\n45 46 47\n"


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def written(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(text)
        return path


class Gauge(InAFolder):
    def level_m(self, text, *t_s):
        record = types.SimpleNamespace(utc_start_ns=NOON_S * 10**9)
        return reduction.water_level_m(self.written("tide.csv", text), record, np.array(t_s))

    def test_between_readings_are_straight_lines(self):
        text = "time,height_m\n# a gauge\n2025-06-01T11:50:00Z,1.0\n2025-06-01T12:10:00Z;1.4\n2025-06-01T12:20:00+00:00\t1.2\n"
        np.testing.assert_allclose(self.level_m(text, -600, 0, 600, 900), [1.0, 1.2, 1.4, 1.3])

    def test_an_invalid_reading_is_reported_with_its_line(self):
        good = "2025-06-01T11:50:00Z,1.0\n"
        for line in ("2025-06-01T12:10:00Z,nan", "2025-06-01T12:10:00Z", "2025-06-01T12:10:00,1.4", "noon,1.4", "2025-06-01T11:50:00Z,1.4"):
            with self.subTest(line), self.assertRaisesRegex(UserError, r"tide.csv:2: is no reading later than those before; allowed: a UTC time"):
                self.level_m(good + line + "\n", 0)

    def test_readings_cover_the_survey(self):
        text = "2025-06-01T11:50:00Z,1.0\n2025-06-01T12:10:00Z,1.4\n"
        for t_s in (-601, 601):
            with self.subTest(t_s), self.assertRaisesRegex(UserError, "does not cover the survey"):
                self.level_m(text, *sorted((0, t_s)))

    def test_settlement_is_a_table_by_speed(self):
        table = reduction.settlement_of("0:0,2:0.02,5:0.11")
        np.testing.assert_allclose(reduction.settled_m(table, np.array([0, 2, 3.5, 9])), [0, 0.02, 0.065, 0.11])
        np.testing.assert_allclose(reduction.settled_m([], np.array([3.0])), [0])
        for text in ("0", "0:0,0:1", "2:0,1:1", "0:x", "0:nan", "0:0:1"):
            with self.subTest(text), self.assertRaises(ValueError):
                reduction.settlement_of(text)


class Grid(InAFolder):
    def test_a_grid_gives_its_cells_and_planes_between(self):
        path = self.written("plane.asc", PLANE)  # centres at east -20, 0, 20 and north -10, 10
        found = reduction.grid_at(path, np.array([-20, 20, -10, -29]), np.array([-10, 10, 0, -19]), None)
        np.testing.assert_allclose(found, [45, 49, 46.5, 45])

    def test_a_grid_in_degrees_is_asked_where_the_world_is(self):
        path = os.path.join(self.folder, "geoid.tif")
        grid = gdal.GetDriverByName("GTiff").Create(path, 3, 3, 1, gdal.GDT_Float64)
        crs = osr.SpatialReference()
        crs.SetWellKnownGeogCS("WGS84")
        grid.SetSpatialRef(crs)
        grid.SetGeoTransform((-4.05, 0.1, 0, 48.75, 0, -0.1))  # centres at -4.0, -3.9, -3.8 and 48.7, 48.6, 48.5
        grid.GetRasterBand(1).WriteArray(50.0 + np.array([[2, 2, 3], [0, 0, 1], [-2, -2, -1]]))
        grid = None
        # 0.01 degree of latitude at 48.6 is 1112.0 m on WGS 84, and 0.1 of the way from 50 to 52; of longitude 737.5 m, from 50 to 51.
        found = reduction.grid_at(path, np.array([0, 0, 737.5]), np.array([0, 1112.0, 0]), (48.6, -3.9))
        np.testing.assert_allclose(found, [50, 50.2, 50.1], atol=2e-4)
        with self.assertRaisesRegex(UserError, "the record does not state where the world is"):
            reduction.grid_at(path, np.zeros(1), np.zeros(1), None)

    def test_where_it_knows_nothing_is_refused(self):
        holed = self.written("holed.asc", PLANE.replace("48", "-9999"))
        for path, east, north, place in ((self.written("plane.asc", PLANE), 31.0, 0.0, r"\(31.0, 0.0\) m"), (holed, 0.0, 5.0, r"\(0.0, 5.0\) m")):
            with self.subTest(place), self.assertRaisesRegex(UserError, f"has no value at {place}; allowed: a grid over the whole survey"):
                reduction.grid_at(path, np.array([east]), np.array([north]), None)
        for path in (os.path.join(self.folder, "no.asc"), self.written("words.asc", "46")):
            with self.subTest(path), self.assertRaisesRegex(UserError, "cannot be read"):
                reduction.grid_at(path, np.zeros(1), np.zeros(1), None)


@unittest.skipIf(synthetic_record is None, "needs the package mcap")
class Refused(InAFolder):
    def test_what_a_record_lacks_is_named(self):
        file = os.path.join(self.folder, "survey.mcap")
        synthetic_record.write(file, lines=1, line_m=20.0)
        tide = self.written("tide.csv", "1969-01-01T00:00:00Z,1.0\n1971-01-01T00:00:00Z,1.0\n")
        for words, cause in ((["--gauge", tide], "neither delayed_heave/1 nor attitude/1"), (["--separation", tide], "holds no position/1"),
                             (["--settlement", "0:0"], "--settlement: needs --gauge"), (["--gauge", "no.csv"], "neither delayed")):
            with self.subTest(words), contextlib.redirect_stderr(io.StringIO()) as printed:
                self.assertEqual(main(["survey", file, *words]), 2)
                self.assertIn(cause, printed.getvalue())


if __name__ == "__main__":
    unittest.main()
