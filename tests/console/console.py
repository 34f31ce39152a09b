"""Starts `ensonify console` for a test, and makes records whose content is known."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

SOURCE = pathlib.Path(os.environ["ENSONIFY_SOURCE"])
BIN = pathlib.Path(os.environ["ENSONIFY_BIN"])
sys.path.insert(0, str(SOURCE / "tools/plot/tests"))

import ensonify  # noqa: E402
import synthetic_heads  # noqa: E402

SOUND_SPEED_MPS = 1500.0
STEP_M = 0.06


def fan(pings=20, beams=61, samples=1000, rate_hz=10.0, target=(12, 35.1), level_db=120.0, step_m=STEP_M, roll_deg=lambda t_s: None):
    """A head of 120 degrees in silence of 60 dB, with one sample of one beam that stands out: `target` is its beam and range. By `roll_deg`
    it hangs with its starboard side down; None: nobody knows."""
    angles = np.linspace(-np.pi / 3, np.pi / 3, beams).astype("f4")
    for ping in range(pings):
        amplitude = np.full((beams, samples), 1e3, "f4")
        amplitude[target[0], round(target[1] / step_m)] = 10 ** (level_db / 20)
        yield "bow/ping", ensonify.Ping(
            stamp_ns=int(ping / rate_hz * 1e9), ping=ping, kind="multibeam", sample_period_s=2 * step_m / SOUND_SPEED_MPS,
            first_sample_s=0.0, beam_angle_rad=angles, amplitude_upa=amplitude, range_m=samples * step_m, **hanging(roll_deg(ping / rate_hz)),
            **synthetic_heads.applied())


def hanging(roll_deg):
    """Pose of a head for a ping."""
    if roll_deg is None:
        return {}
    return {"pose_time_s": np.zeros(1), "pose_position_enu_m": np.zeros((1, 3)), "pose_enu_from_head": np.array([angles_wxyz(0.5, 0.0, np.radians(roll_deg))])}


def sides(pings=20, samples=600, rate_hz=10.0):
    """A sidescan of 36 m whose level in dB is 80 + the ping's number to port and 100 to starboard, everywhere."""
    for ping in range(pings):
        amplitude = np.empty((2, samples), "f4")
        amplitude[0], amplitude[1] = 10 ** ((80 + ping % 20) / 20), 1e5
        yield "fish/ping", ensonify.Ping(
            stamp_ns=int(ping / rate_hz * 1e9), ping=ping, kind="sidescan", sample_period_s=2 * STEP_M / SOUND_SPEED_MPS,
            first_sample_s=0.0, beam_angle_rad=np.array([-1.0, 1.0], "f4"), amplitude_upa=amplitude, range_m=samples * STEP_M,
            **synthetic_heads.applied())


def slope_depth_m(east_m):
    return 20.0 + 0.1 * east_m


def survey(pings=60, rate_hz=20.0, beams=41):
    """Soundings of a slope that falls to the east, on the middles of cells of 0.5 m, every fourth one half a metre shoaler; the estimate and
    the true pose go north at 10 m/s, 3 m apart."""
    for ping in range(pings):
        stamp_ns, north_m = int(ping / rate_hz * 1e9), ping * 0.5 + 0.25
        east_m = np.arange(beams) * 0.5 + 0.25
        depth_m = slope_depth_m(east_m) - np.where(ping % 4 == 0, 0.5, 0.0)
        places = np.stack([east_m, np.full(beams, north_m), -depth_m], axis=1)
        yield "bow/soundings", ensonify.Soundings(stamp_ns=stamp_ns, ping=ping, valid=np.ones(beams, "u1"), position_enu_m=places,
                                                  beam_angle_rad=np.zeros(beams, "f4"), travel_time_s=np.zeros(beams, "f4"))
        # The same cells again, one sounding deeper.
        yield "bow/soundings", ensonify.Soundings(stamp_ns=stamp_ns, ping=ping, valid=np.ones(beams, "u1"), position_enu_m=places - [0, 0, 0.25],
                                                  beam_angle_rad=np.zeros(beams, "f4"), travel_time_s=np.zeros(beams, "f4"))
        north = (0.0, np.sqrt(0.5), np.sqrt(0.5), 0.0)
        yield "nav/estimate", ensonify.Estimate(stamp_ns=stamp_ns, position_enu_m=(10.0, north_m, 0.0), enu_from_body=north)
        yield "boat/pose", ensonify.Pose(stamp_ns=stamp_ns, position_enu_m=(13.0, north_m, 0.0), enu_from_body=north)


def health(times_s=(0.0, 1.0)):
    for i, t_s in enumerate(times_s):
        yield "nav/health", ensonify.Health(stamp_ns=int(t_s * 1e9), state="degraded", message=f"<b>report</b> {i}",
                                            counters=[ensonify.Counter(name="fixes", count=i)])


def angles_wxyz(heading_rad, pitch_rad, roll_rad):
    """Attitude quaternion enu_from_body of an FRD body, w, x, y, z."""
    def product(a, b):
        return (a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0])

    def about(axis, angle):
        return (np.cos(angle / 2), *(np.sin(angle / 2) * (i == axis) for i in range(3)))

    level_to_north = (0.0, np.sqrt(0.5), np.sqrt(0.5), 0.0)
    return product(level_to_north, product(about(2, heading_rad), product(about(1, pitch_rad), about(0, roll_rad))))


TRUE_ROLL_DEG, ESTIMATED_ROLL_DEG = 10.0, 12.0


def voyage(seconds=20.0, rate_hz=5.0, gap_s=(8.0, 12.0)):
    """A vehicle that turns by 9 degrees a second from 200 degrees on, 4 m/s fast; its true roll is TRUE_ROLL_DEG, its estimated roll
    ESTIMATED_ROLL_DEG. In `gap_s` there is no estimate. An altimeter counts down from 30 m; in the second half it has no answer."""
    for i in range(int(seconds * rate_hz)):
        t_s = i / rate_hz
        common = {"stamp_ns": int(t_s * 1e9), "position_enu_m": (1.0, 2.0, -3.0), "velocity_enu_mps": (0.0, 4.0, 1.0)}
        heading_rad = np.radians((200 + 9 * t_s) % 360)
        yield "boat/pose", ensonify.Pose(**common, enu_from_body=angles_wxyz(heading_rad, 0.0, np.radians(TRUE_ROLL_DEG)))
        if not gap_s[0] <= t_s < gap_s[1]:
            yield "nav/estimate", ensonify.Estimate(**common, enu_from_body=angles_wxyz(heading_rad, 0.0, np.radians(ESTIMATED_ROLL_DEG)))
        answers = t_s < seconds / 2
        yield "echo/altitude", ensonify.Altitude(stamp_ns=int(t_s * 1e9), valid=answers, range_m=30.0 - t_s if answers else 0.0)


def mission(seconds=20.0, rate_hz=5.0):
    """A runline on which the vehicle of voyage() is 7.25 m to port at first and wanders to starboard by 0.5 m/s; 4 m of it go by a second."""
    for i in range(int(seconds * rate_hz)):
        t_s = i / rate_hz
        yield "pilot/mission", ensonify.MissionState(stamp_ns=int(t_s * 1e9), state="on_line", line=2, line_count=7, line_name="<i>NW 3</i>",
                                                     cross_track_m=-7.25 + 0.5 * t_s, distance_to_go_m=500.0 - 4.0 * t_s)
        yield "pilot/guidance", ensonify.Guidance(stamp_ns=int(t_s * 1e9), heading_grid_rad=np.radians(123.0), speed_mps=3.5)


CHART_ORIGIN = (54.25, -3.5)  # degrees north and east


def seabed_chart():
    """A plane that falls by 0.1 m a metre to the east, 10 m deep at east -200 m and 50 m at 200 m; 41 x 41 posts of 10 m about the origin."""
    east_m = np.arange(-200.0, 201.0, 10.0)
    height_m = np.tile(-(30.0 + 0.1 * east_m), (41, 1)).astype("f4")
    yield "pager/chart", ensonify.Chart(origin_latitude_deg=CHART_ORIGIN[0], origin_longitude_deg=CHART_ORIGIN[1], west_m=-200.0, south_m=-200.0, east_m=200.0,
                                        north_m=200.0, shallowest_m=10.0, deepest_m=50.0, spacing_m=10.0, height_m=height_m)


def write_record(file, *streams, declares=None):
    """In the order of time."""
    messages = sorted((message for stream in streams for message in stream), key=lambda m: getattr(m[1], "stamp_ns", 0))
    return synthetic_heads.write(file, messages, declares)


class Console:
    """The gateway in a process of its own."""

    def __init__(self, *words, env=None):
        self.log = tempfile.NamedTemporaryFile("w+", suffix=".log")
        self.process = subprocess.Popen([BIN / "ensonify-console", *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=self.log, text=True, env={**os.environ, **(env or {})})
        self.view = self._url("to view:")
        self.control = self._url("to control:")
        self.port = int(self.view.split("#")[0].rstrip("/").rsplit(":", 1)[1])

    def _url(self, label):
        line = self.process.stdout.readline()
        if not line.startswith(label):
            self.process.wait(10)
            raise AssertionError(f"no line {label!r} but {line!r}; {self.stderr()}")
        return line.split(": ", 1)[1].strip()

    def stderr(self):
        return pathlib.Path(self.log.name).read_text()

    def lives(self):
        return self.process.poll() is None

    def stop(self):
        if self.lives():
            self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait(20)
        finally:
            self.process.kill()
            self.process.stdout.close()
        return self.process.returncode


class ConsoleTest(unittest.TestCase):
    """Consoles end with the test, and none of them may have died."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def console(self, *words, **more):
        console = Console(*words, **more)
        self.addCleanup(console.stop)
        return console

    def wait_for(self, what, patience_s=10.0):
        end = time.monotonic() + patience_s
        while not what():
            self.assertLess(time.monotonic(), end, "waited too long")
            time.sleep(0.02)
