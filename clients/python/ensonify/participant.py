"""Taking part in a run: inputs due at each event, outputs at event times, in lockstep with everybody else.

    with ensonify.Participant("agent") as me:
        pings = me.subscribe("ping", ensonify.Ping)
        command = me.publish("command", ensonify.Guidance)
        for step in me.steps(rate=10):
            for ping in pings:  # those that became due since the last step
                ...
            command.send(ensonify.Guidance(stamp_ns=step.t_ns, speed_mps=1.5))
"""
import collections
import fractions
import json
import math
import os
import sys
from typing import Any, Iterator, Mapping

from ensonify import wire
from ensonify.injections import InjectedKill, Injector
from ensonify.launching import assignments
from ensonify.packets import Ending
from ensonify.rate_limit import RateLimit
from ensonify.session import EXIT_BAD_INPUT, EXIT_DIED, RunError, Session, wall_ns
from ensonify.typed import Message, declared_in


class Received:
    """A message with what its envelope says."""

    __slots__ = ("topic", "envelope", "content")

    def __init__(self, topic: str, envelope: wire.Envelope, content: Any):
        self.topic = topic
        self.envelope = envelope
        self.content = content

    @property
    def t_sim_ns(self) -> int:
        """Time of the event that published it."""
        return self.envelope.t_sim_ns


class In:
    """An input. Iterating yields the messages that became due at the current step, each once, in order."""

    def __init__(self, port: str, message_type: type | None, delay_ns: int, optional: bool, topics: list):
        self.port = port
        self.message_type = message_type
        self.delay_ns = delay_ns
        self.optional = optional
        self.topics = topics
        self.received: list = []  # as iterating, with envelopes
        self.latest: Any = None  # the newest message of all steps so far, None before the first

    def __iter__(self) -> Iterator:
        return iter([received.content for received in self.received])

    def declaration(self) -> dict:
        """This port in HELLO and --check."""
        return {"port": self.port, "type": self.message_type.TYPE if self.message_type else "*",
                "delay_ns": self.delay_ns, "optional": self.optional, "topics": self.topics}


class Out:
    """An output."""

    def __init__(self, participant: "Participant", port: str, message_type: type, max_bytes: int, rate: tuple):
        self._participant = participant
        self.port = port
        self.message_type = message_type
        self.max_bytes = max_bytes
        self.rate = rate
        self.topic: str | None = None  # known once joined
        self.topic_id = 0
        self._topic_frame = b""
        self._limit = RateLimit(rate)
        self._hash = wire.type_hash(message_type.TYPE)

    def declaration(self) -> dict:
        """This port in HELLO and --check."""
        return {"port": self.port, "type": self.message_type.TYPE, "max_bytes": self.max_bytes, "rate": list(self.rate)}

    def connect(self, topic: str, topic_id: int) -> None:
        """The clock says what topic this port is, in each epoch."""
        self.topic, self.topic_id, self._topic_frame = topic, topic_id, topic.encode() + b"\0"
        self._limit = RateLimit(self.rate)

    def send(self, message: Message) -> None:
        """Publishes at the current step's time. Arrays travel without a copy: do not write to them afterwards."""
        if not isinstance(message, self.message_type):
            raise TypeError(f"{self.port} carries {self.message_type.TYPE}, not {type(message).__name__}")
        self._participant._send(self.port, message.to_map(), self._publish)

    def _publish(self, content: dict) -> None:
        body = wire.encode_body(content)
        size = sum(memoryview(part).nbytes for part in body)
        if size > self.max_bytes:
            raise ValueError(f"{self.port}: {size} bytes, at most {self.max_bytes} were declared")
        if not self._limit.take(self._participant._now_ns):
            raise ValueError(f"{self.port}: more than {self._limit}: publish(rate=...) declares how many there may be")
        self._participant._publish(self._topic_frame, self.topic_id, self._hash, body)


class Step:
    """One event of this participant."""

    __slots__ = ("t_ns", "next_ns")

    def __init__(self, t_ns: int, next_ns: int):
        self.t_ns = t_ns  # sim time of the event
        self.next_ns = next_ns  # time of the next one; may be moved, but never to t_ns or before

    @property
    def t_s(self) -> float:
        """Sim time of the event in seconds."""
        return self.t_ns * 1e-9


class Participant:
    """One process of a run. Name, clock and configuration come from the launcher unless given.

    Use it as a context manager: an exception inside ends the run and names this process; leaving steps() early means
    that nothing more is published, and the run goes on without it.
    """

    def __init__(self, name: str | None = None, *, clock: str | None = None, config: dict | None = None,
                 may_finish: bool = False, patience_s: float = math.inf):
        self.name = name or os.environ.get("ENSONIFY_NAME") or os.path.splitext(os.path.basename(sys.argv[0]))[0]
        self.config = configuration() if config is None else config
        self._clock = clock or os.environ.get("ENSONIFY_CLOCK")
        self.facts: dict = {}  # of the epoch, known once joined: "launch", "scenario", ...
        self._may_finish = may_finish
        self._patience_s = patience_s  # wall seconds that the others may take between two steps
        self._finish = False
        self._resets = False  # can begin another epoch
        self._resetting = False  # has asked for one
        self._ins: list = []
        self._outs: list = []
        self._declares: dict = {}  # by type
        self._session: Session | None = None
        self._left = False
        self._now_ns: int | None = None
        self._injector: Injector | None = None  # of the epoch
        self._queues: list = []  # (delay ns, deque of (topic, Packet), In), one per edge
        self._by_topic: dict = {}  # topic id -> queues that want it
        self._may_be_lost: set = set()  # topics whose publisher the run may lose
        self._ended: set = set()  # those of which nothing more is taken

    # --- declaring ports, before the first step

    def subscribe(self, port: str, message_type: type | None = None, *, delay_ms: float = 0.0, optional: bool = False,
                  topics: list | None = None) -> In:
        """An input of one type; without a type, every message of the `topics` (names or patterns as "*", "bow/*"),
        as plain maps. A message published at t is seen from t + delay on."""
        port_in = In(port, message_type, round(delay_ms * 1e6), optional or message_type is None, topics or [])
        self._ins.append(port_in)
        return port_in

    def publish(self, port: str, message_type: type, *, max_bytes: int = 4096, rate=10) -> Out:
        """An output: at most `max_bytes` per message and `rate` messages per second, which it is
        held to: what one second of it brings and 2 more may come at once."""
        port_out = Out(self, port, message_type, max_bytes, as_fraction(rate))
        self._outs.append(port_out)
        return port_out

    def declare(self, declaration: Message) -> None:
        """What others want to know of this process before time starts, such as a HeadDeclaration; one of each type."""
        self._declares[declaration.TYPE] = declaration.to_map()

    def declaration(self) -> dict:
        """What --check prints: the ports of this process, and what it declares."""
        return {"name": self.name, "component": "python", "may_finish": self._may_finish, "declares": self._declares,
                "out": [port.declaration() for port in self._outs], "in": [port.declaration() for port in self._ins]}

    def declared(self, message_type: type) -> dict:
        """What processes of the run declare, by process: `declared(ensonify.HeadDeclaration)["bow"]`. Known once joined."""
        return declared_in(self.facts.get("declarations", "{}"), message_type)

    # --- running

    def epochs(self) -> Iterator[int]:
        """Each epoch of the run, by its number: the first, and another after each reset. Go through steps() in it.

            for epoch in me.epochs():
                for step in me.steps(rate=10):
                    ...
        """
        self._resets = True
        epoch: int | None = 1
        while epoch is not None:
            yield epoch
            session = self._session
            if session is None or session.next_epoch == epoch:
                raise RuntimeError("each epoch is to be gone through by steps()")
            if not self._left and session.next_epoch is None:
                self._idle()
            epoch = session.next_epoch

    def reset(self, settings: Mapping[str, Any] | None = None, *, out: str | os.PathLike | None = None) -> None:
        """Ends the epoch for everyone at this step, and begins another in the same processes: sim time 0, with parameters
        `settings` (as --set has them: {"seed": 7, "nav.altimeter.dropout": 0.3}) behind those of the launch. Its results go
        to the folder `out`, else to epochs/N within the launch's. Within epochs() only; the steps end then. A RunError says
        why it cannot be, and the epoch goes on."""
        if not self._resets or self._now_ns is None:
            raise RuntimeError("reset() is called within a step within epochs()")
        self._session.reset(assignments(settings or {}), os.path.abspath(out) if out is not None else "")
        self._resetting = True

    def steps(self, rate=None, *, first_ns: int = 0) -> Iterator[Step]:
        """Joins the run and yields every event: with `rate` (Hz, a number or (num, den)) at first_ns + n / rate, else at
        first_ns and then at each step.next_ns that you set. Ends with the run, within epochs() with the epoch."""
        if "--check" in sys.argv[1:]:
            print(json.dumps(self.declaration()))
            raise SystemExit(0)
        num, den = as_fraction(rate) if rate is not None else (0, 1)
        self._join(first_ns)
        session = self._session
        step, n = Step(first_ns, first_ns), 0
        while (grant := session.wait_grant()) is not None and session.collect(grant, self._enqueue):
            began = wall_ns()
            while step.next_ns <= grant.horizon_ns:
                t_ns = step.next_ns
                n += 1
                step = Step(t_ns, first_ns + n * 1_000_000_000 * den // num if num else wire.NEVER)
                self._now_ns = t_ns
                if self._injector is not None:
                    self._begin_step(t_ns)
                self._deliver(t_ns)
                yield step
                self._now_ns = None
                if self._resetting:
                    break
                if step.next_ns <= t_ns:
                    raise ValueError(f"next_ns must be later than this step ({t_ns} ns), not {step.next_ns}")
                if self._finish:
                    break
            if self._resetting:
                self._resetting = False
                session.done(wire.NEVER, False, wall_ns() - began, for_ever=False)
            elif self._finish:  # the clock takes the end from this promise; events until then come with later grants
                self._finish = False
                session.done(t_ns + 1, True, wall_ns() - began)
            else:
                session.done(step.next_ns, False, wall_ns() - began, for_ever=not self._resets)
        if session.next_epoch is None:
            self._leave()

    def finish(self) -> None:
        """Ends the run for everyone, one second after this step. Needs may_finish=True."""
        if not self._may_finish:
            raise RuntimeError("only a participant made with may_finish=True can end the run")
        self._finish = True

    def leave(self, *, stay: bool = True) -> None:
        """Promises to publish nothing more, stays until the run has ended, and gives the sockets back. A context manager
        does it by itself. Without `stay` it goes at once: that is for a run that is gone."""
        if self._session is None:
            return
        try:
            if stay and not self._left:
                self._idle()
        finally:
            self._session.close()

    @property
    def end_code(self) -> int | None:
        """Exit code of the run, None while it goes on."""
        return self._session.end_code if self._session else None

    def __enter__(self) -> "Participant":
        return self

    def __exit__(self, kind, error, trace) -> bool:
        session = self._session
        if session is None:
            return self._reported(error)
        try:
            if kind is None and not self._left:
                self._idle()
            elif error is not None and not self._left:
                code = error.code if isinstance(error, RunError) else EXIT_DIED
                text = f"{kind.__name__}: {error}" if str(error) else kind.__name__
                known = isinstance(error, RunError)
                session.fail(code, str(error) if known else text, error.culprit if known else "")
        finally:
            session.close()
        return self._reported(error)

    # --- inside

    @staticmethod
    def _reported(error) -> bool:
        """A run's own errors need no traceback: one line and the exit code say it."""
        if isinstance(error, RunError):
            print(error, file=sys.stderr)
            raise SystemExit(error.code) from None
        if isinstance(error, KeyboardInterrupt):
            raise SystemExit(130) from None
        return False

    def _join(self, first_ns: int) -> None:
        hello = {**self.declaration(), "pid": os.getpid(), "resets": self._resets, "first_ns": first_ns, "facts": {}}
        if self._session is None:
            if not self._clock:
                raise RunError(f"{self.name}: no clock to join: ENSONIFY_CLOCK is not set", EXIT_BAD_INPUT)
            self._session = Session(self.name, self._clock, self._patience_s)
            welcome = self._session.join(hello)
        elif self._session.next_epoch is not None:
            welcome = self._session.join_again(hello)
        else:
            raise RuntimeError("steps() can be used once in an epoch")
        self._queues, self._by_topic = [], {}
        self._may_be_lost, self._ended = {entry["topic"] for entry in welcome["in"] if entry.get("may_be_lost")}, set()
        for port in self._ins:
            port.received, port.latest = [], None
        self.facts = welcome.get("facts", {})
        self._injector = Injector(self.facts, self.name) if self.facts.get("inject") else None
        outs = {port.port: port for port in self._outs}
        ins = {port.port: port for port in self._ins}
        for entry in welcome["out"]:
            outs[entry["port"]].connect(entry["topic"], entry["topic_id"])
        for entry in welcome["in"]:
            queue = (entry["delay_ns"], collections.deque(), ins[entry["port"]], entry["topic"])
            self._queues.append(queue)
            self._by_topic.setdefault(entry["topic_id"], []).append(queue[1])

    def _enqueue(self, topic_id: int, packet) -> None:
        for queue in self._by_topic[topic_id]:
            queue.append(packet)

    def _deliver(self, t_ns: int) -> None:
        """Hands each input what is due at t_ns, in the order (t_sim, publisher, topic id, seq)."""
        for port in self._ins:
            port.received = []
        due = []
        for delay_ns, queue, port, topic in self._queues:
            while queue and queue[0].envelope.t_sim_ns + delay_ns <= t_ns:
                packet = queue.popleft()
                e = packet.envelope
                due.append(((e.t_sim_ns, e.publisher, e.topic_id, e.seq), packet, port, topic))
        due.sort(key=lambda entry: entry[0])
        for _, packet, port, topic in due:
            if topic in self._ended:
                continue
            try:
                content = self._content(port, topic, packet)
            except RunError as why:
                self._end(topic, t_ns, why)
                continue
            port.received.append(Received(topic, packet.envelope, content))
            port.latest = content

    def _end(self, topic: str, t_ns: int, why: RunError) -> None:
        """Goes on without a topic whose publisher may be lost; raises `why` for any other."""
        if topic not in self._may_be_lost:
            raise why
        if topic not in self._ended:
            self._ended.add(topic)
            self._session.unusable(t_ns, why)

    @staticmethod
    def _content(port: In, topic: str, packet) -> Any:
        """What a message says. One that cannot be read is its sender's mistake."""
        if isinstance(packet, Ending):
            raise packet.why
        try:
            content = wire.decode_body(packet.head, packet.arrays)
            return content if port.message_type is None else port.message_type.from_map(content)
        except wire.DecodeError as error:
            sender = topic.split("/")[0]
            raise RunError(f"{sender} sent a message that cannot be used: {topic}: seq {packet.envelope.seq}: {error}", EXIT_DIED,
                           sender) from None

    def _send(self, port: str, content: dict, publish) -> None:
        if self._now_ns is None:
            raise RuntimeError("messages are published within a step")
        if self._injector is None:
            return publish(content)
        return self._injector.send(port, self._now_ns, content, publish)

    def _begin_step(self, t_ns: int) -> None:
        try:
            self._injector.begin_step(t_ns)
        except InjectedKill as kill:  # the others know of all that was published before
            self._session.done(t_ns, False, 0)
            self._session.close()
            self._left = True
            os.kill(os.getpid(), kill.signal)
            raise SystemExit(128 + kill.signal) from None  # who catches that signal ends all the same

    def _publish(self, topic: bytes, topic_id: int, type_hash: int, body: list) -> None:
        if self._now_ns is None:
            raise RuntimeError("messages are published within a step")
        self._session.publish(topic, topic_id, type_hash, self._now_ns, body)

    def _idle(self) -> None:
        """The user left the loop: promise to publish nothing more, and stay until the epoch ends."""
        session = self._session
        finish, self._finish = self._finish and self._now_ns is not None, False
        self._resetting = False
        session.done(self._now_ns + 1 if finish else wire.NEVER, finish, 0, for_ever=not self._resets)
        while (grant := session.wait_grant()) is not None:
            if not session.collect(grant, lambda topic_id, packet: None):
                break
            session.done(wire.NEVER, False, 0, for_ever=not self._resets)
        self._now_ns = None
        if session.next_epoch is None:
            self._leave()

    def _leave(self) -> None:
        if not self._left:
            self._left = True
            self._session.bye()


def configuration() -> dict:
    """This process's `config:` of the launch file, which the launcher hands over as JSON in ENSONIFY_CONFIG."""
    text = os.environ.get("ENSONIFY_CONFIG") or "{}"
    try:
        config = json.loads(text)
    except ValueError as error:
        raise RunError(f"ENSONIFY_CONFIG is no JSON: {error}", EXIT_BAD_INPUT) from None
    if not isinstance(config, dict):
        raise RunError("ENSONIFY_CONFIG is no JSON object", EXIT_BAD_INPUT)
    return config


def as_fraction(rate) -> tuple:
    """A rate in Hz as (num, den), so that 15 Hz and (30000, 1001) are exact."""
    if isinstance(rate, tuple):
        num, den = rate
    else:
        try:
            num, den = fractions.Fraction(rate).limit_denominator(1_000_000).as_integer_ratio()
        except (TypeError, ValueError, OverflowError):
            num, den = 0, 1
    if num <= 0 or den <= 0:
        raise ValueError(f"a rate is a positive number of events per second, not {rate!r}")
    return int(num), int(den)
