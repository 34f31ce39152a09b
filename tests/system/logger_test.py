"""A survey of the bay, logged as .all: whole by `ensonify info`, the record's soundings, the same bytes however it is run.

What is read here is read by a small reader of its own, so that writer and reader are not wrong together.
"""
import json
import math
import struct
import subprocess
import unittest

import cones
import ensonify
import numpy as np
import pyxtf
import support

SECONDS = 8
LAUNCH = support.bay(SECONDS, "[bow/soundings]") + "  log: { run: logger, config: { head: bow } }\n"
NAME = "0000_20250601_120000_boat.all"
HEADER = struct.Struct("<IBBHIIHH")  # length, start mark, type, model, date, time, counter, serial
XYZ, XYZ_BEAM = struct.Struct("<HHfHHfB3x"), struct.Struct("<fffHBbBbh")
RAW, RAW_SECTOR, RAW_BEAM = struct.Struct("<HHHHfI"), struct.Struct("<hHfffHBBf"), struct.Struct("<hBBHBbfhbx")
ENTRY = struct.Struct("<HHhhhH")
VALID = 128  # detection bytes below it


def datagrams(file):
    """(type, time in s of its day, counter, body) of each."""
    data, offset = file.read_bytes(), 0
    while offset < len(data):
        length, _, kind, _, _, time_ms, counter, _ = HEADER.unpack_from(data, offset)
        yield chr(kind), 1e-3 * time_ms, counter, data[offset + HEADER.size:offset + 1 + length]
        offset += 4 + length


def table(layout, body, at, rows):
    return np.array([layout.unpack_from(body, at + i * layout.size) for i in range(rows)], float)


class AllFile:
    """Of a .all file: xyz and raw by ping, attitude as rows of time, roll, pitch, heave, heading (degrees, m down)."""

    def __init__(self, file):
        self.xyz, self.raw, attitude, positions = {}, {}, [], []
        for kind, t, counter, body in datagrams(file):
            if kind == "X":
                heading, _, depth_m, beams, _, _, _ = XYZ.unpack_from(body)
                self.xyz[counter] = 0.01 * heading, depth_m, table(XYZ_BEAM, body, XYZ.size, beams)
            elif kind == "N":
                speed, sectors, beams, _, _, _ = RAW.unpack_from(body)
                at = RAW.size + sectors * RAW_SECTOR.size
                self.raw[counter] = t, 0.1 * speed, table(RAW_SECTOR, body, RAW.size, sectors), table(RAW_BEAM, body, at, beams)
            elif kind == "A":
                rows = table(ENTRY, body, 2, struct.unpack_from("<H", body)[0])
                attitude += [(t + 1e-3 * row[0], *(0.01 * row[2:])) for row in rows]
            elif kind == "P":
                _, _, _, speed, course, _ = struct.unpack_from("<iiHHHH", body)
                positions.append((t, 0.01 * speed, math.radians(0.01 * course)))
        self.attitude, self.positions = np.array(attitude), np.array(positions)
        self.attitude[:, 4] = np.degrees(np.unwrap(np.radians(self.attitude[:, 4])))

    def ned_from_body(self, t):
        roll, pitch, heading = (np.interp(t, self.attitude[:, 0], self.attitude[:, k]) for k in (1, 2, 4))
        return cones.ned_from_body(roll, pitch, heading)

    def head_ned_m(self, t, since, lever_m):
        """Of the head, from where the reference point was at `since`, but for its heave."""
        _, speed, course = self.positions[np.argmin(np.abs(self.positions[:, 0] - t))]
        way = speed * (t - since) * np.array([math.cos(course), math.sin(course), 0])
        return way + [0, 0, np.interp(t, self.attitude[:, 0], self.attitude[:, 3])] + self.ned_from_body(t) @ lever_m

    def sounding(self, ping, beam, lever_m):
        """x, y, z of X from N, A and P: where the transmitter's cone, the receiver's and the time of travel agree."""
        t, speed, sectors, beams = self.raw[ping]
        angle, sector, travel_s = beams[beam][0], sectors[int(beams[beam][1])], beams[beam][6]
        t_transmit = t + sector[3]
        transmit, receive = (self.head_ned_m(time, t, lever_m) for time in (t_transmit, t_transmit + travel_s))
        along, across = self.ned_from_body(t_transmit)[:, 0], self.ned_from_body(t_transmit + travel_s)[:, 1]
        there = cones.sounding(transmit, receive, along, across, 0.01 * sector[0], -0.01 * angle, speed * travel_s)
        heading = math.radians(self.xyz[ping][0])
        forward, starboard = (math.cos(heading), math.sin(heading), 0), (-math.sin(heading), math.cos(heading), 0)
        return there @ forward, there @ starboard, there[2] - self.head_ned_m(t, t, lever_m)[2]


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

        logged, compared = AllFile(out / NAME), 0
        with ensonify.Record(out / "run.mcap") as record:
            recorded = [soundings for _, _, soundings in record.messages("bow/soundings")]
        for soundings in recorded:
            if soundings.ping not in logged.xyz:
                continue
            _, depth_m, beams = logged.xyz[soundings.ping]
            valid = np.asarray(soundings.valid, bool)
            np.testing.assert_array_equal(beams[:, 6] < VALID, valid)
            up_m = np.asarray(soundings.position_enu_m)[valid, 2]
            np.testing.assert_allclose(beams[valid, 0], soundings.pose_position_enu_m[0][2] - up_m, atol=1e-4)
            # Without a tide, below the water line is below chart datum, but for what the estimate errs in height.
            self.assertLess(np.abs(beams[valid, 0] + depth_m + up_m).max(), 0.3)
            compared += valid.sum()
        self.assertGreater(compared, 5000)

        # Angles, travel times, tilt, attitude and heave of the file alone give its soundings. Across the vertical, steps of
        # 0.01 degree are 7 mm at 40 m. Vertically the record's places follow the estimate's height, which fixes correct by
        # centimetres between transmission and reception, and the file has heave.
        lever_m = np.array([1.5, 0.2, 0.8])  # transducers with a reader's phase centres, as `ensonify info` prints them
        errors = []
        for ping in sorted(logged.raw)[5:-5:5]:
            for beam in range(2, len(logged.raw[ping][3]), 9):
                if logged.raw[ping][3][beam][2] < VALID:
                    z, y, x = logged.xyz[ping][2][beam][:3]
                    errors.append(np.array(logged.sounding(ping, beam, lever_m)) - (x, y, z))
        self.assertGreater(len(errors), 200)
        horizontal_m, vertical_m = np.abs(errors)[:, :2], np.abs(errors)[:, 2]
        self.assertLess(horizontal_m.max(), 0.015)
        self.assertLess(vertical_m.max(), 0.05)
        self.assertLess(np.abs(np.mean(errors, axis=0)).max(), 0.01)

    def test_a_full_disk_is_5_names_the_logger_and_leaves_whole_datagrams(self):
        small = self.folder / "small"
        small.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", str(small)], capture_output=True).returncode:
            self.skipTest("cannot mount a small tmpfs here (needs root)")
        try:
            result = self.run_launch(LAUNCH.replace("head: bow }", f"head: bow, folder: {small} }}"), timeout=120)
            self.assertEqual((result.code, result.report()["culprit"]), (5, "log"), result.stderr)
            self.assertIn(NAME, result.stderr)
            done = self.tool("info", "--json", small / NAME)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertGreater(json.loads(done.stdout)[0]["pings"]["serial 101"]["numbers"], 5)
        finally:
            subprocess.run(["umount", "-l", str(small)], check=True)

    def test_pyxtf_reads_sidescan_and_soundings_of_the_record(self):
        launch = LAUNCH.replace("[bow/soundings]", "[bow/soundings, side/*]").replace(
            "  log: { run: logger, config: { head: bow } }", "  side: { run: sidescan }\n  log: { run: logger, config: { head: bow, sidescan: side, formats: [all, xtf] } }")
        result = self.run_launch(launch, out="xtf", timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        file = result.out / NAME.replace(".all", ".xtf")
        header, packets = pyxtf.xtf_read(str(file))
        kinds = pyxtf.XTFHeaderType
        self.assertEqual((header.NumberOfSonarChannels, header.NumberOfBathymetryChannels, header.NavUnits), (2, 1, 3))
        self.assertIn(b"simulated by Ensonify", bytes(packets[kinds.notes][0].NotesText))
        with ensonify.Record(result.out / "run.mcap") as record:
            pings = {m.content.ping: m.content for m in record.messages("side/ping_main")}
            soundings = {m.content.ping: m.content for m in record.messages("bow/soundings")}
            bottoms = {m.content.ping: m.content for m in record.messages("side/bottom_main")}
        read = packets[kinds.sonar]
        self.assertGreater(len(read), 5 * (SECONDS - 2))
        for packet in read:
            ping = pings[packet.PingNumber]
            amplitude = np.asarray(ping.amplitude_upa, float)
            range_m = 0.5 * ping.sound_speed_mps * (ping.first_sample_s + ping.sample_period_s * np.arange(amplitude.shape[1]))
            gain_db = ping.gain_spreading_db * np.log10(np.maximum(range_m, 1)) + 2 * ping.gain_absorption_dbpm * range_m + ping.gain_offset_db
            wanted = amplitude * 10 ** (gain_db / 20)
            port, starboard = packet.data
            scale = np.median(starboard[starboard > 100] / wanted[1][starboard > 100])
            np.testing.assert_allclose(starboard, np.minimum(65535, scale * wanted[1]), atol=0.6, rtol=1e-4)
            np.testing.assert_allclose(port, np.minimum(65535, scale * wanted[0])[::-1], atol=0.6, rtol=1e-4)
            self.assertGreater(np.median(starboard), 50)  # not black
            self.assertLess(np.mean(starboard == 65535), 0.01)
            self.assertAlmostEqual(packet.ping_chan_headers[0].SlantRange, 0.5 * ping.sound_speed_mps * ping.sample_period_s * amplitude.shape[1], places=2)
            if bottoms[packet.PingNumber].valid:
                self.assertAlmostEqual(packet.SensorPrimaryAltitude, bottoms[packet.PingNumber].altitude_m, places=3)
            self.assertTrue(42 < packet.SensorYcoordinate < 43 and -71 < packet.SensorXcoordinate < -70)
        for packet in packets[kinds.q_multibeam]:
            message = soundings[packet.PingNumber]
            valid = np.asarray(message.valid, bool)
            self.assertEqual([beam.Quality > 0 for beam in packet.data], valid.tolist())
            np.testing.assert_allclose([beam.BeamAngle for beam in packet.data], np.degrees(np.asarray(message.beam_angle_rad, float)), atol=1e-4)
            np.testing.assert_allclose(np.array([beam.TwoWayTravelTime for beam in packet.data])[valid], np.asarray(message.travel_time_s, float)[valid], rtol=1e-6)
        # The three formats' headings, positions and attitudes are one: the attitude packets have those of 'A'.
        logged = AllFile(result.out / NAME)
        clock = {round(1e-3 * (packet.Hour * 3_600_000 + packet.Minute * 60_000 + packet.Second * 1000 + packet.Millisecond), 3): packet
                 for packet in packets[kinds.attitude]}
        compared = 0
        for t, roll, pitch, heave, heading in logged.attitude:
            packet = clock.get(round(t, 3))
            if packet is not None:
                np.testing.assert_allclose([packet.Roll, packet.Pitch, -packet.Heave], [roll, pitch, heave], atol=0.0051)
                self.assertLess(abs((packet.Heading - heading + 180) % 360 - 180), 0.0051)
                compared += 1
        self.assertGreater(compared, 100)

    def test_processes_and_one_process_write_the_same_bytes(self):
        apart, together = self.logged(out="apart"), self.logged("--in-process", out="together")
        self.assertEqual((apart / NAME).read_bytes(), (together / NAME).read_bytes())


if __name__ == "__main__":
    unittest.main()
