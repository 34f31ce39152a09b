"""What an action publishes."""
import math
from typing import Any, Callable, Mapping

import gymnasium
import numpy as np

from ensonify.arguments import one_of
from ensonify.messages import Altitude, Depth, Estimate, Guidance
from ensonify.typed import Message

Box = gymnasium.spaces.Box


class Act:
    """What an agent publishes: a function makes a message of the action, which is in `space`, and of what was seen last.
    `reads` are topics and message types that the function reads, observed or not."""

    def __init__(self, message_type: type, function: Callable[[np.ndarray, Any], Message], space: Box, *, port: str = "command",
                 reads: Mapping[str, type] | None = None):
        self.message_type = message_type
        self.function = function
        self.space = one_of("the space of an Act", space, (Box,), "a gymnasium.spaces.Box")
        self.port = port
        self.reads = dict(reads or {})


def steer(*, heading_rad: Any = 0.0, speed_mps: Any = 1.0, depth_m: Any = None, altitude_m: Any = None,
          altimeter: str = "nav/altitude", depth_sensor: str = "nav/depth") -> Act:
    """Guidance: grid heading, speed through the water, and the depth below the water level or the altitude above the seabed.
    Each is (least, most), and then one number of the action, in this order, or fixed. An altitude is turned into a depth by
    what the two instruments measured last, at each step; without an answer of the altimeter the depth stays. With neither
    depth nor altitude it stays, too."""
    level = Level(depth_m, altitude_m, altimeter, depth_sensor)
    return guidance({"heading_grid_rad": heading_rad, "speed_mps": speed_mps, **level.given}, level.reads, level.depth,
                    "heading_rad, speed_mps, depth_m and altitude_m")


def goto(*, east_m: Any, north_m: Any, speed_mps: Any = 1.0, depth_m: Any = None, altitude_m: Any = None, estimate: str = "nav/estimate",
         altimeter: str = "nav/altitude", depth_sensor: str = "nav/depth") -> Act:
    """Guidance towards a waypoint of the world frame, from where the navigation estimate says that the vehicle is; it does not
    stop there. Otherwise as steer."""
    level = Level(depth_m, altitude_m, altimeter, depth_sensor)

    def heading(order: dict, seen: Any) -> dict:
        east_m, north_m, *_ = seen[estimate].position_enu_m
        heading_rad = math.atan2(order.pop("east_m") - east_m, order.pop("north_m") - north_m)
        return {**level.depth(order, seen), "heading_grid_rad": heading_rad}

    return guidance({"east_m": east_m, "north_m": north_m, "speed_mps": speed_mps, **level.given}, {estimate: Estimate, **level.reads}, heading,
                    "east_m, north_m, speed_mps, depth_m and altitude_m")


class Level:
    """The depth of an order, by itself or from an altitude."""

    def __init__(self, depth_m: Any, altitude_m: Any, altimeter: str, depth_sensor: str):
        if depth_m is not None and altitude_m is not None:
            raise ValueError("an order has depth_m or altitude_m, not both")
        self._altimeter, self._depth_sensor = altimeter, depth_sensor
        self.given = {"depth_m": math.nan if depth_m is None else depth_m} if altitude_m is None else {"altitude_m": altitude_m}
        self.reads = {} if altitude_m is None else {altimeter: Altitude, depth_sensor: Depth}

    def depth(self, order: dict, seen: Any) -> dict:
        """The order with a depth in place of the altitude."""
        if "altitude_m" not in order:
            return order
        rest = {name: value for name, value in order.items() if name != "altitude_m"}
        measured = seen[self._altimeter]
        depth_m = seen[self._depth_sensor].depth_m + measured.range_m - order["altitude_m"] if measured.valid else math.nan
        return {**rest, "depth_m": depth_m}


def guidance(given: Mapping[str, Any], reads: Mapping[str, type], complete: Callable[[dict, Any], dict], names: str) -> Act:
    """An Act whose action has those of `given` that are ranges; `complete` makes fields of guidance of all."""
    chosen = {name: value for name, value in given.items() if isinstance(value, tuple)}
    fixed = {name: value for name, value in given.items() if name not in chosen}
    if not chosen:
        raise ValueError(f"an action has at least one of {names} as (least, most)")
    least, most = np.array(list(chosen.values()), np.float32).T

    def function(action: np.ndarray, seen: Any) -> Guidance:
        return Guidance(stamp_ns=seen.t_ns, **complete({**fixed, **dict(zip(chosen, map(float, action)))}, seen))

    return Act(Guidance, function, Box(least, most, dtype=np.float32), reads=reads)
