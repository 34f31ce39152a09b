#!/usr/bin/python3
"""Soak: a long run must keep its memory flat, lose nothing and leak no descriptor; a thousand starts must lose nothing.

    bench/soak.py [--build build/release] [--minutes 120] [--starts 1000]

Memory is the resident set of each process, the mean of the last tenth of the samples against the mean of the second
tenth (the first is start-up). Flat means growth below 1 MiB + 1 %: allocators settle, leaks do not. A lost message cannot
hide: every subscriber checks each topic's sequence (exit 5), and a missing last message stalls the run (exit 4).
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = os.sysconf("SC_PAGE_SIZE")


def children_of(pid):
    return [int(c) for c in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def name_of(pid):
    words = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")
    return words[words.index(b"--name") + 1].decode() if b"--name" in words else pathlib.Path(words[0].decode()).name


def sample(run):
    """Resident bytes and open descriptors of the launcher and each process, by name."""
    seen = {}
    for pid in [run.pid, *children_of(run.pid)]:
        try:
            resident = int(pathlib.Path(f"/proc/{pid}/statm").read_text().split()[1]) * PAGE
            seen[name_of(pid)] = (resident, len(os.listdir(f"/proc/{pid}/fd")))
        except (OSError, ValueError, IndexError):
            continue  # it has just ended
    return seen


def judge(samples):
    """Faults of a run, given its samples in order."""
    faults = []
    tenth = max(1, len(samples) // 10)
    for name in samples[len(samples) // 2]:
        memory = [s[name][0] for s in samples if name in s]
        files = [s[name][1] for s in samples if name in s]
        early, late = statistics.mean(memory[tenth:2 * tenth]), statistics.mean(memory[-tenth:])
        growth = late - early
        descriptors = files[-tenth] - files[tenth]
        print(f"{name:12} {early / 2**20:8.1f} MiB -> {late / 2**20:8.1f} MiB   descriptors {files[tenth]} -> {files[-tenth]}")
        if growth > 2**20 + 0.01 * early:
            faults.append(f"{name}: memory grew by {growth / 2**20:.1f} MiB")
        if descriptors > 0:
            faults.append(f"{name}: {descriptors} descriptors leaked")
    return faults


def long_run(build, minutes):
    with tempfile.TemporaryDirectory(prefix="ensonify-soak-") as out:
        seconds = int(minutes * 60 * 10)  # the launch file paces at 10 sim seconds per second
        run = subprocess.Popen([str(build / "bin" / "ensonify-run"), str(ROOT / "bench/launch/soak.yaml"), "--quiet",
                                "--out", out, "--arg", f"seconds={seconds}"], stderr=subprocess.PIPE, text=True)
        samples = []
        interval_s = max(0.5, minutes * 60 / 500)
        while run.poll() is None:
            time.sleep(interval_s)
            samples.append(sample(run))
        errors = run.stderr.read()
        if run.returncode != 0:
            return [f"exit code {run.returncode}: {errors}"]
        report = json.loads((pathlib.Path(out) / "clock.json").read_text())
        print(f"{report['sim_s']:.0f} s of sim time in {report['wall_s']:.0f} s")
        return judge([s for s in samples if len(s) == len(samples[len(samples) // 2])])


def starts(build, count):
    """Every start exchanges hundreds of messages at once, from the first moment."""
    faults = []
    for i in range(count):
        with tempfile.TemporaryDirectory(prefix="ensonify-soak-") as out:
            run = subprocess.run([str(build / "bin" / "ensonify-run"), str(ROOT / "bench/launch/start.yaml"), "--quiet",
                                  "--out", out], capture_output=True, text=True)
            if run.returncode != 0:
                faults.append(f"start {i}: exit code {run.returncode}: {run.stderr}")
    print(f"{count} starts, {len(faults)} with something lost")
    return faults


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build/release", help="build folder with the stub (default: build/release)")
    parser.add_argument("--minutes", type=float, default=120, help="length of the long run (default 120)")
    parser.add_argument("--starts", type=int, default=1000, help="number of starts (default 1000)")
    arguments = parser.parse_args()
    build = (ROOT / arguments.build).resolve()
    faults = starts(build, arguments.starts) + long_run(build, arguments.minutes)
    for fault in faults:
        print("FAULT:", fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
