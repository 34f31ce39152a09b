"""A picture of a dive over the seabed, as altimeter and pressure sensor have measured it."""
import numpy as np

from ensonify.episode import Seen

COLUMNS, ROWS, DEEPEST_M = 300, 160, 40.0  # newest at the right; of the lowest row
WATER, SEABED, TRACK = (20, 40, 70), (150, 120, 80), (255, 255, 255)
DEPTH, ALTITUDE = "nav/depth", "nav/altitude"


class Profile:
    """The last 300 steps. An altimeter without an answer leaves a gap in the seabed."""

    keeps = {DEPTH: COLUMNS, ALTITUDE: COLUMNS}

    def __call__(self, seen: Seen) -> np.ndarray:
        picture = np.full((ROWS, COLUMNS, 3), WATER, np.uint8)
        row_m = (np.arange(ROWS) + 0.5) * DEEPEST_M / ROWS
        pairs = list(zip(reversed(seen.last(DEPTH)), reversed(seen.last(ALTITUDE))))
        for column, (depth, altitude) in zip(range(COLUMNS - 1, -1, -1), pairs):
            if altitude.valid:
                picture[row_m > depth.depth_m + altitude.range_m, column] = SEABED
            picture[np.abs(row_m - depth.depth_m) < 0.3, column] = TRACK
        return picture
