"""The official Python reader (PyPI mcap) finds in a record what was written. Exit code 77: the reader is not installed.

  read_with_python.py WRITE_SAMPLE_RECORD
"""
import json
import os
import subprocess
import sys
import tempfile

START_NS = 1748736000 * 10**9


def check(found, wanted, what):
    if found != wanted:
        sys.exit(f"{what}: found {found!r}, wanted {wanted!r}")


def check_summary(summary):
    check(summary.statistics.message_count, 53, "messages")
    check(summary.statistics.chunk_count, 3, "chunks, one per second")
    check(summary.statistics.attachment_count, 2, "attachments")
    check(summary.statistics.message_start_time, START_NS, "first time")
    check(summary.statistics.message_end_time, START_NS + 2_400_000_000, "last time")
    topics = {c.topic: (c.id, summary.statistics.channel_message_counts[c.id]) for c in summary.channels.values()}
    check(topics, {"bow/ping": (3, 3), "bow/soundings": (4, 25), "agent/thought": (5, 25), "bow/health": (6, 0)}, "topics")
    check(sorted(s.name for s in summary.schemas.values()), ["health/1", "ping/1", "soundings/1"], "schemas")
    for schema in summary.schemas.values():
        check(schema.encoding, "jsonschema", "schema encoding")
        check(json.loads(schema.data)["title"], schema.name, "schema title")
    channel = summary.channels[3]
    check(channel.message_encoding, "msgpack", "message encoding")
    check(channel.metadata, {"type": "ping/1", "rank": "2", "max_bytes": "100000"}, "channel metadata")


def check_messages(messages):
    import msgpack
    for schema, channel, message in messages:
        number = (message.log_time - START_NS) // 100_000_000
        check(message.sequence, number, "sequence")
        check(message.publish_time, message.log_time, "publish time")
        content = msgpack.unpackb(message.data)
        if channel.topic == "agent/thought":
            check(schema, None, "schema of a foreign type")
            check(content["heading_grid_rad"], 0.25, "heading")
            continue
        check(content["ping"], number, "ping")
        known = set(json.loads(schema.data)["properties"])
        check(set(content), known, f"fields of {schema.name}")
        if channel.topic == "bow/ping":
            array = content["amplitude_upa"]
            check((array["dtype"], array["shape"], len(array["data"])), ("f4", [256, 20], 4 * 256 * 20), "array")


def main():
    try:
        from mcap.reader import NonSeekingReader, SeekingReader
    except ImportError:
        print("skipped: PyPI's mcap is not installed (./dev test installs it into build/venv)")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "sample.mcap")
        subprocess.run([sys.argv[1], file], check=True)
        for kind in (SeekingReader, NonSeekingReader):
            for what in ("summary", "messages", "attachments", "metadata"):
                with open(file, "rb") as stream:
                    reader = kind(stream, validate_crcs=True)
                    check(reader.get_header().profile, "x-ensonify/1", "profile") if what == "summary" else None
                    if what == "summary" and kind is SeekingReader:
                        check_summary(reader.get_summary())
                    if what == "messages":
                        messages = list(reader.iter_messages())
                        check(len(messages), 53, "messages read")
                        check_messages(messages)
                    if what == "attachments":
                        found = {a.name: (a.media_type, a.data, a.log_time) for a in reader.iter_attachments()}
                        check(found, {"launch.yaml": ("application/yaml", b"ensonify: launch/1\n", START_NS),
                                      "seed": ("text/plain", b"42", START_NS)}, "attachments")
                    if what == "metadata":
                        found = {m.name: m.metadata for m in reader.iter_metadata()}
                        check(found, {"ensonify": {"version": "1.2.3", "seed": "42", "utc_start_ns": str(START_NS)}}, "metadata")
    print("the official Python reader agrees")


if __name__ == "__main__":
    main()
