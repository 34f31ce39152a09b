"""The shipped casts bend sound as the measured ones do that they are made after, and are what make.py writes.

Measured: speed near the surface and at the bottom, the steepest gradient and where it is, and by how much of the water
below a straight ray at the head's speed misses the depth (negative: too shallow), head at 1 m. Tolerances: the casts are
of the kind, not copies: 1.5 m/s, a fifth of the gradient, a tenth of the error or 0.1 %.
"""
import csv
import io
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

FOLDER = pathlib.Path(os.environ["ENSONIFY_SOURCE"]) / "scenarios" / "casts"
PHYSICS = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "bin" / "ensonify-physics"

# name: (bottom m, speed at 1 m, at the bottom, least, steepest 1/s, at m, % of the water below at 60 and at 70 degrees)
MEASURED = {
    "mixed": (17, None, None, None, None, None, 0.02, 0.06),  # Bynoe, April 2017
    "summer_thermocline": (22, 1512.7, 1491.7, 1491.7, -3.4, 7, -1.49, -4.61),  # Portsmouth, August 2012
    "salt_wedge": (54, 1504.9, 1510.0, 1504.9, 0.5, 13, 0.52, 1.74),  # San Francisco Bay, August 2019
    "cold_mid_layer": (264, 1525.8, 1513.5, 1510.8, -0.5, None, -1.37, -4.27),  # Sicily, June 2013
    "deep_channel": (1000, 1531.4, 1482.4, None, -0.4, None, -3.8, -11.0),  # Hawaii, March 2012
}


def physics(*words):
    """The first row of what `ensonify physics` prints."""
    done = subprocess.run([str(PHYSICS), *map(str, words)], capture_output=True, text=True, timeout=60, check=True)
    return next(csv.DictReader(io.StringIO(done.stdout)))


def speeds(name):
    """[(depth, speed)] of a shipped cast, by the UNESCO law."""
    lines = [line for line in (FOLDER / f"{name}.csv").read_text().splitlines() if not line.startswith("#")]
    found = []
    for row in csv.DictReader(lines):
        made = physics("sound-speed", "--law", "unesco", "--temperature-degc", row["temperature_degc"],
                       "--salinity-psu", row["salinity_psu"], "--depth-m", row["depth_m"])
        found.append((float(row["depth_m"]), float(made["sound_speed_mps"])))
    return found


def at(profile, depth_m):
    for (z0, c0), (z1, c1) in zip(profile, profile[1:]):
        if z0 <= depth_m <= z1:
            return c0 + (c1 - c0) * (depth_m - z0) / (z1 - z0)
    raise AssertionError(f"{depth_m} m is outside the cast")


class Casts(unittest.TestCase):
    def test_files_are_what_the_script_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["/usr/bin/python3", str(FOLDER / "make.py"), folder], check=True, timeout=60)
            made = {path.name: path.read_text() for path in pathlib.Path(folder).iterdir()}
        self.assertEqual(made, {path.name: path.read_text() for path in FOLDER.glob("*.csv")})
        self.assertEqual({f"{name}.csv" for name in MEASURED}, set(made))

    def test_they_bend_sound_as_measured_ones_do(self):
        for name, (bottom_m, top, bottom, least, steepest, steepest_at_m, *errors) in MEASURED.items():
            profile = speeds(name)
            down = [(z, c) for z, c in profile if z <= bottom_m] + [(bottom_m, at(profile, bottom_m))]
            gradients = [((c1 - c0) / (z1 - z0), 0.5 * (z0 + z1)) for (z0, c0), (z1, c1) in zip(down, down[1:])
                         if z1 > z0]
            gradient, where_m = max(gradients, key=lambda found: abs(found[0]))
            with self.subTest(name):
                for found, wanted in ((at(profile, 1), top), (down[-1][1], bottom), (min(c for _, c in down), least)):
                    if wanted is not None:
                        self.assertAlmostEqual(found, wanted, delta=1.5)
                if steepest is not None:
                    self.assertAlmostEqual(gradient, steepest, delta=0.2 * abs(steepest))
                if steepest_at_m is not None:
                    self.assertAlmostEqual(where_m, steepest_at_m, delta=1.5)
                for angle_deg, wanted in zip((60, 70), errors):
                    found = self.error_percent(profile, bottom_m, angle_deg)
                    self.assertAlmostEqual(found, wanted, delta=max(0.1, 0.1 * abs(wanted)))

    def test_a_launch_takes_them(self):
        for name in MEASURED:
            done = subprocess.run([str(PHYSICS.with_name("ensonify-check")), str(FOLDER.parents[1] / "launch" / "adaptive.yaml"),
                                   "--set", f"water.cast=scenarios/casts/{name}.csv"],
                                  capture_output=True, text=True, timeout=60, check=False, cwd="/")
            self.assertEqual(done.returncode, 0, done.stderr)

    def error_percent(self, profile, bottom_m, angle_deg):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write("".join(f"{z} {c}\n" for z, c in profile))
            file.flush()
            refracted = physics("ray", "--profile", file.name, "--source-depth-m", 1, "--depression-deg", 90 - angle_deg,
                           "--target-depth-m", bottom_m)
        straight_m = at(profile, 1) * float(refracted["travel_time_s"]) * math.cos(math.radians(angle_deg))
        return 100 * (straight_m / (bottom_m - 1) - 1)


if __name__ == "__main__":
    unittest.main()
