"""launch/nav_feed.yaml: a vessel's log, sent to the loopback interface as it was recorded, drives the boat."""
import math
import re
import socket
import threading
import time
import unittest

import ensonify
import numpy as np
from nmea import free_port, sentence
from support import SHARED, SOURCE, SystemTest

LOG = SHARED / "data/nav/nbp1406_seapath330.nmea"
SECONDS = 14


def degrees(text, half):
    value = float(text)
    return (1 if half in "NE" else -1) * (math.floor(value / 100) + value % 100 / 60)


def blocks(seconds):
    """Second by second: GGA and HDT as they were logged, and PASHR made of the log's PSXN,23, whose heave counts down."""
    found = []
    for line in LOG.read_text().splitlines():
        logged = line.split(" ", 1)[1]
        fields = logged[1:].split("*")[0].split(",")
        if fields[0] == "INGGA":
            found.append({"time": fields[1], "lat": degrees(*fields[2:4]), "lon": degrees(*fields[4:6]), "text": logged + "\r\n"})
        elif found and fields[0] == "INHDT":
            found[-1].update(heading=float(fields[1]), text=found[-1]["text"] + logged + "\r\n")
        elif found and fields[:2] == ["PSXN", "23"]:
            roll, pitch, heading, heave = map(float, fields[2:6])
            heave = -heave
            body = f"PASHR,{float(found[-1]['time']):010.3f},{heading:.2f},T,{roll:+.2f},{pitch:+.2f},{heave:+.2f},0.05,0.05,0.1,1,1"
            found[-1].update(roll=roll, pitch=pitch, heave=heave, text=found[-1]["text"] + sentence(body))
    return found[:seconds]


def three_hours_ahead(block):
    fields = block["text"].splitlines()[0][1:].split("*")[0].split(",")
    return sentence(",".join([fields[0], f"{float(fields[1]) + 30000:09.2f}", *fields[2:]]))


@unittest.skipUnless(LOG.exists(), f"{LOG} is not there: the log that is sent")
class NavFeed(SystemTest):
    def test_a_vessels_log_drives_the_boat(self):
        port, sent = free_port(), blocks(SECONDS + 6)
        run = self.start_launch(SOURCE / "launch/nav_feed.yaml", "--arg", f"port={port}", "--arg", "latitude_deg=-22.0",
                                "--arg", "longitude_deg=-17.94", "--arg", f"seconds={SECONDS}")
        self.wait_for_go()
        stop = threading.Event()

        def send():
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
                began = time.monotonic()
                for i, block in enumerate(sent):
                    out.sendto(block["text"].encode(), ("127.0.0.1", port))
                    out.sendto(b"noise that is no sentence\r\n", ("127.0.0.1", port))
                    if i % 5 == 4:  # a fix of another time: reported, and nothing comes of it
                        out.sendto(three_hours_ahead(block).encode(), ("127.0.0.1", port))
                    if stop.wait(max(0.0, began + i + 1 - time.monotonic())):
                        return

        sender = threading.Thread(target=send)
        sender.start()
        _, error = run.communicate(timeout=200)
        stop.set()
        sender.join()
        self.assertEqual(run.returncode, 0, error)

        with ensonify.Record(self.folder / "out/nav_feed.mcap") as record:
            poses = [message for _, _, message in record.messages("boat/pose")]
            fixes = [message for _, _, message in record.messages("boat/fix")]
            health = [message for _, _, message in record.messages("boat/health")]
        self.assertGreater(len(fixes), 5)
        counts = {counter.name: counter.count for counter in health[-1].counters}
        self.assertGreater(counts["sentences_malformed"], 5)  # reported, and nothing came of it
        self.assertNotIn("sentences_with_bad_checksum", counts)
        self.assertGreater(counts["fixes_at_another_time"], 0)
        self.assertNotIn("time_jumps", counts)
        self.assertTrue(any("time jumped ahead by 3 h 0 min" in message.message for message in health), health)

        # Where the log is at each fix, by the sphere about the site: 1 m in 2 km north and 6 km east of it is enough to
        # give the right fix; along the way the boat must reach it to the millimetre.
        t_s = np.array([pose.stamp_ns for pose in poses]) * 1e-9
        way_m = np.array([pose.position_enu_m for pose in poses])
        matched = 0
        for fix in fixes:
            logged = min(sent, key=lambda block: abs(block["lat"] - fix.latitude_deg) + abs(block["lon"] - fix.longitude_deg))
            self.assertAlmostEqual(logged["lat"], fix.latitude_deg, places=9)
            self.assertAlmostEqual(logged["lon"], fix.longitude_deg, places=9)
            radius_m = 6378137.0 / math.sqrt(1 - 0.00669438 * math.sin(math.radians(22)) ** 2)
            east_m = math.radians(logged["lon"] + 17.94) * radius_m * math.cos(math.radians(logged["lat"]))
            self.assertAlmostEqual(fix.position_enu_m[0], east_m, delta=1.0)
            at_s = fix.stamp_ns * 1e-9
            if not t_s[0] <= at_s <= t_s[-1] - 0.02:
                continue
            matched += 1
            here_m = [np.interp(at_s, t_s, axis) for axis in way_m.T]
            self.assertLess(np.hypot(here_m[0] - fix.position_enu_m[0], here_m[1] - fix.position_enu_m[1]), 1e-3)
            pose = poses[int(np.argmin(np.abs(t_s - at_s)))]
            w, x, y, z = pose.enu_from_body
            ahead = (1 - 2 * (y * y + z * z), 2 * (x * y + w * z))  # the body's forward axis, east and north
            heading = math.degrees(math.atan2(*ahead)) % 360
            self.assertAlmostEqual((heading - logged["heading"] + 180) % 360 - 180, 0, delta=0.05)
            down_stern = math.degrees(math.asin(2 * (x * z - w * y)))  # up component of forward: pitch
            self.assertAlmostEqual(down_stern, logged["pitch"], delta=0.05)
        self.assertGreater(matched, 4)
        speeds = np.hypot(*np.array([pose.velocity_enu_mps for pose in poses]).T[:2])
        self.assertTrue(np.all(np.abs(speeds - 9.1 * 0.5144) < 0.5), speeds)  # VTG of the log: 9.1 knots

    def test_a_port_that_is_taken_is_reported(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
            taken.bind(("127.0.0.1", 0))
            result = self.run_launch(SOURCE / "launch/nav_feed.yaml", "--arg", f"port={taken.getsockname()[1]}")
        self.assertEqual(result.code, 2, result.stderr)
        self.assertRegex(result.stderr + result.log("boat"), re.compile("cannot listen to UDP port .* allowed: a port that is free"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
