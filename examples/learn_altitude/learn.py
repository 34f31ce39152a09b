"""Trains an agent on a task of altimeters with Stable-Baselines3, and holds it against the untrained one and the task's baseline.

  python3 learn.py AltitudeHold --seconds 600 --out out/learn      # train, then evaluate on five seeds that it has not seen
  python3 learn.py AltitudeHold --evaluate out/learn/policy.zip    # only the latter
"""
import argparse
import importlib
import pathlib
import time

import ensonify  # registers the tasks
import gymnasium
import numpy as np
from stable_baselines3 import SAC
from stable_baselines3.common.callbacks import BaseCallback

UNSEEN = range(9000, 9005)  # seeds of the evaluation; those of the training are drawn from four billion
CRASH = 20.0  # what touching the bottom costs in training
HISTORY = 3  # observations that the agent is given at once, newest first


class Sensed(gymnasium.Wrapper):
    """What the altimeters of a task say, as numbers of the order of 1: errors of altitude (the last valid ones, in tolerated errors) and
    velocities in m/s, of the last steps. Shape (HISTORY * n,).

    With `shaped` the reward also falls beyond the tolerated error, where the task's is 0 and teaches nothing, and touching the
    bottom costs: for the training only."""

    def __init__(self, env, task, shaped=False):
        super().__init__(env)
        self._task, self._shaped = task, shaped
        self._altimeters = [key for key in sorted(env.observation_space) if key.endswith("/range_m")]
        numbers = len(self._altimeters) + env.observation_space["nav/estimate"].shape[0]
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (HISTORY * numbers,), np.float32)

    def _now(self, seen):
        for key in self._altimeters:
            if seen[key.replace("/range_m", "/valid")][0]:
                slant = getattr(self._task, "AHEAD_COS", 1.0) if key.startswith("ahead") else 1.0
                self._errors[key] = (slant * seen[key][0] - self._task.ALTITUDE_M) / self._task.TOLERATED_M
        return np.concatenate([list(self._errors.values()), seen["nav/estimate"]]).astype(np.float32)

    def reset(self, **options):
        """As the environment's; the history begins with what is seen first."""
        seen, info = self.env.reset(**options)
        self._errors = {key: 0.0 for key in self._altimeters}
        self._past = [self._now(seen)] * HISTORY
        return np.concatenate(self._past), info

    def step(self, action):
        """As the environment's."""
        seen, reward, terminated, truncated, info = self.env.step(action)
        self._past = [self._now(seen), *self._past[:-1]]
        if self._shaped:
            reward += min(0.0, 1.0 - abs(min(self._errors.values()))) - CRASH * terminated
        return np.concatenate(self._past), float(reward), terminated, truncated, info


def task_of(name):
    """The module of a task: its constants and its baseline."""
    return importlib.import_module({"AltitudeHold": "ensonify.tasks.altitude_hold", "BottomFollow": "ensonify.tasks.bottom_follow"}[name])


def environment(name, shaped=False):
    """A task as the agent senses it."""
    return Sensed(gymnasium.make(f"Ensonify/{name}-v0", disable_env_checker=True), task_of(name), shaped)


class Until(BaseCallback):
    """Ends the training after some wall seconds, and says now and then what an episode earned."""

    def __init__(self, seconds):
        super().__init__()
        self._seconds, self._began = seconds, time.monotonic()
        self._total, self._said = 0.0, self._began

    def _on_step(self):
        self._total += float(self.locals["rewards"][0])
        now = time.monotonic()
        if self.locals["dones"][0]:
            if now - self._said > 15:
                self._said = now
                print(f"{now - self._began:4.0f} s, {self.num_timesteps} steps: return {self._total:.0f}", flush=True)
            self._total = 0.0
        return now - self._began < self._seconds


def learner(env, seed, warm_up=1500):
    """Soft actor-critic [SAC] with a small network: every step teaches."""
    return SAC("MlpPolicy", env, seed=seed, learning_rate=1e-3, gamma=0.98, batch_size=128, buffer_size=200_000, learning_starts=warm_up,
               train_freq=4, gradient_steps=4, ent_coef="auto_0.1", policy_kwargs={"net_arch": [64, 64]}, device="cpu")


def returns(env, policy, seeds):
    """The return of an episode with each seed; policy(observation) gives the action."""
    totals = []
    for seed in seeds:
        seen, _ = env.reset(seed=seed)
        total, over = 0.0, False
        while not over:
            seen, reward, terminated, truncated, _ = env.step(policy(seen))
            total, over = total + reward, terminated or truncated
        totals.append(total)
    return np.array(totals)


def report(name, totals):
    """A line with the mean and its interval of 95 % by Student's t over the seeds."""
    spread = 2.776 * totals.std(ddof=1) / np.sqrt(len(totals)) if len(totals) == 5 else float("nan")
    print(f"{name:10} {totals.mean():6.1f} +- {spread:5.1f}   ({', '.join(f'{total:.0f}' for total in totals)})", flush=True)


def evaluate(name, trained, untrained=None, seeds=UNSEEN):
    """Mean returns of the trained agent, the untrained one and the baseline, over the same seeds."""
    env = environment(name)
    act = lambda model: lambda seen: model.predict(seen, deterministic=True)[0]
    means = {}
    if untrained is not None:
        means["untrained"] = returns(env, act(untrained), seeds)
    means["trained"] = returns(env, act(trained), seeds)
    env.close()
    env = gymnasium.make(f"Ensonify/{name}-v0", disable_env_checker=True)
    baselines = []
    for seed in seeds:  # it remembers its last altitude: one for each episode
        baselines.append(returns(env, task_of(name).Baseline(), [seed])[0])
    env.close()
    means["baseline"] = np.array(baselines)
    for who, totals in means.items():
        report(who, totals)
    print(f"trained / baseline: {means['trained'].mean() / means['baseline'].mean():.2f}", flush=True)
    return {who: float(totals.mean()) for who, totals in means.items()}


def main():
    """Trains and evaluates, as the arguments say."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("task", choices=["AltitudeHold", "BottomFollow"])
    parser.add_argument("--seconds", type=float, default=600, help="of wall time that training takes (default 600)")
    parser.add_argument("--steps", type=int, default=10**9, help="of the world, instead: the same on any machine, with one seed")
    parser.add_argument("--seed", type=int, default=1, help="of the training")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/learn"), help="folder of policy.zip")
    parser.add_argument("--evaluate", type=pathlib.Path, metavar="POLICY", help="evaluates a policy, and does not train")
    options = parser.parse_args()
    if options.evaluate:
        return evaluate(options.task, SAC.load(options.evaluate, device="cpu"))
    env = environment(options.task, shaped=True)
    untrained, model = learner(env, options.seed), learner(env, options.seed)
    model.learn(options.steps, callback=Until(options.seconds if options.steps == 10**9 else float("inf")))
    env.close()
    options.out.mkdir(parents=True, exist_ok=True)
    model.save(options.out / "policy.zip")
    return evaluate(options.task, model, untrained)


if __name__ == "__main__":
    main()
