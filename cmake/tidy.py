#!/usr/bin/env python3
"""Runs clang-tidy on the .cpp files named on standard input, several at a time, as far as the build knows them."""
import argparse
import concurrent.futures
import json
import pathlib
import subprocess
import sys


def tidy(build, path):
    command = ["clang-tidy", "-p", build, "--quiet", "--warnings-as-errors=*", str(path)]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    # Standard error holds only the count of suppressed warnings unless clang-tidy itself could not work.
    return done.returncode, done.stdout or (done.stderr if done.returncode else "")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", help="folder with compile_commands.json")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()

    commands = json.loads(pathlib.Path(options.build, "compile_commands.json").read_text())
    known = {str(pathlib.Path(entry["directory"], entry["file"]).resolve()) for entry in commands}
    paths = [path for path in sys.stdin.read().split() if str(pathlib.Path(path).resolve()) in known]

    bad = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for code, text in pool.map(lambda path: tidy(options.build, path), paths):
            bad += code != 0
            print(text, end="")
    print(f"clang-tidy: {len(paths)} files, {bad} with findings")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
