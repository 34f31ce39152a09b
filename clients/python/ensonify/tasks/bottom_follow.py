"""Follow rough relief at 4 m and get on, by an altimeter that points down and one that points ahead and down.

The reward of a step is the way made, 1 at 1.5 m/s, times 1 at 4 m of altitude, 0 from 3 m of error on. Below 0.5 m the episode
ends. 60 s are 600 steps."""
import pathlib
from typing import Any

import numpy as np

from ensonify.environment import Env
from ensonify.episode import Seen
from ensonify.messages import Altitude, Depth, Estimate, Guidance, Pose
from ensonify.acts import Act
from ensonify.spaces import Array, Box, Fields
from ensonify.tasks.profile import Profile

ALTITUDE_M = 4.0  # to keep
TOLERATED_M = 3.0  # error of the altitude that still earns something
LEAST_M = 0.5
STEP_M = 2.0  # an action of 1 orders a depth so much greater than the present
SPEED_MPS = 1.5  # that earns 1
SLOWEST_MPS, FASTEST_MPS = 0.5, 2.0  # actions of -1 and 1
AHEAD_COS = np.cos(np.radians(45))  # of the beam that points ahead, from the vertical


def order(action: np.ndarray, seen: Seen) -> Guidance:
    """Depth and speed that an action asks for, straight ahead."""
    depth_m = max(0.5, seen["nav/depth"].depth_m + STEP_M * float(action[0]))
    speed_mps = SLOWEST_MPS + (FASTEST_MPS - SLOWEST_MPS) * (1 + float(action[1])) / 2
    return Guidance(stamp_ns=seen.t_ns, heading_grid_rad=0.0, speed_mps=speed_mps, depth_m=depth_m)


def reward(seen: Seen) -> float:
    """By the altimeter without errors and the true speed north."""
    altitude = seen["judge/altitude"]
    near = max(0.0, 1.0 - abs(altitude.range_m - ALTITUDE_M) / TOLERATED_M) if altitude.valid else 0.0
    return near * seen["auv/pose"].velocity_enu_mps[1] / SPEED_MPS


def done(seen: Seen) -> bool:
    """Too near to the seabed."""
    altitude = seen["judge/altitude"]
    return altitude.valid and altitude.range_m < LEAST_M


def way(estimate: Estimate) -> tuple:
    """Speed north and up, in m/s."""
    return estimate.velocity_enu_mps[1:]


class BottomFollow(Env):
    """Ensonify/BottomFollow-v0. Keywords are Env's, to change it."""

    def __init__(self, **changes: Any):
        super().__init__(**{
            "launch": pathlib.Path(__file__).with_name("bottom_follow.yaml"),
            "observe": {"nav/altitude": Fields(Altitude, "range_m", "valid"), "ahead/altitude": Fields(Altitude, "range_m", "valid"),
                        "nav/depth": Fields(Depth, "depth_m"),
                        "nav/estimate": Array(Estimate, way, Box(-np.inf, np.inf, (2,), np.float64))},
            "act": Act(Guidance, order, Box(-1, 1, (2,), np.float32)),
            "truth": {"judge/altitude": Altitude, "auv/pose": Pose},
            "reward": reward,
            "done": done,
            "seconds": 60,
            "image": Profile(),
            "hosted": True,
            **changes})


class Baseline:
    """A classical controller: dives in proportion to what the lesser of both altitudes is too large, and slows down for a
    slope ahead."""

    def __init__(self, gain_per_m: float = 0.5, slow_per_m: float = 0.6, cruise: float = 1.0):
        self._gain_per_m, self._slow_per_m, self._cruise = gain_per_m, slow_per_m, cruise
        self._below_m = self._ahead_m = ALTITUDE_M

    def __call__(self, observation: dict) -> np.ndarray:
        if observation["nav/altitude/valid"][0]:
            self._below_m = observation["nav/altitude/range_m"][0]
        if observation["ahead/altitude/valid"][0]:
            self._ahead_m = observation["ahead/altitude/range_m"][0] * AHEAD_COS
        down = self._gain_per_m * (min(self._below_m, self._ahead_m) - ALTITUDE_M)
        faster = self._cruise + self._slow_per_m * min(0.0, self._ahead_m - ALTITUDE_M)
        return np.clip([down, faster], -1, 1).astype(np.float32)
