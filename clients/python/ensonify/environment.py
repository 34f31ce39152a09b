"""A Gymnasium environment of any launch file: docs/manual/gymnasium.md.

    env = ensonify.Env("launch/altitude_hold.yaml",
                       observe={"nav/altitude": ensonify.Fields(ensonify.Altitude)},
                       act=ensonify.steer(speed_mps=1.5, depth_m=(5, 28)),
                       truth={"judge/altitude": ensonify.Altitude},
                       reward=lambda seen: -abs(seen["judge/altitude"].range_m - 6),
                       done=lambda seen: seen["judge/altitude"].range_m < 1,
                       seconds=60)
"""
import math
import os
import pathlib
import tempfile
import weakref
from typing import Any, Callable, Mapping

import gymnasium
import numpy as np

from ensonify.episode import Episode, Seen
from ensonify.images import picture
from ensonify.messages import Mesh, Ping, Pose, Tile
from ensonify.spaces import Act, Array, Fields, checked

ALWAYS_TRUTH = (Pose, Tile, Mesh)  # message types that no instrument gives
LARGEST_SEED = 2**31


class TruthError(ValueError):
    """An observation of what only the simulator knows."""


class Env(gymnasium.Env):
    """A process of a launch, as an environment: the one that the launch file calls `agent` and marks `external: true`.

    observe: topics and what of them is observed, ensonify.Fields or ensonify.Array
    act: what an action publishes, ensonify.steer(...) or ensonify.Act
    reward, done: functions of what is Seen after a step; done ends the episode, `seconds` of sim time truncate it
    truth: topics and message types that reward and done read besides: what must not be observed
    rate: steps per second of sim time
    image: topic of a head's pings, for render() with render_mode="rgb_array"
    set: parameters in every episode, as `--set`; reset(options={"set": {...}}) adds to them
    out: folder in which episodes leave their results (0000, 0001, ...); without it they leave none
    settle_s: sim time within which all topics must have come for the first time
    patience_s: wall time that the launch may take for one step
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(self, launch: str | os.PathLike, *, observe: Mapping[str, Fields | Array], act: Act,
                 reward: Callable[[Seen], float], done: Callable[[Seen], bool] = lambda seen: False,
                 truth: Mapping[str, type] | None = None, rate: Any = 10, seconds: float = math.inf,
                 image: str | None = None, set: Mapping[str, Any] | None = None, agent: str = "agent",
                 out: str | os.PathLike | None = None, settle_s: float = 10.0, patience_s: float = 300.0,
                 render_mode: str | None = None):
        truth = dict(truth or {})
        refuse_truth(observe, truth)
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode is {render_mode!r}; allowed: None, 'rgb_array'")
        if render_mode and not image:
            raise ValueError("render_mode='rgb_array' needs image=TOPIC, the pings of a head")
        self.observation_space = gymnasium.spaces.Dict(
            {key: space for topic, part in observe.items() for key, space in part.spaces(topic).items()})
        self.action_space = act.space
        self.render_mode = render_mode
        self._observe, self._act, self._reward, self._done = dict(observe), act, reward, done
        self._topics = {topic: part.message_type for topic, part in observe.items()} | truth
        self._image = image if render_mode else None
        if self._image:
            self._topics.setdefault(self._image, Ping)
        self._launch, self._agent, self._rate, self._seconds = launch, agent, rate, seconds
        self._set, self._out = dict(set or {}), out
        self._settle_s, self._patience_s = settle_s, patience_s
        self._episodes = 0  # so far
        self._running = Running()
        self._end_at_exit = weakref.finalize(self, self._running.end)
        self._ended = "there is no episode yet"  # why no step can be made; "" while one can
        self._began_s = 0.0

    def reset(self, *, seed: int | None = None, options: dict | None = None) -> tuple:
        """Another episode, until all topics have come: in the processes of the one before, or in a new launch. `seed` is the
        scenario's; without it one is drawn."""
        super().reset(seed=seed)
        options = dict(options or {})
        settings = {**self._set, **options.pop("set", {})}
        if options:
            raise ValueError(f"options has {', '.join(map(repr, options))}; allowed: 'set'")
        if "seed" in settings:
            raise ValueError("set: seed is given by reset(seed=...)")
        self._ended = "there is no episode yet"
        settings["seed"] = int(self.np_random.integers(LARGEST_SEED)) if seed is None else seed
        seen = self._running.begin(lambda out: Episode(
            self._launch, self._agent, out, settings, self._topics, {self._act.port: self._act.message_type}, self._rate,
            self._patience_s), settings, self._folder())
        while missing := [topic for topic in self._topics if seen[topic] is None]:
            if seen.t_s >= self._settle_s:
                self.close()
                raise TimeoutError(f"{', '.join(missing)}: nothing came within {self._settle_s:g} s of sim time")
            seen = self._running.episode.step()
        self._began_s = seen.t_s
        self._ended = ""
        return self._observation(seen), {"t_s": seen.t_s, "seed": settings["seed"]}

    def step(self, action: Any) -> tuple:
        """Publishes what the action says, and goes on to the next step."""
        if self._ended:
            raise gymnasium.error.ResetNeeded(f"{self._ended}: call reset() first")
        episode = self._running.episode
        action = checked(action, self.action_space)
        message = self._act.function(action, episode.seen)
        try:
            seen = episode.step({self._act.port: message})
        except BaseException:
            self._ended = "the episode broke off"
            raise
        seen.action = action
        reward = float(self._reward(seen))
        if not math.isfinite(reward):
            raise ValueError(f"the reward at t = {seen.t_s:.3f} s is {reward}")
        terminated = bool(self._done(seen))
        truncated = not terminated and seen.t_s - self._began_s > self._seconds - 1e-6
        if terminated or truncated:
            self._ended = "the episode has ended"
        return self._observation(seen), reward, terminated, truncated, {"t_s": seen.t_s}

    def render(self) -> np.ndarray | None:
        """The newest ping of `image`, as ensonify.images.picture draws it."""
        if not self._image:
            return None
        if self._running.episode is None:
            raise gymnasium.error.ResetNeeded(f"{self._ended}: call reset() first")
        return picture(self._running.episode.seen[self._image])

    def close(self) -> None:
        """Ends the launch and waits for its end."""
        self._ended = self._ended or "the environment was closed"
        self._running.end()

    def _observation(self, seen: Seen) -> dict:
        return {key: value for topic, part in self._observe.items() for key, value in part.values(topic, seen[topic]).items()}

    def _folder(self) -> pathlib.Path | None:
        self._episodes += 1
        return pathlib.Path(self._out) / f"{self._episodes - 1:04d}" if self._out is not None else None


class Running:
    """The launch that goes on, if any, and its folder. Holds nothing of the Env, which it may outlive."""

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


def refuse_truth(observe: Mapping[str, Any], truth: Mapping[str, type]) -> None:
    """A TruthError names an observed topic that is truth."""
    for topic, part in observe.items():
        if topic in truth:
            raise TruthError(f"{topic} is marked as truth: reward and done may read it, an observation may not")
        if issubclass(part.message_type, ALWAYS_TRUTH):
            raise TruthError(f"{topic} is {part.message_type.TYPE}, which is truth: put it into truth=, for reward and done to read")
