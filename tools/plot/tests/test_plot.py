"""`ensonify plot` on a synthetic record whose errors are known."""
import contextlib
import csv
import importlib.util
import io
import json
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np
from osgeo import gdal, osr

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import ensonify  # noqa: E402
from ensonify.record import Recorded  # noqa: E402
from ensonify_plot import files, grid  # noqa: E402
from ensonify_plot.main import coverage, main, utc_texts  # noqa: E402
from ensonify_plot.pictures import hillshade, in_minutes, round_minutes  # noqa: E402
from ensonify_plot.plan import read_plan  # noqa: E402
from ensonify_plot.errors import UserError
from ensonify_plot.survey import _mission, read_survey  # noqa: E402
from ensonify_plot.truth import Seabed  # noqa: E402

HAS_MCAP = importlib.util.find_spec("mcap") is not None
if HAS_MCAP:
    import synthetic_record

NOISE_M, BIAS_M = 0.05, 0.02


def run(*arguments):
    """(exit code, stdout, stderr)."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main([str(argument) for argument in arguments])
    return code, out.getvalue(), err.getvalue()


@unittest.skipUnless(HAS_MCAP, "the package mcap is not installed (./dev test installs it)")
class OfARecord(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.root = pathlib.Path(cls.folder.name)
        cls.record = cls.root / "survey.mcap"
        cls.pings = synthetic_record.write(cls.record, noise_m=NOISE_M, bias_m=BIAS_M)
        run_facts = {"wall_s": 10.0, "sim_s": 225.0, "real_time_factor": 22.5,
                     "processes": [{"name": "bow", "max_rss_kib": 2}]}
        (cls.root / "run.json").write_text(json.dumps(run_facts))
        (cls.root / "clock.json").write_text(json.dumps({"late_events": 3}))
        cls.code, cls.printed, cls.errors = run("survey", cls.record)
        cls.summary = json.loads((cls.root / "summary.json").read_text()) if cls.code == 0 else None

    def test_everything_is_written(self):
        self.assertEqual((self.code, self.errors), (0, ""))
        wanted = {"bathymetry.tif", "soundings.csv", "survey.png", "truth.png", "survey_and_truth.png", "difference.png",
                  "ping.png", "summary.json"}
        self.assertEqual(set(self.summary["files"]), wanted)
        for name in wanted:
            self.assertGreater((self.root / name).stat().st_size, 200, name)

    def test_the_planted_errors_are_found(self):
        truth = self.summary["depth_against_truth"]
        # Depth noise grows as 1 / cos(beam angle): its variance over the fan is the mean of 1 / cos^2.
        angles = np.radians(np.linspace(-65, 65, 64))
        std_m = NOISE_M * np.sqrt(np.mean(1 / np.cos(angles) ** 2))
        # About 141,000 independent soundings: standard errors of 0.0002 m; the bilinear mesh adds some millimetres.
        self.assertAlmostEqual(truth["bias_m"], BIAS_M, delta=0.003)
        self.assertAlmostEqual(truth["std_m"], std_m, delta=0.003)
        self.assertEqual(self.summary["pings"], self.pings)
        self.assertEqual(truth["soundings"], self.summary["soundings"])
        self.assertAlmostEqual(self.summary["accepted"], 0.99, delta=0.005)

    def test_predicted_uncertainty_is_held_against_errors_and_orders(self):
        truth, stated = self.summary["depth_against_truth"], self.summary["uncertainty"]
        # Bias counts as if drawn: 95.4 % at nadir, 95.1 % outside, scatter of 14,000 soundings a class 0.2 %.
        for share in [truth["inside_tvu"], *truth["inside_tvu_by_angle"]]:
            self.assertAlmostEqual(share, 0.95, delta=0.012)
        self.assertEqual(stated["thu_m"], 1.5)  # beyond the 1 m of Exclusive Order
        # At 65 degrees 1.96 x sqrt(0.02^2 + (0.05 / cos)^2) = 0.235 m, inside sqrt(0.25^2 + (0.0075 x 20)^2) = 0.29 m.
        self.assertEqual((stated["order"], stated["share_that_keeps"]["Exclusive Order"]), ("Special Order", 0.0))
        self.assertEqual(stated["share_that_keeps"]["Special Order"], 1.0)
        self.assertIn("uncertainty only: Special Order", self.printed)

    def test_coverage_sees_a_gap_between_lines(self):
        with tempfile.TemporaryDirectory() as out:
            record = pathlib.Path(out) / "gap.mcap"
            shares = []
            for spacing_m in (40, 180):
                synthetic_record.write(record, lines=2, spacing_m=spacing_m, leave_out=("tile/1", "ping/1"))
                survey = read_survey(ensonify.Record(record))
                frame = grid.frame_around(survey.soundings.east_m, survey.soundings.north_m, 4.0)
                shares.append(coverage(survey, frame)["share"])
        self.assertGreater(shares[0], 0.97)
        # Depths of 20 and 25 m on the two lines: swaths of 86 and 109 m, in an area 180 m + half of both wide.
        self.assertAlmostEqual(shares[1], (86 + 109) / (180 + (86 + 109) / 2), delta=0.04)

    def test_run_facts(self):
        self.assertEqual((self.summary["real_time_factor"], self.summary["late_events"]), (22.5, 3))
        self.assertEqual(self.summary["peak_memory_bytes"], {"bow": 2048})

    def test_the_geotiff_lies_where_it_should(self):
        raster = gdal.Open(str(self.root / "bathymetry.tif"))
        up_m, count, tvu_m = raster.ReadAsArray()
        self.assertAlmostEqual(float(tvu_m[count > 0].min()), 1.96 * np.hypot(NOISE_M, BIAS_M), delta=0.002)  # at nadir
        self.assertEqual(int(count.sum()), self.summary["soundings"])
        west, cell_m, _, north, _, minus_cell_m = raster.GetGeoTransform()
        self.assertEqual((cell_m, minus_cell_m), (self.summary["cell_m"], -self.summary["cell_m"]))
        rows, cols = np.nonzero(count >= 5)
        east, northing = west + (cols + 0.5) * cell_m, north - (rows + 0.5) * cell_m
        error_m = up_m[rows, cols] - synthetic_record.seabed_up_m(east, northing)
        self.assertLess(abs(np.median(error_m) - BIAS_M), 0.01)
        crs = osr.SpatialReference(raster.GetProjection())
        self.assertEqual(crs.GetProjParm("latitude_of_origin"), 54.3)
        self.assertEqual(crs.GetProjParm("central_meridian"), 10.2)
        self.assertEqual(crs.GetProjParm("scale_factor"), 1.0)

    def test_the_csv_holds_every_accepted_sounding(self):
        with open(self.root / "soundings.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual(len(rows), self.summary["soundings"])
        self.assertEqual(list(rows[0]), ["t_s", "utc", "line", "head", "ping", "beam", "latitude_deg", "longitude_deg", "east_m", "north_m",
                                         "depth_m", "received_level_db", "tvu_m", "thu_m"])
        depths = np.array([float(row["depth_m"]) for row in rows])
        self.assertAlmostEqual(depths.mean(), self.summary["depth_m"]["mean"], places=3)
        self.assertEqual(rows[-1]["head"], "bow")
        self.assertEqual(int(rows[-1]["ping"]), self.pings - 1)

    def test_the_csv_says_when_where_and_on_which_line(self):
        with open(self.root / "soundings.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual((rows[0]["utc"], rows[0]["line"]), ("2025-06-01T12:00:00.000000Z", "1"))
        self.assertEqual((rows[-1]["utc"], rows[-1]["line"]), ("2025-06-01T12:03:44.900000Z", "3"))
        for row in rows[:: len(rows) // 50]:
            # Metres from the origin, by the ellipsoid's radii of curvature there; within 300 m the plane errs by less than 20 mm.
            sine = np.sin(np.radians(54.3))
            across_m = 6378137.0 / np.sqrt(1 - 0.00669437999 * sine**2)
            along_m = across_m * (1 - 0.00669437999) / (1 - 0.00669437999 * sine**2)
            north_m = np.radians(float(row["latitude_deg"]) - 54.3) * along_m
            east_m = np.radians(float(row["longitude_deg"]) - 10.2) * across_m * np.sqrt(1 - sine**2)
            self.assertAlmostEqual(north_m, float(row["north_m"]), delta=0.02)
            self.assertAlmostEqual(east_m, float(row["east_m"]), delta=0.02)

    def test_utm_on_request(self):
        with tempfile.TemporaryDirectory() as out:
            self.assertEqual(run("survey", self.record, "--out", out, "--utm", "--latlon")[0], 0)
            raster = gdal.Open(str(pathlib.Path(out) / "bathymetry.tif"))
            up_m, count, _ = raster.ReadAsArray()
            crs = osr.SpatialReference(raster.GetProjection())
            self.assertEqual(crs.GetAuthorityCode(None), "32632")
            west, cell_m, _, north, _, _ = raster.GetGeoTransform()
            rows, cols = np.nonzero(count >= 5)
            geodetic = files.transformed(crs, files.wgs84(), west + (cols + 0.5) * cell_m, north - (rows + 0.5) * cell_m)
            east_m, north_m = files.transformed(files.wgs84(), files.world_crs((54.3, 10.2)), *geodetic)
            self.assertLess(abs(np.median(up_m[rows, cols] - synthetic_record.seabed_up_m(east_m, north_m)) - BIAS_M), 0.01)

    def test_soundings_of_turns_are_left_out_unless_asked_for(self):
        with tempfile.TemporaryDirectory() as out:
            record = pathlib.Path(out) / "turns.mcap"
            synthetic_record.write(record, lines=2, line_m=60, turn_pings=100, names=("L01, $north^$ of it all", "ré"), leave_out=("ping/1",))
            code, printed, errors = run("survey", record)
            self.assertEqual((code, errors), (0, ""))
            lines = json.loads((pathlib.Path(out) / "summary.json").read_text())
            self.assertAlmostEqual(lines["left_out_in_turns"], 0.99 * 200 * 64, delta=60)
            self.assertAlmostEqual(lines["depth_against_truth"]["bias_m"], 0.02, delta=0.005)
            self.assertIn("of turns left out", printed)
            with open(pathlib.Path(out) / "soundings.csv", newline="", encoding="utf-8") as stream:
                self.assertEqual({row["line"] for row in csv.DictReader(stream)}, {"L01, $north^$ of it all", "ré"})
            run("survey", record, "--turns")
            everything = json.loads((pathlib.Path(out) / "summary.json").read_text())
            self.assertEqual(everything["soundings"], lines["soundings"] + lines["left_out_in_turns"])
            self.assertLess(everything["depth_against_truth"]["bias_m"], -0.1)
            with open(pathlib.Path(out) / "soundings.csv", newline="", encoding="utf-8") as stream:
                self.assertIn("", {row["line"] for row in csv.DictReader(stream)})

    def test_each_vehicle_runs_its_own_mission(self):
        def states(topic, *of_times):
            return [Recorded(topic, 0, ensonify.MissionState(stamp_ns=int(t * 1e9), state=state, line=0, line_name=name))
                    for t, state, name in of_times]

        missions = {"a/mission": states("a", (0, "turn", ""), (1, "on_line", "A"), (2, "on_line", "A"), (3, "turn", "")),
                    "b/mission": states("b", (0.5, "on_line", "B"), (2.5, "run_out", ""), (4, "on_line", "B"))}

        class Both:
            def topics_of(self, kind):
                return list(missions)

            def messages(self, topic):
                return missions[topic]

        lines, working_s = _mission(Both())
        self.assertEqual([(line.name, line.begin_s, line.end_s) for line in lines], [("B", 0.5, 2.5), ("A", 1.0, 3.0), ("B", 4.0, np.inf)])
        self.assertEqual(sorted(working_s), [[0.5, 2.5], [1.0, 3.0], [4.0, np.inf]])

    def test_truth_comes_before_claims_and_contradicts_them(self):
        self.assertLess(self.printed.index("against the true seabed"), self.printed.index("as stated"))
        self.assertIsNone(self.summary["warning"])
        with tempfile.TemporaryDirectory() as out:
            record = pathlib.Path(out) / "bold.mcap"
            # True errors at 95 %: 0.5 m and more, inside 1a alone; a tenth of it is stated.
            synthetic_record.write(record, lines=1, line_m=40, noise_m=0.2, stated_share=0.1, leave_out=("ping/1",))
            printed = run("survey", record)[1]
            summary = json.loads((pathlib.Path(out) / "summary.json").read_text())
        self.assertEqual((summary["uncertainty"]["order"], summary["depth_against_truth"]["order"]), ("Special Order", "Order 1a"))
        self.assertIn("warning: the soundings state Special Order, and their true errors keep Order 1a", printed)

    def test_coverage_of_any_survey_with_a_plan_over_it(self):
        with tempfile.TemporaryDirectory() as out:
            plan = pathlib.Path(out) / "plan.json"
            plan.write_text(json.dumps({"positions": "geodetic", "lines": [{"name": "", "places": [[54.3, 10.2], [54.3, 10.202]]}]}))
            self.assertEqual(run("coverage", self.record, "--out", out, "--plan", plan, "--soundings", 5)[0], 0)
            self.assertGreater((pathlib.Path(out) / "coverage.png").stat().st_size, 10000)
            [line] = read_plan(str(plan), (54.3, 10.2))
            np.testing.assert_allclose(line, [[0, 0], [130.2, 0]], atol=0.1)
            with self.assertRaisesRegex(UserError, "has latitudes and longitudes"):
                read_plan(str(plan), None)
            for wrong in ({}, {"lines": [{"places": []}]}, {"lines": [{"places": [[1, 2, 3], [4, 5, 6]]}]}):
                plan.write_text(json.dumps(wrong))
                code, _, errors = run("coverage", self.record, "--plan", plan)
                self.assertEqual(code, 2)
                self.assertIn("cannot be read as a plan", errors)
            with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()):
                main(["coverage", str(self.record), "--soundings", "0"])

    def test_json_is_the_summary(self):
        with tempfile.TemporaryDirectory() as out:
            code, printed, _ = run("survey", self.record, "--out", out, "--json", "--cell", 2)
            self.assertEqual(code, 0)
            self.assertEqual(json.loads(printed), json.loads((pathlib.Path(out) / "summary.json").read_text()))
            self.assertEqual(json.loads(printed)["cell_m"], 2.0)

    def test_one_ping(self):
        with tempfile.TemporaryDirectory() as out:
            self.assertEqual(run("ping", self.record, "--out", out, "--ping", 100)[0], 0)
            self.assertEqual(os.listdir(out), ["ping_100.png"])
            code, _, errors = run("ping", self.record, "--out", out, "--ping", 101)
            self.assertEqual(code, 2)
            self.assertIn("ping 101 of bow/ping was not recorded; the nearest is 100", errors)
            code, _, errors = run("ping", self.record, "--out", out, "--topic", "stern/ping")
            self.assertEqual(code, 2)
            self.assertIn("stern/ping is no recorded ping topic; there are bow/ping", errors)

    def test_the_record_is_found_in_the_output_folder(self):
        with tempfile.TemporaryDirectory() as out, mock.patch.dict(os.environ, {"ENSONIFY_OUT": out}):
            code, _, errors = run("ping")
            self.assertEqual(code, 2)
            self.assertIn("holds no record (*.mcap)", errors)
            os.symlink(self.record, pathlib.Path(out) / "a.mcap")
            self.assertEqual(run("ping")[0], 0)
            os.symlink(self.record, pathlib.Path(out) / "b.mcap")
            self.assertIn("several records", run("ping")[2])

    def test_what_was_not_recorded_is_left_out(self):
        with tempfile.TemporaryDirectory() as out:
            record = pathlib.Path(out) / "bare.mcap"
            bare = ("tile/1", "chart/1", "ping/1", "mission_state/1", "estimate/1")
            synthetic_record.write(record, lines=1, line_m=30, leave_out=bare)
            code, printed, errors = run("survey", record)
            self.assertEqual((code, errors), (0, ""))
            summary = json.loads((pathlib.Path(out) / "summary.json").read_text())
            self.assertIsNone(summary["depth_against_truth"])
            self.assertEqual(summary["coverage"]["of"], "convex hull of all soundings")
            self.assertEqual(set(summary["files"]), {"bathymetry.tif", "soundings.csv", "survey.png", "summary.json"})
            synthetic_record.write(record, lines=1, line_m=30, leave_out=("soundings/1",))
            code, _, errors = run("survey", record)
            self.assertEqual(code, 2)
            self.assertIn("holds no soundings", errors)

    def test_the_users_mistakes_name_their_cause(self):
        cases = {
            ("survey", self.root / "missing.mcap"): "No such file",
            ("survey", self.root / "run.json"): "is no MCAP file",
            ("survey", self.record, "--cell", "0"): "--cell 0: must be positive",
            ("survey", self.record, "--cell", "1e-6"): "at most 20,000,000 cells",
            ("survey", self.record, "--out", self.record / "x"): "Not a directory",
        }
        for arguments, why in cases.items():
            code, _, errors = run(*arguments)
            self.assertEqual(code, 2, arguments)
            self.assertIn(why, errors)


class Parts(unittest.TestCase):
    def test_numbers_are_written_as_text(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "x.csv"
            self.assertEqual(utc_texts(None, np.array([1.0])), [""])
            values = np.array([0.0, -0.0004, -0.0006, 1234.5678, -7.0, np.nan])
            files.write_csv(str(path), [("a", values, 3), ("n", np.arange(6) * 11, 0), ("h", np.zeros(6, int), ["bow"])])
            self.assertEqual(path.read_text(), "a,n,h\n0.000,0,bow\n0.000,11,bow\n-0.001,22,bow\n1234.568,33,bow\n"
                                               "-7.000,44,bow\n,55,bow\n")

    def test_texts_are_quoted_where_a_cell_must_be(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "x.csv"
            texts = ["a b", 'say "é", twice', "two\nrows", ""]
            files.write_csv(str(path), [("n", np.arange(4), 0), ("text", np.array([0, 1, 2, -1]), texts)])
            with open(path, newline="", encoding="utf-8") as stream:
                self.assertEqual([row["text"] for row in csv.DictReader(stream)], texts)

    def test_utm_zones(self):
        # Zone 32 reaches west to 3 degrees east between 56 and 64 degrees; on Svalbard there are 31, 33, 35 and 37 alone [DMA1989].
        for place, code in (((54.3, 10.2), 32632), ((-33.9, 18.4), 32734), ((60.4, 5.3), 32632), ((60.4, 2.9), 32631), ((78.2, 15.6), 32633),
                            ((78.2, 8.9), 32631), ((78.2, 9.1), 32633), ((0.0, -179.9), 32601), ((10.0, 180.0), 32601)):
            self.assertEqual(files.utm_crs(*place).GetAuthorityCode(None), str(code), place)

    def test_degrees_and_minutes_are_round(self):
        self.assertEqual(in_minutes(round_minutes(54.2991, 54.3009), "NS"), ["54°17.95'N", "54°18.00'N", "54°18.05'N"])
        self.assertEqual(in_minutes(round_minutes(-0.25, 0.25), "EW"), ["0°10'W", "0°00'E", "0°10'E"])

    def test_the_grid_means_and_counts(self):
        east, north, up = np.array([0.1, 0.4, 2.5]), np.array([0.2, 0.3, 1.5]), np.array([1.0, 3.0, 7.0])
        frame = grid.frame_around(east, north, 1.0)
        self.assertEqual((frame.cols, frame.rows, frame.extent_m), (3, 2, (0.0, 3.0, 0.0, 2.0)))
        gridder = grid.Gridder(frame, east, north)
        np.testing.assert_array_equal(gridder.count, [[2, 0, 0], [0, 0, 1]])
        np.testing.assert_array_equal(gridder.mean(up), [[2, np.nan, np.nan], [np.nan, np.nan, 7]])

    def test_the_cell_is_the_finest_that_is_well_filled(self):
        for step_m, cell_m in ((0.2, 0.5), (0.5, 1.0), (1.0, 2.0)):  # 4 to 9, 4 and 4 soundings; 1 at the next finer size
            east, north = (x.ravel() + step_m / 2 for x in np.meshgrid(np.arange(200) * step_m, np.arange(200) * step_m))
            self.assertEqual(grid.choose_cell_m(east, north), cell_m)

    def test_the_outline_is_the_convex_hull(self):
        covered = np.zeros((20, 30), bool)
        covered[5:15, 5:25] = True
        covered[8:12, 10:20] = False  # a hole belongs to the area
        frame = grid.Frame(100.0, 200.0, 2.0, 30, 20)
        area = grid.inside(frame, grid.outline(frame, covered))
        expected = np.zeros_like(covered)
        expected[5:15, 5:25] = True
        np.testing.assert_array_equal(area, expected)

    def test_the_seabed_is_continuous_across_tiles(self):
        def plane(east, north):
            return -10 + 0.1 * east - 0.2 * north

        posts = np.arange(5.0)
        tiles = []
        for col in range(2):
            east, north = np.meshgrid(posts + 4 * col, posts)
            tiles.append(ensonify.Tile(col=col, row=0, origin_east_m=4.0 * col, origin_north_m=0.0, spacing_m=1.0,
                                       height_m=plane(east, north).astype("f4")))
        east, north = np.array([0.0, 3.99, 4.0, 4.01, 7.9, 9.0]), np.array([0.0, 1.5, 2.0, 2.5, 3.9, 1.0])
        height = Seabed(tiles).height_m(east, north)
        np.testing.assert_allclose(height[:-1], plane(east, north)[:-1], atol=1e-5)
        self.assertTrue(np.isnan(height[-1]))

    def test_the_sun_stands_in_the_north_west(self):
        north, east = np.mgrid[0:9, 0:9].astype(float)
        slope = (east - north) / np.sqrt(2)  # 45 degrees, falling to the north-west: the sun's rays hit it at right angles
        np.testing.assert_allclose(hillshade(slope, 1.0, 1.0), 1.0)
        np.testing.assert_allclose(hillshade(-slope, 1.0, 1.0), 0.0, atol=1e-12)


if __name__ == "__main__":
    unittest.main()
