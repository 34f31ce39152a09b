"""The survey of a user's own raster, on data measured at sea: planned, surveyed, compared with itself, or refused with
the reason. Skipped where the shared data folder is absent."""
import json
import unittest

from support import SHARED, SOURCE, SystemTest

TERRAIN = SHARED / "data/terrain"


@unittest.skipUnless(TERRAIN.is_dir(), f"no shared data in {TERRAIN}")
class Rasters(SystemTest):
    def survey(self, raster, **arguments):
        options = [f"raster={TERRAIN / raster}", *(f"{name}={value}" for name, value in arguments.items())]
        return self.run_launch(SOURCE / "launch/survey.yaml", *(word for o in options for word in ("--arg", o)),
                               timeout=300)

    def check_surveyed(self, raster, least_m, greatest_m):
        """One line of 60 m. Depth limits are those of the data; a posted 2 m mean of a rough 50 m swath is not exact."""
        result = self.survey(raster, lines=1, longest_m=60)
        self.assertEqual(result.code, 0, result.stderr)
        summary = json.loads((result.out / "summary.json").read_text())
        against_truth = summary["depth_against_truth"]
        self.assertGreater(summary["pings"], 50)  # 60 m and run-in; in 70 m of water two or three pings a second
        self.assertGreater(summary["accepted"], 0.7)
        self.assertGreater(summary["coverage"]["share"], 0.85)
        self.assertGreater(summary["depth_m"]["mean"], least_m)
        self.assertLess(summary["depth_m"]["mean"], greatest_m)
        self.assertLess(abs(against_truth["bias_m"]), 0.25)
        self.assertLess(against_truth["within_95_m"], 0.25)

    def test_an_inner_shelf_as_geotiff(self):
        self.check_surveyed("massbay_5m.tif", 6.5, 29.9)

    def test_a_strait_half_without_data_as_bag(self):
        self.check_surveyed("bering_jd211_2m.bag", 51.0, 53.0)

    def test_a_basin_half_without_data(self):
        self.check_surveyed("bedford_depth_9m.tif", 14.4, 71.3)

    def test_a_survey_area_of_which_a_fifth_is_known(self):
        self.check_surveyed("f00788_8m.tif", 36.2, 68.4)

    def check_refused(self, raster, *causes, **arguments):
        result = self.survey(raster, **arguments)
        self.assertEqual(result.code, 2, result.stderr)
        for cause in causes:
            self.assertIn(cause, result.stderr)

    def test_a_reef_smaller_than_a_swath_is_refused_with_what_it_would_take(self):
        self.check_refused("horseshoe_reef_1cm.tif", "scenario.yaml", "mission.auto: no room for a survey",
                           "8 m x 8 m", "one line needs")

    def test_a_raster_without_a_reference_system_is_refused(self):
        self.check_refused("german_bight_1km.nc", "german_bight_1km.nc", "coordinate reference system", values="depth")

    def test_a_file_that_is_no_raster_is_refused(self):
        self.check_refused("stats.json", "stats.json", "cannot be read as a raster")

    def test_a_missing_file_is_refused_with_the_place_that_names_it(self):
        self.check_refused("nowhere.tif", "survey.yaml:", "seabed.raster.path", "no such file")

    def test_depths_taken_for_heights_are_noticed(self):
        self.check_refused("massbay_5m.tif", "massbay_5m.tif", "mostly above the water", values="depth")


if __name__ == "__main__":
    unittest.main()
