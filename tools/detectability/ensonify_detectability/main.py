"""How well a detector finds what is in generated pictures: probability of detection and false alarms, and what they depend on.

Of a recipe pictures are made by `ensonify dataset` where they are not there yet. Results are in DIR/detectability.
"""
import argparse
import os
import subprocess
import sys
import traceback
from pathlib import Path

import ensonify
import numpy as np

from . import limits, report
from .detectors import named
from .pictures import Unreadable, read

BAD_INPUT, DIED = 2, 3
USUAL = ("class", "range_m", "size_m", "grazing_deg", "buried", "contrast_db")  # axes, where no others are asked for


def arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="ensonify detectability", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="Exit codes: 0 measured, 2 arguments or set are wrong, 3 the detector failed, else that of `ensonify dataset`.")
    parser.add_argument("--version", action="version", version=f"ensonify {ensonify.__version__}")
    parser.add_argument("of", metavar="RECIPE|SET", type=Path, help="recipe file, or the folder of a set")
    parser.add_argument("-n", type=int, default=400, metavar="N", help="number of pictures of a recipe (default: 400)")
    parser.add_argument("-o", "--out", type=Path, help="folder of set and results; of a set that is there: its own")
    parser.add_argument("-j", "--jobs", type=int, default=max(1, (os.cpu_count() or 2) // 2), help="scenes at once")
    parser.add_argument("--detector", default="cfar", help="cfar (default), MODULE:FUNCTION or FILE.py:FUNCTION, called with a picture")
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--threshold", type=float, help="least score of a find that counts")
    group.add_argument("--alarms", type=float, default=0.1, help="false alarms a picture for which the threshold is set, on the pictures of val (default: 0.1)")
    parser.add_argument("--split", choices=("train", "val", "test"), help="measure on these pictures alone; default: all but those of val")
    parser.add_argument("--by", action="append", metavar="NAME[:E1,E2,...]", help="what to measure against, with edges of bins; may be given several times")
    parser.add_argument("--bins", type=int, default=5, help="bins of a number without edges, of equal numbers of things")
    parser.add_argument("--only", type=int, metavar="K", help="look at picture K of a recipe alone")
    return parser


def set_of(given: argparse.Namespace) -> tuple:
    """(folder of the set, folder of results). Makes the set of a recipe."""
    if given.of.is_dir():
        inner = given.of / "set"
        folder = inner if inner.is_dir() else given.of
        return folder, (given.out or folder.parent) / "detectability"
    if given.out is None:
        raise Unreadable(f"{given.of}: give -o DIR, where the pictures of a recipe are made")
    program = Path(os.environ.get("ENSONIFY_BIN", ".")) / "ensonify-dataset"
    words = [str(program), str(given.of), "-o", str(given.out), "--jobs", str(given.jobs)]
    words += ["-n", str(given.n)] if given.only is None else ["--only", str(given.only)]
    code = subprocess.run(words).returncode
    if code != 0:
        sys.exit(code)
    return given.out / "set", given.out / "detectability"


def outcomes_of(pictures: list, detector) -> list:
    found = []
    for picture in pictures:
        try:
            found.append(limits.outcome(picture, detector))
        except Unreadable:
            raise
        except Exception:
            raise Failed(f"the detector failed on picture {picture.name}:\n{traceback.format_exc()}") from None
    return found


class Failed(Exception):
    """Somebody's detector ended in an exception."""


def threshold_of(given: argparse.Namespace, pictures: list, detector) -> float:
    if given.threshold is not None:
        return given.threshold
    if not given.alarms >= 0:
        raise Unreadable(f"--alarms {given.alarms}: allowed is 0 or more")
    validation = [picture for picture in pictures if picture.split == "val"]
    if not validation:
        raise Unreadable("no picture is of val, by which the threshold is set; allowed is --threshold, or more pictures")
    return limits.threshold_for(outcomes_of(validation, detector), given.alarms)


def axes_of(given: argparse.Namespace, outcomes: list, threshold: float) -> dict:
    known = limits.names(outcomes)
    rows = {}
    for words in given.by if given.by is not None else [axis for axis in USUAL if axis in known]:
        axis, _, edges = words.partition(":")
        try:
            numbers = [float(edge) for edge in edges.split(",")] if edges else None
        except ValueError:
            numbers = []
        if numbers is not None and (len(numbers) < 2 or any(not a < b for a, b in zip(numbers, numbers[1:]))):
            raise Unreadable(f"--by {words}: allowed are two or more rising numbers as edges, with commas")
        rows[axis] = limits.against(outcomes, threshold, axis, numbers, given.bins)
    return rows


def look_at(picture, detector, threshold: float, folder: Path) -> None:
    """One picture: what of it is found, and a drawing."""
    of = outcomes_of([picture], detector)[0]
    for thing, score in zip(of.things, of.hit_scores):
        print(f"  {thing.name}: " + (f"found, {score:.4f}" if score >= threshold else "missed" if np.isneginf(score) else f"missed, {score:.4f}"))
    print(f"  {int((of.alarm_scores >= threshold).sum())} false alarms")
    folder.mkdir(parents=True, exist_ok=True)
    boxes, scores = detector(picture)
    report.picture(picture, boxes, scores, threshold).save(folder / f"{picture.name}.png")
    print(f"  {folder / (picture.name + '.png')}")


def run(given: argparse.Namespace) -> int:
    if given.threshold is not None and not np.isfinite(given.threshold):
        raise Unreadable(f"--threshold {given.threshold}: allowed is a number")
    if given.bins < 1:
        raise Unreadable(f"--bins {given.bins}: allowed is 1 or more")
    detector = named(given.detector)
    if given.only is not None and (given.of.is_dir() or given.threshold is None):
        raise Unreadable("--only: needs a recipe and --threshold")
    folder, results = set_of(given)
    pictures = read(folder)
    if given.only is not None:
        look_at(pictures[0], detector, given.threshold, results)
        return 0
    threshold = threshold_of(given, pictures, detector)
    asked = [picture for picture in pictures if (picture.split == given.split if given.split else picture.split != "val" or given.threshold is not None)]
    if not asked:
        raise Unreadable(f"{folder}: has no such pictures; allowed is another --split, or more pictures")
    outcomes = outcomes_of(asked, detector)
    whole, axes = limits.at(outcomes, threshold), axes_of(given, outcomes, threshold)
    things = [(of.picture, thing, score) for of in outcomes for thing, score in zip(of.things, of.hit_scores)]
    words = ["ensonify", "detectability", str(given.of) if given.of.is_file() else "RECIPE", "--detector", given.detector, "--threshold", repr(threshold)]
    report.write(results, whole, axes, limits.curve(outcomes), things, limits.missed(outcomes, threshold), words)
    print(report.text(whole, axes))
    print(f"{results}: limits.csv, limits.png, curve.csv, things.csv, missed.csv, report.json")
    return 0


def main(words: list | None = None) -> int:
    given = arguments().parse_args(words)
    try:
        return run(given)
    except Unreadable as error:
        print(f"ensonify detectability: {error}", file=sys.stderr)
        return BAD_INPUT
    except Failed as error:
        print(f"ensonify detectability: {error}", file=sys.stderr)
        return DIED
    except OSError as error:
        print(f"ensonify detectability: {error}", file=sys.stderr)
        return 5


if __name__ == "__main__":
    sys.exit(main())
