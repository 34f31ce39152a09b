"""A viewer written from docs/manual/console-wire.md alone: what the tests of the console speak with it."""
import json
import struct
import time

import msgpack
import numpy as np
from websockets.sync.client import connect

TYPES = ("view/1", "health/1", "clock_health/1", "console_state/1", "console_flow/1", "console_answer/1", "console_cells/1", "console_track/1", "console_values/1", "console_alarms/1", "console_log/1", "console_relief/1", "console_plan/1", "mission_state/1", "pose/1")
DTYPES = {"u1": "<u1", "i2": "<i2", "u2": "<u2", "i4": "<i4", "u4": "<u4", "i8": "<i8", "f4": "<f4", "f8": "<f8"}


def fnv1a(text):
    value = 0xCBF29CE484222325
    for byte in text.encode():
        value = (value ^ byte) * 0x100000001B3 % 2**64
    return value


NAMES = {fnv1a(name): name for name in TYPES}


class Frame:
    """One message of the gateway."""

    def __init__(self, data):
        magic, self.version, self.epoch, self.frames, hashed, self.seq, self.t_sim_ns = struct.unpack_from("<IHxxIxxxxxxxxIQQq", data)
        assert magic == 0x31534E45
        self.size = len(data)
        self.type = NAMES.get(hashed, "")
        topic, size = struct.unpack_from("<II", data, 64)
        self.topic = data[72:72 + topic].decode()
        at = 72 + -(-topic // 8) * 8
        content = msgpack.unpackb(data[at:at + size])
        self.at = at + -(-size // 8) * 8
        self.content = self._arrays(content, data)
        assert self.at == len(data)

    def _arrays(self, value, data):
        if isinstance(value, list):
            return [self._arrays(element, data) for element in value]
        if not isinstance(value, dict):
            return value
        if {"dtype", "shape", "frame"} <= value.keys():
            dtype = np.dtype(DTYPES[value["dtype"]])
            count = int(np.prod(value["shape"])) if value["shape"] else 0
            array = np.frombuffer(data, dtype, count, self.at).reshape(value["shape"] or (0,))
            self.at += -(-count * dtype.itemsize // 8) * 8
            return array
        return {key: self._arrays(member, data) for key, member in value.items()}


class Viewer:
    """Enters by a URL of the console. `answers=False`: a page that never says that it has drawn."""

    def __init__(self, url, answers=True):
        base, self.token = url.split("#")
        self.socket = connect(base.replace("http", "ws") + "live", max_size=None, compression=None)
        self.answers = answers
        self.say("console_enter/1", token=self.token)

    def say(self, kind, **content):
        self.socket.send(json.dumps({"type": kind, **content}))

    def watch(self, *topics, hidden=False, values=(), **wish):
        self.say("console_watch/1", hidden=hidden, values=list(values), topics=[{"topic": topic, **wish} for topic in topics])

    def next(self, patience_s=5.0):
        """The next frame; TimeoutError when none comes."""
        frame = Frame(self.socket.recv(timeout=patience_s))
        if self.answers and frame.type not in ("console_state/1", "console_answer/1"):
            self.say("console_drawn/1", topic=frame.topic, seq=frame.seq)
        return frame

    def until(self, fits, patience_s=10.0, most=100_000):
        """The first frame that fits; AssertionError when none of `most` does, or none within the time."""
        end = time.monotonic() + patience_s
        for _ in range(most):
            frame = self.next(max(0.01, end - time.monotonic()))
            if fits(frame):
                return frame
            if time.monotonic() > end:
                break
        raise AssertionError("it did not come")

    def of(self, kind, **more):
        return self.until(lambda frame: frame.type == kind, **more)

    def close(self):
        self.socket.close()
