"""Records: what the client reads from an MCAP file that another library wrote."""
import importlib.util
import pathlib
import tempfile
import unittest

import numpy as np

import ensonify
from ensonify import wire

UTC_START_NS = 1_700_000_000 * 10**9


@unittest.skipUnless(importlib.util.find_spec("mcap"), "the package mcap is not installed (./dev test installs it)")
class Records(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "small.mcap"
        self.write()

    def write(self, profile="x-ensonify/1", chunk_size=1000, **options):
        from mcap.writer import CompressionType, Writer

        with open(self.file, "wb") as stream:
            writer = Writer(stream, chunk_size=chunk_size, **{"compression": CompressionType.NONE, **options})
            writer.start(profile=profile, library="test")
            writer.add_metadata("ensonify", {"version": "0", "seed": "1", "utc_start_ns": str(UTC_START_NS)})
            writer.add_attachment(0, 0, "scenario.yaml", "text/yaml", b"seed: 1\n")
            writer.add_attachment(0, 0, "declarations.json", "application/json",
                                  b'{"bow":{"head_declaration/1":{"finest_beam_rad":0.5,"later":1}},"pager":{"x/1":{}}}')
            schema = writer.register_schema("ping/1", "jsonschema", b"{}")
            other = writer.register_schema("of_another/9", "jsonschema", b"{}")
            ping_channel = writer.register_channel("bow/ping", "msgpack", schema)
            other_channel = writer.register_channel("x/y", "msgpack", other)
            for n in range(30):
                ping = ensonify.Ping(ping=n, amplitude_upa=np.full((2, 5), n, "f4"))
                time = UTC_START_NS + n
                writer.add_message(ping_channel, time, wire.encode_inline(ping.to_map()), time, n)
            writer.add_message(other_channel, time, wire.encode_inline({"a": 1}), time, 0)
            writer.finish()

    def test_messages_topics_and_attachments(self):
        with ensonify.Record(self.file) as record:
            self.assertTrue(record.whole)
            self.assertEqual(record.topics(), {"bow/ping": ("ping/1", 30), "x/y": ("of_another/9", 1)})
            self.assertEqual(record.topics_of(ensonify.Ping), ["bow/ping"])
            pings = list(record.messages("bow/ping"))
            self.assertEqual([(p.t_sim_ns, p.content.ping, p.content.amplitude_upa.max()) for p in pings],
                             [(n, n, n) for n in range(30)])
            thinned = record.messages("bow/ping", least_apart_ns=7)
            self.assertEqual([p.content.ping for p in thinned], [0, 7, 14, 21, 28])
            self.assertEqual([m.content for m in record.messages("x/y")], [{"a": 1}])
            self.assertEqual(len(list(record.messages())), 31)
            for patterns, number in ((("*",), 31), (("bow/*",), 30), (("*/y", "x/*"), 1), (("x/y", "bow/p?ng"), 31)):
                self.assertEqual(len(list(record.messages(*patterns))), number, patterns)
            self.assertEqual(record.missed, {})
            self.assertEqual(record.attachments["scenario.yaml"], b"seed: 1\n")
            self.assertEqual({process: head.finest_beam_rad for process, head in record.declared(ensonify.HeadDeclaration).items()},
                             {"bow": 0.5})
            self.assertEqual(record.declared(ensonify.PagerDeclaration), {})
            self.assertEqual(record.info["seed"], "1")

    def test_a_truncated_record_is_read_to_its_last_whole_chunk(self):
        whole = self.file.read_bytes()
        lengths = set()
        for size in range(1000, len(whole), 97):
            self.file.write_bytes(whole[:size])
            record = ensonify.Record(self.file)
            pings = [m.content.ping for m in record.messages() if m.topic == "bow/ping"]
            self.assertEqual(pings, list(range(len(pings))))
            lengths.add(len(pings))
        self.assertGreater(len(lengths), 3)

    def test_what_is_no_record_is_the_users_mistake(self):
        def refused(why):
            with self.assertRaisesRegex(ensonify.RunError, why) as raised:
                ensonify.Record(self.file)
            self.assertEqual(raised.exception.code, 2)

        self.write(profile="ros2")
        refused("has the profile 'ros2', not x-ensonify/1")
        self.file.write_bytes(b"not a record at all")
        refused("is no MCAP file")
        self.file.write_bytes(b"")
        refused("cannot mmap an empty file")
        self.file.unlink()
        refused("No such file")
        self.write()
        with self.assertRaisesRegex(ensonify.RunError, "has no topic bow/pong; it has bow/ping, x/y"):
            list(ensonify.Record(self.file).messages("bow/pong"))
        with self.assertRaisesRegex(ensonify.RunError, r"has no topic stern/\*; it has bow/ping, x/y"):
            list(ensonify.Record(self.file).messages("bow/*", "stern/*"))


if __name__ == "__main__":
    unittest.main()
