"""`ensonify grid`: what it writes is read by GDAL and h5py, and is what numpy makes of the same soundings."""
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import h5py
import numpy as np
from osgeo import gdal, osr

import synthetic_record

gdal.UseExceptions()
osr.UseExceptions()
PROGRAM = sys.argv.pop(1)
SAMPLES = sys.argv.pop(1)  # writes files of other formats


def grid(*words, given=None):
    return subprocess.run([PROGRAM, *map(str, words)], input=given, capture_output=True, timeout=120)


def bands(file):
    raster = gdal.Open(str(file))
    return raster, raster.ReadAsArray().astype(float)


def shortened(soundings_of):
    def act(*arguments):
        soundings, range_m = soundings_of(*arguments)
        soundings.position_enu_m = soundings.position_enu_m[:-1]
        return soundings, range_m
    return act


class Points(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)

    def test_cells_hold_what_numpy_makes_of_the_same_points(self):
        random = np.random.default_rng(3)
        x, y = random.uniform(-7, 13, 5000), random.uniform(100, 121, 5000)
        depth, sd = 30 + 0.2 * x + random.normal(0, 0.3, 5000), random.uniform(0.1, 0.6, 5000)
        file = self.root / "points.tif"
        done = grid("--points", "-", "--cell", 2, "--out", file, "--json", given=np.stack([x, y, depth, sd], 1).tobytes())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["soundings"], 5000)
        raster, (weighted, shoalest, count, spread, uncertainty) = bands(file)
        self.assertEqual(raster.GetGeoTransform(), (-8.0, 2.0, 0.0, 122.0, 0.0, -2.0))
        self.assertEqual(count.shape, (11, 11))
        column, row = np.floor(x / 2).astype(int) + 4, 60 - np.floor(y / 2).astype(int)
        for i, j in ((0, 0), (5, 5), (10, 3)):
            own = (column == i) & (row == j)
            self.assertEqual(count[j, i], own.sum())
            weights = 1 / sd[own] ** 2
            self.assertAlmostEqual(weighted[j, i], -np.average(depth[own], weights=weights), delta=1e-5)  # float32 at 30 m
            self.assertAlmostEqual(shoalest[j, i], -depth[own].min(), delta=1e-5)
            self.assertAlmostEqual(spread[j, i], np.std(depth[own], ddof=1), delta=1e-6)
            larger = max(np.sqrt(np.mean(sd[own] ** 2)), np.std(depth[own], ddof=1))
            self.assertAlmostEqual(uncertainty[j, i], 1.959964 * larger, delta=1e-6)

    def test_cells_without_soundings_stay_open(self):
        points = np.array([[0.5, 0.5, 10, np.nan], [4.5, 0.5, 12, np.nan]])
        file = self.root / "open.tif"
        self.assertEqual(grid("--points", "-", "--cell", 1, "--out", file, given=points.tobytes()).returncode, 0)
        _, (mean, _, count, spread, uncertainty) = bands(file)
        np.testing.assert_array_equal(mean, [[-10, np.nan, np.nan, np.nan, -12]])
        self.assertTrue(np.isnan(count[0, 1:4]).all() and np.isnan(spread).all() and np.isnan(uncertainty).all())

    def test_mistakes_name_their_cause(self):
        text = self.root / "no.mcap"
        text.write_text("nothing")
        two = self.root / "two"
        two.mkdir()
        (two / "a.mcap").touch()
        (two / "b.mcap").touch()
        subprocess.run([SAMPLES, self.root], check=True)
        point = np.array([0.0, 0, 10, 0.1]).tobytes()
        cases = [((), "FILE: is missing", None), ((self.root / "sample.xtf",), "is an XTF file; allowed: records", None),
                 ((text,), "is no record", None),
                 ((self.root / "none.mcap",), "none.mcap", None), ((self.root,), "is no record", None),
                 ((two,), "holds 2 records", None), (("--points", "-", "--tide", "x.csv"), "x.csv: cannot be read", point),
                 (("--points", "-"), "no accepted sounding", b""), (("--points", "-"), "four doubles", point[:-4]),
                 (("--points", "-", "--out", "x.las"), "allowed: .tif or .bag", point),
                 (("--points", "-", "--crs", "utm"), "does not state where it is", point),
                 (("--points", "-", "--out", self.root / "x.bag"), "needs a map", point),
                 (("--points", "-", "--cell", "0"), "--cell", point),
                 (("--points", "-", "--cell", 0.001), "use larger ones", np.array([[0, 0, 1, 1], [1e5, 1e5, 1, 1.0]]).tobytes())]
        for words, cause, given in cases:
            with self.subTest(words):
                done = grid("--out", self.root / "y.tif", *words, given=given) if "--out" not in words else grid(*words, given=given)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(cause, done.stderr.decode())
        done = grid("--points", "-", "--out", self.root / "no/such/folder.tif", given=point)
        self.assertEqual(done.returncode, 5, done.stderr)


    def test_an_interrupted_grid_is_not_written(self):
        file = self.root / "part.tif"
        with subprocess.Popen([PROGRAM, "--points", "-", "--out", str(file)], stdin=subprocess.PIPE) as running:
            running.stdin.write(np.tile([1.0, 1.0, 10.0, 0.1], 100_000).tobytes())  # more than the pipe holds: it is reading
            running.send_signal(signal.SIGINT)
            running.stdin.close()
            self.assertEqual(running.wait(timeout=60), 130)
        self.assertFalse(file.exists())


class Records(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.folder.name)
        cls.record = cls.root / "survey.mcap"
        synthetic_record.write(cls.record, line_m=60.0, turn_pings=20)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_a_record_gives_the_seabed_on_the_worlds_map(self):
        file = self.root / "world.tif"
        done = grid(self.root, "--out", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        raster, (up_m, shoalest_m, count, spread, uncertainty_m) = bands(file)
        self.assertEqual(raster.GetMetadataItem("VERTICAL_DATUM"), "chart datum of the scenario")
        crs = osr.SpatialReference(raster.GetProjection())
        self.assertEqual((crs.GetProjParm("latitude_of_origin"), crs.GetProjParm("central_meridian")), (54.3, 10.2))
        west, cell_m, _, north, _, _ = raster.GetGeoTransform()
        self.assertEqual(cell_m, 0.5)  # 5 % of some 19 m, rounded down
        rows, columns = np.nonzero(np.nan_to_num(count) >= 5)
        error_m = up_m[rows, columns] - synthetic_record.seabed_up_m(west + (columns + 0.5) * cell_m, north - (rows + 0.5) * cell_m)
        self.assertLess(abs(np.median(error_m) - 0.02), 0.01)  # the record's bias
        self.assertTrue((shoalest_m[rows, columns] >= up_m[rows, columns]).all())
        # Depth noise of 0.05 m at nadir, more beyond; stated as it is.
        self.assertGreater(np.median(uncertainty_m[rows, columns]), 1.96 * 0.05)
        self.assertLess(np.median(uncertainty_m[rows, columns]), 1.96 * 0.3)

    def test_turns_are_left_out_unless_asked_for(self):
        count = {words: json.loads(grid(self.record, "--json", "--out", self.root / "turns.tif", *words).stdout)["soundings"]
                 for words in ((), ("--turns",))}
        self.assertGreater(count[("--turns",)], count[()] * 1.05)

    def test_the_same_record_twice_doubles_the_numbers_and_nothing_else(self):
        for name, files in (("once", [self.record]), ("twice", [self.record] * 2)):
            self.assertEqual(grid(*files, "--out", self.root / f"{name}.tif").returncode, 0)
        once, twice = (bands(self.root / f"{name}.tif")[1] for name in ("once", "twice"))
        np.testing.assert_array_equal(twice[2], 2 * once[2])
        np.testing.assert_allclose(twice[0], once[0], atol=1e-5)
        np.testing.assert_array_equal(twice[1], once[1])

    def test_a_bag_holds_elevation_and_uncertainty_of_the_geotiff(self):
        tif, bag = self.root / "utm.tif", self.root / "utm.bag"
        done = grid(self.record, "--crs", "utm", "--cell", 2, "--out", tif, "--out", bag)
        self.assertEqual(done.returncode, 0, done.stderr)
        flat, (up_m, _, count, _, uncertainty_m) = bands(tif)
        self.assertEqual(osr.SpatialReference(flat.GetProjection()).GetAuthorityCode(None), "32632")
        raster, (bag_up_m, bag_uncertainty_m) = bands(bag)
        self.assertTrue(osr.SpatialReference(raster.GetProjection()).IsProjected())
        np.testing.assert_allclose(raster.GetGeoTransform(), flat.GetGeoTransform())
        known = count > 0
        np.testing.assert_array_equal(bag_up_m[known], up_m[known])
        stated = known & np.isfinite(uncertainty_m)
        np.testing.assert_array_equal(bag_uncertainty_m[stated], uncertainty_m[stated])
        self.assertTrue((bag_up_m[~known] == raster.GetRasterBand(1).GetNoDataValue()).all())
        with h5py.File(bag) as file:  # another reader; rows from the south
            np.testing.assert_array_equal(np.flipud(file["BAG_root/elevation"][:])[known], up_m[known].astype("f4"))
            text = bytes(file["BAG_root/metadata"][:]).decode()
        self.assertIn("chart datum of the scenario", text)
        self.assertIn("productUncert", text)

    def test_a_full_disk_is_an_error_with_its_cause(self):
        for name in ("full.tif", "full.bag"):
            (self.root / name).symlink_to("/dev/full")
            done = grid(self.record, "--crs", "utm", "--out", self.root / name)
            with self.subTest(name):
                self.assertEqual(done.returncode, 5, done.stderr)
                self.assertIn("cannot be written: ", done.stderr.decode())

    def test_a_record_with_arrays_that_disagree_is_refused(self):
        broken = self.root / "broken.mcap"
        with mock.patch.object(synthetic_record, "soundings_of", shortened(synthetic_record.soundings_of)):
            synthetic_record.write(broken, lines=1, line_m=5.0, leave_out=("ping/1",))
        done = grid(broken, "--out", self.root / "broken.tif")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("its arrays differ in length", done.stderr.decode())

    def test_topics_are_named_or_refused(self):
        self.assertEqual(grid(self.record, "--soundings", "bow/soundings", "--out", self.root / "topic.tif").returncode, 0)
        done = grid(self.record, "--soundings", "stern/soundings", "--out", self.root / "topic.tif")
        self.assertEqual(done.returncode, 2)
        self.assertIn("there are bow/soundings", done.stderr.decode())


if __name__ == "__main__":
    unittest.main(verbosity=2)
