"""The vertical chain of a whole run: soundings reduced by tide gauge and by satellite agree with each other and with the seabed when every
instrument reports the truth, whatever tide, draught, settlement, waves and datums do."""
import csv
import unittest

import ensonify
import numpy as np
from support import SystemTest

DEPTH_M = 20.0
WORLD = """
ensonify: scenario/1
site: { latitude_deg: 48.6, longitude_deg: -3.9 }
time: { start_utc: "2025-06-01T12:00:00Z" }
seed: 11
water: { sound_speed_mps: 1500 }
vertical: { tide: { gauge: tide.csv }, geoid_above_ellipsoid_grid: geoid.asc, datum_above_geoid_grid: datum.asc }
seabed:
  kind: layers
  post_spacing_m: 0.5
  size_m: [200, 200]
  layers: { ground: { plane: { depth_m: 20 } } }
vehicles:
  boat:
    roll: { amplitude_deg: 3, period_s: 5 }
    heave: { amplitude_m: 0.4, period_s: 7 }
    floats: { deeper_m: 0.08, settlement: [{ speed_mps: 0, lower_m: 0 }, { speed_mps: 4, lower_m: 0.06 }] }
    mountings: { bow: { actual: { position_m: [1.2, 0.4, 0.6] } } }
mission: { speed_mps: 3, runlines: [{ from_m: [0, -30], to_m: [0, 60] }] }
"""
LAUNCH = """
ensonify: launch/1
scenario: world.yaml
duration_s: 15
clock: { rate: free }
processes:
  boat:  { run: vehicle }
  nav:
    run: navigation
    config:
      { sigma_roll_deg: 0, sigma_pitch_deg: 0, sigma_heading_deg: 0, sigma_heave_m: 0, sigma_horizontal_m: 0, sigma_vertical_m: 0,
        sigma_velocity_mps: 0, sigma_sound_speed_mps: 0, gnss: { grade: true_fixes.yaml, rate_hz: 20, position_m: [-1, 0.4, -4] } }
  pilot: { run: autopilot }
  pager: { run: terrain_pager }
  bow:   { run: multibeam, config: { ping_rate_hz: 4, amplitude_every: 1000, quality: 0.25 } }
  recorder: { run: recorder, config: { file: run.mcap, topics: [pager/chart, nav/estimate, nav/attitude, nav/position, bow/soundings] } }
"""
TRUE_FIXES = "fix: { horizontal_m: 0, vertical_m: 0, wander_horizontal_m: 0, wander_vertical_m: 0 }\nfirst_fix_s: 0\nconverge_s: 0\nhdop_wander: 0\n"
# Water rises by 5 mm/s, quicker than any tide: what is taken from a wrong time shows.
TIDE = "time,height_m\n2025-06-01T11:59:00Z,1.2\n2025-06-01T12:02:00Z,2.1\n"
SETTLEMENT = "0:0.08,4:0.14"  # with the load


def grid(first_m, east_m, north_m, cell_m=40.0, cells=6):
    """An Esri ASCII grid about the world's origin that rises by so many metres from cell to cell."""
    rows = [" ".join(f"{first_m + east_m * i + north_m * j:.4f}" for i in range(cells)) for j in reversed(range(cells))]
    corner_m = -0.5 * cells * cell_m
    return (f"ncols {cells}\nnrows {cells}\nxllcorner {corner_m}\nyllcorner {corner_m}\ncellsize {cell_m}\n" + "\n".join(rows) + "\n")


class Reduction(SystemTest):
    def setUp(self):
        super().setUp()
        self.write("tide.csv", TIDE)
        self.write("geoid.asc", grid(50.1, 0.02, -0.05))
        self.write("datum.asc", grid(-4.6, 0.01, 0.11))
        self.separation = self.write("separation.asc", grid(45.5, 0.03, 0.06))  # their sum
        self.write("true_fixes.yaml", TRUE_FIXES)
        self.write("world.yaml", WORLD)

    def soundings(self, record, name, *how):
        """(ping, beam) to depth, and beams' depths as one array; by `ensonify plot survey`."""
        done = self.tool("plot", "survey", record, "--out", self.folder / name, *how, timeout=200)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.folder / name / "soundings.csv", newline="") as rows:
            return {(row["ping"], row["beam"]): float(row["depth_m"]) for row in csv.DictReader(rows)}

    def test_by_gauge_and_by_satellite_a_sounding_has_the_same_depth_and_the_true_one(self):
        result = self.run_launch(LAUNCH, timeout=200)
        self.assertEqual(result.code, 0, result.stderr)
        record = result.out / "run.mcap"
        with ensonify.Record(record) as reader:
            up_m = np.array([fix.position_enu_m[2] for _, _, fix in reader.messages("nav/position")])
        self.assertGreater(np.ptp(up_m), 0.8)  # the boat did heave

        by_gauge = self.soundings(record, "gauge", "--gauge", self.folder / "tide.csv", "--settlement", SETTLEMENT)
        by_satellite = self.soundings(record, "satellite", "--separation", self.separation)
        both = sorted(by_gauge.keys() & by_satellite.keys())
        self.assertGreater(len(both), 0.9 * max(len(by_gauge), len(by_satellite)))
        self.assertGreater(len(both), 5000)
        gauge_m, satellite_m = (np.array([depths[key] for key in both]) for depths in (by_gauge, by_satellite))
        self.assertLess(np.max(np.abs(gauge_m - satellite_m)), 0.02)
        for depths_m in (gauge_m, satellite_m):
            self.assertAlmostEqual(np.median(depths_m), DEPTH_M, delta=0.02)

        # What is forgotten shows as its own size: settlement and load at 3 m/s, chart datum below the geoid.
        forgotten = self.soundings(record, "forgotten", "--gauge", self.folder / "tide.csv")
        self.assertAlmostEqual(np.median([by_gauge[key] - forgotten[key] for key in both]), 0.08 + 0.06 * 3 / 4, delta=0.005)
        wrong = self.soundings(record, "wrong", "--separation", self.folder / "geoid.asc")
        self.assertAlmostEqual(np.median([wrong[key] - by_satellite[key] for key in both]), 4.3, delta=0.1)  # by place


if __name__ == "__main__":
    unittest.main(verbosity=2)
