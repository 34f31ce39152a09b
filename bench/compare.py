#!/usr/bin/env python3
"""Is this commit faster than another? Builds the other one beside this, and runs the table of speed with both, in turns.

    bench/compare.py BASE [--only TEXT] [--pairs 5] [--build build/release] [--folder /tmp/ensonify-compare]

BASE is a commit or a branch. Printed is the processor time of a ping, the median of ours over that of BASE, with the least and the
greatest ratio of a pair. Machines at work change their speed from minute to minute: only pairs count. Exit code 1 where a ping is
slower by more than 5 % in the median.
"""
import argparse
import pathlib
import statistics
import subprocess
import sys

from harness import ROOT, Bench
from table_bench import CASES, measured

SLOWER = 1.05


def built(base: str, folder: pathlib.Path) -> pathlib.Path:
    """A release build of a commit in a work tree of its own, which stays for the next time."""
    if not (folder / ".git").exists():
        subprocess.run(["git", "-C", str(ROOT), "worktree", "add", "--detach", str(folder), base], check=True)
    subprocess.run(["git", "-C", str(folder), "checkout", "--quiet", "--detach", base], check=True)
    subprocess.run(["cmake", "--preset", "release"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", "build/release"], cwd=folder, check=True)
    return folder / "build/release"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base", help="commit or branch to compare with, or a finished build folder")
    parser.add_argument("--only", default="", help="cases whose name has this text")
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--build", default="build/release", help="our build folder (default: build/release)")
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("/tmp/ensonify-compare"), help="work tree of BASE")
    options = parser.parse_args()
    cases = [case for case in CASES if options.only in case.name]
    if not cases:
        parser.error(f"no case has {options.only!r}; allowed: {'; '.join(case.name for case in CASES)}")
    other = pathlib.Path(options.base)
    theirs = Bench(other.resolve() if (other / "bin").is_dir() else built(options.base, options.folder), 1, False)
    ours = Bench((ROOT / options.build).resolve(), 1, False)
    slower = 0
    for case in cases:
        pairs = [(measured(ours, case, 5)[1], measured(theirs, case, 5)[1]) for _ in range(options.pairs)]
        ratios = sorted(a / b for a, b in pairs)
        ratio = statistics.median(ratios)
        slower += ratio > SLOWER
        print(f"{case.name:<68} {statistics.median(a for a, _ in pairs):8.2f} ms  {statistics.median(b for _, b in pairs):8.2f} ms  "
              f"{ratio:.3f} ({ratios[0]:.3f} to {ratios[-1]:.3f})", flush=True)
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
