"""Outlines of masks, along the edges of their pixels: pixel (0, 0) covers [0, 1) x [0, 1)."""
import numpy as np


def box(mask: np.ndarray) -> tuple | None:
    """(x, y, width, height) of the smallest box round a mask, nothing of an empty one."""
    rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    if not rows.size:
        return None
    x, y = int(columns[0]), int(rows[0])
    return x, y, int(columns[-1]) + 1 - x, int(rows[-1]) + 1 - y


def rings(mask: np.ndarray) -> list:
    """Closed outlines (corners x 2: x, y), those of parts clockwise on the screen, those of holes the other way. Parts that touch
    at a corner only are apart."""
    padded = np.pad(mask.astype(bool), 1)
    here, above, left = padded[1:-1, 1:-1], padded[:-2, 1:-1], padded[1:-1, :-2]
    below, right = padded[2:, 1:-1], padded[1:-1, 2:]
    onward: dict = {}  # corner -> ends of the edges that leave it, the mask on their right
    for beside, start, end in ((above, (0, 0), (1, 0)), (right, (1, 0), (1, 1)), (below, (1, 1), (0, 1)), (left, (0, 1), (0, 0))):
        for y, x in zip(*np.nonzero(here & ~beside)):
            onward.setdefault((x + start[0], y + start[1]), []).append((x + end[0], y + end[1]))
    found = []
    while onward:
        first = next(iter(onward))
        corners, at, came = [first], first, None
        while True:
            ends = onward[at]
            step = ends[0]
            if len(ends) > 1 and came is not None:  # two parts touch: turn right, to stay on one
                right_turn = (at[0] - came[1], at[1] + came[0])
                step = right_turn if right_turn in ends else ends[0]
            ends.remove(step)
            if not ends:
                del onward[at]
            came, at = (step[0] - at[0], step[1] - at[1]), step
            if at == first:
                break
            corners.append(at)
        found.append(_without_straight(corners))
    return found


def _without_straight(corners: list) -> np.ndarray:
    """Without corners in the middle of a straight side."""
    ring = np.array(corners, np.float64)
    before, after = ring - np.roll(ring, 1, 0), np.roll(ring, -1, 0) - ring
    return ring[before[:, 0] * after[:, 1] != before[:, 1] * after[:, 0]]


def area(ring: np.ndarray) -> float:
    """Area inside a ring, negative of a hole's."""
    x, y = ring[:, 0], ring[:, 1]
    return 0.5 * float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def oriented_box(mask: np.ndarray) -> np.ndarray | None:
    """Corners (4 x 2) of the rectangle of least area round a mask, in order; nothing of an empty one."""
    if not mask.any():
        return None
    hull = _hull(np.concatenate(rings(mask)))
    best, least = None, np.inf
    for a, b in zip(hull, np.roll(hull, -1, 0)):  # one of its sides lies on a side of the hull
        along = (b - a) / np.hypot(*(b - a))
        turned = hull @ np.array([along, (-along[1], along[0])]).T
        low, high = turned.min(0), turned.max(0)
        if np.prod(high - low) < least:
            least = np.prod(high - low)
            corners = np.array([low, (high[0], low[1]), high, (low[0], high[1])])
            best = corners @ np.array([along, (-along[1], along[0])])
    return best


def _hull(points: np.ndarray) -> np.ndarray:
    """Convex hull (Andrew's chains)."""
    points = np.unique(points, axis=0)

    def half(of):
        chain: list = []
        for p in of:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return np.array(half(points) + half(points[::-1]))


def _turn(a, b, c) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
