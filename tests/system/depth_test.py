"""Depth against truth can fail: what should spoil a survey does, by the amount that it should."""
import math
import unittest

import ensonify
import numpy as np
from support import SOURCE, SystemTest

LAUNCH = f"""
ensonify: launch/1
scenario: {SOURCE}/scenarios/bay/scenario.yaml
duration_s: 4
clock: {{ rate: free }}
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
  bow:   {{ run: multibeam, config: {{ amplitude_every: 100 }} }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: [bow/soundings, pager/tile] }} }}
"""


class Depth(SystemTest):
    def errors(self, out, *options):
        """Up-errors of all accepted soundings against the true tiles, and the share accepted."""
        result = self.run_launch(LAUNCH, *options, out=out, timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        errors, accepted, beams = [], 0, 0
        with ensonify.Record(result.out / "run.mcap") as record:
            tiles = [tile for _, _, tile in record.messages("pager/tile")]
            for _, _, soundings in record.messages("bow/soundings"):
                valid = np.asarray(soundings.valid, bool)
                accepted, beams = accepted + valid.sum(), beams + valid.size
                position = np.asarray(soundings.position_enu_m)[valid]
                errors.append(position[:, 2] - true_height(tiles, position))
        self.assertGreater(beams, 2500)  # ten pings: without a bottom the head waits its whole range
        errors = np.concatenate(errors)
        return errors[np.isfinite(errors)], accepted / beams

    def test_a_healthy_survey_is_right(self):
        errors, accepted = self.errors("healthy")
        self.assertGreater(accepted, 0.95)
        # A few centimetres a sounding average out over 10,000; what stays is the vertical noise of the position, common
        # to all beams: centimetres at 5 Hz, of which the estimate's filter leaves a slow part over these 4 s.
        self.assertLess(abs(np.median(errors)), 0.06)
        self.assertLess(np.percentile(np.abs(errors), 95), 0.15)

    def test_a_metre_of_lever_arm_error_shows_as_a_metre(self):
        true_up, _ = self.errors("right")
        # The measured mounting says 1 m deeper than the actual: soundings come out 1 m too deep (cosine of 3 degrees roll).
        wrong_up, _ = self.errors("wrong", "--set", "vehicles.boat.mountings.bow.measured.position_m=[1.5, 0.2, 1.8]")
        self.assertAlmostEqual(np.median(true_up) - np.median(wrong_up), 1.0, delta=1 - math.cos(math.radians(3)) + 0.01)

    def test_a_source_level_of_minus_200_db_yields_no_soundings(self):
        errors, accepted = self.errors("silent", "--set", "bow.source_level_db=-200")
        self.assertEqual((len(errors), accepted), (0, 0))


def true_height(tiles, position):
    """Bilinear height of the true seabed at each east, north; NaN outside the tiles."""
    height = np.full(len(position), np.nan)
    for tile in tiles:
        grid = np.asarray(tile.height_m)
        x = (position[:, 0] - tile.origin_east_m) / tile.spacing_m
        y = (position[:, 1] - tile.origin_north_m) / tile.spacing_m
        inside = (x >= 0) & (y >= 0) & (x < grid.shape[1] - 1) & (y < grid.shape[0] - 1)
        col, row = x[inside].astype(int), y[inside].astype(int)
        u, v = x[inside] - col, y[inside] - row
        height[inside] = ((grid[row, col] * (1 - u) + grid[row, col + 1] * u) * (1 - v)
                          + (grid[row + 1, col] * (1 - u) + grid[row + 1, col + 1] * u) * v)
    return height


if __name__ == "__main__":
    unittest.main(verbosity=2)
