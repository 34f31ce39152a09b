"""Attitudes joined with positions and UTC, as KM binary: what goes out, with which time, and what never does."""
import contextlib
import io
import math
import sys
import unittest
from unittest import mock

from ensonify import mavlink
from ensonify.mavlink import NO_PLACE, SAMPLE, Attitude, Join, Position, between

UTC_US = 1_780_000_000 * 10**6  # at boot time 0
REST = (0, 0, 0)


class Sent:
    """A sample's values, by the layout of #KMB."""

    def __init__(self, sample):
        (self.mark, self.bytes, self.version, s, ns, self.status, self.latitude, self.longitude, self.height, self.roll, self.pitch,
         self.heading, *_) = SAMPLE.unpack(sample)
        self.boot_ms = (s * 10**6 + ns // 1000 - UTC_US) / 1000

    def has_place(self):
        return not self.status & NO_PLACE


class Joined(unittest.TestCase):
    def setUp(self):
        self.sent, self.said = [], []
        self.booted_s = 0.0  # by the gateway's own clock
        self.join = Join(lambda sample: self.sent.append(Sent(sample)), self.said.append)

    def attitude(self, boot_ms, roll=0.0, pitch=0.0, yaw=0.0):
        self.join.attitude(Attitude(boot_ms, (roll, pitch, yaw), REST), self.booted_s + boot_ms / 1000)

    def position(self, boot_ms, latitude=1.0, longitude=2.0, altitude_m=0.0, velocity=REST):
        self.join.position(Position(boot_ms, (latitude, longitude, altitude_m), velocity), self.booted_s + boot_ms / 1000)

    def utc(self, boot_ms=0, ahead_us=0):
        self.join.time(boot_ms, UTC_US + 1000 * boot_ms + ahead_us, self.booted_s + boot_ms / 1000)

    def test_an_attitude_goes_out_with_the_position_of_its_time(self):
        self.utc()
        self.position(0)
        for boot_ms in (40, 80, 120):
            self.attitude(boot_ms, roll=math.radians(3), pitch=math.radians(-2), yaw=math.radians(-90))
        self.assertEqual(self.sent, [])  # no position of their time or later is there
        self.position(100, latitude=1.001, altitude_m=10)
        self.assertEqual([sample.boot_ms for sample in self.sent], [40, 80])
        first = self.sent[0]
        self.assertEqual((first.mark, first.bytes), (b"#KMB", 132))
        self.assertAlmostEqual(first.latitude, 1.0004, places=9)
        self.assertAlmostEqual(first.height, 4, places=5)
        self.assertAlmostEqual(first.roll, 3, places=5)
        self.assertAlmostEqual(first.pitch, -2, places=5)
        self.assertAlmostEqual(first.heading, 270, places=4)
        self.assertTrue(first.has_place())

    def test_positions_between_two_follow_the_velocities_of_both(self):
        speed, radius_m = 10.0, 20.0
        metres = 111_300.0  # a degree at the equator, near enough for places; the rates are the ellipsoid's

        def on_circle(boot_ms):
            turned = speed / radius_m * boot_ms / 1000
            return Position(boot_ms, (radius_m * math.sin(turned) / 110_574.3, radius_m * (1 - math.cos(turned)) / 111_319.5, 0),
                            (speed * math.cos(turned), speed * math.sin(turned), 0))

        a, b = on_circle(0), on_circle(500)
        for boot_ms in (100, 250, 400):
            off = [metres * (x - y) for x, y in zip(between(a, b, boot_ms).place[:2], on_circle(boot_ms).place[:2])]
            self.assertLess(math.hypot(*off), 2e-3)  # the chord is off by 0.15 m

    def test_the_way_across_180_degrees_is_the_short_one(self):
        middle = between(Position(0, (0, 179.999, 0), REST), Position(100, (0, -179.997, 0), REST), 50)
        self.assertAlmostEqual(middle.place[1], -179.999, places=9)

    def test_nothing_is_extrapolated_and_wide_gaps_are_not_joined(self):
        self.utc()
        self.attitude(0)  # before the first position
        self.position(100)
        self.attitude(1000)
        self.position(1700)  # 1.6 s behind the one before it
        self.assertEqual([sample.has_place() for sample in self.sent], [False, False])
        for boot_ms in range(1720, 3300, 20):
            self.attitude(boot_ms)
        self.assertEqual([sample.boot_ms for sample in self.sent[2:]], [1720, 1740, 1760])  # waited for 1.5 s
        self.assertFalse(any(sample.has_place() for sample in self.sent))

    def test_nothing_goes_out_before_utc_is_known(self):
        self.position(0)
        self.attitude(10)
        for utc_us in (0, 2**64 - 1):  # an autopilot that has no UTC
            self.join.time(20, utc_us, 0.02)
        self.attitude(30)
        self.position(40)
        self.assertEqual(self.sent, [])
        self.assertEqual(self.said, ["no UTC by SYSTEM_TIME yet: nothing is sent"])
        self.utc(50)
        self.attitude(60)
        self.position(80)
        self.assertEqual([sample.boot_ms for sample in self.sent], [60])

    def test_a_restart_begins_again_with_the_next_system_time(self):
        self.utc()
        self.position(60_000)
        self.attitude(60_010)
        self.booted_s = 61.0
        self.attitude(200)
        self.assertEqual([sample.boot_ms for sample in self.sent], [60_010])  # with the UTC of its own boot
        self.assertFalse(self.sent[0].has_place())
        self.utc(300, ahead_us=61_000_000)
        self.position(300)
        self.attitude(310)
        self.position(400)
        self.assertEqual([sample.boot_ms for sample in self.sent], [60_010, 61_310])
        self.assertIn("boot time jumped from 60.010 s to 0.200 s", self.said[1])
        self.assertEqual(self.join.counts["boot_time_jumps"], 1)

    def test_a_boot_time_that_runs_ahead_of_its_arrival_is_of_another_boot(self):
        self.utc()
        self.attitude(100)
        self.attitude(20_000)  # a pause is none
        self.assertEqual(self.join.counts["boot_time_jumps"], 0)
        self.booted_s = -69.98
        self.attitude(90_000)
        self.assertEqual(self.join.counts["boot_time_jumps"], 1)
        self.assertEqual(self.join.counts["attitudes_before_utc"], 1)

    def test_a_jump_of_utc_is_followed_and_said(self):
        self.utc()
        self.position(0)
        self.utc(1000, ahead_us=-3_600_000_000)
        self.attitude(1010)
        self.position(1100)
        self.assertEqual(self.sent[0].boot_ms, 1010 - 3_600_000)
        self.assertEqual(self.said[1:], ["UTC jumped by -3600.000 s: followed"])

    def test_what_is_late_double_or_impossible_is_counted(self):
        self.utc()
        self.position(0)
        self.attitude(100)
        self.attitude(100)
        self.attitude(90)
        self.attitude(110, roll=math.nan)
        self.join.attitude(Attitude(110, REST, (3e38, 0, 0)), 0.11)
        self.position(0)
        self.position(50, latitude=0, longitude=0)
        self.position(60, latitude=200)
        self.assertEqual({name: count for name, count in self.join.counts.items() if name.endswith(("double", "impossible"))},
                         {"attitudes_late_or_double": 2, "attitudes_impossible": 2, "positions_late_or_double": 1,
                          "positions_impossible": 2})


class Started(unittest.TestCase):
    def said(self, *arguments):
        """Exit code and what is said of it."""
        with contextlib.redirect_stderr(io.StringIO()) as error:
            try:
                code = mavlink.main(list(arguments))
            except SystemExit as ended:
                code = ended.code
        return code, error.getvalue()

    def test_without_pymavlink_it_says_what_to_install(self):
        with mock.patch.dict(sys.modules, {"pymavlink": None}):
            code, error = self.said("--to", "127.0.0.1:10110")
        self.assertEqual(code, 2)
        self.assertIn("needs pymavlink: pip install 'ensonify[mavlink]'", error)

    def test_addresses_and_ids_that_cannot_be_are_refused(self):
        for option, value, allowed in (("--listen", "ship:127.0.0.1:1", "udp:HOST:PORT or tcp:HOST:PORT"), ("--listen", "udp:14550", "udp:HOST:PORT"),
                                       ("--listen", "udp:::1:14550", "udp:HOST:PORT"), ("--connect", "udp:[::1]:5760", "tcp:HOST:PORT"),
                                       ("--sender", "ship", "an address, as 127.0.0.1 or ::1"),
                                       ("--to", "127.0.0.1:70000", "HOST:PORT"), ("--system", "0", "1 to 255"), ("--component", "x", "1 to 255")):
            code, error = self.said("--to", "127.0.0.1:10110", option, value)
            self.assertEqual(code, 2)
            self.assertIn(f"{value}; allowed is {allowed}", error)

    def test_addresses_of_ipv6_stand_in_brackets(self):
        way = mavlink.connected("tcp:[fd00::7]:5760")
        self.assertEqual((way.address.host, way.address.port, str(way.address)), ("fd00::7", 5760, "[fd00::7]:5760"))
        self.assertEqual(mavlink.listened("tcp:127.0.0.1:5760"), ("tcp_server", ("127.0.0.1", 5760)))


if __name__ == "__main__":
    unittest.main()
