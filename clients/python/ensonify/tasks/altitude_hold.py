"""Keep an AUV 6 m above hills, by an altimeter that points down and a pressure sensor.

The reward of a step is 1 at 6 m, 0 from 3 m of error on. Below 1 m the episode ends. 60 s are 600 steps."""
import pathlib
from typing import Any

import numpy as np

from ensonify.environment import Env
from ensonify.episode import Seen
from ensonify.messages import Altitude, Depth, Estimate, Guidance
from ensonify.acts import Act
from ensonify.spaces import Array, Box, Fields
from ensonify.tasks.profile import Profile

ALTITUDE_M = 6.0  # to keep
TOLERATED_M = 3.0  # error of the altitude that still earns something
LEAST_M = 1.0
STEP_M = 2.0  # an action of 1 orders a depth so much greater than the present
SPEED_MPS = 1.5


def order(action: np.ndarray, seen: Seen) -> Guidance:
    """The depth that an action asks for, straight ahead."""
    depth_m = max(0.5, seen["nav/depth"].depth_m + STEP_M * float(action[0]))
    return Guidance(stamp_ns=seen.t_ns, heading_grid_rad=0.0, speed_mps=SPEED_MPS, depth_m=depth_m)


def reward(seen: Seen) -> float:
    """By the altimeter without errors."""
    altitude = seen["judge/altitude"]
    return max(0.0, 1.0 - abs(altitude.range_m - ALTITUDE_M) / TOLERATED_M) if altitude.valid else 0.0


def done(seen: Seen) -> bool:
    """Too near to the seabed."""
    altitude = seen["judge/altitude"]
    return altitude.valid and altitude.range_m < LEAST_M


def climb(estimate: Estimate) -> list:
    """Vertical speed, up, in m/s."""
    return [estimate.velocity_enu_mps[2]]


class AltitudeHold(Env):
    """Ensonify/AltitudeHold-v0. Keywords are Env's, to change it."""

    def __init__(self, **changes: Any):
        super().__init__(**{
            "launch": pathlib.Path(__file__).with_name("altitude_hold.yaml"),
            "observe": {"nav/altitude": Fields(Altitude, "range_m", "valid"), "nav/depth": Fields(Depth, "depth_m"),
                        "nav/estimate": Array(Estimate, climb, Box(-np.inf, np.inf, (1,), np.float64))},
            "act": Act(Guidance, order, Box(-1, 1, (1,), np.float32)),
            "truth": {"judge/altitude": Altitude},
            "reward": reward,
            "done": done,
            "seconds": 60,
            "image": Profile(),
            "hosted": True,
            **changes})


class Baseline:
    """A classical controller: dives in proportion to what the last valid altitude is too large."""

    def __init__(self, gain_per_m: float = 0.5):
        self._gain_per_m = gain_per_m
        self._altitude_m = ALTITUDE_M

    def __call__(self, observation: dict) -> np.ndarray:
        if observation["nav/altitude/valid"][0]:
            self._altitude_m = observation["nav/altitude/range_m"][0]
        return np.clip([self._gain_per_m * (self._altitude_m - ALTITUDE_M)], -1, 1).astype(np.float32)
