"""Keep two AUVs 6 m above hills and 20 m from each other, by altimeter, pressure sensor and the array that finds the other.

Red goes to port, blue to starboard. An AUV's reward of a step is 1 at 6 m, 0 from 3 m of error on, times 1 at 20 m from the other, 0
from 5 m of error on. Below 1 m of altitude an AUV's episode ends, within 5 m of each other that of both. 60 s are 600 steps. The
seed also draws the start."""
import pathlib
from typing import Any

import numpy as np

from ensonify.agent import Agent
from ensonify.episode import Seen
from ensonify.episodes import drawn_seed
from ensonify.messages import Altitude, Depth, Guidance, Pose, UsblFix
from ensonify.parallel import ParallelEnv
from ensonify.acts import Act
from ensonify.spaces import Box, Fields

ALTITUDE_M, DISTANCE_M = 6.0, 20.0  # to keep
ALTITUDE_TOLERATED_M, DISTANCE_TOLERATED_M = 3.0, 5.0  # errors that still earn something
LEAST_ALTITUDE_M, LEAST_DISTANCE_M = 1.0, 5.0
STEP_M = 2.0  # an action of 1 orders a depth so much greater than the present
TURN_RAD = np.radians(30)  # an action of 1 orders a heading so much to starboard of north
SPEED_MPS = 1.5


def nearness(error_m: float, tolerated_m: float) -> float:
    """1 without an error, 0 from the tolerated on."""
    return max(0.0, 1.0 - abs(error_m) / tolerated_m)


def distance_m(seen: Seen) -> float:
    """True distance of the two."""
    return float(np.linalg.norm(np.subtract(seen["red/pose"].position_enu_m, seen["blue/pose"].position_enu_m)))


def auv(name: str) -> Agent:
    """One of the two, as an agent: it observes what its own instruments measure."""
    def order(action: np.ndarray, seen: Seen) -> Guidance:
        depth_m = max(0.5, seen[f"{name}_nav/depth"].depth_m + STEP_M * float(action[0]))
        return Guidance(stamp_ns=seen.t_ns, heading_grid_rad=TURN_RAD * float(action[1]), speed_mps=SPEED_MPS, depth_m=depth_m)

    def reward(seen: Seen) -> float:
        altitude = seen[f"{name}_judge/altitude"]
        near = nearness(altitude.range_m - ALTITUDE_M, ALTITUDE_TOLERATED_M) if altitude.valid else 0.0
        return near * nearness(distance_m(seen) - DISTANCE_M, DISTANCE_TOLERATED_M)

    def done(seen: Seen) -> bool:
        altitude = seen[f"{name}_judge/altitude"]
        return (altitude.valid and altitude.range_m < LEAST_ALTITUDE_M) or distance_m(seen) < LEAST_DISTANCE_M

    return Agent(observe={f"{name}_nav/altitude": Fields(Altitude, "range_m", "valid"),
                          f"{name}_nav/depth": Fields(Depth, "depth_m"),
                          f"{name}_nav/usbl": Fields(UsblFix, "range_m", "place_body_m", "valid")},
                 act=Act(Guidance, order, Box(-1, 1, (2,), np.float32)), reward=reward, done=done)


class KeepFormation(ParallelEnv):
    """Agents red and blue. Keywords are ParallelEnv's, to change it."""

    metadata = {"name": "keep_formation_v0", "render_modes": []}

    def __init__(self, **changes: Any):
        super().__init__(**{
            "launch": pathlib.Path(__file__).with_name("keep_formation.yaml"),
            "agents": {name: auv(name) for name in ("red", "blue")},
            "truth": {"red_judge/altitude": Altitude, "blue_judge/altitude": Altitude, "red/pose": Pose, "blue/pose": Pose},
            "seconds": 60,
            "hosted": True,
            **changes})

    def reset(self, seed: int | None = None, options: dict | None = None) -> tuple:
        """As ParallelEnv's, 16 to 24 m from each other, up to 3 m ahead or behind, up to 10 degrees off north."""
        if seed is None:
            seed = drawn_seed(self.np_random)
        drawn = np.random.default_rng(seed)
        east_m, north_m, heading_deg = drawn.uniform(8, 12, 2) * (-1, 1), drawn.uniform(-1.5, 1.5, 2), drawn.uniform(-10, 10, 2)
        start = {key: value for at, name in enumerate(("red", "blue")) for key, value in (
            (f"vehicles.{name}.start.position_m", [float(east_m[at]), -200 + float(north_m[at]), -20]),
            (f"vehicles.{name}.start.heading_deg", float(heading_deg[at])))}
        return super().reset(seed, {**(options or {}), "set": {**start, **(options or {}).get("set", {})}})


class Baseline:
    """A classical controller of one AUV: dives in proportion to what the last valid altitude is too large, and turns towards the
    other in proportion to what the last valid range is."""

    def __init__(self, gain_per_m: float = 0.5, turn_radpm: float = 0.05):
        self._gain_per_m, self._turn_radpm = gain_per_m, turn_radpm
        self._altitude_m, self._range_m, self._side = ALTITUDE_M, DISTANCE_M, 0.0

    def __call__(self, observation: dict) -> np.ndarray:
        seen = {key.split("/", 1)[1]: value for key, value in observation.items()}  # whatever the AUV's name
        if seen["altitude/valid"][0]:
            self._altitude_m = seen["altitude/range_m"][0]
        if seen["usbl/valid"][0]:
            self._range_m, self._side = seen["usbl/range_m"][0], np.sign(seen["usbl/place_body_m"][1])
        turn_rad = self._turn_radpm * (self._range_m - DISTANCE_M) * self._side
        return np.clip([self._gain_per_m * (self._altitude_m - ALTITUDE_M), turn_rad / TURN_RAD], -1, 1).astype(np.float32)
