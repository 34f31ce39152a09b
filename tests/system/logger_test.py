"""A survey of the bay, logged as .all: whole by `ensonify info`, the record's soundings, the same bytes however it is run."""
import json
import math
import struct
import unittest

import ensonify
import support

SECONDS = 8
LAUNCH = support.bay(SECONDS, "[bow/soundings]") + "  log: { run: logger, config: { head: bow } }\n"
NAME = "0000_20250601_120000_boat.all"
HEADER = struct.Struct("<IBBHIIHH")  # length, start mark, type, model, date, time, counter, serial
XYZ = struct.Struct("<HHfHHfB3x")
BEAM = struct.Struct("<fffHBbBbh")


def xyz_of(file):
    """Soundings of a .all file by ping: (depth of the transducer, [(z, valid), ...]). A reader of its own."""
    data, offset, pings = file.read_bytes(), 0, {}
    while offset < len(data):
        length, _, kind, _, _, _, counter, _ = HEADER.unpack_from(data, offset)
        if chr(kind) == "X":
            at = offset + HEADER.size
            _, _, depth_m, beams, _, _, _ = XYZ.unpack_from(data, at)
            fields = [BEAM.unpack_from(data, at + XYZ.size + i * BEAM.size) for i in range(beams)]
            pings[counter] = depth_m, [(beam[0], beam[6] < 128) for beam in fields]
        offset += 4 + length
    return pings


class Logger(support.SystemTest):
    def logged(self, *options, out):
        result = self.run_launch(LAUNCH, *options, out=out, timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        return result.out

    def test_the_file_is_whole_and_has_the_soundings_of_the_record(self):
        out = self.logged(out="run")
        done = self.tool("info", "--json", out / NAME)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(done.stdout)[0]
        self.assertEqual(summary["notes"], [])
        pings = summary["pings"]["serial 101"]
        self.assertEqual(pings["missing"], 0)
        self.assertGreater(pings["numbers"], 8 * (SECONDS - 2))
        self.assertEqual(summary["datagrams"]["A"]["count"], SECONDS + 1)
        self.assertAlmostEqual(summary["positions"]["rate_hz"], 5, places=1)

        logged, compared = xyz_of(out / NAME), 0
        with ensonify.Record(out / "run.mcap") as record:
            recorded = [soundings for _, _, soundings in record.messages("bow/soundings")]
        for soundings in recorded:
            if soundings.ping not in logged:
                continue
            depth_m, beams = logged[soundings.ping]
            self.assertEqual(len(beams), len(soundings.valid))
            for (z_m, valid), there, place in zip(beams, soundings.valid, soundings.position_enu_m):
                self.assertEqual(valid, bool(there))
                if valid:
                    # Without a tide, below the water line is below chart datum, but for what the estimate errs in height.
                    self.assertLess(abs(z_m + depth_m + place[2]), 0.3)
                    compared += 1
            head_m = soundings.pose_position_enu_m[0][2]
            self.assertTrue(all(math.isclose(z_m, head_m - place[2], abs_tol=1e-4)
                                for (z_m, valid), place in zip(beams, soundings.position_enu_m) if valid))
        self.assertGreater(compared, 5000)

    def test_processes_and_one_process_write_the_same_bytes(self):
        apart, together = self.logged(out="apart"), self.logged("--in-process", out="together")
        self.assertEqual((apart / NAME).read_bytes(), (together / NAME).read_bytes())


if __name__ == "__main__":
    unittest.main()
