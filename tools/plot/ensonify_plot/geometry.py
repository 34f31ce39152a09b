"""Where a sample stands in a picture: beams and ranges in a plane, slant range over ground, pings over time.

Pure functions. Rays are straight, at the sound speed that the head knows; bottoms are level. Arrays of power (mean squares)
come in and go out: means of power are what levels are made of.
"""
import numpy as np


def beam_edges_rad(angle_rad: np.ndarray) -> np.ndarray:
    """Borders between beams in rising order, one more than there are beams: half way between axes; the outermost beams reach as
    far out as in. A single beam is drawn 2 degrees wide."""
    angle = np.sort(np.asarray(angle_rad, float))
    if len(angle) == 1:
        return angle[0] + np.radians([-1.0, 1.0])
    middle = (angle[1:] + angle[:-1]) / 2
    return np.concatenate([[2 * angle[0] - middle[0]], middle, [2 * angle[-1] - middle[-1]]])


def beam_at(angle_rad: np.ndarray, wanted_rad: np.ndarray) -> np.ndarray:
    """Index of the beam whose sector holds each angle, whole turns apart or not, -1 outside the fan."""
    edges = beam_edges_rad(angle_rad)
    sector = np.searchsorted(edges, edges[0] + np.mod(np.asarray(wanted_rad) - edges[0], 2 * np.pi), side="right") - 1
    inside = (sector >= 0) & (sector < len(angle_rad))
    return np.where(inside, np.argsort(angle_rad, kind="stable")[np.where(inside, sector, 0)], -1)


def sample_at(range_m: np.ndarray, first_range_m: float, step_m: float, samples: int) -> np.ndarray:
    """Index of the nearest sample, -1 where there is none within half a step."""
    sample = np.floor((range_m - first_range_m) / step_m + 0.5).astype(np.int64)
    return np.where((sample >= 0) & (sample < samples), sample, -1)


def polar_image(power: np.ndarray, angle_rad, first_range_m: float, step_m: float, across_m, along_m) -> np.ndarray:
    """Beam x sample `power` at the points (across, along), NaN where no beam points. Angles count from the along axis (down for
    a fan, forward for a forward-looking head), positive to starboard."""
    across, along = np.broadcast_arrays(across_m, along_m)
    beam = beam_at(np.asarray(angle_rad, float), np.arctan2(across, along))
    sample = sample_at(np.hypot(across, along), first_range_m, step_m, power.shape[1])
    return np.where((beam >= 0) & (sample >= 0), power[beam, sample], np.nan)


def polar_bounds_m(angle_rad, nearest_m: float, farthest_m: float) -> tuple:
    """Least and greatest across, least and greatest along of a fan between two ranges."""
    edges = beam_edges_rad(angle_rad)
    rim = np.linspace(edges[0], edges[-1], 721)
    across, along = (np.outer((nearest_m, farthest_m), part) for part in (np.sin(rim), np.cos(rim)))
    return across.min(), across.max(), along.min(), along.max()


def thinned(power: np.ndarray, first_range_m: float, step_m: float, finest_m: float) -> tuple:
    """(power, first range, step) with so many samples averaged into one that the step comes close to `finest_m` from below: a
    picture shows no more, and leaving samples out instead would lose targets."""
    block = max(1, int(finest_m / step_m))
    samples = power.shape[1] // block * block
    if block == 1 or samples == 0:
        return power, first_range_m, step_m
    means = power[:, :samples].reshape(len(power), -1, block).mean(axis=2)
    return means, first_range_m + (block - 1) / 2 * step_m, block * step_m


def ground_range_m(slant_range_m, altitude_m):
    """sqrt(R^2 - H^2) over a level bottom; 0 in the water column."""
    return np.sqrt(np.maximum(np.square(slant_range_m) - np.square(altitude_m), 0.0))


def slant_range_m(ground_range_m, altitude_m):
    """Its inverse, sqrt(X^2 + H^2)."""
    return np.hypot(ground_range_m, altitude_m)


def ground_line(power: np.ndarray, first_range_m: float, step_m: float, altitude_m: float, cell_m: float, cells: int):
    """One side of a waterfall over ground range: cell j reaches from j to j + 1 times `cell_m` and gets the mean power of the
    samples that fall in it, or the sample nearest to its centre where none does; NaN where there is none. Altitude 0 leaves
    slant range. As `kernels/acoustics/detect/bottom_track.h` does it."""
    range_m = first_range_m + np.arange(len(power)) * step_m
    on_ground = range_m >= altitude_m
    cell = np.floor(ground_range_m(range_m, altitude_m) / cell_m).astype(np.int64)
    chosen = on_ground & (cell < cells)
    count = np.bincount(cell[chosen], minlength=cells)
    total = np.bincount(cell[chosen], power[chosen], cells)
    nearest = sample_at(slant_range_m((np.arange(cells) + 0.5) * cell_m, altitude_m), first_range_m, step_m, len(power))
    alone = np.where(nearest >= 0, power[nearest], np.nan)
    return np.where(count > 0, total / np.maximum(count, 1), alone)


def vertical_rad(enu_from_head) -> float:
    """Angle in the head's athwartships plane from its down axis to the vertical, positive to starboard: the beam of this angle
    points straight down. `enu_from_head` is a quaternion w, x, y, z."""
    w, x, y, z = enu_from_head
    # World down (0, 0, -1) in head axes: minus the third row of the rotation's matrix.
    starboard, down = -2 * (y * z + w * x), -(1 - 2 * (x * x + y * y))
    return float(np.arctan2(starboard, down))


def ping_of_rows(along: np.ndarray, most: int, t_s: np.ndarray | None = None) -> tuple:
    """(index of the ping in each row, -1 in a gap; first and last place) of an image with rows of equal time or distance, `most` at most. A
    ping stands in the rows nearest to it. Where pings are more than three of their median intervals apart, in time where `t_s` is given,
    rows more than one and a half from both are a gap."""
    along = np.asarray(along, float)
    if len(along) == 1:
        return np.zeros(1, int), along[0] - 0.5, along[0] + 0.5
    steps = np.diff(along)
    t_s = along if t_s is None else np.asarray(t_s, float)
    interval = float(np.median(steps))
    begin, end = along[0] - interval / 2, along[-1] + interval / 2
    rows = int(np.clip(round((end - begin) / interval), 1, most))
    centre = begin + (np.arange(rows) + 0.5) * (end - begin) / rows
    ping = np.searchsorted((along[1:] + along[:-1]) / 2, centre)
    # Half way to its neighbours a ping stands everywhere, however fast the head went; across a gap in time it does not.
    reach = np.where(np.diff(t_s) > 3 * np.median(np.diff(t_s)), 1.5 * interval, steps)
    before, after = np.concatenate([[interval], reach]), np.concatenate([reach, [interval]])
    off = centre - along[ping]
    return np.where(np.where(off < 0, -off <= before[ping], off <= after[ping]), ping, -1), begin, end


def grouped(values: np.ndarray, size: int) -> np.ndarray:
    """Means over successive groups of `size` rows (the last may hold fewer), NaN values left out; NaN where all are."""
    starts = np.arange(0, len(values), size)
    known = np.isfinite(values)
    count = np.add.reduceat(known.astype(np.int64), starts, axis=0)
    total = np.add.reduceat(np.where(known, values, 0.0), starts, axis=0)
    return np.where(count > 0, total / np.maximum(count, 1), np.nan)
