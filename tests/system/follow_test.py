"""A vehicle goes along a recorded track (docs/manual/follow.md): generated and genuine files, the same bytes at any rate, and what is refused."""
import csv
import math
import subprocess
import unittest

import ensonify
import numpy as np
from support import BIN, SHARED, SOURCE, SystemTest

ROUND = SOURCE / "scenarios/tracks/harbour_round.csv"
LOG = SHARED / "data/nav/nbp1406_seapath330.nmea"
GENUINE = [LOG, SHARED / "data/records/em710_g_7041.all", SHARED / "data/records/em2040p_eg.kmall", SHARED / "data/sonar/scotsman-iver2.xtf"]

LAUNCH = """
ensonify: launch/1
scenario: {source}/scenarios/tracks/scenario.yaml
set:
  site: {{ latitude_deg: {site[0]}, longitude_deg: {site[1]} }}
  vehicles.boat.fastest_mps: 20
  mission.follow: {{ file: {file}{keys} }}
clock: {{ rate: {rate} }}
processes:
  boat: {{ run: vehicle }}
  nav: {{ run: navigation }}
{more}  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: [boat/pose, nav/estimate] }} }}
"""


def launch(file, keys="", site=(54.4, 10.3), rate="free", more=""):
    return LAUNCH.format(source=SOURCE, file=file, keys=keys, site=site, rate=rate, more=more)


def poses(out):
    with ensonify.Record(out / "run.mcap") as record:
        found = [message for _, _, message in record.messages("boat/pose")]
    return np.array([pose.stamp_ns for pose in found]) * 1e-9, found


def angles(pose):
    """Roll and pitch in degrees of a pose, from the body's axes in the world: port up, bow up."""
    w, x, y, z = pose.enu_from_body
    forward_up = 2 * (x * z - w * y)
    starboard_up = 2 * (y * z + w * x)
    down_up = 1 - 2 * (x * x + y * y)
    return math.degrees(math.atan2(-starboard_up, -down_up)), math.degrees(math.asin(forward_up))


def degrees(text, half):
    value = float(text)
    return (1 if half in "NE" else -1) * (math.floor(value / 100) + value % 100 / 60)


def enu_m(place, origin):
    """East and north of a place some kilometres from the origin, on its transverse Mercator map [Snyder1987]: within centimetres."""
    a, e2 = 6378137.0, 0.00669437999014
    latitude, middle = math.radians(place[0]), math.radians((place[0] + origin[0]) / 2)
    away = math.radians(place[1] - origin[1])
    of_meridian = a * (1 - e2) / (1 - e2 * math.sin(middle) ** 2) ** 1.5
    across = a / math.sqrt(1 - e2 * math.sin(latitude) ** 2)
    return (across * math.cos(latitude) * away,
            of_meridian * math.radians(place[0] - origin[0]) + across * math.sin(latitude) * math.cos(latitude) * away ** 2 / 2)


class Follow(SystemTest):
    def ran(self, text, out):
        result = self.run_launch(text, out=out)
        self.assertEqual(result.code, 0, result.stderr)
        return result

    def refused(self, text, *words):
        """By `check` and by `run`, before time starts."""
        file = self.write("refused.yaml", text)
        checked = self.tool("check", file)
        self.assertEqual(checked.returncode, 2, checked.stdout + checked.stderr)
        for word in words:
            self.assertIn(word, checked.stderr)
        run = self.run_launch(file, out="refused")
        self.assertEqual(run.code, 2, run.stderr)
        self.assertIn(words[0], run.stderr)

    def test_the_shipped_track_is_followed_at_its_times(self):
        result = self.ran(launch(ROUND), "out")
        t_s, found = poses(result.out)
        self.assertGreaterEqual(t_s[-1], 120.0)  # the run ends with the track, and what was granted is run
        self.assertLess(t_s[-1], 121.5)
        self.assertEqual(max(map(abs, found[-1].velocity_enu_mps)), 0.0)
        rows = list(csv.DictReader(line for line in ROUND.read_text().splitlines() if not line.startswith("#")))
        of_roll = []
        for row in rows:
            pose = found[round(float(row["time_s"]) * 100)]
            roll, pitch = angles(pose)
            self.assertAlmostEqual(roll, float(row["roll_deg"]), delta=1e-6)
            self.assertAlmostEqual(pitch, float(row["pitch_deg"]), delta=1e-6)
            self.assertAlmostEqual(pose.position_enu_m[2], float(row["heave_m"]), delta=1e-6)
            east, north = enu_m((float(row["latitude_deg"]), float(row["longitude_deg"])), (54.4, 10.3))
            self.assertLess(math.hypot(pose.position_enu_m[0] - east, pose.position_enu_m[1] - north), 0.002)
            of_roll.append(roll)
        self.assertGreater(np.std(of_roll), 2.0)
        found = found[:12001]
        place = np.array([pose.position_enu_m for pose in found])
        velocity = np.array([pose.velocity_enu_mps for pose in found])
        self.assertLess(np.abs(place[1:-1] - place[:-2] - 0.01 * velocity[:-2]).max(), 0.02)

    def test_the_same_bytes_at_any_rate(self):
        free = self.ran(launch(ROUND, ", to_s: 20"), "free")
        paced = self.ran(launch(ROUND, ", to_s: 20", rate=10), "paced")
        done = subprocess.run([BIN / "ensonify-compare", str(free.out / "run.mcap"), str(paced.out / "run.mcap")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"^same: [1-9]\d+ messages on 2 topics")

    def test_a_record_is_followed_again_from_another_origin(self):
        first = self.ran(launch(ROUND, ", to_s: 20"), "first")
        again = self.ran(launch(first.out / "run.mcap", ", to_s: 20", site=(54.41, 10.32)), "again")
        (_, before), (_, after) = poses(first.out), poses(again.out)
        self.assertEqual(len(before), len(after))
        shift = np.array(after[0].position_enu_m) - before[0].position_enu_m
        self.assertGreater(np.hypot(*shift[:2]), 1500)
        for one, other in zip(before[::50], after[::50]):
            # Grids of origins 1.3 km apart are turned by 0.016 degrees: 20 mm over 60 m.
            self.assertLess(np.abs(np.array(other.position_enu_m) - one.position_enu_m - shift).max(), 0.05)
            self.assertAlmostEqual(angles(one)[0], angles(other)[0], delta=1e-4)

    def test_modelled_attitude_keeps_the_places(self):
        recorded = self.ran(launch(ROUND, ", to_s: 20"), "recorded")
        modelled = self.ran(launch(ROUND, ", to_s: 20, attitude: modelled"), "modelled")
        (_, one), (_, other) = poses(recorded.out), poses(modelled.out)
        way = [np.array([pose.position_enu_m[:2] for pose in found]) for found in (one, other)]
        self.assertLess(np.abs(way[0] - way[1]).max(), 1e-9)
        rolls = [np.array([angles(pose)[0] for pose in found]) for found in (one, other)]
        self.assertGreater(np.abs(rolls[0] - rolls[1]).max(), 1.0)

    @unittest.skipUnless(LOG.exists(), f"{LOG} is not there: the log that is followed")
    def test_a_vessels_log_is_followed_as_it_was_recorded(self):
        result = self.ran(launch(LOG, ", to_s: 300", site=(-22.0, -17.94)), "out")
        t_s, found = poses(result.out)
        fixes, motions, began = [], [], None
        for line in LOG.read_text().splitlines():
            stamp, text = line.split(" ", 1)
            at = 60 * int(stamp[14:16]) + float(stamp[17:26])
            fields = text[1:].split("*")[0].split(",")
            if fields[0] == "INGGA":
                began = at if began is None else began
                gga = float(fields[1][2:4]) * 60 + float(fields[1][4:])
                fixes.append((gga, (degrees(*fields[2:4]), degrees(*fields[4:6])), at))
            elif fields[:2] == ["PSXN", "23"] and fixes:
                motions.append((fixes[-1][0] - fixes[0][0] + at - fixes[-1][2], *map(float, fields[2:6])))
        way = np.array([pose.position_enu_m for pose in found])
        off_m = []
        for gga, place, _ in fixes:
            at = gga - fixes[0][0]
            if at <= 300:
                east, north = enu_m(place, (-22.0, -17.94))
                off_m.append(math.hypot(np.interp(at, t_s, way[:, 0]) - east, np.interp(at, t_s, way[:, 1]) - north))
        self.assertGreater(len(off_m), 290)
        self.assertLess(max(off_m), 0.05)
        within = [motion for motion in motions if motion[0] < 300]
        of_log = np.array(within)
        of_run = np.array([[*angles(found[round(at * 100)]), found[round(at * 100)].position_enu_m[2]] for at, *_ in within])
        for column, logged in ((0, 1), (1, 2), (2, 4)):
            self.assertAlmostEqual(np.std(of_run[:, column]) / np.std(of_log[:, logged]), 1.0, delta=0.01)

    def test_genuine_files_of_every_format(self):
        there = [file for file in GENUINE if file.exists()]
        if not there:
            self.skipTest(f"none of {', '.join(map(str, GENUINE))} is there")
        for file in there:
            with self.subTest(file.name):
                far = self.tool("check", self.write("far.yaml", launch(file)))
                self.assertEqual(far.returncode, 2, far.stdout)
                latitude, longitude = far.stderr.split("latitude_deg: ")[1].split(" }")[0].split(", longitude_deg: ")
                checked = self.tool("check", self.write("near.yaml", launch(file, site=(latitude, longitude))))
                self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_what_is_refused(self):
        def table(rows, name="track.csv", names="time_s,east_m,north_m,depth_m"):
            return self.write(name, names + "\n" + "\n".join(rows) + "\n")
        line = [f"{t},0,{2 * t},1" for t in range(0, 60)]
        self.refused(launch(table(line[:20] + line[40:])), "has no place from 19.000 to 40.000 s; allowed: 10 s", "refused.yaml:7:")
        self.refused(launch(table(line[:9] + line[7:])), ":11: time runs back by 1.000 s")
        self.refused(launch(table([])), "has a single place; allowed: a track of two at least")
        self.refused(launch(self.write("empty.nmea", "")), "is empty; allowed: a file with a track")
        self.refused(launch(table(line, names="time_s,east_m,nort_m,depth_m")), "did you mean north_m?")
        self.refused(launch(ROUND, site=(10, 20)), "allowed: site: { latitude_deg: 54.3987, longitude_deg: 10.3000 }")
        self.refused(launch(ROUND, more="  pilot: { run: autopilot }\n"), "there is nothing to steer; allowed: a launch without this process")
        pager = "  pager: { run: terrain_pager }\n"
        self.refused(launch(table([f"{t},0,{2 * t},{20 + t}" for t in range(0, 60)]), more=pager), "mission.follow: ")
        self.refused(launch(table([f"{t},{4000 + 2 * t},0,1" for t in range(-10, 60)]), more=pager), "mission.follow: ")


if __name__ == "__main__":
    unittest.main(verbosity=2)
