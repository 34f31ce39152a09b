"""`ensonify georeference`: soundings of a logged survey are where the file has them, and where they truly are."""
import csv
import json
import unittest

import ensonify
import numpy as np
import support

SECONDS = 6
NAME = "0000_20250601_120000_boat.kmall"
LAUNCH = support.bay(SECONDS, "[bow/soundings]") + "  log: { run: logger, config: { head: bow, formats: [kmall, all] } }\n"
QUIET = [f"nav.sigma_{what}=0" for what in ("roll_deg", "pitch_deg", "heading_deg", "heave_m", "horizontal_m", "vertical_m", "velocity_mps",
                                            "sound_speed_mps")]
STEEP = ('water={"profile":[{"depth_m":0,"sound_speed_mps":1510},{"depth_m":3,"sound_speed_mps":1505},{"depth_m":8,"sound_speed_mps":1485},'
         '{"depth_m":25,"sound_speed_mps":1470}],"wind_speed_mps":6}')
TURNED = 'vehicles.boat.mountings.bow={"actual":{"position_m":[1.5,0.2,0.8],"roll_deg":2,"pitch_deg":-3,"heading_deg":4}}'


class Georeference(support.SystemTest):
    def survey(self, *sets):
        result = self.run_launch(LAUNCH, *(word for one in sets for word in ("--set", one)), timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        return result.out

    def georeference(self, *words, code=0):
        done = self.tool("georeference", *words, timeout=60)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def rows(self, file):
        with open(file, encoding="utf-8") as text:
            return list(csv.DictReader(text))

    def test_of_ideal_sensors_a_turned_head_and_a_steep_profile_they_are_within_centimetres(self):
        """5 mm vertically and 2 cm horizontally: what the file's own resolution and the first node at the face leave."""
        out = self.survey(*QUIET, STEEP, TURNED)
        table = self.folder / "soundings.csv"
        tide = self.write("gauge.tid", "--------\n2025/06/01 11:00:00 1.00\n2025/06/01 13:00:00 1.00\n")
        found = json.loads(self.georeference(out / NAME, "--within", 0.005, 0.02, "--json", "--out", table, "--tide", tide).stdout)
        self.assertGreater(found["soundings"], 256 * 5 * (SECONDS - 2))
        self.assertEqual((found["without_attitude"], found["faults"]), (0, 0))
        self.assertLess(found["vertical"]["largest_m"], 0.01)
        # .all has times to 1 ms, attitudes and angles to 0.01 degrees, P at 5 Hz: 2 and 5 cm, and 3 and 8 at most.
        other = json.loads(self.georeference(out / NAME.replace(".kmall", ".all"), "--within", 0.02, 0.05, "--json").stdout)
        self.assertEqual(other["soundings"], found["soundings"])
        self.assertLess(other["vertical"]["largest_m"], 0.03)
        self.assertLess(other["horizontal"]["largest_m"], 0.08)
        with ensonify.Record(out / "run.mcap") as record:
            recorded = {m.content.ping: m.content for m in record.messages("bow/soundings")}
        rows = self.rows(table)
        self.assertEqual(len(rows), found["soundings"])
        for row in rows[::97]:
            soundings, beam = recorded[int(row["ping"])], int(row["sounding"])
            self.assertAlmostEqual(float(row["depth_m"]), -float(np.asarray(soundings.position_enu_m)[beam, 2]), delta=0.02)
            self.assertAlmostEqual(float(row["chart_depth_m"]), float(row["depth_m"]) - 1, delta=1e-3)
        # Far apart on the ground, by latitude and longitude as by metres.
        first, last = rows[0], rows[255]
        north_m = 111_080 * (float(last["latitude_deg"]) - float(first["latitude_deg"]))  # at 42.25 degrees
        east_m = 82_520 * (float(last["longitude_deg"]) - float(first["longitude_deg"]))
        away = [np.asarray(recorded[int(row["ping"])].position_enu_m)[int(row["sounding"]), :2] for row in (first, last)]
        np.testing.assert_allclose([east_m, north_m], away[1] - away[0], atol=0.1)

    def test_what_is_wrong_is_said(self):
        out = self.survey()
        self.georeference(out / NAME, "--within", 0.005, 0.02, code=1)  # the default heave's white noise
        self.georeference(out / NAME, "--within", 0.06, 0.02)
        self.assertIn("is neither a .kmall nor a .all file", self.georeference(out / "run.mcap", code=2).stderr)
        whole = (out / NAME).read_bytes()
        for kind, said in ((b"#IIP", "holds no installation (#IIP)"), (b"#SVP", "holds no sound speed profile (#SVP)"),
                           (b"#SKM", "holds no attitude (#SKM)")):
            part = self.folder / "part.kmall"
            part.write_bytes(without(whole, kind))
            self.assertIn(said, self.georeference(part, code=2).stderr)
        self.assertIn("has no level for", self.georeference(out / NAME, "--out", self.folder / "t.csv", "--tide",
                                                            self.write("t.csv", "2024-01-01T00:00:00Z,1\n2024-01-02T00:00:00Z,1\n"), code=2).stderr)


def without(content, kind):
    """A .kmall file less the datagrams of a type."""
    kept, at = b"", 0
    while at < len(content):
        length = int.from_bytes(content[at:at + 4], "little")
        if content[at + 4:at + 8] != kind:
            kept += content[at:at + length]
        at += length
    return kept


if __name__ == "__main__":
    unittest.main()
