"""A survey of the bay, logged as .kmall and read by Valerie Schmidt's reader: the record's soundings, and soundings that
follow from the file's raw data alone."""
import contextlib
import io
import json
import math
import re
import unittest

import cones
import ensonify
import numpy as np
import support
from KMALL import kmall

SECONDS = 8
LAUNCH = support.bay(SECONDS, "[bow/soundings]").replace(
    "  bow:   { run: multibeam }\n", "  bow:   { run: multibeam, config: { seabed_image: { published: true } } }\n") + \
    "  log: { run: logger, config: { head: bow, formats: [kmall] } }\n"
NAME = "0000_20250601_120000_boat.kmall"


class KmallFile:
    """Of a .kmall file: pings by number; motion as rows of time, roll, pitch, heading (degrees), heave (m down)."""

    def __init__(self, file):
        reader = kmall(str(file))
        with contextlib.redirect_stdout(io.StringIO()):
            reader.index_file()
        self.pings, motion = {}, []
        for kind, offset in zip(reader.Index["MessageType"].astype(str), reader.Index["ByteOffset"]):
            reader.FID.seek(int(offset))
            if "MRZ" in kind:
                ping = reader.read_EMdgmMRZ()
                self.pings[ping["cmnPart"]["pingCnt"]] = ping
            elif "SKM" in kind:
                motion.append(reader.read_EMdgmSKM()["sample"]["KMdefault"])
            elif "IIP" in kind:
                self.installation = reader.read_EMdgmIIP()["install_txt"]
            elif "SPO" in kind:
                self.position = reader.read_EMdgmSPO()
        reader.closeFile()
        rows = [np.stack([np.asarray(part["time_sec"]) % 86400 + 1e-9 * np.asarray(part["time_nanosec"]), part["roll_deg"],
                          part["pitch_deg"], part["heading_deg"], part["heave_m"]], axis=1) for part in motion]
        self.motion = np.concatenate(rows)
        self.motion[:, 3] = np.degrees(np.unwrap(np.radians(self.motion[:, 3])))

    def at(self, t):
        return [np.interp(t, self.motion[:, 0], self.motion[:, k]) for k in (1, 2, 3, 4)]

    def sounding(self, ping, beam, lever_m, velocity_mps):
        """x, y, z of #MRZ from its raw part and #SKM."""
        t = ping["header"]["dgtime"] % 86400
        one = {key: values[beam] for key, values in ping["sounding"].items()}
        speed, sector = ping["pingInfo"]["soundSpeedAtTxDepth_mPerSec"], ping["txSectorInfo"]
        t_transmit = t + sector["sectorTransmitDelay_sec"][one["txSectorNumb"]]
        places, turns = [], []
        for time in (t_transmit, t_transmit + one["twoWayTravelTime_sec"]):
            roll, pitch, heading, heave = self.at(time)
            turns.append(cones.ned_from_body(roll, pitch, heading))
            places.append(velocity_mps * (time - t) + [0, 0, heave - self.at(t)[3]] + turns[-1] @ lever_m)
        there = cones.sounding(*places, turns[0][:, 0], turns[1][:, 1], sector["tiltAngleReTx_deg"][one["txSectorNumb"]],
                               -one["beamAngleReRx_deg"], speed * one["twoWayTravelTime_sec"])
        heading = math.radians(ping["pingInfo"]["headingVessel_deg"])
        return there @ (math.cos(heading), math.sin(heading), 0), there @ (-math.sin(heading), math.cos(heading), 0), there[2]


def water_columns(file):
    """#MWC by number."""
    reader = kmall(str(file))
    with contextlib.redirect_stdout(io.StringIO()):
        reader.index_file()
    columns = {}
    for kind, offset in zip(reader.Index["MessageType"].astype(str), reader.Index["ByteOffset"]):
        if "MWC" in kind:
            reader.FID.seek(int(offset))
            column = reader.read_EMdgmMWC()
            columns[column["cmnPart"]["pingCnt"]] = column
    reader.closeFile()
    return columns


class LoggerKmall(support.SystemTest):
    def test_another_reader_finds_the_water_column_of_the_record_which_convert_makes_too(self):
        launch = support.bay(4, "[bow/*, nav/*]").replace("  bow:   { run: multibeam }\n", "  bow:   { run: multibeam, config: { mode: water_column, beams: 32, phase_every: 0 } }\n") + \
            "  log: { run: logger, config: { head: bow, formats: [wcd, kmwcd] } }\n"
        result = self.run_launch(launch, timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        columns = water_columns(result.out / NAME.replace(".kmall", ".kmwcd"))
        self.assertGreater(len(columns), 20)
        with ensonify.Record(result.out / "run.mcap") as record:
            pings = {m.content.ping: m.content for m in record.messages("bow/ping")}
        for number, column in list(columns.items())[::5]:
            ping, head = pings[number], column["rxInfo"]
            level_db = 20 * np.log10(np.asarray(ping.amplitude_upa, float)) - ping.source_level_db
            range_m = 0.5 * ping.sound_speed_mps * ping.sample_period_s * np.arange(level_db.shape[1])
            tvg_db = head["TVGfunctionApplied"] * np.log10(np.maximum(range_m, 1)) + 2 * ping.gain_absorption_dbpm * range_m + head["TVGoffset_dB"]
            wanted = np.clip(level_db + tvg_db, -64, 63.5)
            for beam, samples in enumerate(column["beamData"]["sampleAmplitude05dB_p"]):
                np.testing.assert_allclose(0.5 * np.array(samples), wanted[beam, :len(samples)], atol=0.26)
            self.assertGreater(wanted.max(), -40)  # the seabed
        made = self.folder / "made"
        done = self.tool("convert", result.out, "--to", "wcd,kmwcd", made, timeout=120)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for ending in (".wcd", ".kmwcd"):
            name = NAME.replace(".kmall", ending)
            self.assertEqual((made / name).read_bytes(), (result.out / name).read_bytes(), name)

    def test_another_reader_finds_the_soundings_of_the_record_and_what_they_follow_from(self):
        result = self.run_launch(LAUNCH, timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        done = self.tool("info", "--json", result.out / NAME)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)[0]["notes"], [])

        file, compared = KmallFile(result.out / NAME), 0
        self.assertGreater(len(file.pings), 8 * (SECONDS - 2))
        with ensonify.Record(result.out / "run.mcap") as record:
            recorded = {m.content.ping: m.content for m in record.messages("bow/soundings")}
        for number, ping in file.pings.items():
            soundings, written = recorded[number], {key: np.asarray(values) for key, values in ping["sounding"].items()}
            valid = np.asarray(soundings.valid, bool)
            np.testing.assert_array_equal(written["detectionType"] == 0, valid)
            up_m = np.asarray(soundings.position_enu_m)[valid, 2]
            below_m = written["z_reRefPoint_m"][valid] - ping["pingInfo"]["z_waterLevelReRefPoint_m"]
            self.assertLess(np.abs(below_m + up_m).max(), 0.3)  # chart datum, but for what the estimate errs in height
            np.testing.assert_allclose(written["twoWayTravelTime_sec"][valid], np.asarray(soundings.travel_time_s)[valid])
            np.testing.assert_allclose(written["reflectivity2_dB"][valid], np.asarray(soundings.backscatter_strength_db)[valid], atol=1e-4)
            # BS = EL - SL - M + TVG: the level comes back.
            level_db = written["reflectivity2_dB"] + written["sourceLevelApplied_dB"] + written["receiverSensitivityApplied_dB"] - written["TVG_dB"]
            np.testing.assert_allclose(level_db[valid], np.asarray(soundings.backscatter_db)[valid], atol=1e-3)
            self.assertEqual(len(ping["SIsample_desidB"]), written["SInumSamples"].sum())
            self.assertTrue((written["SIcentreSample"][valid] >= 1).all() and (written["SIcentreSample"][valid] <= written["SInumSamples"][valid] + 1).all())
            compared += valid.sum()
        self.assertGreater(compared, 5000)

        # Angles are floats and travel times too: what is left is the estimate's correction of height between transmission and
        # reception, which the file does not have, and straight rays in water of one speed.
        offset = {key: float(value) for key, value in re.findall(r"([A-Z]+)=([-\d.]+)", re.search(r"TRAI_TX1:([^,]*)", str(file.installation)).group(1))}
        self.assertAlmostEqual(offset["X"] + offset["ICX"], 1.5, places=3)  # of a head that is not turned
        lever_m = np.array([offset[axis] + offset["IC" + axis] for axis in "XYZ"])
        block = file.position["sensorData"]
        course, speed = math.radians(block["courseOverGround_deg"]), block["speedOverGround_mPerSec"]
        velocity_mps = speed * np.array([math.cos(course), math.sin(course), 0])
        errors = []
        for number in sorted(file.pings)[5:-5:5]:
            ping = file.pings[number]
            for beam in range(2, ping["rxInfo"]["numSoundingsMaxMain"], 9):
                if ping["sounding"]["detectionType"][beam] == 0:
                    read = [ping["sounding"][key][beam] for key in ("x_reRefPoint_m", "y_reRefPoint_m", "z_reRefPoint_m")]
                    errors.append(np.array(file.sounding(ping, beam, lever_m, velocity_mps)) - read)
        self.assertGreater(len(errors), 200)
        horizontal_m, vertical_m = np.abs(errors)[:, :2], np.abs(errors)[:, 2]
        self.assertLess(horizontal_m.max(), 0.02)
        self.assertLess(vertical_m.max(), 0.05)
        self.assertLess(np.abs(np.mean(errors, axis=0)).max(), 0.01)


if __name__ == "__main__":
    unittest.main()
