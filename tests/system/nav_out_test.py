"""nav_out: gpsd and pynmea2 read what it sends, nobody holds it up, and nav_feed follows it back to the estimate."""
import contextlib
import datetime
import json
import math
import os
import pty
import socket
import subprocess
import threading
import time
import tty
import unittest

import ensonify
import numpy as np
import pynmea2
from nmea import free_port
from support import SOURCE, SystemTest

START = datetime.datetime(2025, 6, 1, 12, tzinfo=datetime.timezone.utc)
INSTRUMENTS = """vehicle: boat, imu: { grade: tactical }, gnss: { grade: rtk, position_m: [-1, 0.4, -4], first_fix_s: 1, converge_s: 1 },
              motion_sensor: { grade: survey }, heading: { grade: satellite }"""
# A boat whose instruments speak; copies follow what they receive of them.
LAUNCH = """
ensonify: launch/1
scenario: {source}/scenarios/tideway/scenario.yaml
set: {{ {copies} }}
clock: {{ rate: {rate} }}
duration_s: {seconds}
processes:
  boat: {{ run: vehicle }}
  nav: {{ run: navigation, config: {{ {instruments} }} }}
  pilot: {{ run: autopilot, config: {{ vehicle: boat }} }}
  out: {{ run: nav_out, config: {{ outputs: {{ {outputs} }} }} }}
{feeds}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: all }} }}
wiring: {{ nav.pose: boat/pose, out.position: nav/position }}
"""


def launch(outputs, seconds, rate="free", feeds=None):
    """`feeds`: vehicles that follow, with the configuration of each."""
    feeds = feeds or {}
    copies = ", ".join(f"vehicles.{name}: {{}}" for name in feeds)
    lines = "\n".join(f"  {name}: {{ run: nav_feed, config: {{ {config} }} }}" for name, config in feeds.items())
    return LAUNCH.format(source=SOURCE, outputs=outputs, seconds=seconds, rate=rate, feeds=lines, copies=copies,
                         instruments=INSTRUMENTS)


def by_stamp(record, topic):
    return {message.stamp_ns: message for _, _, message in record.messages(topic)}


def counts_of(record, topic):
    health = [message for _, _, message in record.messages(topic)]
    return {counter.name: counter.count for counter in health[-1].counters}


def angles_of(message):
    """Heading (grid), pitch and roll of an ENU from FRD quaternion, radians."""
    w, x, y, z = message.enu_from_body
    forward = (1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y))
    starboard_up, down_up = 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)
    return math.atan2(forward[0], forward[1]), math.asin(forward[2]), math.atan2(-starboard_up, -down_up)


def wrapped(angle):
    return (angle + math.pi) % (2 * math.pi) - math.pi


@contextlib.contextmanager
def gpsd(port):
    """What gpsd, fed by a UDP port, reports until the block ends."""
    control = free_port()
    process = subprocess.Popen(["gpsd", "-N", "-n", "-S", str(control), f"udp://127.0.0.1:{port}"], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    reports = []

    def read():
        with contextlib.suppress(OSError):
            for line in client.makefile("r", encoding="ascii", errors="replace"):
                with contextlib.suppress(json.JSONDecodeError):  # version 3.22 doubles a comma now and then
                    reports.append(json.loads(line))

    try:
        for _ in range(100):
            with contextlib.suppress(ConnectionRefusedError):
                client = socket.create_connection(("127.0.0.1", control), timeout=60)
                break
            time.sleep(0.05)
        client.sendall(b'?WATCH={"enable":true,"json":true}\n')
        reader = threading.Thread(target=read)
        reader.start()
        yield reports
    finally:
        process.terminate()
        process.wait(timeout=20)
    reader.join(timeout=20)
    client.close()


class Datagrams:
    """What arrives at a UDP port."""

    def __init__(self):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(0.2)
        self.port, self.all, self.over = self.socket.getsockname()[1], [], threading.Event()
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        while not self.over.is_set():
            with contextlib.suppress(TimeoutError):
                self.all.append(self.socket.recv(65536))

    def end(self):
        self.over.set()
        self.thread.join()
        self.socket.close()


class NavOut(SystemTest):
    def test_other_peoples_readers_have_what_the_instruments_measured(self):
        here, there = Datagrams(), free_port()
        sentences = "{ ZDA: 1, GGA: 5, GST: 1, VTG: 1, HDT: 10, PASHR: 10, VDO: 1 }"
        outputs = f"gpsd: {{ udp: {there}, talker: IN, sentences: {sentences} }}, pynmea2: {{ udp: {here.port}, sentences: {sentences} }}"
        with gpsd(there) as reports:
            run = self.run_launch(launch(outputs, 15, rate=1))
        here.end()
        self.assertEqual(run.code, 0, run.stderr)
        with ensonify.Record(run.out / "run.mcap") as record:
            poses, positions = by_stamp(record, "boat/pose"), by_stamp(record, "nav/position")
            headings, attitudes = by_stamp(record, "nav/heading"), by_stamp(record, "nav/attitude")
            counts = counts_of(record, "out/health")
            zda_at = [data.stamp_ns for _, _, data in record.messages("out/sent") if b"ZDA" in data.bytes.tobytes()]
        self.assertEqual(set(counts), {"sentences", "bytes"}, counts)  # nothing lost, refused or late
        self.assertEqual(zda_at, [second * 10**9 for second in range(16)])
        for stamp, position in positions.items():  # instrument and truth, within the instrument's errors
            truth = poses[min(poses, key=lambda t: abs(t - stamp))]
            self.assertLess(math.dist(position.position_enu_m, truth.position_enu_m), 0.3)

        def of_utc(time_of_day):
            return round((datetime.datetime.combine(START, time_of_day, START.tzinfo) - START).total_seconds() * 1e3) * 10**6

        fixes, motions, times = 0, 0, []
        for datagram in here.all:
            self.assertTrue(datagram.endswith(b"\r\n") and datagram.count(b"\n") == 1, datagram)
            if datagram.startswith(b"!"):
                continue
            said = pynmea2.parse(datagram.decode(), check=True)
            if isinstance(said, pynmea2.types.talker.GGA):
                position = positions[of_utc(said.timestamp.replace(tzinfo=None))]
                self.assertLess(abs(said.latitude - position.latitude_deg), 1e-9)  # half of 1e-7 minute
                self.assertLess(abs(said.longitude - position.longitude_deg), 1e-9)
                self.assertLess(abs(float(said.altitude) - position.height_above_geoid_m), 6e-4)
                fixes += 1
            elif isinstance(said, pynmea2.types.proprietary.ash.ASHRATT):
                attitude = attitudes[of_utc(said.timestamp.replace(tzinfo=None))]
                self.assertLess(abs(math.radians(float(said.roll)) - attitude.roll_rad), math.radians(0.0051))
                self.assertLess(abs(math.radians(float(said.pitch)) - attitude.pitch_rad), math.radians(0.0051))
                self.assertLess(abs(float(said.heave) - attitude.heave_m), 0.0051)
                motions += 1
            elif isinstance(said, pynmea2.types.talker.ZDA):
                times.append(datetime.datetime(said.year, said.month, said.day, said.timestamp.hour, said.timestamp.minute, said.timestamp.second))
        self.assertGreater(fixes, 60)
        self.assertGreater(motions, 140)
        self.assertEqual(times, [START.replace(tzinfo=None) + datetime.timedelta(seconds=s) for s in range(16)])

        tpv = [r for r in reports if r["class"] == "TPV" and "lat" in r and "time" in r]
        attitude = [r for r in reports if r["class"] == "ATT" and "heading" in r]
        self.assertGreater(len(tpv), 10)
        self.assertGreater(len(attitude), 10)  # of talker IN: gpsd 3.22 passes HE over
        newest = tpv[-1]
        stamp = of_utc(datetime.datetime.fromisoformat(newest["time"].rstrip("Z")).time())
        position = positions[stamp]
        self.assertLess(abs(newest["lat"] - position.latitude_deg), 2e-9)
        self.assertLess(abs(newest["lon"] - position.longitude_deg), 2e-9)
        self.assertLess(abs(newest["altMSL"] - position.height_above_geoid_m), 2e-3)
        self.assertEqual(newest["status"], 3)  # RTK fixed
        truth = poses[min(poses, key=lambda t: abs(t - stamp))]
        self.assertLess(abs(newest["speed"] - math.hypot(*truth.velocity_enu_mps[:2])), 0.2)
        spoken = np.degrees([heading.heading_true_rad for heading in headings.values()])
        for report in attitude:
            self.assertLess(min(abs((spoken - report["heading"] + 180) % 360 - 180)), 0.006)

    def copy_follows(self, record, name, km_binary):
        """What a copy makes of the sentences is what the instruments said, to the last digit of the sentences, once its times
        are moved to those of the fixes that it took."""
        poses = by_stamp(record, f"{name}/pose")
        said = by_stamp(record, "nav/estimate") if km_binary else by_stamp(record, "nav/position")
        attitudes = by_stamp(record, "nav/estimate") if km_binary else by_stamp(record, "nav/attitude")
        t_s, off_m, off_deg, off_up_m = np.array(sorted(poses)) * 1e-9, [], [], []
        way = np.array([poses[stamp].position_enu_m for stamp in sorted(poses)])
        turned = np.unwrap(np.array([angles_of(poses[stamp]) for stamp in sorted(poses)]), axis=0)
        fixes = by_stamp(record, f"{name}/fix")
        # How much later than the boat the copy is: delay_s and what the first fixes took to arrive, the same for all of a run.
        lag_s = []
        for fix in fixes.values():
            twin = min(said.values(), key=lambda one: math.dist(one.position_enu_m[:2], fix.position_enu_m[:2]))
            lag_s.append((fix.stamp_ns - twin.stamp_ns) * 1e-9)
        lag_s = float(np.median(lag_s))
        for stamp, one in said.items():
            at_s = stamp * 1e-9 + lag_s
            if not t_s[0] + 2 < at_s < t_s[-1]:
                continue
            place = [np.interp(at_s, t_s, way[:, axis]) for axis in range(3)]
            off_m.append(math.dist(place[:2], one.position_enu_m[:2]))
            off_up_m.append(abs(place[2] - one.position_enu_m[2]))
        for stamp, one in attitudes.items():
            at_s = stamp * 1e-9 + lag_s
            if not t_s[0] + 2 < at_s < t_s[-1] or (not km_binary and stamp % 20_000_000 != 0):  # PASHR at 50 Hz
                continue
            wanted = angles_of(one) if km_binary else (one.heading_grid_rad, one.pitch_rad, one.roll_rad)
            for axis in (1, 2):
                off_deg.append(abs(math.degrees(wrapped(np.interp(at_s, t_s, turned[:, axis]) - wanted[axis]))))
        print(f"{name}: lag {lag_s:.3f} s, off {max(off_m):.5f} m, up {max(off_up_m):.5f} m, {max(off_deg):.5f} degrees, {len(off_m)} places")
        self.assertGreater(len(off_m), 30)
        self.assertLess(lag_s, 2.6)
        self.assertLess(max(off_m), 0.003 if km_binary else 0.0005)  # 0.2 mm is the last digit of GGA; the lag is known to 0.5 ms
        self.assertLess(max(off_up_m), 0.006)
        self.assertLess(max(off_deg), 0.01)  # half of a hundredth, and 10 degrees a second times 0.5 ms
        return max(off_deg)

    def test_the_loop_closes_over_udp_tcp_and_a_serial_line(self):
        udp, tcp = free_port(), free_port()
        ours, theirs = pty.openpty()  # a line: what is written at one end is read at the other
        tty.setraw(theirs)
        far, near = pty.openpty()
        tty.setraw(near)
        over = threading.Event()

        def cable():
            os.set_blocking(ours, False)
            while not over.wait(0.002):
                with contextlib.suppress(BlockingIOError, OSError):
                    os.write(far, os.read(ours, 4096))

        thread = threading.Thread(target=cable)
        thread.start()
        sentences = "{ GGA: 5, HDT: 10, PASHR: 50 }"
        outputs = (f"udp: {{ udp: {udp}, format: km_binary, rate_hz: 100 }}, tcp: {{ tcp_server: {tcp}, sentences: {sentences} }}, "
                   f"line: {{ serial: {os.ttyname(theirs)}, baud: 115200, sentences: {sentences} }}")
        feeds = {"by_udp": f"height: gga, sources: {{ boat: {{ udp: {udp}, format: km_binary }} }}",
                 "by_tcp": f"height: gga, sources: {{ boat: {{ tcp: {tcp} }} }}",
                 "by_line": f"height: gga, sources: {{ boat: {{ serial: {os.ttyname(near)}, baud: 115200 }} }}"}
        run = self.run_launch(launch(outputs, 20, rate=1, feeds=feeds))
        over.set()
        thread.join()
        self.assertEqual(run.code, 0, run.stderr)
        with ensonify.Record(run.out / "run.mcap") as record:
            for name in feeds:
                self.copy_follows(record, name, km_binary=name == "by_udp")

    def test_the_loop_closes_inside_a_run_and_every_byte_is_the_same_again(self):
        outputs = "boat: { file: boat.nmea, sentences: { ZDA: 1, GGA: 5, HDT: 10, PASHR: 50, VDO: 1 } }"
        feeds = {"copy": "height: gga, recorded: true, sources: { boat: { udp: 10110 } }"}
        first = self.run_launch(launch(outputs, 30, feeds=feeds), out="first")
        self.assertEqual(first.code, 0, first.stderr)
        again = self.run_launch(launch(outputs, 30, feeds=feeds), "--rate", "10", out="again")
        self.assertEqual(again.code, 0, again.stderr)
        text = (first.out / "boat.nmea").read_bytes()
        self.assertEqual(text, (again.out / "boat.nmea").read_bytes())
        same = self.tool("compare", "--topic", "out/sent", "--topic", "copy/pose", first.out / "run.mcap", again.out / "run.mcap")
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)
        self.assertRegex(same.stdout, r"^same: [1-9]\d+ messages on 2 topics")
        other = self.run_launch(launch(outputs, 30, feeds=feeds), "--set", "seed=7", out="other")
        self.assertNotEqual(text, (other.out / "boat.nmea").read_bytes())
        with ensonify.Record(first.out / "run.mcap") as record:
            sent = b"".join(data.bytes.tobytes() for _, _, data in record.messages("out/sent"))
            self.assertLess(self.copy_follows(record, "copy", km_binary=False), 0.00501)  # the lag is known here
        self.assertEqual(sent, text)

    def test_no_slow_absent_or_refusing_receiver_holds_the_run_up(self):
        alone = self.run_launch(launch("log: { file: log.nmea }", 20), out="alone")
        self.assertEqual(alone.code, 0, alone.stderr)
        mute = socket.socket()  # takes connections, never reads
        mute.bind(("127.0.0.1", 0))
        mute.listen()
        full, unread = pty.openpty()
        tty.setraw(unread)
        outputs = ("log: { file: log.nmea }, "
                   f"absent: {{ udp: {free_port()}, sentences: {{ PASHR: 100 }} }}, "
                   f"refusing: {{ tcp: {free_port()}, sentences: {{ PASHR: 100 }} }}, "
                   f"mute: {{ tcp: {mute.getsockname()[1]}, sentences: {{ PASHR: 100, PSXN23: 100 }} }}, "
                   f"nobody: {{ tcp_server: {free_port()}, sentences: {{ PASHR: 100 }} }}, "
                   f"line: {{ serial: {os.ttyname(unread)}, baud: 921600, sentences: {{ PASHR: 100, PSXN23: 100 }} }}")
        held = self.run_launch(launch(outputs, 20), out="held")
        self.assertEqual(held.code, 0, held.stderr)
        mute.close()
        os.close(full)
        os.close(unread)
        self.assertEqual((alone.out / "log.nmea").read_bytes(), (held.out / "log.nmea").read_bytes())
        self.assertLess(held.wall_s, alone.wall_s + 12)  # two seconds at the end for each of five, and a slow machine
        ends = {line.split("to=")[1].split()[0]: line for line in held.log("out").splitlines() if " sent " in line}
        lost = {name: int(line.split("lost=")[1].split()[0]) for name, line in ends.items()}
        self.assertGreater(lost["refusing"], 1500)
        self.assertGreater(lost["nobody"], 1500)
        self.assertGreater(int(ends["absent"].split("refused=")[1].split()[0]), 0)
        self.assertEqual(lost["log"], 0)

    def test_mistakes_are_named_before_anything_runs(self):
        for outputs, said in (
                ("mru: { serial: /dev/ttyUSB0, baud: 9600, format: tss1, rate_hz: 100 }", "outputs.mru.rate_hz: TSS1 at 100 Hz needs 2700 bytes/s"),
                ("nav: { udp: 10110, sentences: { GGA: 50 } }", "needs at least 50 Hz, and nav/position has"),
                ("nav: { udp: 10110, sentences: { GLL: 1 } }", "GLL"),
                ("nav: { udp: 10110, to: nowhere }", "outputs.nav.to: \"nowhere\" is no host")):
            path = self.write("mistake.yaml", launch(outputs, 5))
            done = self.tool("check", path)
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            self.assertIn(said, done.stdout + done.stderr)
        taken = socket.socket()
        taken.bind(("127.0.0.1", 0))
        run = self.run_launch(launch(f"nav: {{ tcp_server: {taken.getsockname()[1]} }}", 5), out="taken")
        taken.close()
        self.assertEqual(run.code, 2, run.stderr)
        self.assertIn("outputs.nav: cannot listen to TCP port", run.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
