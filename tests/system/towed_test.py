"""launch/towed.yaml: a towed sidescan detects the bottom from where the body truly is; aboard it is found by layback or by USBL."""
import unittest

import ensonify
import numpy as np
from support import SOURCE, SystemTest


class Towed(SystemTest):
    def sail(self, by):
        result = self.run_launch(SOURCE / "launch/towed.yaml", "--free", "--arg", f"by={by}", "--arg", "seconds=25", out=by,
                                 timeout=300)
        self.assertEqual(result.code, 0, result.stderr)
        with ensonify.Record(result.out / "towed.mcap") as record:
            def places(topic):
                messages = [m for _, _, m in record.messages(topic)]
                return np.array([m.stamp_ns for m in messages]) * 1e-9, np.array([m.position_enu_m for m in messages])

            t_s, body_m = places("fish/pose")
            vessel_s, vessel_m = places("boat/pose")
            at_s, estimated_m = places("fish/estimate")
            tracks = [m for _, _, m in record.messages("fish_side/bottom_main")]
        true_m = np.stack([np.interp(at_s, t_s, axis) for axis in body_m.T], axis=1)
        ahead_m = np.stack([np.interp(t_s, vessel_s, axis) for axis in vessel_m.T], axis=1)
        return t_s, body_m, ahead_m, at_s, estimated_m - true_m, tracks

    def test_by_layback(self):
        t_s, body_m, vessel_m, at_s, error_m, tracks = self.sail("layback")
        behind_m = np.hypot(*(vessel_m - body_m)[:, :2].T)
        self.assertTrue(np.all((behind_m > 15) & (behind_m < 31)), behind_m)  # 25 m of cable from a sheave 5 m abaft
        # The first line is straight: across it only the vessel's own error and the sea, along it the cable's sag.
        settled = at_s > 10
        self.assertLess(np.std(error_m[settled, 0]), 0.5)
        self.assertTrue(np.all(np.abs(error_m[settled, 1]) < 3))
        self.assertLess(np.mean(error_m[settled, 1]), 0)  # a straight cable is longer than one that sags: too far back
        self.assertAlmostEqual(np.mean(error_m[settled, 2]), 0, delta=0.01)  # 5 cm of noise, 700 samples
        received = [track.altitude_m for track in tracks if track.stamp_ns > 10e9]
        self.assertGreater(len(received), 20)
        self.assertTrue(all(3 < altitude_m < 22 for altitude_m in received), received)

    def test_by_usbl(self):
        t_s, body_m, vessel_m, at_s, error_m, tracks = self.sail("usbl")
        settled = at_s > 10
        # At 30 m the array errs by centimetres, with the vessel's estimate; the sea moves the body between fixes.
        self.assertLess(np.mean(np.hypot(*error_m[settled, :2].T)), 0.7)


if __name__ == "__main__":
    unittest.main(verbosity=2)
