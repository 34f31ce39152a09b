"""Keep a boat 10 m from a quay to starboard, by the images of a sonar that looks ahead.

The reward of a step is 1 at 10 m, 0 from 4 m of error on, times the way made along the wall, 1 at 1 m/s. Within 3 m of the wall the
episode ends. 60 s are 120 steps, each with an image. The seed also draws the distance at the start."""
import pathlib
from typing import Any

import numpy as np

from ensonify.environment import Env
from ensonify.episode import Seen
from ensonify.episodes import drawn_seed
from ensonify.images import grey
from ensonify.messages import Estimate, Guidance, Ping, Pose
from ensonify.acts import Act
from ensonify.spaces import Array, Box

DISTANCE_M = 10.0  # to keep
TOLERATED_M = 4.0  # error of the distance that still earns something
LEAST_M = 3.0
WALL_NORTH_M, WALL_HEADING_RAD = -20.0, np.pi / 2  # the quay's line, of launch/wall_follow.yaml
TURN_RAD = np.radians(30)  # an action of 1 orders a heading so much to starboard of the present
SPEED_MPS = 1.0
RANGE_M, HALF_FAN_RAD = 20.0, np.radians(65)  # of the head
DARK_DB, BRIGHT_DB = 80.0, 160.0  # re 1 uPa, from 0 to 255
SIZE = 64  # rows from near to far, columns from port to starboard


def image(ping: Ping) -> np.ndarray:
    """The strongest sample of each cell of range and beam, by level."""
    beams = ping.amplitude_upa[np.argsort(ping.beam_angle_rad, kind="stable")]
    range_m = (ping.first_sample_s + ping.sample_period_s * np.arange(beams.shape[1])) * 1480 / 2
    cell = np.minimum((range_m * SIZE / RANGE_M).astype(int), SIZE - 1)
    strongest = np.full((SIZE, SIZE), 1e-6, np.float32)
    np.maximum.at(strongest, cell, beams.T)
    level = (20 * np.log10(strongest) - DARK_DB) / (BRIGHT_DB - DARK_DB)
    return np.rint(255 * np.clip(level, 0, 1)).astype(np.uint8)


def heading_rad(enu_from_body: tuple) -> float:
    """Of the body's forward axis, from north over east."""
    w, x, y, z = enu_from_body
    return float(np.arctan2(1 - 2 * (y * y + z * z), 2 * (x * y + w * z)))


def course(estimate: Estimate) -> tuple:
    """Heading in rad and speed over ground in m/s."""
    return heading_rad(estimate.enu_from_body), np.hypot(*estimate.velocity_enu_mps[:2])


def order(action: np.ndarray, seen: Seen) -> Guidance:
    """The heading that an action asks for."""
    heading = heading_rad(seen["nav/estimate"].enu_from_body) + TURN_RAD * float(action[0])
    return Guidance(stamp_ns=seen.t_ns, heading_grid_rad=heading, speed_mps=SPEED_MPS, depth_m=float("nan"))


def distance_m(seen: Seen) -> float:
    """True distance to the quay's line."""
    return seen["boat/pose"].position_enu_m[1] - WALL_NORTH_M


def reward(seen: Seen) -> float:
    """By the true distance and the true speed along the wall."""
    near = max(0.0, 1.0 - abs(distance_m(seen) - DISTANCE_M) / TOLERATED_M)
    return near * seen["boat/pose"].velocity_enu_mps[0] / SPEED_MPS


def done(seen: Seen) -> bool:
    """Too near to the wall."""
    return distance_m(seen) < LEAST_M


class WallFollow(Env):
    """Ensonify/WallFollow-v0. Keywords are Env's, to change it."""

    def __init__(self, **changes: Any):
        super().__init__(**{
            "launch": pathlib.Path(__file__).with_name("wall_follow.yaml"),
            "observe": {"bow/ping": Array(Ping, image, Box(0, 255, (SIZE, SIZE), np.uint8)),
                        "nav/estimate": Array(Estimate, course, Box(-np.inf, np.inf, (2,), np.float64))},
            "act": Act(Guidance, order, Box(-1, 1, (1,), np.float32)),
            "truth": {"boat/pose": Pose},
            "reward": reward,
            "done": done,
            "rate": 2,
            "seconds": 60,
            "image": lambda seen: grey(image(seen["bow/ping"])[::-1]),
            "hosted": True,
            **changes})

    def reset(self, *, seed: int | None = None, options: dict | None = None) -> tuple:
        """As Env's, 8 to 13 m from the wall."""
        if seed is None:
            seed = drawn_seed(self.np_random)
        options = dict(options or {})
        north_m = WALL_NORTH_M + float(np.random.default_rng(seed).uniform(8, 13))
        options["set"] = {"vehicles.boat.start.position_m": [-60, north_m, 0], **options.get("set", {})}
        return super().reset(seed=seed, options=options)


class Baseline:
    """A classical controller: the strongest echo of each beam between 40 and 60 degrees to starboard is the wall; steers
    towards its line in proportion to what the median distance is too large."""

    def __init__(self, gain_radpm: float = 0.15):
        self._gain_radpm = gain_radpm

    def __call__(self, observation: dict) -> np.ndarray:
        picture, heading = observation["bow/ping"], observation["nav/estimate"][0]
        bearing = np.linspace(-HALF_FAN_RAD, HALF_FAN_RAD, SIZE)
        chosen = (bearing > np.radians(40)) & (bearing < np.radians(60))
        range_m = (picture[:, chosen].argmax(axis=0) + 0.5) * RANGE_M / SIZE
        distance = np.median(range_m * np.sin(bearing[chosen] + heading - WALL_HEADING_RAD))
        wanted = WALL_HEADING_RAD + np.clip(self._gain_radpm * (distance - DISTANCE_M), -0.5, 0.5)
        return np.clip([(wanted - heading) / TURN_RAD], -1, 1).astype(np.float32)
