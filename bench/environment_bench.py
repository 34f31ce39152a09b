"""What a Gymnasium environment costs: steps and resets of AltitudeHold, beside the same launch with an autopilot in the agent's place."""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

from harness import ROOT, interleaved, row

STEPS = 600
STEPPER = """
import hashlib, json, sys, time
import gymnasium, numpy as np
steps, hosted = int(sys.argv[1]), sys.argv[2] == "hosted"
seen = hashlib.sha256()
with gymnasium.make("ensonify:Ensonify/AltitudeHold-v0", seconds=steps, hosted=hosted, disable_env_checker=True) as env:
    env.reset(seed=1)
    took = []
    for _ in range(steps):
        began = time.perf_counter()
        observation, _, terminated, _, _ = env.step(np.zeros(1, np.float32))
        took.append(time.perf_counter() - began)
        assert not terminated
        for value in observation.values(): seen.update(value.tobytes())
    print(json.dumps([sum(took), seen.hexdigest()]))
"""


RESETTER = """
import json, sys, time
import gymnasium, numpy as np
def bytes_of(seen): return {key: value.tobytes() for key, value in seen.items()}
with gymnasium.make(f"ensonify:Ensonify/{sys.argv[1]}-v0", disable_env_checker=True) as env:
    took = {"launch": [], "another seed": [], "the same seed": []}
    first = {}
    for what, seed in [("launch", 1), ("the same seed", 1)] + [(what, seed) for seed in range(2, 12) for what in ("another seed", "the same seed")]:
        began = time.perf_counter()
        seen = bytes_of(env.reset(seed=seed)[0])
        took[what].append(time.perf_counter() - began)
        assert first.setdefault(seed, seen) == seen, "the same seed gave another observation"
        env.step(np.zeros(env.action_space.shape, np.float32))
    assert len(set(map(str, first.values()))) > 1, "seeds change nothing"
    print(json.dumps(took))
"""


def environment_of(b):
    return {**os.environ, "ENSONIFY_BIN": str(b.build / "bin"), "PYTHONPATH": str(ROOT / "clients/python")}


def resets(b, task):
    """Wall time from a reset to its first observation, beside that of the launch that they follow."""
    took = {}
    for _ in range(b.repeat):
        done = subprocess.run([sys.executable, "-c", RESETTER, task], env=environment_of(b), capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{task}: {done.stderr}")
        for what, times_s in json.loads(done.stdout).items():
            took.setdefault(what, []).extend(times_s)
    ms = {what: statistics.median(times_s) * 1e3 for what, times_s in took.items()}
    return [row(f"reset of {task}: {what}", ms[what], "ms", ms["launch"], ms[what] / ms["launch"], "<= 1", ms[what] <= ms["launch"])
            for what in ("another seed", "the same seed")]


def bench_environment(b):
    """Wall time of a step at 10 Hz, all processes on their own or hosted; the pilot of the floor sees no message of the Env's."""
    seen = set()

    def step_ms(where="apart"):
        done = subprocess.run([sys.executable, "-c", STEPPER, str(STEPS), where], env=environment_of(b), capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"AltitudeHold: {done.stderr}")
        took_s, digest = json.loads(done.stdout)
        seen.add(digest)
        assert len(seen) == 1, "hosted or not, the observations are the same"
        return took_s / STEPS * 1e3

    def floor_ms():
        text = (ROOT / "launch" / "altitude_hold.yaml").read_text()
        for own, other in (("agent: { external: true }", "agent: { run: autopilot }"), ("duration_s: 3600", f"duration_s: {STEPS / 10}")):
            text = text.replace(own, other)
        with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as folder:
            launch, out = pathlib.Path(folder) / "floor.yaml", pathlib.Path(folder) / "out"
            launch.write_text(text + "wiring: { agent.estimate: nav/estimate }\n")
            done = subprocess.run([b.build / "bin" / "ensonify-run", launch, "--free", "--quiet", "--out", out],
                                  capture_output=True, text=True)
            if done.returncode != 0:
                raise RuntimeError(f"floor of AltitudeHold: exit {done.returncode}: {done.stderr}")
            report = json.loads((out / "clock.json").read_text())
            assert report["sim_s"] >= STEPS / 10, report["sim_s"]
            return report["wall_s"] / STEPS * 1e3

    mine, floor, ratios = interleaved(b.repeat, step_ms, floor_ms)
    apart, hosted, shares = interleaved(b.repeat, step_ms, lambda: step_ms("hosted"))
    return [row("step of Ensonify/AltitudeHold-v0, 10 Hz, no ping", mine, "ms", floor, statistics.median(ratios), "<= 2", mine <= 2),
            row("the same, processes of its own over hosted", hosted, "ms", apart, statistics.median(shares), "<= 1 ms", hosted <= 1),
            *resets(b, "AltitudeHold"), *resets(b, "WallFollow")]
