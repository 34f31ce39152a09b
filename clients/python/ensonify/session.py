"""A participant's sockets: joining, proving edges, collecting what a grant names, answering it (docs/manual/wire.md)."""
import json
import math
import os
import re
import socket
import time

import zmq
import zmq.utils.monitor

from ensonify import wire
from ensonify.keys import Gate, keys_for, set_bound, set_connected
from ensonify.packets import Ending, Packet, decoded_envelope, judged
from ensonify.run_error import EXIT_BAD_INPUT, EXIT_DATA_LOST, EXIT_DIED, EXIT_OK, EXIT_STALL, RunError

LIVE_QUEUE = 4  # messages kept for a viewer that does not keep up; the rest is dropped
LONGEST_WINDOW_S = 5  # how far a launch file may let a publisher run ahead of its readers
LONGEST_WINDOW_NS = LONGEST_WINDOW_S * 1_000_000_000
FLUSH_MS = 2000  # how long what has been sent may take to leave after the end
PATIENCE_S = 50.0  # how long what a grant counts may take to come, unless the clock says otherwise
ENDED = math.inf  # in the place of a count: nothing more of the topic is awaited or taken
WAKE_MS = 1000  # how often a waiting participant checks whether the clock is still there

_EVENTS, _POLLIN, _SNDMORE, _RCVMORE = int(zmq.EVENTS), int(zmq.POLLIN), int(zmq.SNDMORE), int(zmq.RCVMORE)  # plain numbers: pyzmq's enums cost more than the calls

class Session:
    """Everything between a participant and ZeroMQ. No thread of ours: libzmq's own drains the data, and the clock's
    window bounds how much can be on its way, so the receiving queue needs no limit."""

    def __init__(self, name: str, clock: str, longest_wait_s: float = math.inf):
        self.name = name
        self._longest_wait_s = longest_wait_s  # wall time for the clock's next word
        self._context = zmq.Context()
        self._keys = keys_for(clock, os.environ.get("ENSONIFY_RUN_DIR"))
        self._gate = Gate(self._context, self._keys) if self._keys else None
        self._control = self._context.socket(zmq.DEALER)
        self._control.setsockopt(zmq.LINGER, FLUSH_MS)
        self._control.setsockopt(zmq.IDENTITY, name.encode())
        self._control.setsockopt(zmq.RECONNECT_IVL, 5)
        self._control.setsockopt(zmq.RCVTIMEO, WAKE_MS)
        self._monitor = self._control.get_monitor_socket(zmq.EVENT_DISCONNECTED)
        self._sync = self._context.socket(zmq.XPUB)
        self._sync.setsockopt(zmq.XPUB_NODROP, 1)
        self._sync.setsockopt(zmq.LINGER, FLUSH_MS)
        self._live = self._context.socket(zmq.XPUB)
        self._viewed: set = set()  # what viewers have subscribed to
        self._live.setsockopt(zmq.SNDHWM, LIVE_QUEUE)
        self._live.setsockopt(zmq.LINGER, 0)
        self._sub = self._context.socket(zmq.SUB)
        self._sub.setsockopt(zmq.RCVHWM, 0)
        self._sub.setsockopt(zmq.RCVTIMEO, WAKE_MS)
        self._sub.setsockopt(zmq.LINGER, 0)
        self.epoch = 0
        self.rank = 0
        self._patience_s = PATIENCE_S
        self.end_code = None  # set once the run has ended
        self.next_epoch: int | None = None  # set once the present one has ended and another is to begin
        self._idle = False  # nothing that comes is of use any more
        self._arrived: dict = {}  # topic id -> messages so far, or ENDED
        self._newest_ns: dict = {}  # topic id -> sim time of the newest message
        self._latest_ns = LONGEST_WINDOW_NS  # sim time beyond which nothing can have been sent
        self._topics: dict = {}  # first frame of a topic's messages -> its entry in WELCOME
        self._published: dict = {}  # topic id -> messages so far
        self._early: list = []  # packets that no grant has counted yet
        self._lost: set = set()  # processes that are no more
        self._closed: set = set()  # topics of theirs of which not all has come
        try:
            self._bind(clock)
        except zmq.ZMQError as error:
            self.close()
            raise RunError(f"{name}: cannot reach {clock}: {error}", EXIT_BAD_INPUT) from None

    def _bind(self, clock: str) -> None:
        if clock.startswith("ipc://"):
            folder = os.path.dirname(clock)
            self.endpoints = {"sync": f"{folder}/{self.name}.sync", "live": f"{folder}/{self.name}.live"}
        elif re.fullmatch(r"tcp://[\d.]+:\d+", clock):
            here = host_towards(clock)
            if self._keys is None and not here.startswith("127."):
                self.close()
                raise RunError(f"{self.name}: {clock} asks for the run's keys; name them with ENSONIFY_KEYS", EXIT_BAD_INPUT)
            self.endpoints = {"sync": f"tcp://{here}:*", "live": f"tcp://{here}:*"}
        else:
            self.close()
            raise RunError(f"{self.name}: {clock!r} is no clock; ipc://... and tcp://ADDRESS:PORT are", EXIT_BAD_INPUT)
        set_connected(self._control, self._keys)
        set_connected(self._sub, self._keys)
        for plane, own in (("sync", self._sync), ("live", self._live)):
            set_bound(own, self._keys)
            own.bind(self.endpoints[plane])
            self.endpoints[plane] = own.getsockopt_string(zmq.LAST_ENDPOINT).rstrip("\0")
        self._control.connect(clock)

    # --- joining

    def join(self, hello: dict) -> dict:
        """Says HELLO and returns the WELCOME once every edge into this process is subscribed and every edge out of it
        is proven."""
        self._sync.setsockopt(zmq.SNDHWM, sum(queue_length(*out["rate"]) for out in hello["out"]))
        welcome = self._introduce(hello)
        self._subscribe(welcome["in"])
        self._prove({token for out in welcome["out"] for token in out["tokens"]})
        self._note_viewers()
        return welcome

    def join_again(self, hello: dict) -> dict:
        """The same for the epoch that has been announced, over the edges that are there. Returns its WELCOME."""
        welcome = self._introduce({**hello, "epoch": self.next_epoch})
        self.next_epoch, self._idle = None, False
        self._send_control({"kind": "ready"})
        return welcome

    def _introduce(self, hello: dict) -> dict:
        self._send_control({**hello, "kind": "hello", "name": self.name, **self.endpoints})
        welcome = self._await_json("welcome")
        self.epoch, self.rank = welcome["epoch"], welcome["rank"]
        self._patience_s = welcome.get("patience_s", PATIENCE_S)
        self._published = {out["topic_id"]: 0 for out in welcome["out"]}
        self._topics = {entry["topic"].encode() + b"\0": {**entry, "hash": wire.type_hash(entry["type"])} for entry in welcome["in"]}
        self._arrived = {entry["topic_id"]: 0 for entry in welcome["in"]}
        self._newest_ns, self._latest_ns, self._early = {}, LONGEST_WINDOW_NS, []
        return welcome

    def _subscribe(self, inputs: list) -> None:
        for endpoint in {entry["endpoint"] for entry in inputs}:
            self._sub.connect(endpoint)
        for entry in inputs:
            self._sub.subscribe(entry["topic"].encode() + b"\0")
        for entry in inputs:  # last, so that a token vouches for the topics before it
            self._sub.subscribe(b"~" + entry["token"].encode())

    def _prove(self, tokens: set) -> None:
        poller = zmq.Poller()
        poller.register(self._sync, zmq.POLLIN)
        poller.register(self._control, zmq.POLLIN)
        while tokens:
            ready = dict(poller.poll(WAKE_MS))
            if not ready:
                self._check_clock()
            if self._control in ready:
                self._control_message(self._control.recv())  # an end, before it began
                if self.end_code is not None:
                    return
            proven = []
            while self._sync in ready and self._sync.getsockopt(zmq.EVENTS) & zmq.POLLIN:
                subscription = self._sync.recv()
                token = subscription[2:].decode() if subscription[:2] == b"\x01~" else None
                if token in tokens:
                    tokens.discard(token)
                    proven.append(token)
            if proven:
                self._send_control({"kind": "proven", "tokens": proven})

    # --- running

    def wait_grant(self) -> wire.Grant | None:
        """The next grant of this epoch, or None once it has ended."""
        while self.end_code is None and self.next_epoch is None:
            grant = self._control_message(self._receive_control())
            if grant is not None and grant.epoch == self.epoch:
                return grant
        return None

    def collect(self, grant: wire.Grant, deliver) -> bool:
        """Calls deliver(topic id, packet) for all that the grant counts, once it has arrived. What it does not count waits:
        should its publisher be lost before it has counted it, nobody reads it. False if the run ended meanwhile."""
        if self._sub.closed:
            return True
        counts = dict(grant.counts)
        arrived, self._early = self._early, []
        for packet in arrived:
            self._sort_in(packet, counts, deliver)
        for topic_id, count in grant.counts:
            waited_ms = 0
            while self._arrived.get(topic_id, count) < count and topic_id not in self._closed:
                try:
                    topic = self._sub.recv()
                except zmq.Again:
                    self._check_clock()
                    if self._control.getsockopt(zmq.EVENTS) & zmq.POLLIN:
                        self._control_message(self._control.recv())
                    if self.end_code is not None:
                        return False
                    if self._publisher(topic_id) in self._lost:
                        self._closed.add(topic_id)
                        break
                    waited_ms += WAKE_MS
                    if waited_ms > 1000 * self._patience_s:
                        self._sort_in(self._ending(*self._missing(topic_id, count)), counts, deliver)
                    continue
                waited_ms = 0
                packet = self._packet(topic)
                if packet is not None:
                    self._sort_in(packet, counts, deliver)
        return True

    def _sort_in(self, packet: Packet | Ending, counts: dict, deliver) -> None:
        topic_id = packet.envelope.topic_id
        if topic_id in self._closed:
            return
        if packet.envelope.seq < counts.get(topic_id, 0):
            deliver(topic_id, packet)
        else:
            self._early.append(packet)

    def _publisher(self, topic_id: int) -> str:
        return next(entry["publisher"] for entry in self._topics.values() if entry["topic_id"] == topic_id)

    def _missing(self, topic_id: int, count: int) -> tuple:
        entry = next(entry for entry in self._topics.values() if entry["topic_id"] == topic_id)
        return entry, RunError(f"{entry['publisher']} lost messages: {entry['topic']}: its DONE counted {count}, {self._arrived[topic_id]} "
                        "have come", EXIT_DATA_LOST, entry["publisher"])

    def done(self, next_ns: int, finish: bool, cost_ns: int, for_ever: bool = True) -> None:
        """Answers the grant. Whatever was published until now has been handed to ZeroMQ before. Who will do nothing more is sent
        nothing more, or it would pile up here; unless that is for this epoch only."""
        if next_ns == wire.NEVER and for_ever:
            self._sub.close()
        self._idle = next_ns == wire.NEVER
        self._latest_ns = next_ns + LONGEST_WINDOW_NS
        self._control.send(wire.encode_done(self.epoch, next_ns, finish, cost_ns, self._published.items()))
        if self._published:
            self._note_viewers()  # while the others work

    def reset(self, sets: list, out: str) -> None:
        """Asks for another epoch; a RunError where it is refused, and this one goes on. To be followed by done(NEVER)."""
        self._send_control({"kind": "reset", "set": sets, "out": out})
        answer = self._await_json("reset")
        if not answer["ok"]:
            raise RunError(answer["error"], EXIT_BAD_INPUT)

    def publish(self, topic: bytes, topic_id: int, type_hash: int, t_sim_ns: int, body: list) -> None:
        """Sends on both planes; waits while a participant does not keep up. `topic` ends in NUL."""
        seq = self._published[topic_id]
        self._published[topic_id] = seq + 1
        envelope = wire.encode_envelope(
            wire.Envelope(0, self.epoch, self.rank, topic_id, 2 + len(body), type_hash, seq, t_sim_ns))
        frames = [topic, envelope, *body]
        _send(self._sync, frames)
        if self._viewed:
            _send(self._live, frames)

    def _note_viewers(self) -> None:
        """Who wants to see from the next step on; asking lets ZeroMQ take note of them, too."""
        while self._live.getsockopt(_EVENTS) & _POLLIN:
            subscription = self._live.recv()
            (self._viewed.add if subscription[:1] == b"\x01" else self._viewed.discard)(subscription[1:])

    # --- leaving

    def bye(self) -> None:
        """Answers the end."""
        self._send_control({"kind": "bye"})

    def fail(self, code: int, message: str, culprit: str = "") -> None:
        """Reports to the clock why this process leaves."""
        self._send_control({"kind": "failed", "code": code, "message": message, **({"culprit": culprit} if culprit else {})})

    def unusable(self, t_ns: int, why: RunError) -> None:
        """Reports to the clock that from an event on a topic is done without, whose publisher may be lost."""
        self._send_control({"kind": "unusable", "t_ns": t_ns, "code": why.code, "message": str(why), "culprit": why.culprit})

    def close(self) -> None:
        """Lets what has been sent leave, then gives every socket back."""
        if self._context.closed:
            return
        self._control.disable_monitor()
        for socket in (self._monitor, self._control, self._sync, self._live, self._sub):
            socket.close()
        if self._gate is not None:
            self._gate.close()
        self._context.term()

    # --- inside

    def _send_control(self, what: dict) -> None:
        self._control.send(json.dumps(what, separators=(",", ":")).encode())

    def _receive_control(self) -> bytes:
        waited_ms = 0
        while waited_ms <= 1000 * self._longest_wait_s:
            try:
                return self._control.recv()
            except zmq.Again:
                self._check_clock()
                if self._idle:
                    self._drop()
                waited_ms += WAKE_MS
        raise RunError(f"{self.name}: the others have made no progress for {self._longest_wait_s:g} s", EXIT_STALL)

    def _drop(self) -> None:
        while not self._sub.closed and self._sub.getsockopt(_EVENTS) & _POLLIN:
            self._sub.recv(copy=False)

    def _await_json(self, kind: str) -> dict:
        while True:
            message = json.loads(self._receive_control())
            if message.get("kind") == kind:
                return message
            self._refused_or_ended(message)
            if self.end_code is not None:
                raise RunError(f"{self.name}: the run ended before it began", EXIT_DIED)

    def _control_message(self, data: bytes) -> wire.Grant | None:
        if data[:1] == b"G":
            return wire.decode_grant(data)
        self._refused_or_ended(json.loads(data))
        return None

    def _refused_or_ended(self, message: dict) -> None:
        if message.get("kind") == "refused":
            raise RunError("\n".join(message["problems"]), EXIT_BAD_INPUT)
        if message.get("kind") == "end":
            self.end_code = message.get("code", EXIT_OK)
        if message.get("kind") == "lost":
            self._lost.add(message["process"])
        if message.get("kind") == "epoch":
            self.next_epoch = message["epoch"]

    def _check_clock(self) -> None:
        if self._monitor.getsockopt(zmq.EVENTS) & zmq.POLLIN:
            self._control.setsockopt(zmq.LINGER, 0)  # nobody will read what is left
            raise RunError(f"{self.name}: the clock is gone", EXIT_DIED)

    def _packet(self, topic: bytes) -> Packet | Ending | None:
        """The rest of the message that begins with `topic`, if it is the one that its topic expects; None if nothing is to be had of
        it: it is of an epoch before, or its topic has ended. Small frames are copied, arrays are not."""
        entry = self._topics.get(topic) or next((each for each in self._topics.values() if topic == b"~" + each["token"].encode()), None)
        if entry is None:
            raise RunError(f"{self.name}: {topic!r} is no topic of ours", EXIT_DIED)
        frames = []
        more = self._sub.getsockopt(_RCVMORE)
        while more:
            frames.append(self._sub.recv(copy=False))
            more = frames[-1].more
        if self._arrived[entry["topic_id"]] == ENDED:
            return None
        try:
            envelope = decoded_envelope(entry, frames, self._arrived[entry["topic_id"]])
        except RunError as why:
            return self._ending(entry, why)
        if 1 <= envelope.epoch < self.epoch:
            return None
        try:
            packet = judged(entry, envelope, frames, self.epoch, self._arrived[entry["topic_id"]])
        except RunError as why:
            return self._ending(entry, why, envelope.t_sim_ns)
        self._arrived[entry["topic_id"]] += 1
        self._newest_ns[entry["topic_id"]] = envelope.t_sim_ns
        return packet

    def _ending(self, entry: dict, why: RunError, t_ns: int | None = None) -> Ending:
        """In the place of what cannot be used: the run goes on without a publisher that may be lost. Raises `why` for any other."""
        if not entry.get("may_be_lost"):
            raise why
        topic_id = entry["topic_id"]
        seq, self._arrived[topic_id] = self._arrived[topic_id], ENDED
        newest_ns = self._newest_ns.get(topic_id, 0)
        known = t_ns is not None and newest_ns <= t_ns <= self._latest_ns
        return Ending(wire.Envelope(0, self.epoch, entry["rank"], topic_id, 0, entry["hash"], seq, t_ns if known else newest_ns), why)


def host_towards(endpoint: str) -> str:
    """The address of this machine by which it reaches a tcp endpoint."""
    host, _, port = endpoint[len("tcp://"):].rpartition(":")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.connect((host, int(port)))  # sends nothing
        return probe.getsockname()[0]


def _send(socket, frames: list) -> None:
    """A message whose first three frames are bytes and whose arrays are handed over uncopied."""
    last = len(frames) - 1
    for n, frame in enumerate(frames):
        socket.send(frame, _SNDMORE if n < last else 0, n < wire.FIRST_ARRAY_FRAME)


def queue_length(num: int, den: int) -> int:
    """Messages of an output at num / den Hz that may be on their way at once."""
    return 2 + -(-LONGEST_WINDOW_S * num // den)


def wall_ns() -> int:
    """For what an event costs; never part of a result."""
    return time.perf_counter_ns()
