#!/usr/bin/env python3
"""A participant written from docs/manual/wire.md alone, with ZeroMQ and msgpack and nothing of ours: it sees every pose once, in
order and in time, and steers east at 1.5 m/s. Exit code 1 if what arrives is not what the page promises."""
import json
import math
import os
import struct
import sys

import msgpack
import zmq

NEVER = 2**63 - 1
PERIOD_NS = 100_000_000
NAME = os.environ["ENSONIFY_NAME"]
CLOCK = os.environ["ENSONIFY_CLOCK"]


def type_hash(name):
    value = 0xCBF29CE484222325
    for byte in name.encode():
        value = (value ^ byte) * 0x100000001B3 % 2**64
    return value


def must(truth, what):
    if not truth:
        sys.exit(f"foreign client: {what}")


context = zmq.Context()
control, sync, live, data = (context.socket(kind) for kind in (zmq.DEALER, zmq.XPUB, zmq.XPUB, zmq.SUB))
sync.setsockopt(zmq.XPUB_NODROP, 1)
data.setsockopt(zmq.RCVHWM, 0)
if os.environ.get("ENSONIFY_KEYS"):
    with open(os.environ["ENSONIFY_KEYS"], encoding="utf-8") as file:
        keys = {name: key.encode() for name, key in json.load(file).items() if name != "allowed"}
    for socket in (sync, live):
        socket.curve_server, socket.curve_secretkey = True, keys["bound_secret"]
    for socket in (control, data):
        socket.curve_serverkey = keys["bound_public"]
        socket.curve_publickey, socket.curve_secretkey = keys["connected_public"], keys["connected_secret"]
control.setsockopt(zmq.IDENTITY, NAME.encode())
control.setsockopt(zmq.RECONNECT_IVL, 5)
endpoints = {}
for plane, socket in (("sync", sync), ("live", live)):
    folder = os.path.dirname(CLOCK)
    socket.bind(f"{folder}/{NAME}.{plane}" if CLOCK.startswith("ipc:") else "tcp://127.0.0.1:*")
    endpoints[plane] = socket.getsockopt(zmq.LAST_ENDPOINT).rstrip(b"\0").decode()
control.connect(CLOCK)
control.send_json({"kind": "hello", "name": NAME, "component": "foreign", "pid": os.getpid(), "may_finish": False,
                   "first_ns": 0, **endpoints, "facts": {},
                   "out": [{"port": "command", "type": "guidance/1", "max_bytes": 4096, "rate": [10, 1]}],
                   "in": [{"port": "pose", "type": "pose/1", "delay_ns": 0, "optional": False, "topics": []}]})
welcome = control.recv_json()
if welcome["kind"] == "refused":
    print("\n".join(welcome["problems"]), file=sys.stderr)
    sys.exit(2)
out, pose = welcome["out"][0], welcome["in"][0]
data.connect(pose["endpoint"])
data.subscribe(pose["topic"].encode() + b"\0")
data.subscribe(b"~" + pose["token"].encode())

unproven = set(out["tokens"])
while unproven:
    subscription = sync.recv()
    if subscription[:2] == b"\x01~" and subscription[2:].decode() in unproven:
        unproven.discard(subscription[2:].decode())
        control.send_json({"kind": "proven", "tokens": [subscription[2:].decode()]})

waiting = []  # (t_sim, message), arrived and not yet due
arrived = published = seen = 0
next_ns = 0
while True:
    frame = control.recv()
    if frame[:1] == b"{":
        must(json.loads(frame)["kind"] == "end", f"unexpected {frame!r}")
        break
    kind, epoch, horizon_ns, n = struct.unpack_from("<cIqI", frame)
    must(kind == b"G", f"unexpected {frame!r}")
    for topic_id, count in struct.iter_unpack("<IQ", frame[17:]):
        must(topic_id == pose["topic_id"], "a grant names a topic that is not ours")
        while arrived < count:
            topic, envelope, head, *arrays = data.recv_multipart()
            magic, major, flags, its_epoch, publisher, its_id, frames, its_type, seq, t_sim = struct.unpack(
                "<IHHIIIIQQq16x", envelope)
            must((magic, major, its_epoch, its_id) == (0x31534E45, 1, epoch, topic_id), "the envelope is not as described")
            must(topic == pose["topic"].encode() + b"\0" and frames == 3 + len(arrays), "the frames are not as described")
            must(its_type == type_hash("pose/1") and publisher == pose["rank"], "another type or publisher")
            must(seq == arrived, f"seq {seq} where {arrived} was expected")
            arrived += 1
            waiting.append((t_sim, msgpack.unpackb(head)))
    while next_ns <= horizon_ns:
        due = [message for t_sim, message in waiting if t_sim + pose["delay_ns"] <= next_ns]
        waiting = waiting[len(due):]
        for message in due:  # 100 Hz: each pose once, without a gap
            must(message["stamp_ns"] == seen * 10_000_000, f"pose of {message['stamp_ns']} ns is not number {seen}")
            seen += 1
        must(seen == next_ns // 10_000_000 + 1, f"at {next_ns} ns {seen} poses were due")
        body = msgpack.packb({"stamp_ns": next_ns, "heading_grid_rad": math.pi / 2, "speed_mps": 1.5,
                              "of_a_later_version": [1, 2, 3]})
        envelope = struct.pack("<IHHIIIIQQq16x", 0x31534E45, 1, 0, epoch, welcome["rank"], out["topic_id"], 3,
                               type_hash("guidance/1"), published, next_ns)
        for socket in (sync, live):
            socket.send_multipart([out["topic"].encode() + b"\0", envelope, body])
        published += 1
        next_ns += PERIOD_NS
    control.send(struct.pack("<cIqBqI", b"D", epoch, next_ns, 0, 0, 1) + struct.pack("<IQ", out["topic_id"], published))
control.send_json({"kind": "bye"})
must(seen > 0, "no pose came")
context.destroy(linger=2000)
