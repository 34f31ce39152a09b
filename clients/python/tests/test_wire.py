"""Bytes: envelope, map, arrays and the control frames, against docs/manual/wire.md."""
import pathlib
import struct
import subprocess
import sys
import unittest

import msgpack
import numpy as np

import ensonify
from ensonify import messages, wire

CLIENT = pathlib.Path(__file__).resolve().parent.parent
SOURCE = CLIENT.parent.parent


class Envelopes(unittest.TestCase):
    ENVELOPE = wire.Envelope(flags=1, epoch=2, publisher=3, topic_id=4, frame_count=5, type_hash=6, seq=7, t_sim_ns=-8)

    def test_each_field_stands_at_its_offset(self):
        data = wire.encode_envelope(self.ENVELOPE)
        self.assertEqual(len(data), 64)
        offsets = {0: ("<I", 0x31534E45), 4: ("<H", 1), 6: ("<H", 1), 8: ("<I", 2), 12: ("<I", 3), 16: ("<I", 4),
                   20: ("<I", 5), 24: ("<Q", 6), 32: ("<Q", 7), 40: ("<q", -8)}
        for offset, (kind, value) in offsets.items():
            self.assertEqual(struct.unpack_from(kind, data, offset), (value,), offset)
        self.assertEqual(data[:4], b"ENS1")
        self.assertEqual(data[48:], bytes(16))

    def test_comes_back(self):
        self.assertEqual(wire.decode_envelope(wire.encode_envelope(self.ENVELOPE)), self.ENVELOPE)

    def test_size_magic_and_version_are_checked(self):
        data = wire.encode_envelope(self.ENVELOPE)
        for wrong, why in ((data[:-1], "63 bytes"), (b"X" + data[1:], "magic"), (data[:4] + b"\2\0" + data[6:], "version 2")):
            with self.assertRaisesRegex(wire.DecodeError, why):
                wire.decode_envelope(wrong)

    def test_type_hash_is_fnv_1a(self):
        self.assertEqual(wire.type_hash(""), 0xCBF29CE484222325)
        self.assertEqual(wire.type_hash("foobar"), 0x85944171F73967E8)  # the FNV authors' test vector


def ping():
    return ensonify.Ping(stamp_ns=5, ping=1, sample_period_s=1e-5, beam_angle_rad=np.linspace(-1, 1, 3, dtype="f4"),
                         amplitude_upa=np.arange(12, dtype="f4").reshape(3, 4))


class Bodies(unittest.TestCase):
    def test_arrays_travel_without_a_copy(self):
        sent = ping()
        head, *arrays = wire.encode_body(sent.to_map())
        self.assertTrue(np.shares_memory(arrays[1], sent.amplitude_upa))
        frames = [memoryview(array) for array in arrays]
        got = ensonify.Ping.from_map(wire.decode_body(head, frames))
        self.assertTrue(np.shares_memory(got.amplitude_upa, sent.amplitude_upa))
        self.assertFalse(got.amplitude_upa.flags.writeable)
        np.testing.assert_array_equal(got.amplitude_upa, sent.amplitude_upa)
        self.assertEqual((got.stamp_ns, got.ping, got.sample_period_s), (5, 1, 1e-5))

    def test_descriptor_is_as_documented(self):
        content = msgpack.unpackb(wire.encode_body(ping().to_map())[0])
        self.assertEqual(list(content)[:2], ["stamp_ns", "ping"])
        self.assertEqual(content["amplitude_upa"], {"dtype": "f4", "shape": [3, 4], "frame": 4})

    def test_a_record_holds_the_arrays_inside(self):
        payload = wire.encode_inline(ping().to_map())
        self.assertEqual(msgpack.unpackb(payload)["beam_angle_rad"]["shape"], [3])
        np.testing.assert_array_equal(wire.decode_inline(payload)["amplitude_upa"], ping().amplitude_upa)

    def test_empty_arrays_and_slices(self):
        message = ensonify.Soundings(position_enu_m=np.zeros((0, 3)), quality_db=np.arange(8, dtype="f4")[::2])
        head, *arrays = wire.encode_body(message.to_map())
        got = ensonify.Soundings.from_map(wire.decode_body(head, arrays))
        self.assertEqual(got.position_enu_m.shape, (0, 3))
        np.testing.assert_array_equal(got.quality_db, [0, 2, 4, 6])

    def test_every_type_survives_with_its_defaults(self):
        for name, cls in messages.TYPES.items():
            head, *arrays = wire.encode_body(cls().to_map())
            back = cls.from_map(wire.decode_body(head, arrays))
            self.assertEqual(str(back.to_map()), str(cls().to_map()), name)

    def test_structs_inside_and_unknown_keys(self):
        sent = ensonify.Health(state="degraded", counters=[ensonify.Counter("late_tile", 3)])
        content = {**wire.decode_body(*wire.encode_body(sent.to_map()), []), "of_a_later_version": 1}
        got = ensonify.Health.from_map(content)
        self.assertEqual((got.counters[0].name, got.counters[0].count), ("late_tile", 3))

    def test_what_is_wrong_is_named(self):
        good = {"dtype": "f4", "shape": [2], "frame": 3}
        cases = {
            "unknown dtype": {**good, "dtype": "f2"},
            "no such frame": {**good, "frame": 4},
            "asks for 12 bytes, the frame has 8": {**good, "shape": [3]},
            "bad shape": {**good, "shape": [-2]},
        }
        for why, descriptor in cases.items():
            with self.assertRaisesRegex(wire.DecodeError, why):
                wire.decode_body(msgpack.packb({"height_m": descriptor}), [bytes(8)])
        for data in (b"", b"\xc1", b"\x81", msgpack.packb([1]), b"\x93" * 5000, msgpack.packb({1: 2})):
            with self.assertRaises(wire.DecodeError):
                wire.decode_body(data, [])
        with self.assertRaisesRegex(wire.DecodeError, "speed_mps: is no number"):
            ensonify.Guidance.from_map({"speed_mps": "fast"})
        with self.assertRaisesRegex(wire.DecodeError, "height_m: is no array of f4"):
            ensonify.Tile.from_map({"height_m": np.zeros(3)})
        with self.assertRaisesRegex(wire.DecodeError, "position_enu_m: has 2 numbers, not 3"):
            ensonify.Pose.from_map({"position_enu_m": [1, 2]})

    def test_what_cannot_travel_is_refused(self):
        with self.assertRaisesRegex(TypeError, "complex128 does not fit f4"):
            ensonify.Ping(amplitude_upa=np.zeros(2, complex)).to_map()
        with self.assertRaisesRegex(TypeError, "is no integer"):
            ensonify.Ping(stamp_ns=0.5).to_map()


class Control(unittest.TestCase):
    def test_grant_and_done(self):
        data = b"G" + struct.pack("<IqI", 1, 99, 2) + struct.pack("<IQIQ", 4, 10, 5, 20)
        grant = wire.decode_grant(data)
        self.assertEqual(grant, wire.Grant(1, 99, [(4, 10), (5, 20)]))
        self.assertEqual(wire.encode_grant(grant), data)
        done = wire.encode_done(1, wire.NEVER, True, 77, [(7, 3)])
        self.assertEqual(done, b"D" + struct.pack("<IqBqI", 1, 2**63 - 1, 1, 77, 1) + struct.pack("<IQ", 7, 3))
        self.assertEqual(wire.decode_done(done), wire.Done(1, wire.NEVER, True, 77, [(7, 3)]))
        for wrong in (data[:-1], data[:5], b"X" + data[1:]):
            with self.assertRaises(wire.DecodeError):
                wire.decode_grant(wrong)


class Generated(unittest.TestCase):
    def test_the_classes_are_those_of_the_structs(self):
        subprocess.run([sys.executable, str(CLIENT / "generate_messages.py"), str(SOURCE / "messages"), "--check",
                        str(CLIENT / "ensonify" / "messages.py")], check=True)

    def test_the_version_is_the_projects(self):
        self.assertEqual(ensonify.__version__, (SOURCE / "VERSION").read_text().strip())


if __name__ == "__main__":
    unittest.main()
