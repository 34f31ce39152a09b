"""Watching a run through the live plane: lossy for a slow reader, and never able to slow the run.

    with ensonify.Observer() as run:
        for received in run.messages("bow/soundings"):
            print(received.t_sim_ns, received.content.position_enu_m)
"""
import fnmatch
import json
import os
import time
from typing import Any, Iterator, Mapping

import zmq

from ensonify import messages, wire
from ensonify.keys import keys_for, set_connected
from ensonify.launching import assignments
from ensonify.participant import Received
from ensonify.runs import find_run
from ensonify.session import EXIT_BAD_INPUT, EXIT_DIED, RunError

QUEUE = 8  # messages kept per publisher for a reader that does not keep up


class Observer:
    """Asks a run's clock and listens to its topics."""

    def __init__(self, run: str | os.PathLike | None = None, *, answer_s: float = 5.0):
        self.clock, folder = find_run(run)
        self._keys = keys_for(self.clock, folder)
        self._answer_s = answer_s  # wall seconds that the clock has for an answer
        self._context = zmq.Context()
        self._control = self._context.socket(zmq.DEALER)
        self._control.setsockopt(zmq.LINGER, 0)
        self._control.setsockopt(zmq.RECONNECT_IVL, 5)
        set_connected(self._control, self._keys)
        self._control.connect(self.clock)

    def ask(self, kind: str, **what: Any) -> dict:
        """A request of docs/manual/wire.md, e.g. ask("status"), ask("get", what="scenario"), ask("rate", rate=4.0)."""
        self._control.send(json.dumps({"kind": kind, **what}).encode())
        until = time.monotonic() + self._answer_s
        while (left := until - time.monotonic()) > 0:
            if self._control.poll(round(left * 1000) + 1):
                answer = json.loads(self._control.recv())
                if answer.get("kind") == kind:
                    return answer
        raise RunError(f"the clock at {self.clock} did not answer {kind!r} within {self._answer_s:g} s", EXIT_DIED)

    def reset(self, settings: Mapping[str, Any] | None = None, *, out: str | os.PathLike | None = None) -> int:
        """Ends the epoch in order and begins another in the same processes, as Participant.reset does. Its number; a RunError
        where it is refused."""
        answer = self.ask("reset", set=assignments(settings or {}), out=os.path.abspath(out) if out is not None else "")
        if not answer["ok"]:
            raise RunError(answer["error"], EXIT_BAD_INPUT)
        return answer["epoch"]

    def topics(self) -> list:
        """The registry: name, type, publisher, live endpoint, maximum bytes and subscribers of every topic."""
        return self.ask("registry")["topics"]

    def messages(self, *patterns: str, timeout_s: float | None = None) -> Iterator[Received]:
        """Messages of the topics that match ("*" and "bow/*" are patterns), from now on, as they come: typed where the
        type is known, else as maps. Ends after `timeout_s` wall seconds without a message."""
        registry = self.topics()
        chosen = [entry for entry in registry if any(fnmatch.fnmatchcase(entry["topic"], p) for p in patterns)]
        if not chosen:
            known = ", ".join(entry["topic"] for entry in registry)
            raise RunError(f"no topic matches {' '.join(patterns)}; there are {known}", EXIT_BAD_INPUT)
        types = {entry["topic"]: messages.TYPES.get(entry["type"]) for entry in chosen}
        with self._context.socket(zmq.SUB) as sub:
            sub.setsockopt(zmq.RCVHWM, QUEUE)
            sub.setsockopt(zmq.LINGER, 0)
            set_connected(sub, self._keys)
            for endpoint in {entry["live"] for entry in chosen}:
                sub.connect(endpoint)
            for entry in chosen:
                sub.subscribe(entry["topic"].encode() + b"\0")
            while timeout_s is None or sub.poll(round(timeout_s * 1000)):
                yield decoded(sub.recv_multipart(copy=False), types)

    def close(self) -> None:
        """Gives the sockets back."""
        self._context.destroy(linger=0)

    def __enter__(self) -> "Observer":
        return self

    def __exit__(self, *_) -> None:
        self.close()


def decoded(frames: list, types: dict) -> Received:
    """A message of the live plane; `types` maps topic names to message classes or None."""
    if len(frames) < wire.FIRST_ARRAY_FRAME:
        raise wire.DecodeError(f"a message of {len(frames)} frames arrived")
    topic = frames[0].bytes.rstrip(b"\0").decode()
    envelope = wire.decode_envelope(frames[1].bytes)
    last = len(frames) - (envelope.flags & wire.FLAG_WALL_FACTS)
    content: Any = wire.decode_body(frames[2].bytes, [frame.buffer for frame in frames[3:last]])
    if types.get(topic) is not None:
        content = types[topic].from_map(content)
    return Received(topic, envelope, content)
