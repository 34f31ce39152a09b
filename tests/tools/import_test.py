"""`ensonify terrain import` on data measured at sea: where heights land is compared with GDAL's warper, what was lost with
counts of the files themselves. Skipped where the shared data folder is absent."""
import csv
import io
import math
import unittest

import numpy as np
from importing import Import, gdal, terrain
from support import SHARED

DATA = SHARED / "data/terrain"


@unittest.skipUnless(DATA.is_dir(), f"no shared data in {DATA}")
@unittest.skipUnless(gdal, "GDAL's Python module is absent")
class MeasuredAtSea(Import):
    def compare_with_gdalwarp(self, name, *words, **options):
        """Away from holes bilinear is bilinear: half a step of heights, and float's and the post lattice's rounding (1e-4
        of a cell, by slopes below 3: the reef has such). Beside holes GDAL goes on with fewer than four cells; we stop."""
        folder, report = self.run_import(DATA / name, *words)
        ours, gdals = self.warped(DATA / name, folder, report, **options)
        both = np.isfinite(ours) & np.isfinite(gdals)
        self.assertEqual(np.count_nonzero(np.isfinite(ours) & ~np.isfinite(gdals)), 0)
        inside = both.copy()
        for axis in (0, 1):  # GDAL weighs what it has where one of the four is missing
            for shift in (1, -1):
                inside &= np.roll(np.isfinite(ours), shift, axis)
        self.assertGreater(np.count_nonzero(inside), 0.5 * np.count_nonzero(np.isfinite(gdals)))
        off = np.abs(ours - gdals)[inside]
        cell = report["sources"][0]["cell_m"]
        self.assertLess(off.max(), 0.5 * report["steps"]["lsb_m"] + 3e-4 * cell + 1e-5)
        return report

    def test_an_inner_shelf(self):
        report = self.compare_with_gdalwarp("massbay_5m.tif")
        self.assertAlmostEqual(report["spacing_m"], 5.0, delta=0.02)
        self.assertEqual(report["sources"][0]["band"]["smoothed_below_cells"], 8)  # exponents 5.1, 4.3, 3.7 by octaves
        self.assertFalse(report["sources"][0]["stripes"]["found"])

    def test_a_basin_half_without_data(self):
        report = self.compare_with_gdalwarp("bedford_depth_9m.tif")
        self.assertGreater(report["holes"]["not_surveyed_m2"], 0)
        surveyed = report["sources"][0]["surveyed_m2"]
        # 34,994 valid cells of 81 m2; UTM is 0.9996 to 0.9998 of the ground here
        self.assertAlmostEqual(surveyed / (34994 * 81), 1.0, delta=1e-3)
        self.assertLess(report["sources"][0]["lost_m2"], 0.1 * surveyed)

    def test_a_coral_patch_of_one_centimetre_cells(self):
        self.compare_with_gdalwarp("horseshoe_reef_1cm.tif")

    def test_the_same_survey_in_two_containers(self):
        reports = [self.run_import(DATA / f"f00788_8m.{kind}", name=kind)[1] for kind in ("bag", "tif")]
        one, two = [self.heights(self.folder / kind)[0] for kind in ("bag", "tif")]
        np.testing.assert_array_equal(one, two)
        self.assertEqual(reports[0]["holes"], reports[1]["holes"])

    def test_five_containers_of_one_clip_have_one_seabed_and_its_hole(self):
        given = {"xyz": ("--crs", "EPSG:32619", "--nodata", "-9999"), "asc": ("--crs", "EPSG:32619")}
        first = None
        for kind in ("tif", "asc", "nc", "xyz", "bag"):
            folder, report = self.run_import(DATA / f"formats/clip.{kind}", *given.get(kind, ()), "--origin", "42.253,-70.7182",
                                             "--spacing", 5, name=kind)
            heights = self.heights(folder)[0]
            first = heights if first is None else first
            # cell corners are rounded to 1e-4 m in the texts, which moves heights by less than a step
            np.testing.assert_allclose(heights, first, atol=1.01 * report["steps"]["lsb_m"])
            self.assertEqual(report["holes"]["count"], 1)
            # 8 x 15 cells, and half a cell more on each side
            self.assertAlmostEqual(report["holes"]["area_m2"], 9 * 16 * 25, delta=9 * 16 * 25 * 0.15)

    def test_undeclared_marks_are_refused_with_the_remedy(self):
        self.refused(DATA / "formats/clip.xyz", "--crs", "EPSG:32619", causes=["clip.xyz: holds -9999", "--nodata -9999"])

    def test_a_strait_with_survey_stripes(self):
        folder, report = self.run_import(DATA / "bering_jd211_2m.bag")
        stripes = report["sources"][0]["stripes"]
        self.assertTrue(stripes["found"])
        # measured on the file before: every 85 to 92 m, standard deviation 5 cm
        self.assertTrue(80 < stripes["spacing_m"] < 97, stripes)
        self.assertTrue(0.03 < stripes["sd_m"] < 0.07, stripes)
        _, cleaned = self.run_import(DATA / "bering_jd211_2m.bag", "--destripe", name="cleaned")
        self.assertGreater(cleaned["sources"][0]["stripes"]["corrected_cells"], 0.8 * 1157306)

    def test_depths_on_degrees_need_a_reference_system_a_sign_and_a_smaller_area(self):
        german_bight = DATA / "german_bight_1km.nc"
        self.refused(german_bight, causes=["german_bight_1km.nc: has no coordinate reference system", "--crs EPSG:"])
        self.refused(german_bight, "--crs", "EPSG:4326", causes=["--positive down"])
        self.refused(german_bight, "--crs", "EPSG:4326", "--positive", "down", causes=["at most 200 km x 200 km", "--bounds"])
        folder, report = self.run_import(german_bight, "--crs", "EPSG:4326", "--positive", "down", "--bounds", "7,54,8,55")
        # 0.0155 degrees of longitude at 54.5 degrees north, 0.00928 of latitude
        self.assertAlmostEqual(report["sources"][0]["cell_m"], 0.015534 * 64800, delta=15)
        self.assertLess(report["highest_m"], 0)

    def test_scattered_points_with_an_overhang(self):
        points = DATA / "colorado_riverbed_points.xyz"
        self.refused(points, causes=["has no coordinate reference system", "--crs plane"])
        self.refused(points, "--crs", "plane", causes=["where its middle is"])
        self.refused(points, "--crs", "plane", "--origin", "36,-112", causes=["--positive down for depths, up for elevations"])
        self.refused(points, "--crs", "plane", "--origin", "36,-112", "--positive", "up", causes=["above the water", "--datum-shift"])
        folder, report = self.run_import(points, "--crs", "plane", "--origin", "36,-112", "--positive", "up", "--datum-shift",
                                         "-376.5", "--points-cell", 0.2)
        source = report["sources"][0]
        self.assertEqual(source["points"]["count"], 100000)
        self.assertGreater(source["points"]["widest_spread_m"], 0.1)  # the bank
        z = np.loadtxt(points)[:, 2]
        self.assertGreaterEqual(report["lowest_m"], z.min() - 376.5 - 1e-3)
        self.assertLessEqual(report["highest_m"], z.max() - 376.5 + 1e-3)

    def test_two_backscatter_mosaics_make_classes_by_thresholds(self):
        folder, report = self.run_import(DATA / "bedford_depth_9m.tif", "--sediment", 9, "--sediment-backscatter",
                                         DATA / "bedford_backscatter2017_10m.tif", "--thresholds=-20,-12",
                                         "--backscatter-classes", "1,2,3")
        _, level = self.warped(DATA / "bedford_backscatter2017_10m.tif", folder, report)
        heights, west, north, step = self.heights(folder)
        rng = np.random.default_rng(4)
        rows, columns = np.nonzero(np.isfinite(heights))
        picked = rng.integers(0, len(rows), 300)
        text = "".join(f"{west + (columns[i] + 0.5) * step},{north - (rows[i] + 0.5) * step}\n" for i in picked)
        lines = list(csv.DictReader(io.StringIO(terrain("sample", folder, "--points", "-", text=text).stdout)))
        checked = 0
        for i, line in zip(picked, lines):
            value = level[rows[i], columns[i]]
            if not math.isfinite(value) or min(abs(value + 20), abs(value + 12)) < 0.01 or line["sediment"] in ("", "9"):
                continue  # beside a hole, GDAL interpolates on and we do not
            checked += 1
            self.assertEqual(int(line["sediment"]), 1 + (value >= -20) + (value >= -12))
        self.assertGreater(checked, 150)

    def test_the_first_file_decides_and_the_others_fill_in(self):
        # A coarser copy of the same sea, 1 m deeper, over the whole rectangle.
        coarse = self.folder / "coarse.tif"
        memory = gdal.Translate("", str(DATA / "massbay_5m.tif"), format="MEM", xRes=25, yRes=25, resampleAlg="average")
        band = memory.GetRasterBand(1)
        array = band.ReadAsArray()
        array[array > -1e30] -= 1.0
        band.WriteArray(array)
        gdal.Translate(str(coarse), memory)
        folder, report = self.run_import(DATA / "formats/clip.tif", coarse, "--spacing", 5)
        fine, rest = report["sources"]
        self.assertAlmostEqual(rest["overlap"]["mean_difference_m"], -1.0, delta=0.02)
        self.assertGreater(rest["used_m2"], 5 * fine["used_m2"])
        self.assertEqual(report["holes"]["count"], self.run_import(coarse, "--spacing", 5, name="alone")[1]["holes"]["count"])

    def test_holes_are_filled_as_far_as_asked(self):
        clip = DATA / "formats/clip.tif"
        folder, report = self.run_import(clip, "--fill", "smooth/30", "--spacing", 5)
        self.assertEqual((report["holes"]["count"], report["holes"]["filled"]), (0, 1))
        self.assertEqual(self.run_import(clip, "--fill", "smooth/10", "--spacing", 5, name="short")[1]["holes"]["count"], 1)
        filled = self.heights(folder)[0]
        whole, _ = self.warped(DATA / "massbay_5m.tif", folder, report)[::-1]
        hole = np.isfinite(filled) & ~np.isfinite(self.heights(self.folder / "short")[0])
        # the seabed that the clip lost, within what it does over 40 m here (rms 0.27 m)
        self.assertLess(np.sqrt(np.nanmean((filled - whole)[hole] ** 2)), 0.6)


if __name__ == "__main__":
    unittest.main()
