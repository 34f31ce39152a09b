"""A console at the far end of a link of 1 Mbit/s: a network namespace of its own, whose loopback is shaped. Exit code 77: that cannot be made here."""
import os
import subprocess
import sys
import time
import unittest

from console import ConsoleTest, fan, health, sides, write_record
from viewer import Viewer

INSIDE = "ENSONIFY_SLOW_LINK"
SHAPE = ("ip link set lo mtu 1500 up && tc qdisc add dev lo root tbf rate 1mbit burst 4kb limit 200kb && exec \"$@\"")


class SlowLink(ConsoleTest):
    def test_pictures_shrink_until_they_pass_and_small_messages_wait_for_none(self):
        record = write_record(self.folder / "both.mcap", fan(pings=60, beams=256), sides(pings=60), health((0.0, 1.0, 2.0, 3.0, 4.0)))
        at = self.console(record, "--loop")
        viewer = Viewer(at.view)
        viewer.watch("bow/view", "fish/view", "nav/health", cells=1024)
        began = time.monotonic()
        shown, lines, reports, health_at = [], [], [], []
        while time.monotonic() < began + 40:
            frame = viewer.next(10)
            now = time.monotonic() - began
            if now < 15:  # it finds its widths
                continue
            if frame.topic == "bow/view":
                shown.append(now)
            elif frame.topic == "fish/view":
                lines.append(frame)
            elif frame.type == "console_flow/1":
                reports.append((now, frame.content))
            elif frame.type == "health/1":
                health_at.append(now)
        self.assertGreater(len(shown), 2 * 25 * 0.8)  # two pictures a second
        flow = {topic["topic"]: topic for topic in reports[-1][1]["topics"]}
        self.assertGreater(flow["bow/view"]["halved"], 0)
        ages = sorted(topic["age_s"] for _, report in reports for topic in report["topics"] if topic["topic"] == "bow/view")
        self.assertLess(ages[int(0.95 * len(ages))], 1.0)
        pings = [frame.content["ping"] for frame in lines]
        self.assertEqual(pings, list(range(pings[0], pings[0] + len(pings))))  # every line
        gaps = [b[0] - a[0] for a, b in zip(reports, reports[1:])]
        self.assertLess(max(gaps), 2.0)  # reports once a second, whatever the pictures
        self.assertGreater(len(health_at), 10)
        print(f"{len(shown) / 25:.1f} pictures a second, 95 % at most {ages[int(0.95 * len(ages))]:.2f} s old, {len(lines) / 25:.1f} lines a second, "
              f"halved {flow['bow/view']['halved']} and {flow['fish/view']['halved']} times, link {reports[-1][1]['link_bytes_per_s'] * 8e-6:.2f} Mbit/s")


if __name__ == "__main__":
    if INSIDE in os.environ:
        unittest.main()
    words = ["unshare", "--net", "sh", "-c", SHAPE, "sh"]
    if os.geteuid() != 0 or subprocess.run([*words, "true"], capture_output=True, check=False).returncode:
        print("no network namespace with a shaped loopback can be made here")
        sys.exit(77)
    sys.exit(subprocess.run([*words, sys.executable, __file__, *sys.argv[1:]], env={**os.environ, INSIDE: "1"}, check=False).returncode)
