"""Ratios of kernels that no machine and no load changes much: both sides run in turns in one program. CI holds them (`.ci/run`)."""
import json
import operator
import subprocess

from harness import row

# Program, benchmark, counter, what it must be, what it is. Bounds leave a fourth to what was measured (docs/decisions/speed.md).
RATIOS = [
    ("bench_trace", "distributed_over_embree/quality_pct:100", "of_embree", operator.ge, 0.45, "Embree alone over a ping's rays, chosen and traced"),
    ("bench_trace", "refracted_over_straight/4096", "bent/straight", operator.le, 1.5, "bent over straight rays"),
    ("bench_echo", "whole_ping_in_turns/1/min_time:2.000/real_time", "of_embree", operator.ge, 0.4, "Embree alone over a whole ping, its echoes and beams included"),
]


def bench_ratios(b):
    rows = []
    for program, name, counter, holds, bound, text in RATIOS:
        done = subprocess.run([str(b.build / "bench" / program), f"--benchmark_filter=^{name}$", "--benchmark_format=json"], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{program}: exit {done.returncode}: {done.stderr}")
        found = [entry[counter] for entry in json.loads(done.stdout)["benchmarks"]]
        assert len(found) == 1, f"{program} has no benchmark {name}"
        rows.append(row(text, found[0], "x", target=f"at {'least' if holds is operator.ge else 'most'} {bound}", ok=holds(found[0], bound)))
    return rows
