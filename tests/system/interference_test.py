"""launch/interference.yaml: a sidescan beside a multibeam of its own frequency. What it receives of it in its water column stands
where the record's transmissions say, drifts by the difference of the ping intervals, and is gone when it is triggered."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import ensonify

SOURCE = pathlib.Path(os.environ["ENSONIFY_SOURCE"])
BIN = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "bin"
SPEED_MPS = 1490.0  # of scenarios/bay
BETWEEN_M = 0.55  # the heads: 0.5 forward, 0.2 abeam, 0.1 up
NEAR_M = 2.0  # the multibeam's pulse and the sidescan's own end before
OFF_BOTTOM_M = 2.0


def received(*arguments):
    """Of each ping of the sidescan: sim time of transmission, the multibeam's transmissions after it (s), level of its
    starboard water column (dB) and that column's slant ranges."""
    with tempfile.TemporaryDirectory(prefix="ens-") as folder:
        done = subprocess.run([BIN / "ensonify-run", SOURCE / "launch/interference.yaml", "--free", "--quiet", "--out", folder,
                               *arguments], capture_output=True, text=True, timeout=280)
        assert done.returncode == 0, done.stdout + done.stderr
        record = ensonify.Record(pathlib.Path(folder) / "interference.mcap")
        bottoms = {message.content.ping: message.content for message in record.messages("side/bottom_main")}
        sent_s = np.array([message.content.stamp_ns * 1e-9 for message in record.messages("bow/transmit")])
        for message in record.messages("side/ping_main"):
            ping = message.content
            range_m = 0.5 * SPEED_MPS * ping.sample_period_s * np.arange(ping.amplitude_upa.shape[1])
            column = (range_m > NEAR_M) & (range_m < bottoms[ping.ping].altitude_m - OFF_BOTTOM_M)
            level_db = 20 * np.log10(np.maximum(ping.amplitude_upa[1], 1.0))
            yield ping.stamp_ns * 1e-9, sent_s - ping.stamp_ns * 1e-9, level_db[column], range_m[column]


class Interference(unittest.TestCase):
    def test_free_heads_drift_and_triggered_ones_do_not(self):
        places = {}  # of the strongest sound in the column, by the time of the ping
        loud_db = []
        for stamp_s, sent_s, level_db, range_m in received():
            straight_m = 0.5 * SPEED_MPS * sent_s + 0.5 * BETWEEN_M
            inside = (straight_m > range_m[0]) & (straight_m < range_m[-1])
            if not inside.any():
                continue
            found = np.flatnonzero(level_db > level_db.max() - 6)[0]
            # A pulse of 100 us begins at a sample of 50 us: 0.04 m.
            self.assertAlmostEqual(range_m[found], straight_m[inside][0], delta=0.08)
            places[stamp_s] = range_m[found]
            loud_db.append(level_db.max())
        self.assertGreater(len(places), 20)
        times = sorted(places)
        drifts_m = [places[b] - places[a] for a, b in zip(times, times[1:]) if b - a < 0.15]
        # 1 / 9.9 s less 1 / 10 s a ping, at half the speed of sound.
        self.assertAlmostEqual(np.mean(drifts_m), 0.5 * SPEED_MPS * (1 / 9.9 - 1 / 10), delta=0.01)

        pings, quiet_db = 0, []
        for stamp_s, sent_s, level_db, range_m in received("--arg", "side=slave"):
            self.assertLess(np.abs(sent_s).min(), 1e-9, f"the sidescan's ping at {stamp_s} s follows no transmission")
            pings += 1
            quiet_db.append(level_db.max())
        self.assertGreater(pings, 150)
        self.assertLess(np.percentile(quiet_db, 95), np.median(loud_db) - 20)


if __name__ == "__main__":
    unittest.main()
