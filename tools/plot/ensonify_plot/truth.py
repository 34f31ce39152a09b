"""The true seabed: tiles as one surface."""
import numpy as np


class Seabed:
    """Heights between the posts of tile/1 messages, bilinear as the head's mesh is to within a triangle."""

    def __init__(self, tiles: list):
        self._tiles = {(tile.col, tile.row): tile for tile in tiles}  # a tile sent again is the same tile
        spacings = {tile.spacing_m for tile in self._tiles.values()}
        shapes = {tile.height_m.shape for tile in self._tiles.values()}
        if len(spacings) > 1 or len(shapes) > 1:
            raise ValueError(f"tiles of several sizes: spacings {sorted(spacings)} m, shapes {sorted(shapes)}")
        self.spacing_m = spacings.pop() if spacings else None  # None: the record holds no tile

    def __bool__(self) -> bool:
        return bool(self._tiles)

    def height_m(self, east_m: np.ndarray, north_m: np.ndarray) -> np.ndarray:
        """Up from chart datum, NaN where no tile is or a post of the cell is a hole."""
        height = np.full(east_m.shape, np.nan)
        if not self._tiles:
            return height
        first = next(iter(self._tiles.values()))
        rows, cols = first.height_m.shape
        width_m, length_m = (cols - 1) * self.spacing_m, (rows - 1) * self.spacing_m
        col = np.floor((east_m - first.origin_east_m) / width_m).astype(np.int64) + first.col
        row = np.floor((north_m - first.origin_north_m) / length_m).astype(np.int64) + first.row
        for (tile_col, tile_row), tile in self._tiles.items():
            inside = np.flatnonzero((col == tile_col) & (row == tile_row))
            if inside.size:
                height.flat[inside] = self._in_tile(tile, east_m.flat[inside], north_m.flat[inside])
        return height

    def _in_tile(self, tile, east_m, north_m):
        rows, cols = tile.height_m.shape
        x = (east_m - tile.origin_east_m) / self.spacing_m
        y = (north_m - tile.origin_north_m) / self.spacing_m
        i = np.clip(np.floor(x).astype(np.intp), 0, cols - 2)
        j = np.clip(np.floor(y).astype(np.intp), 0, rows - 2)
        u, v = x - i, y - j
        h = tile.height_m
        south = h[j, i] * (1 - u) + h[j, i + 1] * u
        north = h[j + 1, i] * (1 - u) + h[j + 1, i + 1] * u
        return south * (1 - v) + north * v
