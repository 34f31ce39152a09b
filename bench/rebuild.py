#!/usr/bin/env python3
"""What one change costs in a build folder: for each file, the steps that Ninja would run again, priced by their last run.

  rebuild.py [--build build/dev] [--cores 2] [--only GLOB] [--slowest N]

Prints the median and the greatest time over all headers, and over all .cpp files. A step costs what Ninja's log says of
it, so the log must be of a build without a compiler cache. No file is changed: each one's time stamp is put back.
"""
import argparse
import os
import pathlib
import re
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent


def prices(build):
    """Seconds of each output's last step."""
    found = {}
    for line in (build / ".ninja_log").read_text(encoding="utf-8").splitlines()[1:]:
        start, end, _, output = line.split("\t")[:4]
        found[output] = (int(end) - int(start)) / 1e3
    return found


def without_cmake(build):
    """Writes a copy of the build file that does not first run CMake again, as a dry run always would."""
    kept = re.sub(r"(?ms)^build build\.ninja[^\n]*: RERUN_CMAKE.*?(?=^\S)", "",
                  (build / "build.ninja").read_text(encoding="utf-8"))
    (build / "rebuild.ninja").write_text(kept, encoding="utf-8")


def dry_run(build):
    return subprocess.run(["ninja", "-C", str(build), "-f", "rebuild.ninja", "-n"], capture_output=True, text=True,
                          check=True).stdout


def steps_after(build, file):
    """Outputs that Ninja would make again if this file had changed."""
    before = file.stat()
    now = time.time_ns()
    os.utime(file, ns=(now, now))
    try:
        printed = dry_run(build)
    finally:
        os.utime(file, ns=(before.st_atime_ns, before.st_mtime_ns))
    return [line.split(" ")[-1] for line in printed.splitlines() if line.startswith("[") and
            (" Building " in line or " Linking " in line)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build/dev", help="build folder, up to date")
    parser.add_argument("--cores", type=int, default=2)
    parser.add_argument("--only", default="*", help="files whose path fits")
    parser.add_argument("--slowest", type=int, default=5, help="how many of each kind are named")
    options = parser.parse_args()
    build = ROOT / options.build
    without_cmake(build)
    if "no work to do" not in dry_run(build):
        sys.exit(f"rebuild.py: {build} is not up to date, so no file's cost can be told: build it first")
    price = prices(build)
    files = subprocess.run(["git", "ls-files", "*.h", "*.cpp"], cwd=ROOT, capture_output=True, text=True,
                           check=True).stdout.split()
    for kind in (".h", ".cpp"):
        costs = []
        for name in files:
            if name.endswith(kind) and pathlib.PurePath(name).match(options.only):
                costs.append((sum(price.get(o, 0.0) for o in steps_after(build, ROOT / name)) / options.cores, name))
        if costs:
            costs.sort(reverse=True)
            print(f"{len(costs)} files *{kind}: median {statistics.median(c for c, _ in costs):.1f} s, greatest "
                  f"{costs[0][0]:.1f} s on {options.cores} cores")
            for seconds, name in costs[:options.slowest]:
                print(f"  {seconds:7.1f} s  {name}")


if __name__ == "__main__":
    main()
