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
import json, sys, time
import gymnasium, numpy as np
steps = int(sys.argv[1])
with gymnasium.make("ensonify:Ensonify/AltitudeHold-v0", seconds=steps, disable_env_checker=True) as env:
    began = time.perf_counter()
    env.reset(seed=1)
    started = time.perf_counter()
    for _ in range(steps):
        assert not env.step(np.zeros(1, np.float32))[2]
    print(json.dumps([started - began, time.perf_counter() - started]))
"""


def bench_environment(b):
    """Wall time of a step at 10 Hz, all processes on their own; the pilot of the floor sees no message of the Env's."""
    resets = []

    def step_ms():
        environment = {**os.environ, "ENSONIFY_BIN": str(b.build / "bin"), "PYTHONPATH": str(ROOT / "clients/python")}
        done = subprocess.run([sys.executable, "-c", STEPPER, str(STEPS)], env=environment, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"AltitudeHold: {done.stderr}")
        reset_s, wall_s = json.loads(done.stdout)
        resets.append(reset_s)
        return wall_s / STEPS * 1e3

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
    reset_ms = statistics.median(resets) * 1e3
    return [row("step of Ensonify/AltitudeHold-v0, 10 Hz, no ping", mine, "ms", floor, statistics.median(ratios), "<= 2", mine <= 2),
            row("reset of it, which starts a launch", reset_ms, "ms")]
