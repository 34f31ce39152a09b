"""Launches without sonar: launch/navigation.yaml and underwater.yaml hold what they promise; a vehicle moved by forces rides the tide."""
import os
import shutil
import subprocess
import unittest

import ensonify
import numpy as np
from support import BIN, SOURCE, SystemTest


def column(record, topic, field):
    """Stamps (s) and values of a field, message by message."""
    messages = [message for _, _, message in record.messages(topic)]
    return np.array([m.stamp_ns for m in messages]) * 1e-9, np.array([getattr(m, field) for m in messages], float)


class Navigation(SystemTest):
    def test_the_estimate_is_as_wrong_as_it_says(self):
        result = self.run_launch(SOURCE / "launch/navigation.yaml", "--free", "--arg", "lines=2", "--arg", "length_m=120",
                                 "--arg", "rate_hz=50", timeout=200)
        self.assertEqual(result.code, 0, result.stderr)
        self.assertTrue(list(result.out.glob("navigation*.png")))
        with ensonify.Record(result.out / "navigation.mcap") as record:
            t_s, true_m = column(record, "boat/pose", "position_enu_m")
            at_s, estimate_m = column(record, "nav/estimate", "position_enu_m")
            _, covariance_m2 = column(record, "nav/estimate", "position_covariance_enu_m2")
            positions = [message for _, _, message in record.messages("nav/position")]
        settled = (at_s > 30) & (at_s <= t_s[-1])
        error_m = estimate_m - np.stack([np.interp(at_s, t_s, axis) for axis in true_m.T], axis=1)
        sigma_m = np.sqrt(covariance_m2[:, [0, 4, 8]])
        # One run: of what wanders over minutes there are few independent values, so no more than 4 sigma, and not 1/100 of it.
        self.assertLess(np.max(np.abs(error_m / sigma_m)[settled]), 4)
        self.assertGreater(np.median(np.abs(error_m / sigma_m)[settled]), 0.05)
        self.assertLess(np.max(sigma_m[settled]), 0.1)  # RTK

        # The launch floats on the tide: 4.9 m + 2.7 cos(M2 t - 90 degrees) + cos(S2 t - 120 degrees), less settlement.
        hours = positions[-1].stamp_ns / 3.6e12
        tide_m = 4.9 + 2.7 * np.cos(np.radians(28.984104 * hours - 90)) + np.cos(np.radians(30.0 * hours - 120))
        up_m = np.mean([p.position_enu_m[2] for p in positions[-300:]])
        self.assertAlmostEqual(up_m, tide_m - 0.06, delta=0.04)  # a minute of waves, averaged; RTK
        for position in positions[::50]:  # GGA: height above the geoid, and the undulation
            self.assertAlmostEqual(position.height_above_geoid_m, position.position_enu_m[2] - 4.6, places=6)
            self.assertAlmostEqual(position.geoid_above_ellipsoid_m, 50.1, places=6)


STEERED = """
ensonify: launch/1
args: {{ seed: 1 }}
scenario: {source}/scenarios/patch_test/scenario.yaml
set:
  seed: $(seed)
  mission.steps: [{{ line: [[-100, 0], [0, 0]] }}, {{ line: [[0, 30], [-100, 30]] }}, {{ line: [[-100, 0], [0, 0]] }}]
clock: {{ rate: free }}
processes:
  boat: {{ run: vehicle }}
  nav:
    run: navigation
    config:
      imu: {{ grade: fog, position_m: [1, 0, 0.3] }}
      gnss: {{ grade: rtk, position_m: [-1, 0, -3] }}
      heading: {{ grade: satellite, position_m: [-1, 0, -3] }}
  pilot: {{ run: autopilot }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: [boat/pose, nav/estimate] }} }}
expect:
  - {{ name: all lines are surveyed, eventually: {{ topic: pilot/mission, where: {{ field: state, equals: done }}, within_s: 300 }} }}
"""


class Steered(SystemTest):
    def test_estimates_of_a_steered_boat_err_as_they_say(self):
        """An autopilot steers in jerks, ten a second, and the inertial unit sits a metre ahead: what vehicle, filter or estimate get
        wrong of that is the same in all runs. A boat that turns at once, not by turn_acceleration_dps2, gives rotation's NEES as
        18; the turn rate of half a step ago makes velocity's 8 in turns."""
        runs = 8
        nees = np.array([self.nees(seed) for seed in range(1, runs + 1)])[:, 60:160]
        # Chi-square with 24 degrees of freedom over 8: 0.7 to 7.6 but for one in 10,000, each second; the mean of 100 s, of
        # which few are independent of each other, 0.9 to 6.7 but for one in 1000.
        self.assertEqual(nees.shape, (runs, 100, 3))
        each = nees.mean(axis=0)
        self.assertGreater(np.min(each), 0.7)
        self.assertLess(np.max(each), 7.6)
        for name, mean in zip(("position", "velocity", "rotation"), each.mean(axis=0)):
            with self.subTest(of=name):
                self.assertGreater(mean, 0.9)
                self.assertLess(mean, 6.7)

    def nees(self, seed):
        """Of position, velocity and rotation, three degrees of freedom each, every second."""
        result = self.run_launch(STEERED.format(source=SOURCE), "--in-process", "--arg", f"seed={seed}", out=f"run{seed}", timeout=100)
        self.assertEqual(result.code, 0, result.stderr)
        with ensonify.Record(result.out / "run.mcap") as record:
            poses, estimates = ({m.stamp_ns: m for _, _, m in record.messages(topic) if m.stamp_ns % 1_000_000_000 == 0}
                                for topic in ("boat/pose", "nav/estimate"))
        rows = []
        for stamp_ns in sorted(poses.keys() & estimates.keys()):
            true, found = poses[stamp_ns], estimates[stamp_ns]
            (w, *v), (a, *b) = true.enu_from_body, found.enu_from_body
            v, b = np.array(v), np.array(b)
            turn = 2 * np.sign(a * w + b @ v) * (w * b - a * v - np.cross(b, v))  # of found after true taken back: small
            errors = ((np.subtract(found.position_enu_m, true.position_enu_m), found.position_covariance_enu_m2),
                      (np.subtract(found.velocity_enu_mps, true.velocity_enu_mps), found.velocity_covariance_enu_m2ps2),
                      (turn, found.rotation_covariance_enu_rad2))
            rows.append([error @ np.linalg.solve(np.reshape(covariance, (3, 3)), error) for error, covariance in errors])
        return rows


class Copied(SystemTest):
    def test_a_program_far_from_its_grades_says_where_it_looked(self):
        program = shutil.copy(BIN / "ensonify-navigation", self.folder)
        words = [program, "--launch", SOURCE / "launch/navigation.yaml", "--name", "nav", "--check"]
        here = {key: value for key, value in os.environ.items() if key != "ENSONIFY_SHARE"}
        alone = subprocess.run(words, env=here, capture_output=True, text=True, timeout=60)
        self.assertEqual(alone.returncode, 2)
        self.assertIn('"tactical" is no grade of this instrument; allowed: a file *.yaml (searched for components/navigation/grades in '
                      f"no folder: ENSONIFY_SHARE is not set, and above {self.folder} stand neither sources nor share/ensonify)", alone.stderr)
        reported = subprocess.run(words, env={**here, "ENSONIFY_SHARE": SOURCE}, capture_output=True, text=True, timeout=60)
        self.assertEqual(reported.returncode, 0, reported.stderr)


class UnderWater(SystemTest):
    def test_a_ship_and_the_water_hold_an_auv_that_sees_no_bottom(self):
        result = self.run_launch(SOURCE / "launch/underwater.yaml", "--free", "--arg", "lines=1", "--arg", "length_m=80",
                                 "--arg", "silent_from_s=30", "--arg", "silent_to_s=60", timeout=200)
        self.assertEqual(result.code, 0, result.stderr)
        with ensonify.Record(result.out / "underwater.mcap") as record:
            t_s, true_m = column(record, "auv/pose", "position_enu_m")
            at_s, estimate_m = column(record, "nav/estimate", "position_enu_m")
            _, covariance_m2 = column(record, "nav/estimate", "position_covariance_enu_m2")
        known = at_s <= t_s[-1]
        error_m = estimate_m - np.stack([np.interp(at_s, t_s, axis) for axis in true_m.T], axis=1)
        sigma_m = np.sqrt(covariance_m2[:, [0, 4, 8]])
        # One run, so no more than that errors are of the size that is stated.
        self.assertLess(np.max(np.abs(error_m / sigma_m)[known & (at_s > 10)]), 4.5)
        level_m = np.hypot(sigma_m[:, 0], sigma_m[:, 1])
        found, silent = (at_s > 25) & (at_s < 30), (at_s > 55) & (at_s < 60)
        self.assertLess(np.max(level_m[found]), 1)
        self.assertGreater(np.mean(level_m[silent]), np.mean(level_m[found]))
        # Half a minute in a current that has been learned for as long: by 0.004 m/s per root second it walks 0.4 m off,
        # and it was known to 0.1 m/s or better.
        self.assertLess(np.max(level_m[silent]), 4)


HYDRODYNAMIC = """
ensonify: launch/1
scenario: tideway.yaml
duration_s: 40
clock: { rate: free }
processes:
  boat: { run: vehicle }
  nav:  { run: navigation, config: { imu: { grade: fog }, gnss: { grade: rtk, position_m: [0, 0, -3] }, depth: { position_m: [0, 0, 0.5] }, motion_sensor: { grade: survey, delayed_heave_s: 0 } } }
  pilot: { run: autopilot }
  recorder: { run: recorder, config: { file: run.mcap, topics: [boat/pose, nav/attitude, nav/depth, nav/estimate] } }
expect:
  - { name: it holds its mission's speed, bounds: { topic: boat/pose, field: velocity_enu_mps.1, min: 1, max: 5, after_s: 20 } }
"""


class Forces(SystemTest):
    def test_a_launch_moved_by_forces_rides_tide_and_waves(self):
        text = (SOURCE / "scenarios/tideway/scenario.yaml").read_text()
        by_forces = text.replace("    acceleration_mps2: 0.3\n", "    acceleration_mps2: 0.3\n    kind: hydrodynamic\n"
                                 f"    dynamics: {SOURCE}/components/vehicle/hydrodynamic/survey_launch.yaml\n")
        self.assertNotEqual(text, by_forces)
        self.write("tideway.yaml", by_forces)
        result = self.run_launch(HYDRODYNAMIC, timeout=200)
        self.assertEqual(result.code, 0, result.stderr)
        with ensonify.Record(result.out / "run.mcap") as record:
            t_s, true_m = column(record, "boat/pose", "position_enu_m")
            _, depth_m = column(record, "nav/depth", "depth_m")
            at_s, heave_m = column(record, "nav/attitude", "heave_m")
        # At the start the tide stands at 4.9 - 0.5 m. Depth of the sensor: 0.5 m and settlement below the level.
        self.assertAlmostEqual(np.mean(true_m[:, 2]), 4.4, delta=0.3)
        self.assertAlmostEqual(np.mean(depth_m), 0.55, delta=0.3)
        # It moves with the sea, by 0.03 m rms in 3.5 s: over 40 s, eleven periods of a band as wide as the jitter, within a third.
        self.assertGreater(np.std(true_m[:, 2]), 0.02)
        self.assertLess(np.std(true_m[:, 2]), 0.06)  # with what the launch settles as she gathers speed
        self.assertLess(np.max(np.abs(heave_m)), 0.3)  # and none of the 4.4 m is heave


TWO_WORLD = """
ensonify: scenario/1
site: { name: Two, latitude_deg: 44, longitude_deg: -63 }
seed: 3
water: { sound_speed_mps: 1500 }
seabed:
  kind: layers
  post_spacing_m: 0.25
  size_m: [100, 100]
  layers: { ground: { plane: { depth_m: 20 } } }
vehicles:
  boat:
    start: { position_m: [0, -10, 0], heading_deg: 0, speed_mps: 2 }
    mountings: { bow: { actual: { position_m: [0, 0, 1] } } }
  auv:
    start: { position_m: [10, -5, -8], heading_deg: 0, speed_mps: 1 }
    mountings: { sounder: { actual: { position_m: [0, 0, 0.2] } } }
mission: { speed_mps: 1, runlines: [{ from_m: [0, -10], to_m: [0, 40] }] }   # nobody flies it
"""

TWO = """
ensonify: launch/1
scenario: two.yaml
duration_s: 4
clock: { rate: free }
processes:
  boat:     { run: vehicle }
  auv:      { run: vehicle }
  boat_nav: { run: navigation, config: { vehicle: boat, usbl: { grade: survey, position_m: [0, 0, 1], rate_hz: 2 } } }
  auv_nav:  { run: navigation, config: { vehicle: auv, depth: { } } }
  pager:    { run: terrain_pager }
  bow:      { run: multibeam, config: { ping_rate_hz: 2, amplitude_every: 1000, quality: 0.1 } }
  sounder:  { run: echosounder, config: { ping_rate_hz: 2, range_m: 40 } }
  recorder: { run: recorder, config: { file: run.mcap, topics: [auv/pose, boat_nav/usbl, auv_nav/depth, bow/soundings, sounder/bottom] } }
wiring:
  boat_nav.pose: boat/pose
  boat_nav.target: auv/pose
  auv_nav.pose: auv/pose
  pager.pose: boat/pose
  bow.pose: boat/pose
  bow.estimate: boat_nav/estimate
  bow.attitude: boat_nav/attitude
  bow.sound_speed: boat_nav/sound_speed
  sounder.pose: auv/pose
  sounder.estimate: auv_nav/estimate
"""


class TwoVehicles(SystemTest):
    def test_each_carries_a_head_of_its_own_and_one_finds_the_other(self):
        self.write("two.yaml", TWO_WORLD)
        result = self.run_launch(TWO, timeout=200)
        self.assertEqual(result.code, 0, result.stderr)
        with ensonify.Record(result.out / "run.mcap") as record:
            t_s, auv_m = column(record, "auv/pose", "position_enu_m")
            soundings = [message for _, _, message in record.messages("bow/soundings")]
            _, altitude_m = column(record, "sounder/bottom", "altitude_m")
            _, depth_m = column(record, "auv_nav/depth", "depth_m")
            fixes = [message for _, _, message in record.messages("boat_nav/usbl")]
        self.assertGreater(len(soundings), 4)
        for ping in soundings:
            up_m = np.asarray(ping.position_enu_m)[np.asarray(ping.valid, bool), 2]
            self.assertAlmostEqual(np.median(up_m), -20, delta=0.3)  # heights of fixes err by 0.05 m
        self.assertAlmostEqual(np.median(altitude_m), 20 - 8.2, delta=0.1)
        self.assertAlmostEqual(np.mean(depth_m), 8, delta=0.01)
        received = [fix for fix in fixes if fix.valid]
        self.assertGreater(len(received), 4)
        for fix in received:  # 15 m away: centimetres by range and angle, and the boat's own estimate
            there_m = [np.interp(fix.stamp_ns * 1e-9, t_s, axis) for axis in auv_m.T]
            self.assertLess(np.linalg.norm(np.asarray(fix.position_enu_m) - there_m), 0.6)


if __name__ == "__main__":
    unittest.main(verbosity=2)
