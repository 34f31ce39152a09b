"""An autopilot's MAVLink drives a boat through the gateway, in real time: on its track, through its restart, past strangers."""
import contextlib
import importlib.util
import json
import math
import socket
import sys
import threading
import time
import unittest

import ensonify
import numpy as np
from nmea import free_port
from support import SOURCE, SystemTest

SITE = (48.6, -3.9)
SECONDS = 17  # of which some pass before a busy machine has connected
DELAY_S = 2.0
RESTART = (6.0, 7.0)  # nothing comes between these times
UTC_AGAIN_S = 8.0  # SYSTEM_TIME comes on full seconds, so not before 8 s after a restart at 7.3 s
FIRST_SENT_S = 7.3
ALTITUDE_M = 3.0
GEOID_M = 50.1  # of the scenario

# Positions have 1e-7 degrees: by rounding 0.7 cm at most, and a cubic through such places is a fifth more beside them.
PLACE_WITHIN_M = 0.012
# Roll and heading turn by 8 deg/s: one attitude too early or late would be 0.15 degrees, and 2.5 ms 0.02 degrees.
ANGLE_WITHIN_DEG = 0.02

LAUNCH = """
ensonify: launch/1
scenario: {source}/scenarios/tideway/scenario.yaml
set: {{ site.latitude_deg: {latitude}, site.longitude_deg: {longitude} }}
clock: {{ rate: 1 }}
duration_s: {seconds}
processes:
  autopilot:
    run: [{python}, -m, ensonify.mavlink, {way}, --to, "127.0.0.1:{to}", --geoid-above-ellipsoid-m, "{geoid}"]
    observer: true
  boat: {{ run: nav_feed, config: {{ delay_s: {delay}, sources: {{ autopilot: {{ udp: {to}, format: km_binary }} }} }} }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: [boat/pose, boat/fix, boat/health] }} }}
"""


class Track:
    """A circle about the site at 4 m/s, with the roll and pitch of a sea."""

    radius_m, speed_mps, first_rad = 30.0, 4.0, 2.0
    rate_radps = speed_mps / radius_m

    def __init__(self):
        s = 1 - 0.00669437999014 * math.sin(math.radians(SITE[0])) ** 2
        self.east_m_per_deg = math.radians(6378137.0 / math.sqrt(s)) * math.cos(math.radians(SITE[0]))
        self.north_m_per_deg = math.radians(6378137.0 / math.sqrt(s) * (1 - 0.00669437999014) / s)

    def heading_rad(self, t_s):
        return self.first_rad + self.rate_radps * t_s

    def east_north_m(self, t_s):
        heading = self.heading_rad(t_s)
        return -self.radius_m * np.cos(heading), self.radius_m * np.sin(heading)

    def roll_pitch_deg(self, t_s):
        return 5 * np.sin(2 * np.pi * t_s / 4), 2 * np.sin(2 * np.pi * t_s / 3 + 1)

    def degrees(self, t_s):
        east, north = self.east_north_m(t_s)
        return SITE[0] + north / self.north_m_per_deg, SITE[1] + east / self.east_m_per_deg

    def time_s(self, latitude_deg, longitude_deg):
        """When it is there, on its first time round."""
        north, east = (latitude_deg - SITE[0]) * self.north_m_per_deg, (longitude_deg - SITE[1]) * self.east_m_per_deg
        return (math.atan2(north, -east) - self.first_rad) % (2 * math.pi) / self.rate_radps


class Autopilot:
    """Frames of one system: attitude at 50 Hz, position at 10 Hz and in between, SYSTEM_TIME and HEARTBEAT at 1 Hz."""

    def __init__(self, system, component=1):
        from pymavlink.dialects.v20 import common

        self.mavlink = common
        self.link = common.MAVLink(None, srcSystem=system, srcComponent=component)

    def attitude(self, boot_ms, roll_deg, pitch_deg, heading_rad):
        yaw = (heading_rad + math.pi) % (2 * math.pi) - math.pi
        return self.mavlink.MAVLink_attitude_message(boot_ms, math.radians(roll_deg), math.radians(pitch_deg), yaw, 0, 0, 0).pack(self.link)

    def position(self, boot_ms, latitude_deg, longitude_deg, north_mps, east_mps):
        return self.mavlink.MAVLink_global_position_int_message(
            boot_ms, round(latitude_deg * 1e7), round(longitude_deg * 1e7), round(ALTITUDE_M * 1000), 0,
            round(north_mps * 100), round(east_mps * 100), 0, 65535).pack(self.link)

    def system_time(self, boot_ms, utc_s):
        return self.mavlink.MAVLink_system_time_message(round(utc_s * 1e6), boot_ms).pack(self.link)

    def heartbeat(self):
        return self.mavlink.MAVLink_heartbeat_message(11, 3, 0, 0, 4, 3).pack(self.link)


def frames(track, ours, stranger, computer, began_utc_s):
    """(when to send, datagram), from half a second before the first SYSTEM_TIME on."""
    for tick in range(-25, 50 * (SECONDS + 4)):
        t_s = tick / 50
        if RESTART[0] <= t_s < FIRST_SENT_S:
            continue
        booted_s = -120.0004 if t_s < RESTART[0] else RESTART[1] - 0.0004  # boot time is cut to ms

        def boot_ms(at_s):
            return int(1000 * (at_s - booted_s) + 1e-6)

        attitude = ours.attitude(boot_ms(t_s), *track.roll_pitch_deg(t_s), track.heading_rad(t_s))
        yield t_s, attitude
        yield t_s, stranger.attitude(boot_ms(t_s), 30, 10, 0)
        if tick % 5 == 0:
            at_s = t_s + 0.007
            course = track.heading_rad(at_s)
            yield at_s, ours.position(boot_ms(at_s), *track.degrees(at_s), track.speed_mps * math.cos(course), track.speed_mps * math.sin(course))
            yield at_s, stranger.position(boot_ms(at_s), SITE[0] + 0.01, SITE[1], 0, 0)
        if tick % 25 == 10:
            yield t_s, attitude[:-1] + bytes([attitude[-1] ^ 0xFF])  # its CRC is wrong
        if tick % 50 == 0:
            yield t_s, ours.system_time(boot_ms(t_s), began_utc_s + t_s) + ours.heartbeat()  # two frames in a datagram
            yield t_s, stranger.system_time(boot_ms(t_s), began_utc_s + t_s + 86400)
            yield t_s, computer.system_time(5, began_utc_s + t_s)


def attitude_of(quaternions):
    """Roll, pitch and heading in degrees of forward, starboard, down in east, north, up."""
    w, x, y, z = quaternions.T
    forward = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])
    starboard_up, down_up = 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)
    return np.degrees([np.arctan2(-starboard_up, -down_up), np.arcsin(forward[2]), np.arctan2(forward[0], forward[1])])


@unittest.skipUnless(importlib.util.find_spec("pymavlink"), "pymavlink is not there: pip install 'ensonify[mavlink]'")
class Mavlink(SystemTest):
    def play(self, send, stop):
        autopilots = Autopilot(1), Autopilot(42), Autopilot(1, component=191)
        began = time.monotonic() + 0.5
        for at_s, datagram in frames(self.track, *autopilots, time.time()):
            if stop.wait(max(0.0, began + at_s - time.monotonic())):
                return
            send(datagram)

    def play_datagrams(self, listen, stop):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
            self.play(lambda datagram: out.sendto(datagram, ("127.0.0.1", listen)), stop)

    def play_a_stream(self, listen, stop):
        """To the first who connects, in pieces that end within frames."""
        with socket.socket() as server:
            server.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            server.bind(("127.0.0.1", listen))
            server.listen(1)
            server.settimeout(30)
            connection, _ = server.accept()
            rest = b""

            def send(frame):
                nonlocal rest
                rest += frame
                connection.sendall(rest[:-3])
                rest = rest[-3:]

            with connection, contextlib.suppress(ConnectionError):  # the run's end ends it
                self.play(send, stop)

    def wait_for_the_gateway(self):
        log = self.folder / "out/log/autopilot.log"
        until = time.monotonic() + 30
        while not (log.exists() and "receives MAVLink" in log.read_text()):
            self.assertLess(time.monotonic(), until, "the gateway does not receive")
            time.sleep(0.02)

    def test_a_boat_follows_an_autopilots_track_through_its_restart(self):
        self.expect_that_a_boat_follows("--listen, 'udp:127.0.0.1:{listen}'", self.play_datagrams)

    def test_a_boat_follows_an_autopilot_over_tcp(self):
        self.expect_that_a_boat_follows("--connect, 'tcp:127.0.0.1:{listen}'", self.play_a_stream)

    def expect_that_a_boat_follows(self, way, play):
        self.track = Track()
        listen, to = free_port(), free_port()
        run = self.start_launch(LAUNCH.format(source=SOURCE, latitude=SITE[0], longitude=SITE[1], seconds=SECONDS, python=sys.executable,
                                              way=way.format(listen=listen), to=to, geoid=GEOID_M, delay=DELAY_S))
        self.wait_for_go()
        self.wait_for_the_gateway()
        stop = threading.Event()
        sender = threading.Thread(target=play, args=(listen, stop))
        sender.start()
        _, error = run.communicate(timeout=200)
        stop.set()
        sender.join()
        self.assertEqual(run.returncode, 0, error)

        self.expect_what_was_said()
        with ensonify.Record(self.folder / "out/run.mcap") as record:
            poses = [message for _, _, message in record.messages("boat/pose")]
            fixes = [message for _, _, message in record.messages("boat/fix")]
            health = [message for _, _, message in record.messages("boat/health")]
        counts = {counter.name: counter.count for counter in health[-1].counters}
        self.assertGreater(counts["fixes_taken"], 300)
        for name in ("motions_malformed", "motions_at_another_time", "sentences_late", "time_jumps", "place_jumps"):
            self.assertNotIn(name, counts)
        self.assertTrue(all(abs(fix.height_above_geoid_m - ALTITUDE_M) < 1e-3 for fix in fixes))
        self.expect_on_track(poses, fixes)

    def expect_what_was_said(self):
        log = (self.folder / "out/log/autopilot.log").read_text()
        for line in ("no UTC by SYSTEM_TIME yet: nothing is sent", "UTC is known at boot time 120.000 s",
                     "(the autopilot restarted?): nothing is sent before its next SYSTEM_TIME", "UTC is known at boot time 1.000 s"):
            self.assertEqual(log.count(line), 1, log)
        counts = json.loads(log.splitlines()[-1])
        self.assertEqual(counts["boot_time_jumps"], 1)
        for name, least in (("sent", 300), ("attitudes_before_utc", 55), ("of_other_systems", 500), ("of_other_components", 8),
                            ("bad_crc", 15), ("other_messages", 8)):
            self.assertGreater(counts[name], least, name)
        for name in ("utc_jumps", "attitudes_late_or_double", "positions_late_or_double", "not_mavlink", "frames_cut", "senders_refused"):
            self.assertNotIn(name, counts)

    def expect_on_track(self, poses, fixes):
        # Sim time at the track's time 0: one number, from the places of all fixes.
        began_s = [fix.stamp_ns * 1e-9 - self.track.time_s(fix.latitude_deg, fix.longitude_deg) for fix in fixes]
        self.assertLess(max(began_s) - min(began_s), 0.01)
        t_s = np.array([pose.stamp_ns for pose in poses]) * 1e-9 - np.mean(began_s)
        compared = (t_s > 0.3) & ((t_s < RESTART[0] - 0.15) | (t_s > UTC_AGAIN_S + 0.15))
        self.assertGreater(np.count_nonzero(compared & (t_s < RESTART[0])), 400)
        self.assertGreater(np.count_nonzero(compared & (t_s > UTC_AGAIN_S)), 200)

        place_m = np.array([pose.position_enu_m for pose in poses])
        off_m = np.hypot(*(place_m[:, :2].T - self.track.east_north_m(t_s)))
        roll, pitch, heading = attitude_of(np.array([pose.enu_from_body for pose in poses]))
        true_roll, true_pitch = self.track.roll_pitch_deg(t_s)
        off_deg = np.array([roll - true_roll, pitch - true_pitch, heading - np.degrees(self.track.heading_rad(t_s))])
        off_deg = np.abs((off_deg + 180) % 360 - 180)
        print(f"places within {off_m[compared].max():.4f} m, angles within {off_deg[:, compared].max():.4f} degrees")
        self.assertLess(off_m[compared].max(), PLACE_WITHIN_M)
        self.assertLess(off_deg[:, compared].max(), ANGLE_WITHIN_DEG)
        self.assertLess(off_m[t_s > 0.3].max(), 1.0)  # in the gap too: joined by nav_feed, which turns 15 degrees in it


if __name__ == "__main__":
    unittest.main(verbosity=2)
