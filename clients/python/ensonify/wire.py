"""Bytes on the wire: envelope, msgpack map, raw arrays (docs/manual/wire.md), without a socket.

A message travels as frames: topic + NUL, envelope, map, arrays. Arrays are never copied: decoding gives numpy views of
the received frames, encoding hands the arrays' own memory to ZeroMQ.
"""
import struct
from typing import Any, NamedTuple, Sequence

import msgpack
import numpy as np

MAGIC = 0x31534E45  # "ENS1"
WIRE_MAJOR = 1
FLAG_WALL_FACTS = 1  # the last frame holds wall-clock facts
ENVELOPE_BYTES = 64
FIRST_ARRAY_FRAME = 3  # counted over the whole message, topic and envelope included
NEVER = 2**63 - 1  # sim time of an event that never comes, ns

_ENVELOPE = struct.Struct("<IHHIIIIQQq16x")
_GRANT = struct.Struct("<cIqI")
_DONE = struct.Struct("<cIqBqI")
_COUNT = struct.Struct("<IQ")

DTYPES = {name: np.dtype("<" + name) for name in ("u1", "i2", "u2", "i4", "u4", "i8", "f4", "f8")}
_NAMES = {dtype: name for name, dtype in DTYPES.items()}


class DecodeError(ValueError):
    """Bytes that are not a message of the expected kind; the text names the field."""


class Envelope(NamedTuple):
    """Who published what, when, and as which message of its topic."""

    flags: int
    epoch: int
    publisher: int  # rank of the process in the launch file
    topic_id: int
    frame_count: int  # of the whole message
    type_hash: int
    seq: int  # from 0 per topic and epoch
    t_sim_ns: int  # time of the event that published it


def encode_envelope(envelope: Envelope) -> bytes:
    """The 64 bytes of frame 1."""
    e = envelope
    return _ENVELOPE.pack(MAGIC, WIRE_MAJOR, e.flags, e.epoch, e.publisher, e.topic_id, e.frame_count, e.type_hash,
                          e.seq, e.t_sim_ns)


def decode_envelope(data) -> Envelope:
    """Raises DecodeError for a wrong size, magic or version."""
    if len(data) != ENVELOPE_BYTES:
        raise DecodeError(f"envelope: has {len(data)} bytes, not {ENVELOPE_BYTES}")
    magic, version, *fields = _ENVELOPE.unpack(data)
    if magic != MAGIC:
        raise DecodeError("envelope: magic is not ENS1")
    if version != WIRE_MAJOR:
        raise DecodeError(f"envelope: wire version {version}, this program speaks {WIRE_MAJOR}")
    return Envelope(*fields)


def type_hash(name: str) -> int:
    """FNV-1a (64 bit) of a message type's name such as "ping/1"."""
    value = 0xCBF29CE484222325
    for byte in name.encode():
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return value


def encode_body(content: dict) -> list:
    """Frames 2..n for a map whose arrays are numpy arrays: the msgpack map, then each array's memory.

    An array must not be written to once it has been handed over.
    """
    arrays: list = []

    def described(value):
        if not isinstance(value, np.ndarray):
            raise TypeError(f"{type(value).__name__} cannot travel in a message")
        dtype = value.dtype.newbyteorder("<") if value.dtype.byteorder == ">" else value.dtype
        if dtype not in _NAMES:
            raise TypeError(f"dtype {value.dtype} cannot travel in a message; {', '.join(DTYPES)} can")
        arrays.append(np.ascontiguousarray(value, dtype))
        return {"dtype": _NAMES[dtype], "shape": list(value.shape), "frame": FIRST_ARRAY_FRAME + len(arrays) - 1}

    head = msgpack.packb(content, default=described)
    return [head, *(array.reshape(-1).view(np.uint8) for array in arrays)]


def decode_body(head, arrays: Sequence) -> dict:
    """The map of frame 2 with its arrays as read-only numpy views of the frames `arrays`."""

    def resolved(pairs: dict) -> Any:
        if "dtype" not in pairs or "frame" not in pairs:
            return pairs
        frame = pairs["frame"]
        if not isinstance(frame, int) or not 0 <= frame - FIRST_ARRAY_FRAME < len(arrays):
            raise DecodeError(f"array: has no such frame: {frame!r}")
        return as_array(pairs.get("dtype"), pairs.get("shape"), arrays[frame - FIRST_ARRAY_FRAME])

    return _unpacked(head, resolved)


def decode_inline(payload) -> dict:
    """A record's payload: the same map with each array's bytes inside it, under `data`. Arrays are copies."""

    def resolved(pairs: dict) -> Any:
        if "dtype" not in pairs or "data" not in pairs:
            return pairs
        return as_array(pairs.get("dtype"), pairs.get("shape"), pairs["data"])

    return _unpacked(payload, resolved)


def encode_inline(content: dict) -> bytes:
    """The reverse of decode_inline."""

    def described(value):
        if not isinstance(value, np.ndarray) or value.dtype not in _NAMES:
            raise TypeError(f"{type(value).__name__} cannot travel in a message")
        return {"dtype": _NAMES[value.dtype], "shape": list(value.shape), "data": np.ascontiguousarray(value).tobytes()}

    return msgpack.packb(content, default=described)


def as_array(dtype: Any, shape: Any, data) -> np.ndarray:
    """A read-only view of `data` as the described array. Raises DecodeError if they do not fit."""
    kind = DTYPES.get(dtype) if isinstance(dtype, str) else None
    if kind is None:
        raise DecodeError(f"array: unknown dtype {dtype!r}")
    if not isinstance(shape, list) or not all(isinstance(n, int) and n >= 0 for n in shape):
        raise DecodeError(f"array: bad shape {shape!r}")
    wanted = kind.itemsize if shape else 0
    for extent in shape:
        wanted *= extent
    view = memoryview(data)
    if view.nbytes != wanted:
        raise DecodeError(f"array: shape asks for {wanted} bytes, the frame has {view.nbytes}")
    array = np.frombuffer(view, kind) if wanted else np.empty(0, kind)
    array = array.reshape(shape or [0])
    array.flags.writeable = False
    return array


def _unpacked(data, hook) -> dict:
    try:
        content = msgpack.unpackb(data, object_hook=hook, strict_map_key=True, raw=False)
    except DecodeError:
        raise
    except (ValueError, TypeError, RecursionError, msgpack.UnpackException) as error:
        raise DecodeError(f"message is not msgpack: {error}") from None
    if not isinstance(content, dict):
        raise DecodeError("message is not a map")
    return content


class Grant(NamedTuple):
    """Run every event up to the horizon, once the first `count` messages of each topic have arrived."""

    epoch: int
    horizon_ns: int
    counts: list  # of (topic id, count)


def decode_grant(data: bytes) -> Grant:
    """A GRANT frame, `G` included."""
    try:
        kind, epoch, horizon_ns, n = _GRANT.unpack_from(data)
        counts = list(_COUNT.iter_unpack(data[_GRANT.size:]))
    except struct.error as error:
        raise DecodeError(f"grant: {error}") from None
    if kind != b"G" or len(counts) != n:
        raise DecodeError("grant: is not well formed")
    return Grant(epoch, horizon_ns, counts)


def encode_grant(grant: Grant) -> bytes:
    """A GRANT frame, as the clock sends it."""
    return _GRANT.pack(b"G", grant.epoch, grant.horizon_ns, len(grant.counts)) + b"".join(
        _COUNT.pack(*count) for count in grant.counts)


def encode_done(epoch: int, next_ns: int, finish: bool, cost_ns: int, counts: Sequence) -> bytes:
    """A DONE frame; `counts` holds (topic id, number published so far)."""
    return _DONE.pack(b"D", epoch, next_ns, 1 if finish else 0, cost_ns, len(counts)) + b"".join(
        _COUNT.pack(*count) for count in counts)


class Done(NamedTuple):
    """What a participant answers to a grant."""

    epoch: int
    next_ns: int
    finish: bool
    cost_ns: int
    counts: list


def decode_done(data: bytes) -> Done:
    """A DONE frame, `D` included."""
    try:
        kind, epoch, next_ns, flags, cost_ns, n = _DONE.unpack_from(data)
        counts = list(_COUNT.iter_unpack(data[_DONE.size:]))
    except struct.error as error:
        raise DecodeError(f"done: {error}") from None
    if kind != b"D" or len(counts) != n:
        raise DecodeError("done: is not well formed")
    return Done(epoch, next_ns, bool(flags & 1), cost_ns, counts)
