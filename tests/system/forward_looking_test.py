"""Launches of heads that point ahead and around: their expectations hold, and their records show rock and the shadows behind it."""
import unittest

import numpy as np

import ensonify
from support import SOURCE, SystemTest


def mean_over_block(power, beams, samples):
    """Means over blocks of beams x samples: speckle taken out. What does not fill a block is left out."""
    rows, columns = power.shape[0] // beams, power.shape[1] // samples
    return power[:rows * beams, :columns * samples].reshape(rows, beams, columns, samples).mean(axis=(1, 3))


class LooksAhead(SystemTest):
    def test_an_imaging_head_shows_rock_and_shadows(self):
        result = self.run_launch(SOURCE / "launch/forward_looking.yaml", "--free", "--arg", "ping_rate_hz=0.5", timeout=200)
        self.assertEqual(result.code, 0, result.stderr)
        self.assertGreater(next(result.out.glob("fls_*.png")).stat().st_size, 100_000)
        with ensonify.Record(result.out / "forward_looking.mcap") as record:
            image = [ping for _, _, ping in record.messages("eye/ping")][-1]
        amplitude = np.asarray(image.amplitude_upa)
        self.assertEqual(amplitude.shape, (512, 1000))
        # Within 45 degrees, from 12 to 25 m, every place is seabed. Over 9 beams x 9 samples speckle leaves 0.5 dB.
        beams = np.abs(image.beam_angle_rad) < np.radians(45)
        range_m = image.first_sample_s + np.arange(1000) * image.sample_period_s * image.sound_speed_mps / 2
        power = mean_over_block(np.square(amplitude[beams][:, (range_m > 12) & (range_m < 25)], dtype=float), 9, 9)
        level_db = 10 * np.log10(power / np.median(power, axis=0))
        self.assertGreater(level_db.max(), 6)   # rock is 11 dB above sand
        self.assertLess(level_db.min(), -10)    # a shadow is dark


class LooksAround(SystemTest):
    def test_a_scanning_head_sees_all_directions(self):
        result = self.run_launch(SOURCE / "launch/scanning.yaml", "--free", timeout=200)
        self.assertEqual(result.code, 0, result.stderr)
        self.assertGreater(next(result.out.glob("scan_*.png")).stat().st_size, 100_000)
        with ensonify.Record(result.out / "scanning.mcap") as record:
            pings = [ping for _, _, ping in record.messages("turner/ping")]
        angle_deg = np.degrees([float(ping.beam_angle_rad[0]) for ping in pings])
        np.testing.assert_allclose(np.diff(np.sort(angle_deg[:400])), 0.9, atol=1e-3)


if __name__ == "__main__":
    unittest.main()
