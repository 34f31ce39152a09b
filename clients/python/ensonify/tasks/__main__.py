"""What a task's baseline earns, and how fast the environment is.

  python3 -m ensonify.tasks AltitudeHold [FIRST_SEED [EPISODES]]
"""
import importlib
import sys
import time

import gymnasium

from ensonify.tasks import TASKS


def main(name: str, first_seed: int = 100, episodes: int = 5) -> None:
    """Prints one line per episode, and means."""
    baseline = importlib.import_module(f"ensonify.tasks.{TASKS[name]}").Baseline
    with gymnasium.make(f"Ensonify/{name}-v0", disable_env_checker=True) as env:
        results = [measured(env, baseline(), seed) for seed in range(first_seed, first_seed + episodes)]
    for seed, (total, reset_s, rate) in enumerate(results, first_seed):
        print(f"seed {seed}: return {total:.1f}, reset {reset_s:.3f} s, {rate:.0f} steps/s")
    totals, resets, rates = zip(*results)
    print(f"mean: return {sum(totals) / episodes:.1f} ({min(totals):.1f} to {max(totals):.1f}), "
          f"reset {sum(resets) / episodes:.3f} s, {sum(rates) / episodes:.0f} steps/s")


def measured(env: gymnasium.Env, policy, seed: int) -> tuple:
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
