"""What labels cost a head: processor time of one and the same run with and without them, in turns."""
import json
import statistics
import subprocess
import tempfile
from pathlib import Path

from harness import ROOT, row

# Launch, head that is labelled, and what makes a run of it long enough.
RUNS = {"sidescan over object_training": ("object_training", "side", ["--arg", "seconds=20"]),
        "imaging head before targets": ("targets", "eye", ["--set", "eye.ping_rate_hz=5"])}
EXPECTATION_FAILED = 1  # which without labels some do


def head_s(build, name, head, labels, options):
    """Processor seconds of the head."""
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as out:
        done = subprocess.run([str(build / "bin/ensonify-run"), str(ROOT / f"launch/{name}.yaml"), "--free", "--out", out, *options,
                               "--set", f"{head}.labels={labels}"], capture_output=True, text=True)
        if done.returncode not in (0, EXPECTATION_FAILED):
            raise RuntimeError(f"{name}: exit {done.returncode}: {done.stderr}")
        return next(one["cpu_s"] for one in json.loads((Path(out) / "run.json").read_text())["processes"] if one["name"] == head)


def bench_labels(b):
    """Masks and shadows over the head without labels, and energies over masks."""
    rows = []
    for what, (name, head, options) in RUNS.items():
        times = [[head_s(b.build, name, head, labels, options) for labels in ("none", "masks", "energies")] for _ in range(b.repeat)]
        none = statistics.median(one[0] for one in times)
        for label, ratio, most in (("masks", [one[1] / one[0] for one in times], 1.15),
                                   ("energies besides", [1 + (one[2] - one[1]) / one[0] for one in times], 2.0)):
            value = statistics.median(ratio)
            rows.append(row(f"{what}: {label}, over the head without labels", value * none, "s", none, value,
                            target=f"at most {most}", ok=value <= most))
    return rows
