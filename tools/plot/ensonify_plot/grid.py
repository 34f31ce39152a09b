"""Soundings on a grid: cell size, mean and count per cell, outline and coverage."""
from dataclasses import dataclass

import numpy as np

CELL_SIZES_M = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)
MIN_COUNT = 3  # soundings that a well-filled cell holds ...
WELL_FILLED = 0.9  # ... and the share of the cells with soundings that are; the rest is the rim of the swath
MAX_CELLS = 20_000_000


@dataclass(frozen=True)
class Frame:
    """Cells of `cell_m`, row 0 in the south, edges on whole multiples of the cell size."""

    west_m: float
    south_m: float
    cell_m: float
    cols: int
    rows: int
    origin: tuple | None = None  # latitude and longitude of the world's, degrees: maps bear these instead of metres

    @property
    def extent_m(self) -> tuple:
        """West, east, south, north: matplotlib's order."""
        return (self.west_m, self.west_m + self.cols * self.cell_m, self.south_m, self.south_m + self.rows * self.cell_m)

    def index(self, east_m, north_m) -> np.ndarray:
        """Flat cell index of points inside."""
        col = np.floor((east_m - self.west_m) / self.cell_m).astype(np.int64)
        row = np.floor((north_m - self.south_m) / self.cell_m).astype(np.int64)
        return np.clip(row, 0, self.rows - 1) * self.cols + np.clip(col, 0, self.cols - 1)

    def centres(self) -> tuple:
        """East and north of every cell's centre, each rows x cols."""
        east = self.west_m + (np.arange(self.cols) + 0.5) * self.cell_m
        north = self.south_m + (np.arange(self.rows) + 0.5) * self.cell_m
        return np.meshgrid(east, north)


def frame_around(east_m, north_m, cell_m: float, origin: tuple | None = None) -> Frame:
    """The smallest frame around all points."""
    west, south = (np.floor(x.min() / cell_m) * cell_m for x in (east_m, north_m))
    cols, rows = (int(np.floor((x.max() - low) / cell_m)) + 1 for x, low in ((east_m, west), (north_m, south)))
    return Frame(float(west), float(south), cell_m, cols, rows, origin)


def cells_of(east_m, north_m, cell_m: float) -> float:
    """How many cells a frame around the points has."""
    return (np.ptp(east_m) / cell_m + 1) * (np.ptp(north_m) / cell_m + 1)


def choose_cell_m(east_m, north_m) -> float:
    """The finest size at which WELL_FILLED of the cells with soundings hold MIN_COUNT of them."""
    for cell_m in CELL_SIZES_M:
        if cells_of(east_m, north_m, cell_m) > MAX_CELLS:
            continue
        frame = frame_around(east_m, north_m, cell_m)
        count = np.bincount(frame.index(east_m, north_m), minlength=frame.cols * frame.rows)
        filled = count > 0
        if np.count_nonzero(count >= MIN_COUNT) >= WELL_FILLED * np.count_nonzero(filled):
            return cell_m
    return CELL_SIZES_M[-1]


class Gridder:
    """Means over the soundings of each cell."""

    def __init__(self, frame: Frame, east_m, north_m):
        self.frame = frame
        self._index = frame.index(east_m, north_m)
        self.count = self._shaped(np.bincount(self._index, minlength=frame.cols * frame.rows))

    def _shaped(self, flat):
        return flat.reshape(self.frame.rows, self.frame.cols)

    def mean(self, values) -> np.ndarray:
        """NaN where there is no sounding; NaN values are left out."""
        known = np.isfinite(values)
        cells = self.frame.cols * self.frame.rows
        index, values = (self._index, values) if known.all() else (self._index[known], values[known])
        total = self._shaped(np.bincount(index, values, cells))
        count = self.count if known.all() else self._shaped(np.bincount(index, minlength=cells))
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.where(count > 0, total / count, np.nan)


def outline(frame: Frame, covered: np.ndarray) -> np.ndarray:
    """Convex hull, counter-clockwise, of the covered cells' centres: points x 2, east and north."""
    points = []
    for row in np.flatnonzero(covered.any(axis=1)):
        cols = np.flatnonzero(covered[row])
        points += [(cols[0], row), (cols[-1], row)]
    points = sorted(set(points))
    hull = _half_hull(points)[:-1] + _half_hull(points[::-1])[:-1]
    cells = np.array(hull if len(hull) > 2 else points, float).reshape(-1, 2)
    return (cells + 0.5) * frame.cell_m + (frame.west_m, frame.south_m)


def _half_hull(points):
    """Andrew's monotone chain."""
    chain = []
    for x, y in points:
        while len(chain) > 1 and ((chain[-1][0] - chain[-2][0]) * (y - chain[-2][1]) <=
                                  (chain[-1][1] - chain[-2][1]) * (x - chain[-2][0])):
            chain.pop()
        chain.append((x, y))
    return chain


def inside(frame: Frame, hull: np.ndarray) -> np.ndarray:
    """Which cells' centres lie in the convex hull, its border included."""
    east, north = frame.centres()
    within = np.ones(east.shape, bool)
    slack = 1e-6 * frame.cell_m
    for (x0, y0), (x1, y1) in zip(hull, np.roll(hull, -1, axis=0)):
        within &= (x1 - x0) * (north - y0) - (y1 - y0) * (east - x0) >= -slack * np.hypot(x1 - x0, y1 - y0)
    return within
