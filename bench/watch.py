#!/usr/bin/python3
"""An observer for benchmarks: attaches to the next run in a runtime directory and reads, dawdles or stops.

    watch.py RUNTIME_DIR live|sync TOPIC reading|slow|stopped

Prints "attached" after the first message.
"""
import os
import pathlib
import signal
import sys
import time

import zmq

runtime, plane, topic, behaviour = sys.argv[1:]
context = zmq.Context()


def endpoint_of_clock():
    while True:
        for path in pathlib.Path(runtime).glob("ensonify/*/clock.endpoint"):
            return path.read_text().strip()
        time.sleep(0.002)


def endpoint_of_topic(clock):
    query = context.socket(zmq.DEALER)
    query.connect(clock)
    while True:
        query.send_json({"kind": "registry"})
        for entry in query.recv_json()["topics"]:
            if entry["topic"] == topic:
                return entry[plane]
        time.sleep(0.002)


seen = context.socket(zmq.SUB)
seen.set_hwm(2)
seen.subscribe(topic.encode() + b"\0")
seen.connect(endpoint_of_topic(endpoint_of_clock()))
seen.recv_multipart(copy=False)
print("attached", flush=True)
if behaviour == "stopped":
    os.kill(os.getpid(), signal.SIGSTOP)
while True:
    seen.recv_multipart(copy=False)
    if behaviour == "slow":
        time.sleep(0.05)
