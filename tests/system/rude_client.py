#!/usr/bin/env python3
"""A participant that steers a vehicle as docs/manual/wire.md says, and makes the one mistake that its config names."""
import json
import math
import os
import struct
import sys

import msgpack
import zmq

NEVER = 2**63 - 1
PERIOD_NS = 100_000_000
MISTAKE_AT = 10  # the number of the event, at 1 s
NAME = os.environ["ENSONIFY_NAME"]
CLOCK = os.environ["ENSONIFY_CLOCK"]
MISTAKE = json.loads(os.environ["ENSONIFY_CONFIG"])["mistake"]
NO_INPUT = MISTAKE in ("creeps", "repeats flag 1")  # so that nobody else holds it back


def type_hash(name):
    value = 0xCBF29CE484222325
    for byte in name.encode():
        value = (value ^ byte) * 0x100000001B3 % 2**64
    return value


class Client:
    def __init__(self):
        context = zmq.Context()
        self.control, self.sync, self.live, self.data = (context.socket(kind) for kind in (zmq.DEALER, zmq.XPUB, zmq.XPUB, zmq.SUB))
        self.sync.setsockopt(zmq.XPUB_NODROP, 1)
        self.data.setsockopt(zmq.RCVHWM, 0)
        self.control.setsockopt(zmq.IDENTITY, NAME.encode())
        self.control.setsockopt(zmq.RECONNECT_IVL, 5)
        folder = os.path.dirname(CLOCK)
        self.sync.bind(f"{folder}/{NAME}.sync")
        self.live.bind(f"{folder}/{NAME}.live")
        self.control.connect(CLOCK)
        self.published = 0
        self.count_off = 0  # how far DONE's count lies
        self.waiting = []

    def hello(self):
        out = {"port": "command", "type": "guidance/1", "max_bytes": 4096, "rate": [10, 1]}
        into = [{"port": "pose", "type": "pose/1", "delay_ns": 0, "optional": False, "topics": []}]
        hello = {"kind": "hello", "name": NAME, "component": "rude", "pid": os.getpid(), "may_finish": MISTAKE != "flag 1 without leave",
                 "sync": self.sync.getsockopt(zmq.LAST_ENDPOINT).rstrip(b"\0").decode(),
                 "live": self.live.getsockopt(zmq.LAST_ENDPOINT).rstrip(b"\0").decode(), "out": [out], "in": [] if NO_INPUT else into}
        if MISTAKE == "unknown type version":
            hello["out"].append({"port": "mark", "type": "mark/9"})
        if MISTAKE == "rate is text":
            out["rate"] = "fast"
        if MISTAKE == "no sync":
            del hello["sync"]
        if MISTAKE == "sync is no endpoint":
            hello["sync"] = "nonsense"
        self.control.send_json(hello)
        self.welcome = self.control.recv_json()
        if self.welcome["kind"] == "refused":
            print("\n".join(self.welcome["problems"]), file=sys.stderr)
            sys.exit(2)
        self.out = self.welcome["out"][0]

    def prove(self):
        for entry in self.welcome["in"]:
            self.data.connect(entry["endpoint"])
            self.data.subscribe(entry["topic"].encode() + b"\0")
            self.data.subscribe(b"~" + entry["token"].encode())
        if MISTAKE == "tokens are numbers":
            self.control.send_json({"kind": "proven", "tokens": [1]})
        unproven = set(self.out["tokens"])
        while unproven:
            token = self.sync.recv()[2:].decode()
            if token in unproven:
                unproven.discard(token)
                self.control.send_json({"kind": "proven", "tokens": [token]})

    def run(self):
        next_ns = event = arrived = 0
        while True:
            frame = self.control.recv()
            if frame[:1] == b"{":
                self.control.send_json({"kind": "bye"})
                return
            _, self.epoch, horizon_ns, _ = struct.unpack_from("<cIqI", frame)
            for _, count in struct.iter_unpack("<IQ", frame[17:]):
                while arrived < count:
                    self.data.recv_multipart()
                    arrived += 1
            while next_ns <= horizon_ns:
                if event == MISTAKE_AT:
                    self.err(next_ns)
                    if MISTAKE in ("creeps", "repeats flag 1"):
                        return self.stand_still(next_ns)
                self.publish(next_ns)
                event += 1
                next_ns += PERIOD_NS
            self.done(next_ns)

    def err(self, t_ns):
        """What goes wrong before the event."""
        mistake = {
            "next taken back": lambda: self.done(t_ns - PERIOD_NS - 1),
            "flag 1 without leave": lambda: self.done(t_ns + 1, flags=1),
            "flag 1 in the future": lambda: self.done(t_ns + 10**12, flags=1),
            "DONE of another epoch": lambda: self.done(t_ns + 1, epoch=2),
            "DONE of 9 bytes": lambda: self.control.send(b"D" + bytes(8)),
            "DONE twice": lambda: (self.done(t_ns), self.done(t_ns)),
            "DONE for another's topic": lambda: self.done(t_ns, topic=0 if self.out["topic_id"] else 1),
            "failed with code 0": lambda: self.control.send_json({"kind": "failed", "code": 0}),
            "failed": lambda: self.control.send_json({"kind": "failed", "code": 5, "message": "my disk is full"}),
            "blames its input": lambda: self.control.send_json({"kind": "failed", "code": 3, "message": "auv: bad pose", "culprit": "auv"}),
            "blames a bystander": lambda: self.control.send_json({"kind": "failed", "code": 3, "message": "it was x", "culprit": "recorder"}),
            "bye early": lambda: self.control.send_json({"kind": "bye"}),
            "counts too many": lambda: setattr(self, "count_off", 1),
            "counts fewer than before": lambda: setattr(self, "count_off", -5),
            "skips a seq": lambda: setattr(self, "published", self.published + 1),
            "another magic": lambda: self.publish(t_ns, magic=0x31534E46),
            "another wire version": lambda: self.publish(t_ns, major=2),
            "an envelope of 60 bytes": lambda: self.publish(t_ns, cut=4),
            "a message of two frames": lambda: self.sync.send_multipart([self.topic(), b""]),
            "another number of frames": lambda: self.publish(t_ns, frames=4),
            "another epoch": lambda: self.publish(t_ns, epoch=2),
            "another publisher": lambda: self.publish(t_ns, rank=77),
            "another topic id": lambda: self.publish(t_ns, topic_id=77),
            "another type": lambda: self.publish(t_ns, type_name="pose/1"),
            "no msgpack": lambda: self.publish(t_ns, body=b"\xc1"),
            "a body cut short": lambda: self.publish(t_ns, body=b"\x82\xa1a"),
            "a list for a map": lambda: self.publish(t_ns, body=msgpack.packb([1, 2])),
            "text for a number": lambda: self.publish(t_ns, body=msgpack.packb({"speed_mps": "fast"})),
            "a fraction for an integer": lambda: self.publish(t_ns, body=msgpack.packb({"stamp_ns": 1.5})),
            "more bytes than declared": lambda: self.publish(t_ns, body=msgpack.packb({"note": "x" * 5000})),
            "a frame of 64 MB": lambda: self.publish(t_ns, body=b"x" * 64_000_000),
            "a time that is over": lambda: self.publish(t_ns - 3 * PERIOD_NS),
            "a time that never comes": lambda: self.publish(NEVER),
            "a flood": lambda: [self.publish(t_ns) for _ in range(1000)],
            "a message on a token": lambda: self.sync.send(b"~" + self.out["tokens"][0].encode()),
            "NaN": lambda: [self.publish(t_ns, speed_mps=math.nan) for _ in range(3)],
        }.get(MISTAKE)
        if mistake:
            mistake()

    def stand_still(self, t_ns):
        """Answers every grant at once without getting anywhere."""
        flags = 1 if MISTAKE == "repeats flag 1" else 0
        n = 0
        while True:
            n += 0 if flags and n else 1
            self.done(t_ns + n, flags=flags)
            if self.control.recv()[:1] == b"{":
                return

    def topic(self):
        return self.out["topic"].encode() + b"\0"

    def publish(self, t_ns, *, magic=0x31534E45, major=1, cut=0, frames=3, epoch=None, rank=None, topic_id=None,
                type_name="guidance/1", body=None, speed_mps=1.5):
        envelope = struct.pack("<IHHIIIIQQq16x", magic, major, 0, self.epoch if epoch is None else epoch,
                               self.welcome["rank"] if rank is None else rank,
                               self.out["topic_id"] if topic_id is None else topic_id, frames, type_hash(type_name), self.published, t_ns)
        body = body or msgpack.packb({"stamp_ns": t_ns, "heading_grid_rad": math.pi / 2, "speed_mps": speed_mps})
        self.sync.send_multipart([self.topic(), envelope[:len(envelope) - cut], body])
        self.published += 1

    def done(self, next_ns, *, flags=0, epoch=None, topic=None):
        self.control.send(struct.pack("<cIqBqI", b"D", self.epoch if epoch is None else epoch, next_ns, flags, 0, 1) +
                          struct.pack("<IQ", self.out["topic_id"] if topic is None else topic, max(self.published + self.count_off, 0)))


client = Client()
client.hello()
client.prove()
client.run()
