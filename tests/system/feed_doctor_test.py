"""`ensonify feed doctor`: what comes by UDP, TCP, a serial line and in a genuine log is named; nav_feed takes the source that it prints."""
import contextlib
import json
import os
import pty
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


def ship_feed():
    """A fix and a heading at the time of this machine."""
    now = time.time()
    clock = time.strftime("%H%M%S", time.gmtime(now)) + f".{int(100 * (now % 1)):02d}"
    fix = sentence(f"GPGGA,{clock},4836.0000,N,00354.0000,W,4,12,0.7,3.0,M,50.0,M,,")
    return (fix + sentence("HEHDT,12.0,T")).encode()


@contextlib.contextmanager
def sending(opened, send):
    """Ten times a second, to what `opened` opens; that is tried until it can be had."""
    stop = threading.Event()

    def work():
        while not stop.wait(0.1):
            with contextlib.suppress(OSError), opened() as to:
                while not stop.wait(0.1):
                    send(to, ship_feed())

    sender = threading.Thread(target=work)
    sender.start()
    try:
        yield
    finally:
        stop.set()
        sender.join()


class FeedDoctor(SystemTest):
    def doctor(self, *words):
        return subprocess.run([BIN / "ensonify", "feed", "doctor", *map(str, words)], capture_output=True, text=True, timeout=60)

    def listed(self, *words, code=0):
        """The one JSON object that is printed."""
        done = self.doctor(*words, "--json")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def check_source(self, report):
        """nav_feed takes what the report prints."""
        self.check_sources(report[report.index("sources:"):])

    def check_sources(self, sources):
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

    def check_ship(self, found, source):
        """All that ship_feed sends has come whole, and the source is as it was asked for."""
        self.assertEqual(found["source"], source)
        self.assertEqual((found["format"], found["time_scale"], found["faults"]), ("nmea", "utc", []))
        self.assertEqual([kind["kind"] for kind in found["kinds"]], ["GPGGA", "HEHDT"])
        self.assertEqual(found["fixes_by_quality"], {"4": found["kinds"][0]["count"]})
        self.assertAlmostEqual(found["kinds"][0]["arrivals"]["rate_hz"], 10, delta=3)
        self.check_sources(f"sources:\n  ship: {found['source']}")

    def test_a_sender_that_connects(self):
        port = free_port()
        with sending(lambda: socket.create_connection(("127.0.0.1", port), timeout=2), socket.socket.sendall):
            self.check_ship(self.listed("--tcp-server", port, "--seconds", 2), f"{{ tcp_server: {port}, motion: false }}")

    def test_a_sender_that_is_connected_to(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            server.settimeout(10)
            port = server.getsockname()[1]
            with sending(lambda: server.accept()[0], socket.socket.sendall):
                found = self.listed("--tcp", port, "--seconds", 2)
        self.check_ship(found, f"{{ tcp: {port}, of: 127.0.0.1, motion: false }}")

    def test_a_sender_that_is_not_there_is_named(self):
        port = free_port()
        found = self.listed("--tcp", port, "--seconds", 0.5, code=1)
        self.assertEqual(found["trouble"], f"no connection to 127.0.0.1:{port}")
        self.assertEqual(len(found["faults"]), 1)
        self.assertIsNone(found["source"])

    def test_a_serial_line(self):
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        self.addCleanup(os.close, theirs)
        line = os.ttyname(theirs)
        with sending(lambda: contextlib.nullcontext(ours), os.write):
            found = self.listed("--serial", line, "--baud", 9600, "--seconds", 2)
        self.check_ship(found, f"{{ serial: {line}, baud: 9600, motion: false }}")

    def test_other_senders_are_refused_and_counted(self):
        port = free_port()
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
            with sending(lambda: contextlib.nullcontext(out), lambda to, text: to.sendto(text, ("127.0.0.1", port))):
                found = self.listed(port, "--sender", "127.0.0.2", "--seconds", 1, code=1)
        self.assertGreater(found["refused"], 3)
        self.assertEqual(found["bytes"], 0)

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
