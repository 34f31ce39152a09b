"""Soundings on a grid: cell size, mean and count per cell, outline and coverage."""
import os
import tempfile
from dataclasses import dataclass

import numpy as np
from osgeo import gdal

from ensonify_plot.programs import run_program

gdal.UseExceptions()

CELL_SIZES_M = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)
MIN_COUNT = 3  # soundings that a well-filled cell holds ...
WELL_FILLED = 0.9  # ... and the share of the cells with soundings that are; the rest is the rim of the swath
MAX_CELLS = 20_000_000
MEAN, COUNT = 1, 3  # bands of `ensonify grid`


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
    (west, east), (south, north) = ((int(np.floor(x.min() / cell_m)), int(np.floor(x.max() / cell_m))) for x in (east_m, north_m))
    return Frame(west * cell_m, south * cell_m, cell_m, east - west + 1, north - south + 1, origin)


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
    """Means over the soundings of each cell, as `ensonify grid` makes them."""

    def __init__(self, frame: Frame, east_m, north_m):
        self.frame = frame
        self._east_m, self._north_m = east_m, north_m
        self._count = None

    @property
    def count(self) -> np.ndarray:
        """Soundings of each cell."""
        if self._count is None:
            self._gridded(np.zeros(len(self._east_m)))
        return self._count

    def mean(self, values) -> np.ndarray:
        """NaN where there is no sounding; NaN values are left out."""
        return self._gridded(np.asarray(values, float))

    def _gridded(self, values: np.ndarray) -> np.ndarray:
        shape = self.frame.rows, self.frame.cols
        mean, count = np.full(shape, np.nan), np.zeros(shape, np.int64)
        known = np.isfinite(values)
        if known.any():
            points = np.stack([self._east_m, self._north_m, values, np.full(len(values), np.nan)], axis=1)[known]
            band, counted, (west_m, south_m) = _run(points, self.frame.cell_m)
            col, row = (round((at - low) / self.frame.cell_m)
                        for at, low in ((west_m, self.frame.west_m), (south_m, self.frame.south_m)))
            place = slice(row, row + band.shape[0]), slice(col, col + band.shape[1])
            mean[place], count[place] = band, counted
        if known.all():
            self._count = count
        return mean


def _run(points: np.ndarray, cell_m: float) -> tuple:
    """Means and numbers of points (x, y, value, NaN) in cells, row 0 in the south, and the west and south of the first."""
    with tempfile.TemporaryDirectory(prefix="ensonify-") as folder:
        file = os.path.join(folder, "grid.tif")
        run_program("grid", "--points", "-", "--cell", repr(cell_m), "--out", file, given=np.ascontiguousarray(points, "<f8").tobytes())
        raster = gdal.Open(file)
        mean = -raster.GetRasterBand(MEAN).ReadAsArray()[::-1].astype(float)  # elevations are its depths' negatives
        count = np.nan_to_num(raster.GetRasterBand(COUNT).ReadAsArray()[::-1])
        west_m, _, _, north_m, _, _ = raster.GetGeoTransform()
    return mean, count.astype(np.int64), (west_m, north_m - cell_m * mean.shape[0])


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
