#!/usr/bin/python3
"""Runs the benchmarks, each interleaved with its floor, and prints medians and ratios.

    bench/run.py [--build build/release] [--only start,round,...] [--json FILE] [--repeat 5] [--quick]

Absolute times belong to the machine and the moment; the ratios to a floor measured in the same run are what counts.
Every benchmark checks its answer first (counts, gaps, exit codes) and fails instead of reporting when it is wrong.
"""
import argparse
import json
import os
import pathlib
import platform
import re
import subprocess
import sys

from bus_benches import bench_free, bench_observers, bench_python, bench_round, bench_start, bench_stream
from console_bench import bench_console
from dataset_bench import bench_dataset
from drive_bench import bench_drive
from environment_bench import bench_environment
from feed_bench import bench_feed
from head_benches import bench_heads
from harness import ROOT, Bench, row
from labels_bench import bench_labels
from logger_bench import bench_logger
from memory_bench import bench_memory
from navigation_bench import bench_navigation
from profile_bench import bench_profile
from ratio_bench import bench_ratios
from scaling_bench import bench_scaling
from table_bench import bench_table, bench_whole
from uncertainty_bench import bench_uncertainty


def bench_kernels(b):
    """The google-benchmark programs of the kernels, which print their own floors."""
    rows = []
    for name in ("bench_array", "bench_trace", "bench_lod", "bench_echo", "bench_detect", "bench_relief", "bench_seabed",
                 "bench_page_in"):
        done = subprocess.run([str(b.build / "bench" / name), "--benchmark_format=json"], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{name}: exit {done.returncode}: {done.stderr}")
        for entry in json.loads(done.stdout)["benchmarks"]:
            rows.append(row(f"{name[6:]}: {entry['name']}", entry["real_time"], entry["time_unit"]))
    return rows


BENCHES = {"start": bench_start, "round": bench_round, "stream": bench_stream, "free": bench_free,
           "python": bench_python, "environment": bench_environment, "observers": bench_observers, "heads": bench_heads, "table": bench_table, "whole": bench_whole, "scaling": bench_scaling, "labels": bench_labels,
           "dataset": bench_dataset, "logger": bench_logger, "memory": bench_memory, "feed": bench_feed,
           "navigation": bench_navigation, "drive": bench_drive, "profile": bench_profile, "uncertainty": bench_uncertainty, "console": bench_console,
           "ratios": bench_ratios, "kernels": bench_kernels}


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
