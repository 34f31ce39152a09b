"""A sidescan and an echosounder survey a line of the bay, as launch/sidescan.yaml says: the run's expectations hold, the record
shows a silent water column and then the seabed on both sides, and the waterfall is drawn."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

import ensonify

SOURCE = pathlib.Path(os.environ["ENSONIFY_SOURCE"])
BIN = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "bin"


class Sidescan(unittest.TestCase):
    def test_a_line_of_the_bay(self):
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            done = subprocess.run([BIN / "ensonify-run", SOURCE / "launch/sidescan.yaml", "--free", "--quiet", "--out", folder],
                                  capture_output=True, text=True, timeout=550)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            verdicts = json.loads((pathlib.Path(folder) / "expect.json").read_text())
            self.assertEqual([entry["ok"] for entry in verdicts], [True] * 6)
            self.assertGreater((pathlib.Path(folder) / "waterfall.png").stat().st_size, 100_000)
            record = ensonify.Record(pathlib.Path(folder) / "sidescan.mcap")
            bottoms = {bottom.content.ping: bottom.content for bottom in record.messages("side/bottom_main")}
            pings = [ping.content for ping in record.messages("side/ping_main")]
        self.assertGreater(len(pings), 500)
        for ping in pings[50::50]:
            first = int(bottoms[ping.ping].travel_time_s / ping.sample_period_s)
            metre = int(2 / 1500 / ping.sample_period_s)
            for side in np.square(ping.amplitude_upa.astype(float)):
                column = np.mean(side[2 * metre:first - metre])
                seabed = np.mean(side[first + metre:first + 10 * metre])
                self.assertGreater(10 * np.log10(seabed / column), 30)  # 215 dB in 16 m of quiet water


if __name__ == "__main__":
    unittest.main()
