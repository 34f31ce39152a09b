"""The shipped scenarios' seabeds measure what measured seabeds do, and their truth.json says so.

The ranges are those of grids of real surveys (docs/physics/seabed/statistics.md): reefs and outcrops beside sand, coral, bedforms,
flat mud, a canyon's head, a river's bed. Plain fractional Brownian relief must fail the mixed one.
"""
import json
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["ENSONIFY_SOURCE"])
BIN = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "bin"
SCENARIOS = SOURCE / "scenarios"

# Rock and sand in one window: two classes of roughness, gathered, steep where rough.
MOSAIC = {"exponent": (3.1, 3.5), "k2": (0.10, 0.35), "rms_over_median": (2.3, 12), "p95_over_p5": (14, 80),
          "bimodality": (0.55, 1), "slope_correlation": (0.5, 0.75)}
CORAL = {"exponent": (3.2, 3.4), "k2": (0.25, 0.40), "rms_over_median": (2, 3), "slope_correlation": (0.6, 0.75)}
EVEN = {"k2": (0, 0.05), "rms_over_median": (1.0, 1.3)}  # flat mud or sand
RANGES = {
    ("slope_overlap", "middle"): MOSAIC,
    ("survey_10km", "rock_and_sand"): MOSAIC,
    ("billion", "rock_and_sand"): MOSAIC,
    ("target_field", "rock"): MOSAIC,
    ("target_field", "sand"): EVEN,
    ("ripple_field", "dunes"): {"k2": (-0.05, 0.05), "rms_over_median": (1.0, 1.2)},
    ("ripple_field", "smooth"): {**EVEN, "p95_over_p5": (2, 3)},
    ("coral_bank", "reef"): CORAL,
    ("coral_bank/inset", "reef"): {**CORAL, "strength_at_1_radpm_m4": (0.02, 0.04)},  # measured: 0.030
    # A measured bed of gravel: exponent 3.53, K2 0.14, rms over median 2.3.
    ("river_bank", "bed"): {"exponent": (3.3, 3.7), "k2": (0.10, 0.18), "rms_over_median": (1.8, 2.8)},
}
# (scenario, window): percentile: degrees. Slopes between posts of about what surveys of the real sites have for cells.
SLOPES = {
    ("canyon_head", "walls"): {"p50": (14, 18), "p95": (33, 41), "p99.9": (50, 60)},  # measured: 16, 37, 55
    ("coral_bank/inset", "reef"): {"p50": (33, 41), "p95": (74, 82), "p99.9": (85, 90)},  # 37, 78, 88
    ("trawl_scars", "plain"): {"p50": (0.4, 0.6)},  # 0.5
}
# Flat mud: scenario: window, and the layers that lie on it there.
MUD = {
    "trawl_scars": ("scars", ("scars",)),
    "target_field": ("mud", ("clutter",)),
    "harbour": ("basin", ("drags", "scour", "rubble", "anchor", "anchor_pit", "anchor_spoil")),
}


def truth(scenario, windows):
    words = [BIN / "ensonify-terrain", "truth", scenario]
    for w in windows:
        words += ["--window", f"{w['name']}={w['east_m']},{w['north_m']},{w['spacing_m']},{w['posts']}"]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=300, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)["windows"]


def truth_file(name):
    folder, _, stem = name.partition("/")
    return SCENARIOS / folder / (f"{stem}.truth.json" if stem else "truth.json")


def scenario_of(file):
    return file.with_name("scenario.yaml" if file.name == "truth.json" else file.name.replace(".truth.json", ".yaml"))


def stored(name):
    return json.loads(truth_file(name).read_text(encoding="utf-8"))["windows"]


def outside(measured, ranges):
    """Which of the ranges a window's numbers leave."""
    return [key for key, (low, high) in ranges.items() if not low <= measured[key] <= high]


class Truth(unittest.TestCase):
    def test_truth_files_are_what_the_scenarios_measure(self):
        files = sorted(SCENARIOS.glob("*/*truth.json"))
        self.assertGreaterEqual(len(files), 18)
        for file in files:
            windows = json.loads(file.read_text(encoding="utf-8"))["windows"]
            for was, now in zip(windows, truth(scenario_of(file), windows)):
                with self.subTest(scenario=file.parent.name, window=was["name"]):
                    for key, value in was.items():
                        if isinstance(value, float):  # rounded to four digits; another CPU may differ in the last
                            self.assertAlmostEqual(now[key], value, delta=2e-3 * abs(value) + 1e-4, msg=key)

    def test_they_lie_where_measured_seabeds_do(self):
        for (scenario, window), ranges in RANGES.items():
            with self.subTest(scenario=scenario, window=window):
                measured = next(w for w in stored(scenario) if w["name"] == window)
                self.assertEqual(outside(measured, ranges), [], measured)
        for (scenario, window), ranges in SLOPES.items():
            with self.subTest(scenario=scenario, window=window):
                measured = next(w for w in stored(scenario) if w["name"] == window)
                self.assertEqual(outside(measured["slope_deg"], ranges), [], measured)

    def test_flat_ones_are_flat(self):
        # rms about the plane in squares of 64 m: 0.046 m on a measured flat shelf; a pad for patch tests below 0.05 m.
        for scenario, window, most_m in (("patch_test", "pad", 0.05), ("trawl_scars", "plain", 0.046)):
            rows = next(w for w in stored(scenario) if w["name"] == window)["roughness"]
            self.assertLess(next(row["rms_m"] for row in rows if row["side_m"] == 64), most_m, scenario)

    def test_mud_and_sand_are_as_rough_as_their_sediments(self):
        # The rms about a plane in squares grows as the root of the spectrum's strength and as side^0.625. The yardstick is
        # unit/fbm, whose rms of 1.5 m and outer scale of 4 km make a strength of 1.5^2 H Ko^2H / pi, H = 0.625; strengths of
        # TR 9407 in cm^4 are 10^-1.5 of that in SI. Sand lies on the mud that is everywhere. Medians scatter by 2 %.
        fbm = 1.5**2 * 0.625 * (2 * math.pi / 4000)**1.25 / math.pi
        row = stored("unit/fbm")[0]["roughness"][0]
        for scenario, window, strength_cm4 in (("harbour", "basin", 0.000518), ("target_field", "mud", 0.000518),
                                               ("target_field", "sand", 0.002715 + 0.000518)):
            for mine in next(w for w in stored(scenario) if w["name"] == window)["roughness"]:
                if mine["side_m"] > 2:
                    continue  # longer waves have other layers, and an outer scale
                expected = row["median_m"] * math.sqrt(strength_cm4 * 10**-1.5 / fbm) * (mine["side_m"] / row["side_m"])**0.625
                self.assertAlmostEqual(mine["median_m"] / expected, 1, delta=0.06, msg=f"{scenario} {mine['side_m']} m")

    def test_mud_under_what_lies_on_it_is_even(self):
        # As measured flat mud: K2 0-0.05, rms/median 1.0-1.3, p95/p5 2-3, where plain fractional Brownian relief has 0.00, 1.04 and
        # 2.1. Here that has 0.00, 1.04 and 1.84 (unit/fbm: our local rms is of no high-passed heights), and scatters by 0.01 in K2.
        even = {"k2": (-0.01, 0.05), "rms_over_median": (1.0, 1.3), "p95_over_p5": (2 * 1.84 / 2.1, 3)}
        windows = {name: {w["name"]: w for w in stored(name)} for name in MUD}
        for name, (window, layers) in MUD.items():
            text = scenario_of(truth_file(name)).read_text(encoding="utf-8")
            for layer in layers:
                text, count = re.subn(rf"^    {layer}:( \{{|\n     )", lambda m: m[0] + (" use: false," if "{" in m[1] else " use: false\n     "),
                                      text, flags=re.M)
                self.assertEqual(count, 1, layer)
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                bare = pathlib.Path(folder) / "scenario.yaml"
                bare.write_text(text, encoding="utf-8")
                measured = truth(bare, [windows[name][window]])[0]
                self.assertEqual(outside(measured, even), [], measured)

    def test_the_border_of_the_ripples_is_sharp(self):
        # Local rms on both sides of a measured one: 15 to 1.
        dunes, smooth = (w["roughness"][0]["median_m"] for w in stored("ripple_field"))
        self.assertAlmostEqual(dunes / smooth, 15, delta=3)

    def test_plain_fractional_brownian_relief_fails_the_mosaic(self):
        plain = truth(SCENARIOS / "unit" / "fbm.yaml", [{"name": "all", "east_m": -128, "north_m": -128, "spacing_m": 0.25, "posts": 1024}])[0]
        self.assertLess(plain["k2"], 0.02)
        self.assertLess(plain["rms_over_median"], 1.2)
        self.assertGreaterEqual(set(outside(plain, MOSAIC)), {"k2", "rms_over_median", "p95_over_p5", "bimodality"})


class UnitCases(unittest.TestCase):
    """Worlds with closed forms: slopes between posts, and depths, are those of the formula."""

    def window(self, case):
        return truth(SCENARIOS / "unit" / f"{case}.yaml", [{"name": "all", "east_m": -31.75, "north_m": -31.75, "spacing_m": 0.25, "posts": 256}])[0]

    def test_plane(self):
        for value in self.window("plane")["slope_deg"].values():
            self.assertAlmostEqual(value, 5.0, delta=0.01)

    def test_ramp_and_step(self):
        self.assertEqual(self.window("ramp")["depth_m"], [18, 22])
        self.assertAlmostEqual(self.window("ramp")["slope_deg"]["p95"], 14.04, delta=0.01)  # 4 m in 16 m
        self.assertEqual(self.window("step")["depth_m"], [19, 21])

    def test_sphere_and_sinusoid(self):
        self.assertEqual(self.window("sphere")["depth_m"], [17, 20])
        wave = self.window("sinusoid")
        self.assertEqual(wave["depth_m"], [19.5, 20.5])
        self.assertAlmostEqual(wave["slope_deg"]["p99.9"], 11.11, delta=0.05)  # atan(2 pi 0.5 / 16)


if __name__ == "__main__":
    unittest.main()
