#!/usr/bin/env python3
"""A participant written from docs/manual/wire.md alone that takes too long for four events, and prints what the clock says of that.
With the argument `view` it has a port for viewers, else none."""
import json
import os
import struct
import sys
import time

import zmq

NAME, CLOCK = os.environ["ENSONIFY_NAME"], os.environ["ENSONIFY_CLOCK"]
PERIOD_NS = 100_000_000
SLOW = range(10, 14)  # events that take 0.3 s of wall time, in a run that has 0.1 s for each

context = zmq.Context()
control, sync, live = (context.socket(kind) for kind in (zmq.DEALER, zmq.XPUB, zmq.XPUB))
control.setsockopt(zmq.IDENTITY, NAME.encode())
endpoints = {}
for plane, socket in (("sync", sync), ("live", live)):
    socket.bind(f"{os.path.dirname(CLOCK)}/{NAME}.{plane}")
    endpoints[plane] = socket.getsockopt(zmq.LAST_ENDPOINT).rstrip(b"\0").decode()
control.connect(CLOCK)
hello = {"kind": "hello", "name": NAME, "component": "foreign", "pid": os.getpid(), "may_finish": False, "first_ns": 0, **endpoints,
         "facts": {}, "out": [], "in": []}
if "view" in sys.argv:
    hello["live_only"] = [{"port": "view", "type": "view/1", "max_bytes": 4096}]
control.send_json(hello)
welcome = control.recv_json()
if welcome["kind"] == "refused":
    sys.exit("\n".join(welcome["problems"]))

event = 0
said = []  # [number of the next event, late]
while True:
    frame = control.recv()
    if frame[:1] == b"{":
        word = json.loads(frame)
        if word["kind"] == "end":
            break
        if word["kind"] != "late":
            sys.exit(f"unexpected {frame!r}")
        said.append([event, word["late"]])
        continue
    kind, epoch, horizon_ns, _ = struct.unpack_from("<cIqI", frame)
    began = time.monotonic()
    while event * PERIOD_NS <= horizon_ns:
        if event in SLOW:
            time.sleep(0.3)
        event += 1
    cost_ns = int(1e9 * (time.monotonic() - began))
    control.send(struct.pack("<cIqBqI", b"D", epoch, event * PERIOD_NS, 0, cost_ns, 0))
control.send_json({"kind": "bye"})
print(json.dumps(said))
context.destroy(linger=2000)
