"""Trains an agent on a task of altimeters with Stable-Baselines3, and holds it against the untrained one and the task's baseline.

  python3 learn.py AltitudeHold --seconds 600 --out out/learn      # train, then evaluate on five seeds that it has not seen
  python3 learn.py AltitudeHold --evaluate out/learn/policy.zip    # only the latter
  python3 learn.py AltitudeHold --watch out/learn/policy.zip       # an episode in a window
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

UNSEEN = range(9000, 9005)  # seeds of the evaluation; those of the training are drawn from two billion
CHOOSING = range(8000, 8010)  # seeds by which the best policy of the training is chosen
CRASH = 20.0  # what touching the bottom costs in training
HOLD = 5  # steps that an action stands: the agent decides twice a second, for a vehicle that changes its depth slowly
HISTORY = 6  # observations, one of each decision, that the agent is given at once, newest first


class Sensed(gymnasium.Wrapper):
    """What the altimeters of a task say, as numbers of the order of 1: errors of altitude (the last valid ones, in tolerated errors) and
    velocities in m/s, of the last decisions. Shape (HISTORY * n,). A step is HOLD of the task's with the same action.

    With `shaped` the reward also falls beyond the tolerated error, where the task's is 0 and teaches nothing, and touching the
    bottom costs: for the training only, as the mean of the steps instead of their sum."""

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
        total = beyond = 0.0
        for _ in range(HOLD):
            seen, reward, terminated, truncated, info = self.env.step(action)
            now = self._now(seen)
            total += reward
            beyond += min(0.0, 1.0 - abs(min(self._errors.values())))
            if terminated or truncated:
                break
        self._past = [now, *self._past[:-1]]
        if self._shaped:
            total = (total + beyond) / HOLD - CRASH * terminated
        return np.concatenate(self._past), float(total), terminated, truncated, info


def task_of(name):
    """The module of a task: its constants and its baseline."""
    return importlib.import_module({"AltitudeHold": "ensonify.tasks.altitude_hold", "BottomFollow": "ensonify.tasks.bottom_follow"}[name])


def environment(name, shaped=False, **options):
    """A task as the agent senses it."""
    return Sensed(gymnasium.make(f"Ensonify/{name}-v0", disable_env_checker=True, **options), task_of(name), shaped)


class Budget:
    """Wall seconds that the training may take, or decisions."""

    def __init__(self, seconds=np.inf, decisions=np.inf):
        self._seconds, self._decisions, self._began = seconds, decisions, time.monotonic()

    def spent_s(self):
        """Seconds so far."""
        return time.monotonic() - self._began

    def left(self, decisions):
        """The share that is left after so many decisions."""
        return min(1 - self.spent_s() / self._seconds, 1 - decisions / self._decisions)


class Until(BaseCallback):
    """Ends the training when its budget is spent, and says now and then what an episode earned."""

    def __init__(self, budget):
        super().__init__()
        self._budget, self._total, self._said = budget, 0.0, 0.0

    def _on_step(self):
        self._total += float(self.locals["rewards"][0])
        if self.locals["dones"][0]:
            if self._budget.spent_s() - self._said > 15:
                self._said = self._budget.spent_s()
                print(f"{self._said:4.0f} s, {self.num_timesteps * HOLD} steps: an episode earned {self._total * HOLD:.0f}", flush=True)
            self._total = 0.0
        return self._budget.left(self.num_timesteps) > 0


class Best(BaseCallback):
    """Saves the policy that earns most on the seeds for choosing, of those after a half, 0.6, ... and all of the training."""

    def __init__(self, name, budget, file):
        super().__init__()
        self._name, self._budget, self._file = name, budget, file
        self._next, self._most = 0.5, -np.inf

    def _on_step(self):
        if self._budget.left(self.num_timesteps) > self._next:
            return True
        self._next -= 0.1
        env = environment(self._name)
        mean = returns(env, acting(self.model), CHOOSING).mean()
        env.close()
        print(f"{self._budget.spent_s():4.0f} s, {self.num_timesteps * HOLD} steps: {mean:.0f} on the seeds for choosing", flush=True)
        if mean > self._most:
            self._most = mean
            self.model.save(self._file)
        return True


def learner(env, seed, budget, warm_up=300):
    """Soft actor-critic [SAC] with a small network: every decision teaches four times, and less and less towards the end."""
    rate = lambda left: 1e-3 * max(0.05, min(left, budget.left(0)))
    return SAC("MlpPolicy", env, seed=seed, learning_rate=rate, gamma=0.98, batch_size=128, buffer_size=200_000, learning_starts=warm_up,
               train_freq=4, gradient_steps=16, ent_coef="auto_0.1", policy_kwargs={"net_arch": [64, 64]}, device="cpu")


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


def acting(model):
    """What a model does, without the chance that it learns by."""
    return lambda seen: model.predict(seen, deterministic=True)[0]


def watch(name, model):
    """The first unseen seed in a window."""
    env = environment(name, render_mode="human")
    print(f"return {returns(env, acting(model), UNSEEN[:1])[0]:.0f}")
    env.close()


def evaluate(name, trained, untrained=None, seeds=UNSEEN):
    """Mean returns of the trained agent, the untrained one and the baseline, over the same seeds."""
    env = environment(name)
    means = {}
    if untrained is not None:
        means["untrained"] = returns(env, acting(untrained), seeds)
    means["trained"] = returns(env, acting(trained), seeds)
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
    parser.add_argument("--steps", type=int, help="of the world, instead: the same on any machine, with one seed")
    parser.add_argument("--seed", type=int, default=1, help="of the training")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/learn"), help="folder of policy.zip")
    parser.add_argument("--evaluate", type=pathlib.Path, metavar="POLICY", help="evaluates a policy, and does not train")
    parser.add_argument("--watch", type=pathlib.Path, metavar="POLICY", help="shows a policy's episode in a window")
    options = parser.parse_args()
    if options.watch:
        return watch(options.task, SAC.load(options.watch, device="cpu"))
    if options.evaluate:
        return evaluate(options.task, SAC.load(options.evaluate, device="cpu"))
    env = environment(options.task, shaped=True)
    options.out.mkdir(parents=True, exist_ok=True)
    policy = options.out / "policy.zip"
    budget = Budget(decisions=options.steps // HOLD) if options.steps else Budget(seconds=options.seconds)
    untrained, model = learner(env, options.seed, budget), learner(env, options.seed, budget)
    model.learn(options.steps // HOLD if options.steps else 10**9, callback=[Until(budget), Best(options.task, budget, policy)])
    env.close()
    return evaluate(options.task, SAC.load(policy, device="cpu"), untrained)


if __name__ == "__main__":
    main()
