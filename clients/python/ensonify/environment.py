"""A Gymnasium environment of any launch file: docs/manual/gymnasium.md.

    env = ensonify.Env("launch/altitude_hold.yaml",
                       observe={"nav/altitude": ensonify.Fields(ensonify.Altitude)},
                       act=ensonify.steer(speed_mps=1.5, depth_m=(5, 28)),
                       truth={"judge/altitude": ensonify.Altitude},
                       reward=lambda seen: -abs(seen["judge/altitude"].range_m - 6),
                       done=lambda seen: seen["judge/altitude"].range_m < 1,
                       seconds=60)
"""
import os
from typing import Any, Callable, Mapping

import gymnasium
import numpy as np

from ensonify.acts import Act
from ensonify.agent import Agent
from ensonify.episode import Seen
from ensonify.episodes import Episodes, drawn_seed
from ensonify.spaces import Array, Fields, Rows, checked


class Env(gymnasium.Env):
    """A process of a launch, as an environment: the one that the launch file calls `agent` and marks `external: true`.

    observe, act, reward, done: as of ensonify.agent.Agent; done ends the episode
    keywords: truth, rate, seconds, image, set, agent, out, settle_s, patience_s, render_mode, fps, hosted, as of ensonify.episodes.Episodes
    """

    metadata = {"render_modes": ["rgb_array", "human"], "render_fps": 10}

    def __init__(self, launch: str | os.PathLike, *, observe: Mapping[str, Fields | Array | Rows], act: Act,
                 reward: Callable[[Seen], float], done: Callable[[Seen], bool] = lambda seen: False, **keywords: Any):
        self._agent = Agent(observe=observe, act=act, reward=reward, done=done)
        self._episodes = Episodes(launch, {act.port: self._agent}, **keywords)
        self.observation_space, self.action_space = self._agent.observation_space, self._agent.action_space
        self.render_mode = self._episodes.render_mode

    def reset(self, *, seed: int | None = None, options: dict | None = None) -> tuple:
        """Another episode, until all topics have come: in the processes of the one before, or in a new launch. `seed` is the
        scenario's; without it one is drawn."""
        super().reset(seed=seed)
        seed = drawn_seed(self.np_random) if seed is None else seed
        self._seen = self._episodes.begin(seed, options)
        return self._agent.observation(self._seen), {"t_s": self._seen.t_s, "seed": seed}

    def step(self, action: Any) -> tuple:
        """Publishes what the action says, and goes on to the next step."""
        self._episodes.need_reset()
        action = checked(action, self.action_space)
        message = self._agent.act.function(action, self._seen)
        seen = self._seen = self._episodes.step({self._agent.act.port: message}).after(action)
        reward, terminated = self._agent.judged(seen)
        truncated = not terminated and self._episodes.late(seen)
        if terminated or truncated:
            self._episodes.finish()
        return self._agent.observation(seen), reward, terminated, truncated, {"t_s": seen.t_s}

    def render(self) -> np.ndarray | None:
        """The picture of `image` with render_mode="rgb_array"; a window shows it by itself."""
        return self._episodes.render()

    def close(self) -> None:
        """Ends the launch and waits for its end."""
        self._episodes.close()
