"""Pictures an hour of `ensonify dataset`, from an empty folder to the joined set, beside its launches alone."""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from harness import ROOT, row

JOBS = 2
RECIPES = {"forward_looking": (60, 10_000), "sidescan": (48, 5_000)}  # pictures of a run; an hour, to reach


def bench_dataset(b):
    """A set of each shipped recipe; the floor is the wall time of its launches, shared by as many as run at once."""
    rows = []
    for recipe, (pictures, target) in RECIPES.items():
        pairs = [made(b, recipe, pictures) for _ in range(1 if b.quick else b.repeat)]
        hourly = 3600 * pictures / statistics.median(wall_s for wall_s, _ in pairs)
        ratio = statistics.median(wall_s / launches_s for wall_s, launches_s in pairs)
        rows.append(row(f"data set {recipe}, {JOBS} jobs: pictures an hour", hourly, "1/h", hourly * ratio, ratio, target=f"at least {target}",
                        ok=hourly >= target))
    return rows


def made(b, recipe, pictures):
    """Wall time of a whole set, and of its launches alone."""
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as out:
        environment = dict(os.environ)
        environment["PATH"] = f"{pathlib.Path(sys.executable).parent}:{environment['PATH']}"
        words = [str(b.build / "bin" / "ensonify-dataset"), str(ROOT / "launch/recipes" / f"{recipe}.yaml"), "-n", str(pictures), "-o", out,
                 "--jobs", str(JOBS), "--keep-runs"]
        began = time.monotonic()
        done = subprocess.run(words, capture_output=True, text=True, env=environment)
        wall_s = time.monotonic() - began
        if done.returncode != 0:
            raise RuntimeError(f"{recipe}: exit {done.returncode}: {done.stderr}")
        rows = [json.loads(line) for line in (pathlib.Path(out) / "set/manifest.jsonl").read_text().splitlines()]
        assert [one["picture"] for one in rows] == list(range(pictures)), f"{recipe}: not all pictures are there"
        assert any(one["objects"] for one in rows) and any(not one["objects"] for one in rows), f"{recipe}: all alike"
        launches = [json.loads(file.read_text())["wall_s"] for file in pathlib.Path(out).glob("runs/*/result.json")]
        return wall_s, sum(launches) / JOBS
