"""Episodes of one launch, one after another: what ensonify.Env and ensonify.ParallelEnv have in common."""
import math
import os
import pathlib
import tempfile
import weakref
from collections.abc import Callable
from typing import Any, Mapping

import gymnasium
import numpy as np

from ensonify.agent import Agent, kept_of, topics_of
from ensonify.arguments import mapping, one_of, positive
from ensonify.episode import Episode, Seen
from ensonify.images import picture
from ensonify.messages import Ping
from ensonify.typed import Message
from ensonify.window import Window

RENDER_MODES = (None, "rgb_array", "human")


class Episodes:
    """`agents` take the place of one process of the launch, each with an output of its own: a port and its agent.

    truth: topics and message types that reward and done read besides: what must not be observed
    rate: steps per second of sim time
    seconds: sim time after which an episode is truncated
    image: what render() draws: the topic of a head's pings, or a function that makes a picture (rows x columns x 3 bytes) of what is Seen;
        its attribute `keeps`, if any, says of how many of the newest messages by topic: seen.last(topic)
    render_mode: None, "rgb_array", for render(), or "human": a window that shows each step, `fps` a second at the most
    set: parameters in every episode, as `--set`; reset(options={"set": {...}}) adds to them
    agent: the process, which the launch file marks `external: true`
    out: folder in which episodes leave their results (0000, 0001, ...); without it they leave none
    settle_s: sim time within which all topics must have come for the first time
    patience_s: wall time that the launch may take for one step
    hosted: the launch's own processes run in one program where they can (`ensonify run --hosted`): the same bytes, and steps without a ping
        cost a fraction; those with large pings lose what processes do side by side
    """

    def __init__(self, launch: str | os.PathLike, agents: Mapping[str, Agent], *, truth: Mapping[str, type] | None = None,
                 rate: Any = 10, seconds: float = math.inf, image: str | Callable[[Seen], np.ndarray] | None = None, set: Mapping[str, Any] | None = None,
                 agent: str = "agent", out: str | os.PathLike | None = None, settle_s: float = 10.0, patience_s: float = 300.0,
                 render_mode: str | None = None, fps: float = 10, hosted: bool = False):
        truth = mapping("truth", truth or {}, "topics and their message types")
        for topic, message_type in truth.items():
            one_of(f"truth: {topic}", message_type, (type,), "a message type, such as ensonify.Altitude")
        for each in agents.values():
            each.refuse_truth(truth)
        if render_mode not in RENDER_MODES:
            raise ValueError(f"render_mode is {render_mode!r}; allowed: {', '.join(map(repr, RENDER_MODES))}")
        if render_mode and not image:
            raise ValueError(f"render_mode={render_mode!r} needs image=: the topic of a head's pings, or a function of what is seen")
        one_of("image", image, (type(None), str, Callable), "a topic, a function of what is Seen")
        self.render_mode = render_mode
        self._window = Window(pathlib.Path(launch).stem, positive("fps", fps)) if render_mode == "human" else None
        self._topics = topics_of(agents) | truth
        self._kept = kept_of(agents)
        self._picture = image
        if render_mode:
            for topic, count in getattr(image, "keeps", {}).items():
                self._kept[topic] = max(count, self._kept.get(topic, 0))
        if render_mode and isinstance(image, str):
            self._topics.setdefault(image, Ping)
            self._picture = lambda seen: picture(seen[image])
        self._ports = {port: each.act.message_type for port, each in agents.items()}
        self._launch, self._process, self._rate, self._seconds = launch, agent, rate, positive("seconds", seconds)
        self._set, self._out = mapping("set", set or {}, "parameters and their values"), out
        self._settle_s, self._patience_s = positive("settle_s", settle_s), positive("patience_s", patience_s)
        self._hosted = one_of("hosted", hosted, (bool,), "True or False")
        self._count = 0  # so far
        self._running = Running()
        self._end_at_exit = weakref.finalize(self, self._running.end)
        self._ended = "there is no episode yet"  # why no step can be made; "" while one can
        self._began_s = 0.0

    def begin(self, seed: int, options: Mapping[str, Any] | None) -> Seen:
        """Another episode, until all topics have come: in the processes of the one before, or in a new launch. `seed` is the
        scenario's."""
        options = mapping("options", options or {}, "'set' and parameters")
        settings = {**self._set, **mapping("options: set", options.pop("set", {}), "parameters and their values")}
        if options:
            raise ValueError(f"options has {', '.join(map(repr, options))}; allowed: 'set'")
        if "seed" in settings:
            raise ValueError("set: seed is given by reset(seed=...)")
        self._ended = "there is no episode yet"
        settings["seed"] = seed
        seen = self._running.begin(lambda out: Episode(
            self._launch, self._process, out, settings, self._topics, self._kept, self._ports, self._rate, self._patience_s, self._hosted),
            settings, self._folder())
        while missing := [topic for topic in self._topics if seen[topic] is None]:
            if seen.t_s >= self._settle_s:
                self.close()
                raise TimeoutError(f"{', '.join(missing)}: nothing came within {self._settle_s:g} s of sim time")
            seen = self._running.episode.step()
        self._began_s = seen.t_s
        self._ended = ""
        self._show(seen)
        return seen

    def need_reset(self) -> None:
        """Raises ResetNeeded where no step can be made."""
        if self._ended:
            raise gymnasium.error.ResetNeeded(f"{self._ended}: call reset() first")

    def step(self, messages: Mapping[str, Message]) -> Seen:
        """Publishes a message on each port that is named, and goes on to the next step."""
        try:
            seen = self._running.episode.step(messages)
        except BaseException:
            self._ended = "the episode broke off"
            raise
        self._show(seen)
        return seen

    def late(self, seen: Seen) -> bool:
        """Whether the episode is as long as it may be."""
        return seen.t_s - self._began_s > self._seconds - 1e-6

    def finish(self) -> None:
        """No step follows before the next episode. The launch goes on for that."""
        self._ended = "the episode has ended"

    def render(self) -> np.ndarray | None:
        """What `image` makes of what was seen last, where the mode is rgb_array."""
        if self.render_mode != "rgb_array":
            return None
        if self._running.episode is None:
            raise gymnasium.error.ResetNeeded(f"{self._ended}: call reset() first")
        return self._drawn(self._running.episode.seen)

    def close(self) -> None:
        """Ends the launch and waits for its end."""
        self._ended = self._ended or "the environment was closed"
        self._running.end()
        if self._window:
            self._window.close()

    def _show(self, seen: Seen) -> None:
        if self._window:
            self._window.show(self._drawn(seen))

    def _drawn(self, seen: Seen) -> np.ndarray:
        drawn = np.asarray(self._picture(seen))
        if drawn.ndim != 3 or drawn.shape[2] != 3 or drawn.dtype != np.uint8:
            raise ValueError(f"image: the function's array is {drawn.dtype} of shape {drawn.shape}; a picture is uint8, rows x columns x 3")
        return drawn

    def _folder(self) -> pathlib.Path | None:
        self._count += 1
        return pathlib.Path(self._out) / f"{self._count - 1:04d}" if self._out is not None else None


def drawn_seed(generator: np.random.Generator) -> int:
    """A scenario's seed."""
    return int(generator.integers(2**31))


class Running:
    """The launch that goes on, if any, and its folder. Holds nothing of Episodes, which it may outlive."""

    def __init__(self):
        self._owner = os.getpid()
        self.episode: Episode | None = None
        self._scratch: tempfile.TemporaryDirectory | None = None

    def begin(self, start: Callable[[pathlib.Path], Episode], settings: Mapping[str, Any], out: pathlib.Path | None) -> Seen:
        """Another episode in the launch that goes on, where that can be, else by `start`: in a folder that is to stay, else in
        one that goes with the launch. What it has seen first."""
        again = out or (pathlib.Path(self._scratch.name) / "again" if self._scratch else None)  # one folder for all: none is kept
        if self._owner == os.getpid() and self.episode is not None and again and self.episode.reset(settings, again):
            return self.episode.seen
        self.end()
        self._owner = os.getpid()
        if out is None:
            self._scratch = tempfile.TemporaryDirectory(prefix="ensonify-env-")
            out = pathlib.Path(self._scratch.name)
        try:
            self.episode = start(out)
        except BaseException:
            self.end()
            raise
        return self.episode.seen

    def end(self) -> None:
        """Ends it and waits for its end; a fork of the process that started it leaves it alone."""
        if os.getpid() != self._owner:
            return
        episode, self.episode = self.episode, None
        scratch, self._scratch = self._scratch, None
        try:
            if episode is not None:
                episode.end()
        finally:
            if scratch is not None:
                scratch.cleanup()
