"""What a task's baseline earns, and how fast the environment is.

  python3 -m ensonify.tasks AltitudeHold [FIRST_SEED [EPISODES]]
"""
import contextlib
import importlib
import sys
import time
from typing import Any

import gymnasium

from ensonify.tasks import TASKS, TEAM_TASKS


class Team:
    """A ParallelEnv as one agent, which acts for all of them: its reward is their mean, its episode ends with the last one's."""

    def __init__(self, env: Any):
        self.env = env
        self.reset, self.close = env.reset, env.close

    def step(self, actions: dict) -> tuple:
        """As of a Gymnasium environment."""
        seen, rewards, *_, infos = self.env.step(actions)
        return seen, sum(rewards.values()) / len(self.env.possible_agents), not self.env.agents, False, infos


class TeamBaseline:
    """A baseline for each agent of a Team."""

    def __init__(self, team: Team, baseline: type):
        self._env = team.env
        self._each = {name: baseline() for name in team.env.possible_agents}

    def __call__(self, seen: dict) -> dict:
        return {name: self._each[name](seen[name]) for name in self._env.agents}


def task(name: str) -> tuple:
    """The environment of a task, and what makes its baseline."""
    module = importlib.import_module(f"ensonify.tasks.{(TASKS | TEAM_TASKS)[name]}")
    if name in TASKS:
        return gymnasium.make(f"Ensonify/{name}-v0", disable_env_checker=True), module.Baseline
    team = Team(getattr(module, name)())
    return team, lambda: TeamBaseline(team, module.Baseline)


def main(name: str, first_seed: int = 100, episodes: int = 5) -> None:
    """Prints one line per episode, and means."""
    env, baseline = task(name)
    with contextlib.closing(env):
        results = [measured(env, baseline(), seed) for seed in range(first_seed, first_seed + episodes)]
    for seed, (total, reset_s, rate) in enumerate(results, first_seed):
        print(f"seed {seed}: return {total:.1f}, reset {reset_s:.3f} s, {rate:.0f} steps/s")
    totals, resets, rates = zip(*results)
    print(f"mean: return {sum(totals) / episodes:.1f} ({min(totals):.1f} to {max(totals):.1f}), "
          f"reset {sum(resets) / episodes:.3f} s, {sum(rates) / episodes:.0f} steps/s")


def measured(env: gymnasium.Env | Team, policy, seed: int) -> tuple:
    """Return of one episode, wall seconds of its reset, steps per wall second."""
    began = time.perf_counter()
    seen, _ = env.reset(seed=seed)
    started = time.perf_counter()
    total, steps, over = 0.0, 0, False
    while not over:
        seen, reward, terminated, truncated, _ = env.step(policy(seen))
        total, steps, over = total + reward, steps + 1, terminated or truncated
    return total, started - began, steps / (time.perf_counter() - started)


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
