#!/usr/bin/env python3
"""Runs clang-tidy on the .cpp files named on standard input, several at a time, as far as the build knows them.

A file without findings is not checked again while neither it, nor what it includes, nor its flags, nor the configuration
change: ~/.cache/ensonify/clang-tidy keeps an empty file by the sum of all these (as ccache does for compilations).
"""
import argparse
import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
CACHE = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "ensonify" / "clang-tidy"


def run(command, **options):
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, **options)


@functools.lru_cache(maxsize=None)
def sum_of(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


@functools.lru_cache(maxsize=None)
def settings():
    return run(["clang-tidy", "--version"]).stdout + sum_of(ROOT / ".clang-tidy")


def key_of(entry):
    """The sum of all that a verdict on this file follows from, or None where its includes cannot be listed."""
    arguments = shlex.split(entry["command"])
    if pathlib.Path(arguments[0]).name == "ccache":
        arguments = arguments[1:]
    out = arguments.index("-o")
    plain = arguments[:out] + arguments[out + 2:]
    listed = run([*plain, "-M"], cwd=entry["directory"])
    if listed.returncode:
        return None
    # Make's form: target, colon, files; lines go on after a backslash.
    included = shlex.split(listed.stdout.replace("\\\n", " ").split(":", 1)[1])
    read = sorted(pathlib.Path(entry["directory"], path).resolve() for path in included)
    parts = [settings(), " ".join(plain[1:]), *(f"{path} {sum_of(path)}" for path in read)]
    return hashlib.sha256("\n".join(parts).replace(str(ROOT), "").encode()).hexdigest()


def tidy(build, path, entry):
    key = key_of(entry)
    if key and (CACHE / key).exists():
        os.utime(CACHE / key)
        return 0, "", True
    done = run(["clang-tidy", "-p", build, "--quiet", "--warnings-as-errors=*", str(path)])
    if key and not done.returncode:
        CACHE.mkdir(parents=True, exist_ok=True)
        (CACHE / key).touch()
    # Standard error holds only the count of suppressed warnings unless clang-tidy itself could not work.
    return done.returncode, done.stdout or (done.stderr if done.returncode else ""), False


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", help="folder with compile_commands.json")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()

    commands = json.loads(pathlib.Path(options.build, "compile_commands.json").read_text())
    known = {str(pathlib.Path(entry["directory"], entry["file"]).resolve()): entry for entry in commands}
    paths = [path for path in sys.stdin.read().split() if str(pathlib.Path(path).resolve()) in known]

    bad = kept = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for code, text, known_clean in pool.map(lambda path: tidy(options.build, path, known[str(pathlib.Path(path).resolve())]), paths):
            bad += code != 0
            kept += known_clean
            print(text, end="", flush=True)
    print(f"clang-tidy: {len(paths)} files ({kept} unchanged since they passed), {bad} with findings")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
