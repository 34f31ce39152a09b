"""The commands and the code of docs/manual/ship-survey.md: a log drives the boat by UDP, and what lies below is surveyed and gridded."""
import math
import os
import re
import subprocess
import unittest

import ensonify
import numpy as np
from nmea import free_port
from osgeo import gdal
from support import BIN, SHARED, SOURCE, SystemTest

PAGE = SOURCE / "docs/manual/ship-survey.md"
GENUINE = SHARED / "data/nav/nbp1406_seapath330.nmea"
LOG = "out/log/instruments.nmea"
HEAD_AHEAD_M = 1.5  # of the reference point: scenarios/tracks/scenario.yaml


def degrees(text, half):
    value = float(text)
    return (1 if half in "NE" else -1) * (math.floor(value / 100) + value % 100 / 60)


def fixes(log):
    """Latitude and longitude of each GGA."""
    found = [re.search(r"GGA,[^,]*,([^,]+),([NS]),([^,]+),([EW])", line) for line in log.read_text().splitlines()]
    return np.array([(degrees(*one.groups()[:2]), degrees(*one.groups()[2:])) for one in found if one])


def metres(places, origin):
    """East and north of places within some kilometres of the origin, by the ellipsoid's radii there: within decimetres at 1 km."""
    a, e2 = 6378137.0, 0.00669437999014
    w2 = 1 - e2 * math.sin(math.radians(origin[0])) ** 2
    north = a * (1 - e2) / w2 ** 1.5
    east = a / math.sqrt(w2) * math.cos(math.radians(origin[0]))
    return np.radians(np.asarray(places) - origin)[:, ::-1] * (east, north)


class ShipSurvey(SystemTest):
    def setUp(self):
        super().setUp()
        page = PAGE.read_text()
        self.port = str(free_port())
        commands = [line for block in re.findall(r"```sh\n(.*?)```", page, re.S) for line in block.splitlines()]
        (self.make, self.doctor, self.survey, self.send, self.grid, self.plot) = commands
        (code,) = re.findall(r"```python\n(.*?)```", page, re.S)
        self.assertIn("10110", code)
        self.write("send.py", code.replace("10110", self.port))
        self.environment["PATH"] = f"{BIN}:{os.environ['PATH']}"

    def words(self, command):
        """The command on this tree's launch files and a port of the test's own."""
        port = f" --arg port={self.port}" if "launch/" in command else ""
        return ["bash", "-c", "exec " + command.replace("launch/", f"{SOURCE}/launch/") + port]

    def do(self, command):
        done = subprocess.run(self.words(command), cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def surveyed(self, log, site, *more):
        """Run and sender of the page, with this log, the site's latitude and longitude and more arguments; then grid and picture."""
        survey = re.sub(r"latitude_deg=\S+ --arg longitude_deg=\S+", "latitude_deg={:.4f} --arg longitude_deg={:.4f}".format(*site), self.survey)
        survey = " ".join([survey, *more])
        run = subprocess.Popen(self.words(survey), cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.wait_for_go("out/ship")
        sender = subprocess.Popen(self.words(self.send.replace(LOG, str(log))), cwd=self.folder, env=self.environment)
        try:
            _, error = run.communicate(timeout=60)
        finally:
            sender.terminate()
            sender.wait()
        self.assertEqual(run.returncode, 0, error)
        self.assertRegex(self.do(self.grid), r"[1-9]\d* soundings in [1-9]\d* cells")
        self.do(self.plot)
        self.assertGreater((self.folder / "out/ship/survey.png").stat().st_size, 20_000)
        self.expect_below_the_track(fixes(log))

    def expect_below_the_track(self, logged):
        with ensonify.Record(self.folder / "out/ship/ship.mcap") as record:
            taken = [message for _, _, message in record.messages("boat/fix")]
            pings = [message for _, _, message in record.messages("bow/soundings")]
        at_s = np.array([ping.stamp_ns for ping in pings]) * 1e-9
        self.assertLess(np.diff(at_s).max(), 0.5)  # the head never waits: it is under the water all the time
        taken = [fix for fix in taken if at_s[0] < fix.stamp_ns * 1e-9 < at_s[-1]]
        self.assertGreater(len(taken), 12)
        fixed = np.array([(fix.latitude_deg, fix.longitude_deg) for fix in taken])
        for place in fixed:
            self.assertLess(np.abs(logged - place).max(axis=1).min(), 1e-8)  # every fix is one of the log's
        # Where the log says that she was, in the world: from the first of these fixes, which is some hundred metres away at most.
        way = metres(fixed, fixed[0]) + taken[0].position_enu_m[:2]
        middle = []
        for fix in taken:
            ping = pings[int(np.argmin(np.abs(at_s - fix.stamp_ns * 1e-9)))]
            places = np.array(ping.position_enu_m).reshape(-1, 3)
            middle.append(places[len(places) // 2, :2])
        apart = np.array(middle) - way
        # The middle beam meets the bottom 19 m below the head, off the reference point by the head's 1.5 m ahead, by 5 degrees of roll
        # (1.7 m), by half a ping of way (0.3 m) and by decimetres of navigation.
        self.assertLess(np.hypot(*apart.T).max(), 4.0)
        # On the average roll and pitch cancel. A second of time wrong would be 4 m along the way.
        course = np.gradient(way, axis=0)
        course /= np.hypot(*course.T)[:, None]
        self.assertAlmostEqual((apart * course).sum(axis=1).mean(), HEAD_AHEAD_M, delta=1.0)
        self.assertAlmostEqual((apart[:, 0] * course[:, 1] - apart[:, 1] * course[:, 0]).mean(), 0.0, delta=1.0)

        grid = gdal.Open(str(self.folder / "out/ship/depth.tif"))
        west, side, _, north, _, _ = grid.GetGeoTransform()
        counts = grid.GetRasterBand(3).ReadAsArray()
        for east, up in way + HEAD_AHEAD_M * course:  # below the head, within a cell: pitch of 1.5 degrees is 0.5 m
            row, column = int((north - up) / side), int((east - west) / side)
            self.assertGreater(np.nan_to_num(counts[row - 1:row + 2, column - 1:column + 2]).max(), 0, f"no cell under {east:.1f}, {up:.1f}")

    def test_the_page_with_the_log_that_it_makes(self):
        self.do(self.make)
        report = self.do(self.doctor)
        for kind in ("GPGGA", "HEHDT", "PASHR"):
            self.assertRegex(report, rf"(?m)^{kind} +\d+ ")
        log = self.folder / LOG
        site = [float(degree) for degree in re.findall(r"itude_deg=(\S+)", self.survey)]
        self.assertLess(np.hypot(*metres(fixes(log)[:1], site)[0]), 100)  # the page's site is the log's place
        self.surveyed(log, site)

    @unittest.skipUnless(GENUINE.exists(), f"{GENUINE} is not there: the genuine log that is sent")
    def test_the_page_with_a_genuine_log(self):
        report = subprocess.run(self.words(self.doctor.replace(LOG, str(GENUINE))), cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=60)
        self.assertIn(report.returncode, (0, 1), report.stderr)  # 1: the doctor has something to correct
        self.assertRegex(report.stdout, r"(?m)^INGGA +\d+ ")
        (deeper,) = re.findall(r"`(--arg head_down_m=\d+)`", PAGE.read_text())
        self.surveyed(GENUINE, fixes(GENUINE)[0], deeper)

    @unittest.skipUnless(GENUINE.exists(), f"{GENUINE} is not there: the genuine log that is played")
    def test_a_head_that_heave_lifts_out_of_the_water_says_so(self):
        latitude, longitude = fixes(GENUINE)[0]
        run = self.run_launch(SOURCE / "launch/ship_survey.yaml", "--free", "--quiet", "--arg", f"latitude_deg={latitude}",
                            "--arg", f"longitude_deg={longitude}", "--arg", "seconds=30", "--set", f"boat.sources={{ ship: {{ file: {GENUINE} }} }}")
        self.assertEqual(run.code, 0, run.stderr)
        with ensonify.Record(run.out / "ship.mcap") as record:
            at_s = [message.stamp_ns * 1e-9 for _, _, message in record.messages("bow/soundings")]
            health = [message for _, _, message in record.messages("bow/health")]
        steps_s = np.diff(at_s)
        self.assertEqual((steps_s > 0.5).sum(), 1)
        begins_s, lasts_s = at_s[int(steps_s.argmax())], steps_s.max()
        log = run.log("bow")
        (begun,) = [float(t) for t, above in re.findall(r"t=(\S+) bow no_ping why=\"the head is (\S+) m above the water\"", log)]
        (ended,) = [(float(t), float(after)) for t, after in re.findall(r"t=(\S+) bow pings_again after_s=(\S+) ", log)][1:]  # the first: she is there
        self.assertAlmostEqual(begun, begins_s + 0.1, delta=0.02)
        self.assertAlmostEqual(ended[0], begins_s + lasts_s, delta=0.02)
        while_it_lasts = [one for one in health if begun - 0.01 < one.stamp_ns * 1e-9 < ended[0] - 0.01]
        self.assertTrue(while_it_lasts)
        for one in while_it_lasts:
            self.assertEqual(one.state, "degraded")
            self.assertRegex(one.message, r"^the head is 0\.[01]\d m above the water$")


if __name__ == "__main__":
    unittest.main(verbosity=2)
