"""Several sources drive a boat at once; a log of one, and a record of all, drive everything to the same bytes again."""
import math
import socket
import subprocess
import threading
import time
import unittest

import ensonify
import numpy as np
from nmea import free_port
from support import BIN, SHARED, SOURCE, SystemTest

LOG = SHARED / "data/nav/nbp1406_seapath330.nmea"
SECONDS = 12

LAUNCH = """
ensonify: launch/1
scenario: {source}/scenarios/tideway/scenario.yaml
set: {{ site.latitude_deg: -22.0, site.longitude_deg: -17.94 }}
clock: {{ rate: {rate} }}
duration_s: {seconds}
processes:
{feed}
  boat: {{ run: nav_feed, config: {{ {config} }} }}
  nav:
    run: navigation
    config: {{ gnss: {{ grade: rtk }}, imu: {{ grade: tactical }}, motion_sensor: {{ grade: survey }}, heading: {{ grade: satellite }} }}
  recorder: {{ run: recorder, config: {{ file: feed.mcap, topics: [{topics}] }} }}
"""
DRIVEN = "boat/pose, boat/fix, nav/estimate, nav/attitude"


def launch(config, rate="free", seconds=SECONDS, feed="", topics=DRIVEN):
    return LAUNCH.format(source=SOURCE, rate=rate, seconds=seconds, feed=feed, config=config, topics=topics)


def logged_lines(seconds):
    """The log's sentences and when each was logged, seconds from the first one's."""
    lines = [line.split(" ", 1) for line in LOG.read_text().splitlines()]
    stamps = [60 * int(stamp[14:16]) + float(stamp[17:26]) for stamp, _ in lines]
    return [(at - stamps[0], text) for at, (_, text) in zip(stamps, lines) if at - stamps[0] < seconds]


@unittest.skipUnless(LOG.exists(), f"{LOG} is not there: the log that is sent")
class NavFeedSources(SystemTest):
    def compare(self, one, other):
        done = subprocess.run([BIN / "ensonify-compare", "--topic", "boat/pose", "--topic", "nav/estimate", "--topic", "nav/attitude",
                               str(one), str(other)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"^same: [1-9]\d+ messages on 3 topics")

    def test_a_log_drives_the_boat_the_same_way_at_any_rate(self):
        config = f"sources: {{ ship: {{ file: {LOG} }} }}"
        free = self.run_launch(launch(config, seconds=60), out="free")
        self.assertEqual(free.code, 0, free.stderr)
        fast = self.run_launch(launch(config, rate=10, seconds=60), out="fast")
        self.assertEqual(fast.code, 0, fast.stderr)
        self.compare(free.out / "feed.mcap", fast.out / "feed.mcap")
        with ensonify.Record(free.out / "feed.mcap") as record:
            poses = [message for _, _, message in record.messages("boat/pose")]
            fixes = [message for _, _, message in record.messages("boat/fix")]
        self.assertGreater(len(fixes), 50)
        t_s = np.array([pose.stamp_ns for pose in poses]) * 1e-9
        way_m = np.array([pose.position_enu_m for pose in poses])
        off_m = [math.hypot(*(np.interp(fix.stamp_ns * 1e-9, t_s, way_m[:, axis]) - fix.position_enu_m[axis] for axis in (0, 1)))
                 for fix in fixes if t_s[0] <= fix.stamp_ns * 1e-9 <= t_s[-1]]
        self.assertGreater(len(off_m), 45)
        self.assertLess(max(off_m), 0.1)

    def test_a_record_of_two_sources_drives_all_to_the_same_bytes(self):
        ship, gyro = free_port(), free_port()
        sources = f"sources: {{ ship: {{ tcp_server: {ship}, heading: false }}, gyro: {{ udp: {gyro}, place: false, motion: false }} }}"
        run = self.start_launch(launch(sources, rate=1, topics=DRIVEN + ", boat/data, boat/health"), out="live")
        self.wait_for_go("live")
        stop = threading.Event()

        def send():
            began = time.monotonic()
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as datagrams:
                connection = None
                for at, text in logged_lines(SECONDS + 6):
                    if stop.wait(max(0.0, began + at - time.monotonic())):
                        break
                    if "HDT" in text:
                        datagrams.sendto(text.encode(), ("127.0.0.1", gyro))
                        continue
                    for _ in range(50):  # the boat's port opens with its first event
                        try:
                            connection = connection or socket.create_connection(("127.0.0.1", ship), timeout=2)
                            break
                        except ConnectionRefusedError:
                            stop.wait(0.1)
                    connection.sendall(text.encode() + b"\r\n")
                if connection:
                    connection.close()

        sender = threading.Thread(target=send)
        sender.start()
        _, error = run.communicate(timeout=200)
        stop.set()
        sender.join()
        self.assertEqual(run.returncode, 0, error)
        live = self.folder / "live/feed.mcap"
        with ensonify.Record(live) as record:
            health = [message for _, _, message in record.messages("boat/health")]
            taken = {piece.source for _, _, data in record.messages("boat/data") for piece in data.pieces}
        counts = {counter.name: counter.count for counter in health[-1].counters}
        self.assertEqual(taken, {"ship", "gyro"})
        self.assertGreater(counts["fixes_taken"], 5)
        self.assertGreater(counts["headings_taken"], 5)
        self.assertGreater(counts["motions_taken"], 5)

        feed = f"  record: {{ run: replay, config: {{ file: {live}, topics: [boat/data] }} }}"
        again = self.run_launch(launch(sources + ", recorded: true", feed=feed), out="again")
        self.assertEqual(again.code, 0, again.stderr)
        self.compare(live, again.out / "feed.mcap")


if __name__ == "__main__":
    unittest.main(verbosity=2)
