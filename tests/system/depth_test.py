"""Depth against truth can fail: what should spoil a survey does, by the amount that it should."""
import math
import unittest

import ensonify
import numpy as np
from support import SystemTest, bay

SECONDS = 4  # of each survey


class Depth(SystemTest):
    def errors(self, out, *options):
        """Up-errors of all accepted soundings against the true tiles, and the share accepted."""
        result = self.run_launch(bay(SECONDS, topics="[bow/soundings, pager/tile]"), *options, out=out, timeout=120)
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
        # What is common to all beams: four standard deviations of the estimate's height, averaged over the run, and 2 mm by
        # which a footprint's curvature delays the echo of the middle beam: half its second moment times the second
        # derivative of the slant range, (h / 2) sigma^2 sec a (1 + 2 tan^2 a) cos a at h = 20 m, a = 32 degrees, sigma =
        # 1 degree / (2.355 cos a). A sounding's own noise averages out over 9,000.
        self.assertLess(abs(np.median(errors)), 4 * height_sd_m(SECONDS) + 0.002)
        # A sounding's own: at 65 degrees a beam of 1 / cos 65 degrees covers 4.2 m of slant range, 56 pulse lengths of
        # 0.075 m, each with its own fading; the centroid of so many scatters by 4.2 m / sqrt(12 * 56) = 0.16 m, in depth
        # 0.07 m. No beam is worse, so 95 % of all lie within twice that and the height's error.
        self.assertLess(np.percentile(np.abs(errors), 95), math.hypot(2 * 0.07, 4 * height_sd_m(SECONDS)))

    def test_a_metre_of_lever_arm_error_shows_as_a_metre(self):
        true_up, _ = self.errors("right")
        # The measured mounting says 1 m deeper than the actual: soundings come out 1 m too deep (cosine of 3 degrees roll).
        wrong_up, _ = self.errors("wrong", "--set", "vehicles.boat.mountings.bow.measured.position_m=[1.5, 0.2, 1.8]")
        self.assertAlmostEqual(np.median(true_up) - np.median(wrong_up), 1.0, delta=1 - math.cos(math.radians(3)) + 0.01)

    def test_a_source_level_of_minus_200_db_yields_no_soundings(self):
        errors, accepted = self.errors("silent", "--set", "bow.source_level_db=-200")
        self.assertEqual((len(errors), accepted), (0, 0))


def height_sd_m(seconds):
    """Standard deviation of the estimate's height error, averaged over a run: white fixes of 0.05 m at 5 Hz through the
    filter of components/navigation with its gain of 0.2 (the velocity's noise adds a hundredth)."""
    fixes = 5 * seconds
    weights, total = np.zeros(fixes), np.zeros(fixes)  # of each fix in the estimate, and in the sum of estimates
    for n in range(fixes):
        gain = max(0.2, 1 / (n + 1))
        weights *= 1 - gain
        weights[n] += gain
        total += weights
    return 0.05 * float(np.linalg.norm(total / fixes))


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
