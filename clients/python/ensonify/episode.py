"""Episodes: a launch with us as one of its processes, stepped event by event, and reset for another episode."""
import collections
import copy
import pathlib
from typing import Any, Mapping

from ensonify.launching import Launch, assignments
from ensonify.observer import Observer
from ensonify.participant import Participant, Received
from ensonify.session import EXIT_BAD_INPUT, EXIT_DIED, EXIT_STALL, RunError
from ensonify.typed import Message

# An agent may learn for long between two steps: what hangs is noticed here, not by the clock.
DEADLINE_S = 3600


class Seen:
    """What is known at a step: `seen[topic]` is the newest message, None before the first."""

    def __init__(self, t_ns: int, inputs: Mapping[str, Any], kept: Mapping[str, Any]):
        self.t_ns = t_ns  # sim time of the step
        self.action: Any = None  # that was taken for it, an array of the action space; None after a reset
        self._latest = {topic: port.latest for topic, port in inputs.items()}
        self._new = {topic: [received.content for received in port.received] for topic, port in inputs.items()}
        self._kept = {topic: list(messages) for topic, messages in kept.items()}

    @property
    def t_s(self) -> float:
        """Sim time of the step in seconds."""
        return self.t_ns * 1e-9

    def __getitem__(self, topic: str) -> Any:
        if topic not in self._latest:
            raise KeyError(f"{topic} is in neither observe nor truth; there are {', '.join(self._latest)}")
        return self._latest[topic]

    def after(self, action: Any) -> "Seen":
        """The same for an agent that took this action."""
        mine = copy.copy(self)
        mine.action = action
        return mine

    def new(self, topic: str) -> list:
        """Messages that have come since the last step, in order."""
        self[topic]
        return self._new[topic]

    def last(self, topic: str) -> list:
        """The newest messages of a topic, in order: as many as ensonify.Rows has rows or the `keeps` of an image says, or fewer."""
        if topic not in self._kept:
            raise KeyError(f"{topic} is kept neither for ensonify.Rows nor by the `keeps` of an image")
        return self._kept[topic]


def texts_of(settings: Mapping[str, Any]) -> dict:
    """Parameters as --set takes them, by key."""
    return dict(assignment.split("=", 1) for assignment in assignments(settings))


def need_external(clock: str, file: Any, agent: str) -> None:
    """A RunError where the launch does not await `agent` from outside: under the name of a process that it starts itself nobody else can join."""
    with Observer(clock) as run:
        external = run.ask("get", what="external")["text"].split()
    if agent not in external:
        raise RunError(f"{file}: agent={agent!r} is not external there; allowed, as it marks them `external: true`: {', '.join(external)}",
                       EXIT_BAD_INPUT, agent)


class Episode:
    """Starts `file` with us as its process `agent`, which reads `topics` and publishes on `ports`, each a name to its message type.
    Of the topics in `kept` it keeps so many of the newest messages. `hosted` as of ensonify.launching.Launch."""

    def __init__(self, file: Any, agent: str, out: pathlib.Path, settings: Mapping[str, Any], topics: Mapping[str, type],
                 kept: Mapping[str, int], ports: Mapping[str, type], rate: Any, patience_s: float, hosted: bool):
        self._settings = texts_of(settings)  # of the launch, which every epoch has
        self._launch = Launch(file, out, {"clock.progress_deadline_s": DEADLINE_S, **settings}, hosted=hosted)
        try:
            need_external(self._launch.clock, file, agent)
        except BaseException:
            self._launch.end()
            raise
        self._me = Participant(agent, clock=self._launch.clock, config={}, patience_s=patience_s)
        self._inputs = {topic: self._me.subscribe(topic, message_type, topics=[topic]) for topic, message_type in topics.items()}
        self._kept = {topic: collections.deque(maxlen=count) for topic, count in kept.items()}
        self._outputs = {port: self._me.publish(port, message_type, rate=rate, max_bytes=1 << 16)
                         for port, message_type in ports.items()}
        self._rate = rate
        self._epochs = self._me.epochs()
        self._over = False
        try:
            self._begin()
        except BaseException:
            self.end()
            raise

    def _begin(self) -> None:
        if next(self._epochs, None) is None:
            raise RunError("the run has ended", EXIT_DIED)
        self._steps = self._me.steps(rate=self._rate)
        for messages in self._kept.values():
            messages.clear()
        self.step()

    def reset(self, settings: Mapping[str, Any], out: pathlib.Path) -> bool:
        """Another episode in the same processes, with its results in `out`. False where that cannot be: then this launch has
        ended."""
        if self._over:
            return False
        added = {key: value for key, value in texts_of(settings).items() if self._settings.get(key) != value}
        try:
            if not self._settings.keys() <= settings.keys():
                raise RunError("a setting of the launch is to be gone", EXIT_BAD_INPUT)
            self._me.reset(added, out=out)
            for _ in self._steps:  # the rest of the epoch: none are left
                pass
            self._begin()
        except RunError:  # a new launch says why, if the settings are wrong
            self.end()
            return False
        return True

    def step(self, messages: Mapping[str, Message] | None = None) -> Seen:
        """Publishes a message on each port that is named, and goes on to the next event."""
        for port, message in (messages or {}).items():
            self._outputs[port].send(message)
        try:
            event = next(self._steps, None)
        except RunError as error:
            if error.code == EXIT_STALL:
                error = self._stalled(error)
            ours = bool(error.culprit) or error.code in (EXIT_BAD_INPUT, EXIT_STALL)  # else the run has ended, and knows why
            self._go(interrupt=ours)
            raise (error if ours else self._launch.fault()) from None
        if event is None:
            self._go(interrupt=False)
            raise self._launch.fault()
        for topic, messages in self._kept.items():
            messages.extend(self._inputs[topic])
        self.seen = Seen(event.t_ns, self._inputs, self._kept)
        return self.seen

    def end(self) -> None:
        """Ends the launch, in order where it still goes on."""
        if self._over:
            return
        self._launch.interrupt()
        try:
            self._me.leave()
        except RunError:
            pass  # the clock was gone already
        self._over = True
        self._launch.wait()

    def _stalled(self, error: RunError) -> RunError:
        """The same with the names of those that have not joined, or have been granted time and do not answer."""
        try:
            with Observer(self._launch.clock) as run:
                status = run.ask("status")
                missing = status.get("missing")  # while they join
                busy = [each["name"] for each in status["participants"] if each["running"]]
        except (RunError, KeyError):
            return error
        if missing:
            return RunError(f"{', '.join(missing)}: has not joined; {error}", EXIT_STALL, missing[0])
        return RunError(f"{', '.join(busy)}: no answer; {error}", EXIT_STALL, busy[0]) if busy else error

    def _go(self, *, interrupt: bool) -> None:
        """Leaves a run that has ended without being asked to, or is to."""
        self._over = True
        self._me.leave(stay=False)
        if interrupt:
            self._launch.end()
