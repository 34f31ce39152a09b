"""An agent: what it observes, does and earns. ensonify.Env has one, ensonify.ParallelEnv one for each vehicle."""
import math
from collections.abc import Callable
from typing import Any, Mapping

import gymnasium

from ensonify.acts import Act
from ensonify.arguments import mapping, one_of
from ensonify.episode import Seen
from ensonify.messages import Labels, Mesh, Object, ObjectMesh, Pose, Tile
from ensonify.spaces import Array, Fields, Rows

ALWAYS_TRUTH = (Pose, Tile, Mesh, Object, ObjectMesh, Labels)  # message types that no instrument gives


class TruthError(ValueError):
    """An observation of what only the simulator knows."""


class Agent:
    """What is an agent's own. It keeps nothing of an episode, so that one may stand for several vehicles.

    observe: topics and what of them is observed, ensonify.Fields, ensonify.Array or ensonify.Rows
    act: what an action publishes, ensonify.steer(...) or ensonify.Act
    reward, done: functions of what is Seen after a step; with done the agent's episode ends
    """

    def __init__(self, *, observe: Mapping[str, Fields | Array | Rows], act: Act, reward: Callable[[Seen], float],
                 done: Callable[[Seen], bool] = lambda seen: False):
        self.observe = mapping("observe", observe, "topics and what of them is observed")
        for topic, part in self.observe.items():
            one_of(f"observe: {topic}", part, (Fields, Array, Rows), "ensonify.Fields, ensonify.Array, ensonify.Rows")
        self.act = one_of("act", act, (Act,), "ensonify.steer(...), ensonify.goto(...), ensonify.Act(...)")
        self._reward = one_of("reward", reward, (Callable,), "a function of what is Seen")
        self._done = one_of("done", done, (Callable,), "a function of what is Seen")
        self.observation_space = gymnasium.spaces.Dict(
            {key: space for topic, part in self.observe.items() for key, space in part.spaces(topic).items()})
        self.action_space = act.space

    def observation(self, seen: Seen) -> dict:
        """What it observes of what was seen."""
        return {key: value for topic, part in self.observe.items()
                for key, value in part.values(topic, seen.last(topic) if isinstance(part, Rows) else seen[topic]).items()}

    def judged(self, seen: Seen) -> tuple:
        """Its reward, and whether it is done."""
        given = self._reward(seen)
        try:
            reward = float(given)
        except (TypeError, ValueError):
            raise TypeError(f"the reward at t = {seen.t_s:.3f} s is {given!r}, which is no number") from None
        if not math.isfinite(reward):
            raise ValueError(f"the reward at t = {seen.t_s:.3f} s is {reward}")
        return reward, bool(self._done(seen))

    def refuse_truth(self, truth: Mapping[str, type]) -> None:
        """A TruthError names a topic that is truth, and observed or read for actions."""
        for topic, message_type in self.topics():
            if topic in truth:
                raise TruthError(f"{topic} is marked as truth: reward and done may read it, an observation or an action may not")
            if issubclass(message_type, ALWAYS_TRUTH):
                raise TruthError(f"{topic} is {message_type.TYPE}, which is truth: put it into truth=, for reward and done to read")

    def topics(self) -> list:
        """Topics that it observes, or reads for its actions, with their message types."""
        return [(topic, part.message_type) for topic, part in self.observe.items()] + list(self.act.reads.items())


def topics_of(agents: Mapping[Any, Agent]) -> dict:
    """The message type of each topic that they observe, or read for their actions. A ValueError where two differ."""
    topics: dict = {}
    for agent in agents.values():
        for topic, message_type in agent.topics():
            if topics.setdefault(topic, message_type) is not message_type:
                raise ValueError(f"{topic} is read as {topics[topic].TYPE} and as {message_type.TYPE}")
    return topics


def kept_of(agents: Mapping[Any, Agent]) -> dict:
    """How many of its newest messages each topic keeps for them, where that is more than one."""
    kept: dict = {}
    for agent in agents.values():
        for topic, part in agent.observe.items():
            if isinstance(part, Rows):
                kept[topic] = max(part.keeps, kept.get(topic, 0))
    return kept
