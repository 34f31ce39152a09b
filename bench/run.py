#!/usr/bin/python3
"""Runs the benchmarks, each interleaved with its floor, and prints medians and ratios.

    bench/run.py [--build build/release] [--only bus,round,...] [--json FILE] [--repeat 5] [--quick]

Absolute times belong to the machine and the moment; the ratios to a floor measured in the same run are what counts.
Every benchmark checks its answer first (counts, gaps, exit codes) and fails instead of reporting when it is wrong.
"""
import argparse
import json
import os
import pathlib
import platform
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Bench:
    """What all benchmarks share: where the programs are and how often to repeat."""

    def __init__(self, build: pathlib.Path, repeat: int, quick: bool):
        self.build, self.repeat, self.quick = build, repeat, quick

    def program(self, *words) -> dict:
        """Runs a bench program that prints one line of JSON."""
        done = subprocess.run([str(self.build / "bench" / words[0]), *map(str, words[1:])], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{words}: exit {done.returncode}: {done.stderr or done.stdout}")
        return json.loads(done.stdout)

    def launch(self, name: str, *options) -> dict:
        """Runs bench/launch/NAME.yaml; the clock's report, with the connect time from its log."""
        with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as out:
            command = [str(self.build / "bin" / "ensonify-run"), str(ROOT / "bench" / "launch" / f"{name}.yaml"),
                       "--out", out, *map(str, options)]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0:
                raise RuntimeError(f"{name}: exit {done.returncode}: {done.stderr}")
            report = json.loads((pathlib.Path(out) / "clock.json").read_text())
            log = (pathlib.Path(out) / "log" / "clock.log").read_text()
            report["connect_s"] = float(re.search(r"connect_s=([0-9.]+)", log).group(1))
            for notes in pathlib.Path(out).glob("python_step.json"):
                report["python_step"] = json.loads(notes.read_text())
            return report


def interleaved(repeat, ours, floor):
    """ours(), floor(), ours(), ... and the median of each."""
    pairs = [(ours(), floor()) for _ in range(repeat)]
    return statistics.median(a for a, _ in pairs), statistics.median(b for _, b in pairs), [a / b for a, b in pairs]


def row(name, value, unit, floor=None, ratio=None, target="", ok=True):
    return {"name": name, "value": value, "unit": unit, "floor": floor, "ratio": ratio, "target": target, "ok": ok}


def bench_start(b):
    """From the last HELLO until time starts, seven processes."""
    times = [b.launch("start")["connect_s"] * 1e3 for _ in range(20)]
    median = statistics.median(times)
    return [row("start: last HELLO to GO, 7 processes, median of 20", median, "ms", target="<= 50", ok=median <= 50)]


def bench_round(b):
    """Grant rounds against a bare ROUTER/DEALER round of the same size."""
    def ours():
        report = b.launch("round")
        grants = sum(p["grants"] for p in report["participants"])
        assert grants >= 6 * 5900, f"too few grants: {grants}"
        return report["wall_s"] / (grants / 6) * 1e6

    grant_bytes, done_bytes = 17 + 5 * 12, 30 + 2 * 12  # five inputs; token and health
    bare = lambda: 1e6 / b.program("bench_bare_round", 6, 6000, grant_bytes, done_bytes)["rounds_per_s"]
    mine, floor, ratios = interleaved(b.repeat, ours, bare)
    ratio = statistics.median(ratios)
    return [row("grant round, 6 participants", mine, "us", floor, ratio, "<= 1.3", ratio <= 1.3)]


def bench_stream(b):
    """Latency of large messages against bare two-frame ZeroMQ."""
    rows = []
    for size, hz in ((4_000_000, 20), (8_000_000, 40)):
        count = hz * (2 if b.quick else 5)
        run = lambda mode: b.program("bench_stream", mode, size, hz, count)["p50_ms"]  # gaps: exit 5
        mine, floor, ratios = interleaved(b.repeat, lambda: run("link"), lambda: run("bare"))
        ratio = statistics.median(ratios)
        rows.append(row(f"{size // 1_000_000} MB at {hz} Hz, p50 latency, 0 gaps", mine, "ms", floor, ratio, "<= 1.15",
                        ratio <= 1.15))
    return rows


def bench_free(b):
    """How many times faster than real time a survey's traffic runs; the physical limit is that of copying the pings."""
    rows = []
    for size, least in ((4_000_000, 10), (100_000, 40)):
        def factor():
            report = b.launch("free_run", "--arg", f"bytes={size}", "--arg", f"seconds={20 if b.quick else 60}")
            return report["sim_s"] / report["wall_s"]
        median = statistics.median(factor() for _ in range(b.repeat))
        rows.append(row(f"free run with {size // 1000} kB pings at 20 Hz", median, "x real time", target=f">= {least}",
                        ok=median >= least))
    return rows


def bench_python(b):
    """A Python agent in lockstep with a world: from its answer to its next step; the floor is the round with a stub."""
    rows = []
    for size, most_us in ((100_000, 150), (4_000_000, 1000)):
        seconds = 50 if b.quick else 200

        def launch(name):
            return b.launch(name, "--arg", f"bytes={size}", "--arg", f"seconds={seconds}")

        def ours():
            step = launch("python_step")["python_step"]
            assert (step["rounds"], step["bytes"]) == (20 * seconds + 1, size), step
            return step["p50_us"]

        mine, floor, ratios = interleaved(b.repeat, ours, lambda: launch("python_step_floor")["wall_s"] / (20 * seconds) * 1e6)
        rows.append(row(f"Python step with {size // 1000} kB, p50", mine, "us", floor, statistics.median(ratios),
                        f"<= {most_us}", mine <= most_us))
    return rows


def bench_kernels(b):
    """The google-benchmark programs of the kernels, which print their own floors."""
    rows = []
    for name in ("bench_trace", "bench_echo"):
        done = subprocess.run([str(b.build / "bench" / name), "--benchmark_format=json"], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{name}: exit {done.returncode}: {done.stderr}")
        for entry in json.loads(done.stdout)["benchmarks"]:
            rows.append(row(f"{name[6:]}: {entry['name']}", entry["real_time"], entry["time_unit"]))
    return rows


BENCHES = {"start": bench_start, "round": bench_round, "stream": bench_stream, "free": bench_free, "python": bench_python,
           "kernels": bench_kernels}


def machine():
    model = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text())
    commit = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty"], capture_output=True, text=True)
    return {"cpu": model.group(1) if model else platform.processor(), "cores": os.cpu_count(),
            "commit": commit.stdout.strip() or "unknown"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build/release", help="build folder (default: build/release)")
    parser.add_argument("--only", default="", help="comma-separated: " + ", ".join(BENCHES))
    parser.add_argument("--repeat", type=int, default=5, help="interleaved pairs per benchmark (default 5)")
    parser.add_argument("--quick", action="store_true", help="shorter runs")
    parser.add_argument("--json", help="write the results to this file")
    arguments = parser.parse_args()
    names = [n for n in arguments.only.split(",") if n] or list(BENCHES)
    unknown = [n for n in names if n not in BENCHES]
    if unknown:
        parser.error(f"unknown benchmark {unknown[0]}; known: {', '.join(BENCHES)}")
    b = Bench((ROOT / arguments.build).resolve(), arguments.repeat, arguments.quick)
    facts = machine()
    print(f"{facts['cpu']}, {facts['cores']} cores, commit {facts['commit']}")
    rows = []
    for name in names:
        for r in BENCHES[name](b):
            rows.append(r)
            floor = f"  floor {r['floor']:.3f}  ratio {r['ratio']:.2f}" if r["floor"] is not None else ""
            verdict = f"  {r['target']}: {'ok' if r['ok'] else 'MISSED'}" if r["target"] else ""
            print(f"{r['name']:<58} {r['value']:10.3f} {r['unit']}{floor}{verdict}", flush=True)
    if arguments.json:
        pathlib.Path(arguments.json).write_text(json.dumps({"machine": facts, "rows": rows}, indent=2) + "\n")
    return 0 if all(r["ok"] for r in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
