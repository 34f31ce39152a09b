"""Several vehicles of one launch, by PettingZoo's parallel API: docs/manual/gymnasium.md.

    env = ensonify.ParallelEnv("launch/keep_formation.yaml",
                               agents={"red": ensonify.Agent(observe=..., act=..., reward=...), "blue": ensonify.Agent(...)})
"""
import os
import re
import warnings
from typing import Any, Mapping

import gymnasium
import numpy as np
import pettingzoo

from ensonify.agent import Agent
from ensonify.arguments import mapping, one_of
from ensonify.episodes import Episodes, drawn_seed
from ensonify.spaces import checked


class ParallelEnv(pettingzoo.ParallelEnv):
    """One process of a launch, as agents that act at the same time. What agent `red` does leaves at the port that its Act
    names, with `_red` behind it: command_red. In a launch without other wiring that steers the process `red`.

    agents: an ensonify.Agent by name, of letters, digits and _; one that is done leaves, and its last order stands
    keywords: truth, rate, seconds, image, set, agent, out, settle_s, patience_s, render_mode, fps, as of ensonify.episodes.Episodes
    """

    metadata = {"name": "ensonify", "render_modes": ["rgb_array", "human"], "render_fps": 10}

    def __init__(self, launch: str | os.PathLike, *, agents: Mapping[str, Agent], **keywords: Any):
        for name, agent in mapping("agents", agents, "names and agents").items():
            one_of(f"agents: {name}", agent, (Agent,), "ensonify.Agent(...)")
            if not re.fullmatch(r"\w+", name, re.ASCII):
                raise ValueError(f"agent {name!r}: a name has letters, digits and _")
        if not agents:
            raise ValueError("agents is empty; there must be one")
        self._all = dict(agents)
        self._ports = {name: f"{agent.act.port}_{name}" for name, agent in agents.items()}
        self._episodes = Episodes(launch, {self._ports[name]: agent for name, agent in agents.items()}, **keywords)
        self.possible_agents = list(agents)
        self.agents: list = []  # that take part in the episode, in the order of possible_agents
        self.observation_spaces = {name: agent.observation_space for name, agent in agents.items()}
        self.action_spaces = {name: agent.action_space for name, agent in agents.items()}
        self.render_mode = self._episodes.render_mode
        self.np_random, _ = gymnasium.utils.seeding.np_random()

    def observation_space(self, agent: str) -> gymnasium.spaces.Dict:
        """What the agent observes."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> gymnasium.spaces.Box:
        """What the agent may do."""
        return self.action_spaces[agent]

    def reset(self, seed: int | None = None, options: dict | None = None) -> tuple:
        """As Env's, with all agents. PettingZoo's checker wants options that nobody knows to be taken: a warning names them."""
        if seed is not None:
            self.np_random, _ = gymnasium.utils.seeding.np_random(seed)
        seed = drawn_seed(self.np_random) if seed is None else seed
        known = {key: value for key, value in (options or {}).items() if key == "set"}
        if unknown := [repr(key) for key in options or {} if key not in known]:
            warnings.warn(f"options: {', '.join(unknown)} is not known and ignored; allowed: 'set'", stacklevel=2)
        seen = self._episodes.begin(seed, known)
        self.agents = list(self.possible_agents)
        self._seen = dict.fromkeys(self.agents, seen)
        return self._observations(), {name: {"t_s": seen.t_s, "seed": seed} for name in self.agents}

    def step(self, actions: Mapping[str, Any]) -> tuple:
        """Publishes what the actions say, and goes on to the next step."""
        self._episodes.need_reset()
        actions = self._checked(actions)
        seen = self._episodes.step({self._ports[name]: self._all[name].act.function(action, self._seen[name])
                                    for name, action in actions.items()})
        self._seen = {name: seen.after(action) for name, action in actions.items()}
        judged = {name: self._named(name, self._all[name].judged, seen) for name, seen in self._seen.items()}
        late = self._episodes.late(seen)
        terminated = {name: done for name, (_, done) in judged.items()}
        truncated = {name: late and not done for name, done in terminated.items()}
        self.agents = [name for name in actions if not (terminated[name] or truncated[name])]
        if not self.agents:
            self._episodes.finish()
        return (self._observations(), {name: reward for name, (reward, _) in judged.items()}, terminated, truncated,
                {name: {"t_s": seen.t_s} for name in actions})

    def render(self) -> np.ndarray | None:
        """The picture of `image` with render_mode="rgb_array"; a window shows it by itself."""
        return self._episodes.render()

    def close(self) -> None:
        """Ends the launch and waits for its end."""
        self._episodes.close()

    def _observations(self) -> dict:
        return {name: self._all[name].observation(seen) for name, seen in self._seen.items()}

    def _checked(self, actions: Mapping[str, Any]) -> dict:
        """Each agent's action as an array of its space, in the order of agents. A ValueError or TypeError names the agent."""
        there = ", ".join(self.agents)
        for name in actions:
            if name not in self.agents:
                why = "has left the episode" if name in self.possible_agents else "is no agent"
                raise ValueError(f"{name}: it {why}; an action is due for {there}")
        for name in self.agents:
            if name not in actions:
                raise ValueError(f"{name}: its action is missing; one is due for {there}")
        return {name: self._named(name, checked, actions[name], self.action_spaces[name]) for name in self.agents}

    @staticmethod
    def _named(name: str, function: Any, *arguments: Any) -> Any:
        """What the function returns; a ValueError or TypeError says whose it is."""
        try:
            return function(*arguments)
        except (TypeError, ValueError) as error:
            kind = TypeError if isinstance(error, TypeError) else ValueError
            raise kind(f"{name}: {error}") from error
