"""`ensonify feed doctor`: what comes by UDP and in a genuine log is named, and nav_feed takes the source that it prints."""
import socket
import subprocess
import threading
import time
import unittest

from nmea import free_port, sentence
from support import BIN, SHARED, SOURCE, SystemTest

LOG = SHARED / "data/nav/nbp1406_seapath330.nmea"
COMPASS = SHARED / "data/records/hemisphere.nmea"

LAUNCH = """
ensonify: launch/1
scenario: {source}/scenarios/tideway/scenario.yaml
duration_s: 10
processes:
  boat:
    run: nav_feed
    config:
{sources}
"""


class FeedDoctor(SystemTest):
    def doctor(self, *words):
        return subprocess.run([BIN / "ensonify", "feed", "doctor", *map(str, words)], capture_output=True, text=True, timeout=60)

    def check_source(self, report):
        """nav_feed takes what the report prints."""
        sources = report[report.index("sources:"):]
        launch = LAUNCH.format(source=SOURCE, sources="\n".join("      " + line for line in sources.splitlines()))
        checked = self.tool("check", self.write("found.yaml", launch))
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_a_feed_by_udp(self):
        port, stop = free_port(), threading.Event()

        def send():
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
                while not stop.wait(0.1):
                    gps = time.gmtime(time.time() + 18)
                    clock = f"{gps.tm_hour:02d}{gps.tm_min:02d}{gps.tm_sec:02d}"
                    out.sendto(sentence(f"GPGGA,{clock}.00,4836.0000,N,00354.0000,W,4,12,0.7,3.0,M,50.0,M,,").encode(), ("127.0.0.1", port))
                    out.sendto(sentence("HEHDT,12.0,T").replace("12.0", "13.0").encode(), ("127.0.0.1", port))
                    out.sendto(sentence("HEHDT,12.0,T").encode(), ("127.0.0.1", port))

        sender = threading.Thread(target=send)
        sender.start()
        done = self.doctor(port, "--seconds", 3)
        stop.set()
        sender.join()
        self.assertEqual(done.returncode, 1, done.stderr)  # there is something to correct
        self.assertRegex(done.stdout, r"checksums: \d+ of \d+ sentences are bad")
        self.assertIn("time scale: GPS: +1", done.stdout)
        self.assertIn(f"ship: {{ udp: {port}, motion: false, time_scale: gps }}", done.stdout)
        self.check_source(done.stdout)

    def test_silence_and_wrong_words(self):
        silent = self.doctor(free_port(), "--seconds", 0.3)
        self.assertEqual(silent.returncode, 1)
        self.assertIn("nothing has come: is the sender alive", silent.stdout)
        self.assertEqual(self.doctor().returncode, 2)
        self.assertEqual(self.doctor("--file", self.folder / "none.nmea").returncode, 2)

    @unittest.skipUnless(LOG.exists() and COMPASS.exists(), f"{LOG} or {COMPASS} is not there: logs that are read")
    def test_genuine_logs(self):
        ship = self.doctor("--file", LOG)
        self.assertIn("sign of roll: right", ship.stdout)
        self.assertRegex(ship.stdout, r"sign of heave: right.*slope 1\.00")
        self.check_source(ship.stdout)
        compass = self.doctor("--file", COMPASS)
        self.assertRegex(compass.stdout, r"fixes of quality 0: \d+ \(no fix\)")
        self.check_source(compass.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
