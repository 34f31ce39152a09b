#!/usr/bin/env python3
"""An agent that steers by the pings it receives: it follows a depth contour along a slope, the shallow side to port.

  ensonify run launch/agent.yaml

It sees beam time series and the navigation estimate, nothing else: no soundings, no truth. From the first strong echo of
each beam it makes points on the seabed, lays a plane through those of the last pings, and steers along the plane's contour
towards the wanted depth. Parameters (`config:` in the launch file): depth_m, speed_mps, head_down_m (of the head, below the
vehicle's reference point), and blind: true, which zeroes the pings before it uses them: the control that shows that it
needs them.
"""
import collections

import numpy as np

import ensonify

SWATH_RAD = np.radians(45)  # farther out an echo says little about depth
NEAREST_M = 2.0  # what comes back sooner is the surface above the head
STRONG = 10.0  # times the median of its beam
PINGS = 20  # that the plane is laid through
LOOK_AHEAD_M = 15.0  # the larger, the gentler the approach
FLATTEST = np.tan(np.radians(0.5))  # a slope on which a contour means something


def rotation(wxyz) -> np.ndarray:
    """enu_from_body as a matrix."""
    w, x, y, z = wxyz
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def seabed_points(ping: ensonify.Ping, amplitude_upa: np.ndarray, pose: ensonify.Estimate, head_down_m: float) -> np.ndarray:
    """Where each beam's first strong echo came from: points x 3, world frame, metres."""
    metres_per_sample = ping.sample_period_s * ping.sound_speed_mps / 2
    nearest = max(0, int(np.ceil(NEAREST_M / metres_per_sample - ping.first_sample_s / ping.sample_period_s)))
    amplitude_upa = amplitude_upa[:, nearest:]
    peak = amplitude_upa.max(axis=1)
    angle = ping.beam_angle_rad
    strong = (np.abs(angle) <= SWATH_RAD) & (peak > 0) & (peak > STRONG * np.median(amplitude_upa, axis=1))
    first = (amplitude_upa[strong] >= 0.5 * peak[strong, None]).argmax(axis=1)
    range_m = ping.first_sample_s * ping.sound_speed_mps / 2 + (nearest + first) * metres_per_sample
    along_beam = np.stack([np.zeros(range_m.size), np.sin(angle[strong]), np.cos(angle[strong])], axis=1)  # body, FRD
    return np.array(pose.position_enu_m) + (along_beam * range_m[:, None] + [0, 0, head_down_m]) @ rotation(pose.enu_from_body).T


def plane_below(points: np.ndarray, place_enu_m) -> tuple:
    """Depth below chart datum at a place, and the depth's gradient (east, north), of the plane nearest to the points."""
    east, north = points[:, 0] - place_enu_m[0], points[:, 1] - place_enu_m[1]
    a = np.stack([np.ones(len(points)), east, north], axis=1)
    depth_m, *gradient = np.linalg.lstsq(a, -points[:, 2], rcond=None)[0]
    return depth_m, np.array(gradient)


def heading_along_contour(depth_m: float, gradient: np.ndarray, wanted_m: float) -> float:
    """Grid heading along the contour with the shallow side to port, turned towards the wanted depth."""
    downhill_rad = np.arctan2(gradient[0], gradient[1])
    distance_m = (depth_m - wanted_m) / np.hypot(*gradient)  # to the contour, positive when it lies to port
    return downhill_rad - np.pi / 2 - np.arctan2(distance_m, LOOK_AHEAD_M)


def steer(me: ensonify.Participant, pings: ensonify.In, estimates: ensonify.In, command: ensonify.Out) -> None:
    """One epoch: nothing is known of the seabed at its beginning."""
    wanted_m = me.config.get("depth_m", 18.0)
    speed_mps = me.config.get("speed_mps", 2.0)
    head_down_m = me.config.get("head_down_m", 0.0)
    blind = me.config.get("blind", False)
    poses = collections.deque(maxlen=200)  # the last two seconds
    seen = collections.deque(maxlen=PINGS)
    heading_rad = None
    for step in me.steps(rate=10):
        poses.extend(estimates)
        for ping in pings:
            pose = min(poses, key=lambda estimate: abs(estimate.stamp_ns - ping.stamp_ns))
            amplitude_upa = np.zeros_like(ping.amplitude_upa) if blind else ping.amplitude_upa
            seen.append(seabed_points(ping, amplitude_upa, pose, head_down_m))
        points = np.concatenate(seen) if seen else np.empty((0, 3))
        if len(seen) == PINGS and len(points) > 100:
            depth_m, gradient = plane_below(points, poses[-1].position_enu_m)
            if np.hypot(*gradient) > FLATTEST:
                heading_rad = heading_along_contour(depth_m, gradient, wanted_m)
        if heading_rad is None and poses:  # nothing seen yet: straight on
            forward = rotation(poses[-1].enu_from_body)[:, 0]
            heading_rad = np.arctan2(forward[0], forward[1])
        if heading_rad is not None:
            command.send(ensonify.Guidance(stamp_ns=step.t_ns, heading_grid_rad=heading_rad, speed_mps=speed_mps))


def main() -> None:
    with ensonify.Participant() as me:
        pings = me.subscribe("ping", ensonify.Ping)
        estimates = me.subscribe("estimate", ensonify.Estimate)
        command = me.publish("command", ensonify.Guidance, rate=10)
        for _ in me.epochs():  # one, and another after each reset
            steer(me, pings, estimates, command)


if __name__ == "__main__":
    main()
