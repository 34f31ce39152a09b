"""Find a box on 100 m x 100 m of seabed by the waterfall of a sidescan, and say where it is.

The first pass that shows the box earns 20: it lies abeam, 5 to 27 m away. An announcement within 5 m of it earns 80, less the nearer to
5 m, and ends the episode; one that is farther away costs 2. Each step costs 0.1. Leaving the area by 50 m costs 25 and ends it. 240 s are 240
steps, each with 5 pings. The seed also draws where the box lies, and the start."""
import pathlib
from typing import Any

import numpy as np

from ensonify.environment import Env
from ensonify.episode import Seen
from ensonify.episodes import drawn_seed
from ensonify.images import grey
from ensonify.messages import Estimate, Guidance, Object, Ping, Pose
from ensonify.acts import Act
from ensonify.spaces import Array, Box, Rows
from ensonify.tasks.wall_follow import heading_rad

HALF_AREA_M = 50.0  # the area is a square about the origin
LEFT_M = 50.0  # beyond the area, where the episode ends
FOUND_M = 5.0  # error of an announcement that is still right
NEAREST_M, FARTHEST_M = 5.0, 27.0  # across the track, where a pass shows the box: neither under the vehicle nor at the end of the swath
TURN_RAD = np.radians(45)  # an action of 1 orders a heading so much to starboard of the present
SPEED_MPS, DEPTH_M = 2.0, 12.0
RANGE_M = 30.0  # of the head
DARK_DB, BRIGHT_DB = 125.0, 175.0  # with the gain that the head's operator set, from 0 to 255
LINES, CELLS = 64, 64  # rows of the waterfall; cells of range of a side


def line(ping: Ping) -> np.ndarray:
    """A row of the waterfall: port's farthest cell first, starboard's last; the mean energy of each cell of slant range, by level."""
    sides = ping.amplitude_upa[np.argsort(ping.beam_angle_rad)]
    range_m = (ping.first_sample_s + ping.sample_period_s * np.arange(sides.shape[1])) * ping.sound_speed_mps / 2
    gain_db = ping.gain_spreading_db * np.log10(np.maximum(range_m, 1)) + 2 * ping.gain_absorption_dbpm * range_m + ping.gain_offset_db
    cell = (range_m * CELLS / RANGE_M).astype(int)
    inside = cell < CELLS
    energy = [np.bincount(cell[inside], side[inside] ** 2 * 10 ** (gain_db[inside] / 10), CELLS) for side in sides]
    mean = np.concatenate([energy[0][::-1], energy[1]]) / np.tile(np.maximum(np.bincount(cell[inside], minlength=CELLS), 1), 2)
    level = (10 * np.log10(np.maximum(mean, 1e-9)) - DARK_DB) / (BRIGHT_DB - DARK_DB)
    return np.rint(255 * np.clip(level, 0, 1)).astype(np.uint8)


WATERFALL = Rows(Ping, line, Box(0, 255, (LINES, 2 * CELLS), np.uint8))


def course(estimate: Estimate) -> tuple:
    """East and north in m, heading in rad."""
    return *estimate.position_enu_m[:2], heading_rad(estimate.enu_from_body)


def order(action: np.ndarray, seen: Seen) -> Guidance:
    """The heading that an action asks for."""
    heading = heading_rad(seen["nav/estimate"].enu_from_body) + TURN_RAD * float(action[0])
    return Guidance(stamp_ns=seen.t_ns, heading_grid_rad=heading, speed_mps=SPEED_MPS, depth_m=DEPTH_M)


def announces(seen: Seen) -> bool:
    """Whether the action says that the box is at its place."""
    return seen.action[3] > 0


def error_m(seen: Seen) -> float:
    """Of the place that the action names."""
    return float(np.hypot(*(HALF_AREA_M * seen.action[1:3] - seen["pager/object"].position_enu_m[:2])))


def found(seen: Seen) -> bool:
    """A right announcement."""
    return announces(seen) and error_m(seen) < FOUND_M


def left(seen: Seen) -> bool:
    """Too far outside."""
    return max(map(abs, seen["auv/pose"].position_enu_m[:2])) > HALF_AREA_M + LEFT_M


def shown(seen: Seen) -> bool:
    """Whether the box was abeam since the last step, within a metre, where the sidescan sees well."""
    for pose in seen.new("auv/pose"):
        away = np.subtract(seen["pager/object"].position_enu_m[:2], pose.position_enu_m[:2])
        heading = heading_rad(pose.enu_from_body)
        along, across = away @ (np.sin(heading), np.cos(heading)), away @ (np.cos(heading), -np.sin(heading))
        if abs(along) < 1 and NEAREST_M < abs(across) < FARTHEST_M:
            return True
    return False


class TargetSearch(Env):
    """Ensonify/TargetSearch-v0. Keywords are Env's, to change it."""

    def __init__(self, **changes: Any):
        self._shown = False  # in this episode
        super().__init__(**{
            "launch": pathlib.Path(__file__).with_name("target_search.yaml"),
            "observe": {"side/ping_main": WATERFALL,
                        "nav/estimate": Array(Estimate, course, Box(-np.inf, np.inf, (3,), np.float64))},
            "act": Act(Guidance, order, Box(-1, 1, (4,), np.float32)),
            "truth": {"auv/pose": Pose, "pager/object": Object},
            "reward": self._earned,
            "done": lambda seen: found(seen) or left(seen),
            "rate": 1,
            "seconds": 240,
            "image": lambda seen: grey(WATERFALL.values("waterfall", seen.last("side/ping_main"))["waterfall"]),
            **changes})

    def reset(self, *, seed: int | None = None, options: dict | None = None) -> tuple:
        """As Env's, with the box anywhere in the area but its outer 5 m, and the start south of it."""
        if seed is None:
            seed = drawn_seed(self.np_random)
        options = dict(options or {})
        drawn = np.random.default_rng(seed)
        place_m, turned_deg, start_east_m, start_deg = drawn.uniform(-45, 45, 2), drawn.uniform(0, 180), drawn.uniform(-40, 40), drawn.uniform(-10, 10)
        options["set"] = {"objects.target.on_seabed.at_m": place_m.tolist(), "objects.target.heading_deg": float(turned_deg),
                          "vehicles.auv.start.position_m": [float(start_east_m), -75, -DEPTH_M],
                          "vehicles.auv.start.heading_deg": float(start_deg), **options.get("set", {})}
        self._shown = False
        return super().reset(seed=seed, options=options)

    def _earned(self, seen: Seen) -> float:
        """The reward of a step, by the true places of box and vehicle."""
        earned = -0.1 - 25 * left(seen)
        if not self._shown and shown(seen):
            self._shown = True
            earned += 20
        if announces(seen):
            earned += 80 * (1 - error_m(seen) / FOUND_M) if found(seen) else -2
        return earned


class Baseline:
    """A classical search: three lines 22 m apart, each sees what lies under the next. The box is where some rows have a shadow that
    means something tall, from the shadow's length, its range and the altitude."""

    LOOKAHEAD_M, TURN_NORTH_M = 12.0, 52.0  # along a line; where it ends
    TALL_M, ROWS = 0.9, 4  # height of what throws the shadow, and rows that see it
    DARKER, BRIGHTER = 30, 35  # of a shadow and of an echo, in grey levels from the median of their range
    CELL_M, ROW_M = RANGE_M / CELLS, SPEED_MPS / 5

    def __init__(self):
        self._lines_east_m: list = []  # the present one first
        self._northward = True

    def __call__(self, observation: dict) -> np.ndarray:
        east_m, north_m, heading = observation["nav/estimate"]
        turn = (self._course(east_m, north_m) - heading + np.pi) % (2 * np.pi) - np.pi
        action = np.array([turn / TURN_RAD, 0, 0, -1])
        place = self._box(observation["side/ping_main"])
        if place and abs(turn) < np.radians(15):  # else the rows do not lie side by side
            ahead_m, starboard_m = place
            action[1] = (east_m + ahead_m * np.sin(heading) + starboard_m * np.cos(heading)) / HALF_AREA_M
            action[2] = (north_m + ahead_m * np.cos(heading) - starboard_m * np.sin(heading)) / HALF_AREA_M
            action[3] = 1
        return np.clip(action, -1, 1).astype(np.float32)

    def _course(self, east_m: float, north_m: float) -> float:
        """The heading to a point of the present line ahead: north and south in turns, first on the outer line that is nearer."""
        if not self._lines_east_m:
            self._lines_east_m = [-22.0, 0.0, 22.0] if east_m < 0 else [22.0, 0.0, -22.0]
        if (north_m if self._northward else -north_m) > self.TURN_NORTH_M:
            self._lines_east_m.append(self._lines_east_m.pop(0))
            self._northward = not self._northward
        return np.arctan2(self._lines_east_m[0] - east_m, self.LOOKAHEAD_M if self._northward else -self.LOOKAHEAD_M)

    def _box(self, picture: np.ndarray) -> tuple | None:
        """How far ahead and to starboard the box lies, once its rows are over. None without one."""
        level = picture.astype(int) - np.median(picture, axis=0).astype(int)
        altitude = int(np.argmax(np.median(picture[:, CELLS:], axis=0) > 100))  # in cells
        for side, cells in ((-1, level[:24, CELLS - 1::-1]), (1, level[:24, CELLS:])):
            start, length = np.transpose([longest_run(row < -self.DARKER) for row in cells])
            tall = altitude * self.CELL_M * length > self.TALL_M * (start + length)
            tall |= (length >= 4) & (start + length >= CELLS - 1)  # it goes on beyond the swath
            first, rows = longest_run(tall)
            if rows >= self.ROWS and 1 <= first <= 5:  # later it has been found already
                shadow = int(np.median(start[first:first + rows]))
                echo = max(0, shadow - 12)
                bright = (cells[first:first + rows, echo:shadow] > self.BRIGHTER).any(axis=0)
                echo += int(np.argmax(bright)) if bright.any() else 8
                slant_m = self.CELL_M * (echo + shadow + 1.5) / 2
                across_m = np.sqrt(max(0.0, slant_m ** 2 - (altitude * self.CELL_M - 0.75) ** 2))
                return -(first + rows / 2 + 0.5) * self.ROW_M, side * across_m
        return None


def longest_run(true: np.ndarray) -> tuple:
    """Where the longest row of trues begins, and how long it is."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], true.astype(np.int8), [0]])))
    starts, lengths = edges[::2], edges[1::2] - edges[::2]
    at = np.argmax(lengths) if lengths.size else 0
    return (int(starts[at]), int(lengths[at])) if lengths.size else (0, 0)
