"""What `ensonify run --profile` costs: processor time of the same run with it and without, in turns."""
import json
import os
import statistics

from harness import ROOT, interleaved, row

# Sim seconds of each head. Forward-looking: few long stages a ping; multibeam: many short ones, for each sector.
KINDS = {"forward_looking": 4, "multibeam": 30}


def bench_profile(b):
    """Processor time of all processes of a head's run with --profile over that without, the median of pairs. One pair differs by
    one or two percent on a machine at work, so there are four times as many as of other benchmarks, and the standard error of their
    median stands beside it; the target counts as missed where the ratio is above it by more than two of these."""
    rows = []
    for kind, seconds in KINDS.items():
        options = ["--arg", f"kind={kind}", "--arg", f"seconds={seconds}"]
        for key, value in json.loads((ROOT / "components" / kind / "bench.json").read_text())["parameters"].items():
            options += ["--set", f"bow.{key}={value}"]
        pings = set()

        def processor_s(*more):
            before = os.times()
            pings.add(b.launch("head", *options, *more)["messages"]["pings"])
            after = os.times()
            return after.children_user + after.children_system - before.children_user - before.children_system

        profiled, plain, ratios = interleaved((2 if b.quick else 4) * b.repeat, lambda: processor_s("--profile"), processor_s)
        assert len(pings) == 1, f"{kind}: {pings} pings: not the same run"
        error = 1.25 * statistics.stdev(ratios) / len(ratios) ** 0.5
        ratio = statistics.median(ratios)
        rows.append(row(f"{kind} with --profile (without; +-{error:.4f})", profiled, "s", plain, ratio,
                        target="at most 1.01", ok=ratio - 2 * error <= 1.01))
    return rows
