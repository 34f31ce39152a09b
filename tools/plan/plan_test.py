"""ensonify plan: closed forms through the command line, and a plan that is read again."""
import json
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "bin"
SOURCE = pathlib.Path(os.environ["ENSONIFY_SOURCE"])
AREA = ["--corner", "0", "0", "--corner", "400", "0", "--corner", "400", "200", "--corner", "0", "200"]


def plan(*arguments):
    done = subprocess.run([BIN / "ensonify-plan", *arguments], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


class Plan(unittest.TestCase):
    def test_level_ground(self):
        code, out, _ = plan("lines", *AREA, "--depth", "20", "--overlap", "0", "--speed", "4", "--turn-speed", "4",
                            "--data-rate", "2", "--day-rate", "8640", "--json")
        self.assertEqual(code, 0)
        found = json.loads(out)
        self.assertEqual(found["lines_count"], 6)  # 400 m in swaths of 69.3 m
        self.assertAlmostEqual(found["lines"][0]["places"][0][0], 20 * math.sqrt(3), delta=1e-3)
        self.assertAlmostEqual(found["line_s"], 6 * 200 / 4)
        self.assertAlmostEqual(found["data_gb"], 2e-3 * 300)
        self.assertAlmostEqual(found["cost"], 0.1 * found["total_s"])
        self.assertAlmostEqual(found["redundancy"], 6 * 2 * 20 * math.sqrt(3) / 400)

    def test_a_scenarios_slope_spreads_the_lines(self):
        slope = str(SOURCE / "scenarios/slope/scenario.yaml")
        code, adapted, error = plan("lines", *AREA, "--scenario", slope, "--json")
        self.assertEqual((code, error), (0, ""))
        code, fixed, _ = plan("lines", *AREA, "--scenario", slope, "--fixed", "--json")
        self.assertEqual(code, 0)
        self.assertLess(json.loads(adapted)["lines_count"], json.loads(fixed)["lines_count"])

    def test_the_pages_own_command_works_from_anywhere(self):
        page = (SOURCE / "docs/manual/planning.md").read_text()
        command = next(line for line in page.splitlines() if line.startswith("    ensonify plan lines"))
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True,
                                  env={**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"})
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("mission/1", pathlib.Path(folder, "mission.yaml").read_text())
        code, _, error = plan("lines", *AREA, "--scenario", "scenarios/slop/scenario.yaml")
        self.assertEqual(code, 2)
        self.assertIn("scenarios/slop/scenario.yaml", error)

    def test_speed(self):
        code, out, _ = plan("speed", "--depth", "37.5", "--feature", "1", "--pings", "3", "--json")
        self.assertEqual(code, 0)
        self.assertAlmostEqual(json.loads(out)["ping_rate_hz"], 10)  # 75 m to the swath's end at 60 degrees
        self.assertAlmostEqual(json.loads(out)["fastest_mps"], 10 / 3)

    def test_sidescan(self):
        code, out, _ = plan("sidescan", "--range", "100", "--overlap", "0", "--json")
        self.assertEqual(code, 0)
        self.assertAlmostEqual(json.loads(out)["altitude_m"], 10)
        self.assertAlmostEqual(json.loads(out)["joining_spacing_m"], 2 * math.sqrt(9900))

    def test_wrong_input_is_2_and_says_what_is_allowed(self):
        for arguments, cause in ((["lines", *AREA], "--scenario FILE or --depth M"),
                                 (["lines", *AREA[:6], "--depth", "20"], "at least 3 corners"),
                                 (["lines", *AREA, "--depth", "20", "--head-depth", "30"], "allowed: above 0"),
                                 (["lines", *AREA, "--depth", "nan"], "--depth"),
                                 (["lines", "--corner", "0", "0", "--corner", "200", "100", "--corner", "200", "0",
                                   "--corner", "0", "300", "--depth", "20"],
                                  "crosses itself: the side from corner 1 (0, 0) crosses the one from corner 3 (200, 0)"),
                                 (["lines", "--corner", "0", "0", "--corner", "40000", "0", "--corner", "40000", "100",
                                   "--scenario", str(SOURCE / "scenarios/slope/scenario.yaml")],
                                  "m lies outside the terrain; allowed: an area"),
                                 (["sidescan", "--range", "10", "--least", "20"], "must be below --range"),
                                 (["import", "none.lnw"], "cannot be read")):
            code, out, error = plan(*arguments)
            self.assertEqual((code, out), (2, ""), arguments)
            self.assertIn(cause, error)

    def test_a_plan_is_a_mission_whose_csv_gives_it_again(self):
        code, mission, _ = plan("lines", *AREA, "--depth", "20")
        self.assertEqual(code, 0)
        self.assertTrue(mission.startswith("ensonify: mission/1\n"))
        _, table, _ = plan("lines", *AREA, "--depth", "20", "--csv")
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "a.csv").write_text(table)
            code, again, error = plan("import", f"{folder}/a.csv")
            self.assertEqual((code, error), (0, ""))
        self.assertEqual([line.split("#")[0] for line in again.splitlines() if line.startswith("  - line")],
                         [line for line in mission.splitlines() if line.startswith("  - line")])


if __name__ == "__main__":
    unittest.main()
