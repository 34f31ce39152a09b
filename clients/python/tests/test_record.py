"""Records: what the client reads from an MCAP file."""
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
        from mcap.writer import CompressionType, Writer

        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = pathlib.Path(folder.name) / "small.mcap"
        with open(self.file, "wb") as stream:
            writer = Writer(stream, compression=CompressionType.NONE)
            writer.start(profile="ensonify", library="test")
            schema = writer.register_schema("ping/1", "jsonschema", b"{}")
            other = writer.register_schema("of_another/9", "jsonschema", b"{}")
            ping_channel = writer.register_channel("bow/ping", "msgpack", schema)
            other_channel = writer.register_channel("x/y", "msgpack", other)
            for n in range(3):
                ping = ensonify.Ping(ping=n, amplitude_upa=np.full((2, 5), n, "f4"))
                writer.add_message(ping_channel, UTC_START_NS + n, wire.encode_inline(ping.to_map()), UTC_START_NS + n, n)
            writer.add_message(other_channel, UTC_START_NS, wire.encode_inline({"a": 1}), UTC_START_NS, 0)
            writer.add_attachment(0, 0, "scenario.yaml", "text/yaml", b"seed: 1\n")
            writer.finish()

    def test_messages_topics_and_attachments(self):
        with ensonify.Record(self.file) as record:
            self.assertEqual(record.topics(), {"bow/ping": ("ping/1", 3), "x/y": ("of_another/9", 1)})
            pings = list(record.messages("bow/ping"))
            self.assertEqual([(p.utc_ns - UTC_START_NS, p.content.ping, p.content.amplitude_upa.max()) for p in pings],
                             [(0, 0, 0), (1, 1, 1), (2, 2, 2)])
            self.assertEqual([m.content for m in record.messages("x/y")], [{"a": 1}])
            self.assertEqual(record.attachments(), {"scenario.yaml": b"seed: 1\n"})

    def test_a_missing_file_is_the_users_mistake(self):
        with self.assertRaisesRegex(ensonify.RunError, "No such file") as raised:
            ensonify.Record(self.file.with_name("missing.mcap"))
        self.assertEqual(raised.exception.code, 2)


if __name__ == "__main__":
    unittest.main()
