#!/usr/bin/python3
"""Runs patch tests with acoustics and navigation's errors, each with a mounting and latencies of its own, and counts.

    bench/patch_bench.py [--build build/release] [--seeds 1-20] [--jobs 1] [--records FOLDER] [--json FILE]

`ensonify patch` sees the records alone; what is true is drawn here: roll within 3.5 degrees of zero, pitch and yaw within 1.5,
position latency to 200 ms, attitude latency to 20 ms. The ping rate is drawn as well, 1.8 to 2.2 Hz: at one rate all surveys would
have their pings in the same places. Counts come with their 95 % interval [ClopperPearson1934].
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

from harness import ROOT

DEGREE = math.pi / 180
#          name of the answer, launch argument, drawn from, to, SI per unit of the argument, limit in that unit
UNKNOWNS = (("position_latency_s", "position_latency_s", 0, 0.2, 1, 0.02),
            ("attitude_latency_s", "attitude_latency_s", 0, 0.02, 1, 0.002),
            ("roll_rad", "roll_deg", -3.5, 3.5, DEGREE, 0.02),
            ("pitch_rad", "pitch_deg", -1.5, 1.5, DEGREE, 0.1),
            ("yaw_rad", "yaw_deg", -1.5, 1.5, DEGREE, 0.1))


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{command}: exit {done.returncode}: {done.stderr}")
    return done.stdout


def drawn(seed):
    """What is true in a survey, by launch argument, and how fast it pings."""
    draw = random.Random(seed)
    true = {argument: round(draw.uniform(least, most), 4) for _, argument, least, most, _, _ in UNKNOWNS}
    return true, round(draw.uniform(1.8, 2.2), 3)


def surveyed(build, seed, record):
    """Leaves the record of a survey there; one that is there is not run anew."""
    true, ping_rate_hz = drawn(seed)
    if record.exists():
        return
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as out:
        arguments = [word for name, value in {"seed": seed, "ping_rate_hz": ping_rate_hz, **true}.items()
                     for word in ("--arg", f"{name}={value}")]
        run(build / "bin/ensonify-run", ROOT / "bench/launch/patch.yaml", "--quiet", "--out", out, *arguments)
        shutil.move(pathlib.Path(out) / "patch.mcap", record)


def survey(build, seed, records):
    """(error, half width of the stated interval) of each unknown, in units of its launch argument."""
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as fresh:
        record = pathlib.Path(records or fresh) / f"{seed}.mcap"
        surveyed(build, seed, record)
        found = json.loads(run(build / "bin/ensonify-patch", record, "--json"))
    if not found["converged"]:
        print(f"seed {seed}: not converged", file=sys.stderr)
    true, _ = drawn(seed)
    return [(found[name]["value"] / unit - true[argument], found[name]["half_interval_95"] / unit)
            for name, argument, _, _, unit, _ in UNKNOWNS]


def tail(hits, tries, share):
    """Probability of at least `hits`."""
    return sum(math.comb(tries, k) * share**k * (1 - share)**(tries - k) for k in range(hits, tries + 1))


def solved(function, level):
    """Where a rising function of 0..1 reaches the level."""
    low, high = 0.0, 1.0
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) < level else (low, middle)
    return (low + high) / 2


def bounds(hits, tries):
    least = 0.0 if hits == 0 else solved(lambda share: tail(hits, tries, share), 0.025)
    most = 1.0 if hits == tries else solved(lambda share: tail(hits + 1, tries, share), 0.975)
    return least, most


def summary(surveys):
    """A row per unknown: how often the truth was inside the interval and the error within the limit, and how large both were."""
    rows = []
    for (name, argument, _, _, _, limit), results in zip(UNKNOWNS, zip(*surveys)):
        count = len(results)
        rows.append({"unknown": argument, "surveys": count,
                     "inside_interval": sum(abs(error) <= half for error, half in results),
                     "within_limit": sum(abs(error) <= limit for error, _ in results), "limit": limit,
                     "mean_error": sum(error for error, _ in results) / count,
                     "rms_error": math.sqrt(sum(error**2 for error, _ in results) / count),
                     "rms_half_interval": math.sqrt(sum(half**2 for _, half in results) / count)})
    return rows


def write(file, surveys):
    content = {"surveys": dict(sorted(surveys.items())), "summary": summary(list(surveys.values()))}
    pathlib.Path(file).write_text(json.dumps(content, indent=1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build/release", help="build folder (default: build/release)")
    parser.add_argument("--seeds", default="1-20", help="first and last (default 1-20)")
    parser.add_argument("--jobs", type=int, default=1, help="surveys at a time (default 1)")
    parser.add_argument("--records", help="keep the records in this folder; those that are there are not run anew")
    parser.add_argument("--json", help="write errors, intervals and counts to this file, after each survey")
    options = parser.parse_args()
    build = (ROOT / options.build).resolve()
    os.environ["PATH"] = f"{build / 'bin'}:{os.environ['PATH']}"
    if options.records:
        pathlib.Path(options.records).mkdir(parents=True, exist_ok=True)
    first, last = (int(word) for word in options.seeds.split("-"))
    surveys = {}
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        waiting = {pool.submit(survey, build, seed, options.records): seed for seed in range(first, last + 1)}
        for done in concurrent.futures.as_completed(waiting):
            surveys[waiting[done]] = done.result()
            print(waiting[done], *(f"{error:+.4f}+-{half:.4f}" for error, half in done.result()), flush=True)
            if options.json:
                write(options.json, surveys)
    for r in summary(list(surveys.values())):
        inside, within = ("{} of {} ({:.0%} to {:.0%})".format(r[key], r["surveys"], *bounds(r[key], r["surveys"]))
                          for key in ("inside_interval", "within_limit"))
        print(f"{r['unknown']}: inside its interval {inside}, within {r['limit']} {within}; mean {r['mean_error']:+.4f}, "
              f"rms {r['rms_error']:.4f}, stated {r['rms_half_interval']:.4f}")


if __name__ == "__main__":
    main()
