"""A message as it arrived, and whether it is what its topic's entry in WELCOME says (docs/manual/wire.md)."""
from typing import Any, NamedTuple

from ensonify import wire
from ensonify.run_error import EXIT_DATA_LOST, EXIT_DIED, RunError


class Packet(NamedTuple):
    """A message as it arrived, not yet decoded."""

    envelope: wire.Envelope
    head: Any  # the msgpack map
    arrays: list  # raw frames


class Ending(NamedTuple):
    """The end of a topic, in the place of its first message that cannot be used."""

    envelope: wire.Envelope
    why: RunError


def broken(entry: dict, seq: int, what: str) -> RunError:
    """Of a message that its publisher should not have sent so."""
    return RunError(f"{entry['publisher']} sent a message that cannot be used: {entry['topic']}: seq {seq}: {what}", EXIT_DIED, entry["publisher"])


def decoded_envelope(entry: dict, frames: list, seq: int) -> wire.Envelope:
    """Of the frames behind the topic's; a RunError where it is none."""
    if len(frames) < wire.FIRST_ARRAY_FRAME - 1:
        raise broken(entry, seq, "message: fewer than 3 frames")
    try:
        return wire.decode_envelope(frames[0].bytes)
    except wire.DecodeError as error:
        raise broken(entry, seq, str(error)) from None


def judged(entry: dict, envelope: wire.Envelope, frames: list, epoch: int, expected: int) -> Packet:
    """The message of these frames, which is to be the one of seq `expected` on the topic; a RunError where it is not."""
    for what, has, wanted in (("epoch", envelope.epoch, epoch), ("publisher", envelope.publisher, entry["rank"]),
                              ("topic id", envelope.topic_id, entry["topic_id"]), ("type hash", envelope.type_hash, entry["hash"]),
                              ("frame count", envelope.frame_count, 1 + len(frames))):
        if has != wanted:
            raise broken(entry, expected, f"envelope: {what}: is {has}, not {wanted}")
    if envelope.seq != expected:
        raise RunError(f"{entry['publisher']} lost messages: {entry['topic']}: seq {expected} is missing, {envelope.seq} came",
                       EXIT_DATA_LOST, entry["publisher"])
    head, arrays = frames[1], frames[2:]
    if envelope.flags & wire.FLAG_WALL_FACTS and arrays:
        arrays.pop()
    size = len(head) + sum(map(len, arrays))
    if size > entry["max_bytes"]:
        raise broken(entry, expected, f"{size} bytes, declared at most {entry['max_bytes']}")
    return Packet(envelope, head.bytes, [frame.buffer for frame in arrays])
