"""Trains a detector on generated pictures alone, and tests it on generated and on real ones.

    python examples/train_detector make imaging -o out/detector      # or sidescan; 40 minutes on two cores; call it again to go on
    python examples/train_detector test out/detector                 # on generated scenes of other places
    python examples/train_detector test out/detector REAL_FOLDER     # on labelled pictures of your own
    python examples/train_detector worth --generated out/detector --real REAL_FOLDER -o out/worth     # how many real pictures train as well
    python examples/train_detector curve --generated out/set --real REAL_FOLDER -o out/curve        # scores by the number of generated cut-outs
    python examples/train_detector effects RECIPE --real REAL_FOLDER -o out/effects                 # what each effect of the simulation brings
    python examples/train_detector realism REAL out/set              # speckle and texture of a real XTF file or folder, and of a generated one
    python examples/train_detector cut out/set -o out/cut_outs       # a picture of each generated thing, in a folder of its class
"""
import argparse
import pickle
import sys
import time
from pathlib import Path

import numpy as np
import torch

import curve
import cut_outs
import judging
import labelled
import realism
import scenes
import training
import worth
from detector import Detector

ALARMS_ON_EMPTY = 0.05  # share of generated validation pictures without things that may have one, by which the threshold is set


def make(given: argparse.Namespace) -> int:
    began = time.monotonic()
    given.out.mkdir(parents=True, exist_ok=True)
    sets = scenes.make(given.kind, given.pictures, given.out, given.jobs)
    names = scenes.classes(sets)
    made = time.monotonic()
    examples = scenes.generated.Examples(scenes.generated.masters(sets, "train"), names, training.SIZE, np.random.default_rng(given.seed))
    net = training.train(training.Batches(examples, given.seed), names, given.out / "training.pt", given.steps, given.seed, given.jobs)
    detector = Detector(net, names, 0.5, {"kind": given.kind, "pictures": given.pictures, "steps": given.steps, "seed": given.seed,
                                          "parameters": sum(weight.numel() for weight in net.parameters())})
    detector.threshold = threshold_of(detector, scenes.shown(sets, "val", names, given.validate))
    detector.save(given.out / "detector.pt")
    print(f"{given.out / 'detector.pt'}: {detector.about['parameters']} parameters, classes {', '.join(names)}, threshold {detector.threshold:.3f}; "
          f"{(made - began) / 60:.1f} min for pictures, {(time.monotonic() - made) / 60:.1f} min for training")
    return 0


def threshold_of(detector: Detector, pictures: list) -> float:
    """The least score at which few pictures without things have a false alarm."""
    highest = [detector.find(picture.grey(), least_score=1e-3).scores[:1] for picture in pictures if not picture.things]
    surest = np.sort([float(score[0]) if len(score) else 0.0 for score in highest])
    if not surest.size:
        raise scenes.Failed("no validation picture is without things; allowed is a set of more pictures")
    return float(np.clip(surest[int(np.ceil((1 - ALARMS_ON_EMPTY) * surest.size)) - 1] + 1e-3, 0.05, 0.95))


def test(given: argparse.Namespace) -> int:
    folder = given.detector if given.detector.is_dir() else given.detector.parent
    file = folder / "detector.pt" if given.detector.is_dir() else given.detector
    if not file.is_file():
        raise labelled.Unreadable(f"{file}: is not there; allowed is what `make` made")
    torch.set_num_threads(given.jobs)
    try:
        detector = Detector.load(file)
    except (OSError, RuntimeError, KeyError, TypeError, AttributeError, EOFError, ValueError, pickle.UnpicklingError) as error:
        raise labelled.Unreadable(f"{file}: {type(error).__name__}; allowed is what `make` made") from None
    if given.pictures is not None:
        given.pictures.mkdir(parents=True, exist_ok=True)
    if given.folder is None:
        pictures = scenes.shown([folder / name for name in scenes.RECIPES[detector.about["kind"]]], "test", detector.names, given.count)
    else:
        pictures = labelled.chosen(labelled.read(given.folder), renamed(given.rename), given.drop, given.only, given.ignore)
    unknown = {thing.name for picture in pictures for thing in picture.things if not thing.ignored} - set(detector.names)
    if unknown:
        print(f"classes that the detector has not, counted blind to class alone: {', '.join(sorted(unknown))}; it has {', '.join(detector.names)}",
              file=sys.stderr)
    boxes = any(thing.box is not None for picture in pictures for thing in picture.things) or not any(picture.things for picture in pictures)
    result = judging.against_boxes(detector, pictures, given.pictures) if boxes else judging.against_classes(detector, pictures)
    print(judging.as_text(result))
    if given.json is not None:
        given.json.write_text(judging.as_json(result))
    return 0


def value(given: argparse.Namespace) -> int:
    result = worth.measure(given.generated, real_ones(given), given.out, given.steps, given.size, given.seed, given.jobs)
    print(worth.as_text(result))
    (given.out / "worth.json").write_text(judging.as_json(result))
    return 0


def cut(given: argparse.Namespace) -> int:
    masters = [master for split in ("train", "val", "test") for master in scenes.generated.masters(worth.sets_in(given.generated), split)]
    print(f"{cut_outs.write(cut_outs.CutOuts(masters), given.out, given.seed)} cut-outs of {len(masters)} pictures in {given.out}")
    return 0


def by_count(given: argparse.Namespace) -> int:
    return say(curve.by_count(given.generated, given.counts, real_ones(given), given.out, **settings(given)), given.out / "curve.json")


def by_effect(given: argparse.Namespace) -> int:
    return say(curve.by_effect(given.recipe, given.pictures, given.count, real_ones(given), given.out, **settings(given)), given.out / "effects.json")


def settings(given: argparse.Namespace) -> dict:
    return {"steps": given.steps, "size": given.size, "seeds": given.seeds, "jobs": given.jobs}


def say(result: dict, file: Path) -> int:
    print(curve.as_text(result))
    file.write_text(judging.as_json(result))
    return 0


def real_ones(given: argparse.Namespace) -> list:
    real = labelled.chosen(labelled.read(given.real), renamed(given.rename), given.drop, given.only, given.ignore)
    return real if given.groups is None else labelled.with_groups(given.groups, real)


def held_together(given: argparse.Namespace) -> int:
    result = realism.compare(given.one, given.other)
    print(realism.as_text(result))
    if given.json is not None:
        given.json.write_text(judging.as_json(result))
    return 0


def renamed(pairs: list) -> dict:
    wrong = [pair for pair in pairs if "=" not in pair]
    if wrong:
        raise labelled.Unreadable(f"--rename {wrong[0]}: allowed is THEIRS=OURS")
    return dict(pair.split("=", 1) for pair in pairs)


def arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="train_detector", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    of = verbs.add_parser("make", help="make pictures, train, fix the threshold")
    of.add_argument("kind", choices=sorted(scenes.RECIPES))
    of.add_argument("-o", "--out", type=Path, required=True)
    of.add_argument("--pictures", type=int, default=None, help="number of generated pictures, of all recipes; default 2400 of imaging heads, 120 waterfalls")
    of.add_argument("--steps", type=int, default=2400, help=f"of training, {training.BATCH} pictures each")
    of.add_argument("--validate", type=int, default=400, help="number of validation pictures")
    of.add_argument("--seed", type=int, default=1)
    of.add_argument("--jobs", type=int, default=2)
    of = verbs.add_parser("test", help="score a detector on generated or on labelled pictures")
    of.add_argument("detector", type=Path, help="folder that `make` wrote, or its detector.pt")
    of.add_argument("folder", type=Path, nargs="?", help="labelled pictures; left out: generated scenes of other places")
    choose_classes(of)
    of.add_argument("--count", type=int, default=400, help="number of generated pictures")
    of.add_argument("--json", type=Path, help="scores as JSON")
    of.add_argument("--pictures", type=Path, help="folder for pictures with labels and finds drawn in")
    of.add_argument("--jobs", type=int, default=2)
    of = verbs.add_parser("worth", help="how many groups of real pictures train a net as well as a generated set")
    of.add_argument("--generated", type=Path, required=True, help="set of `ensonify dataset`, or folder that `make` wrote")
    choose_real(of, steps=600, size=training.SIZE)
    of.add_argument("--seed", type=int, default=1)
    of = verbs.add_parser("curve", help="scores on real cut-outs by the number of generated ones")
    of.add_argument("--generated", type=Path, required=True, help="set of `ensonify dataset`")
    of.add_argument("--counts", type=int, nargs="+", default=[300, 1000, 3000], help="numbers of cut-outs; those that there are not are left out")
    of.add_argument("--seeds", type=int, default=3, help="number of nets for each")
    choose_real(of, steps=200, size=64)
    of = verbs.add_parser("effects", help="scores on real cut-outs with each effect of the simulation switched off")
    of.add_argument("recipe", type=Path, help="recipe of `ensonify dataset`")
    of.add_argument("-n", dest="pictures", type=int, default=190, help="number of pictures of each variant")
    of.add_argument("--count", type=int, default=1000, help="number of cut-outs that are trained on")
    of.add_argument("--seeds", type=int, default=3, help="number of nets for each")
    choose_real(of, steps=200, size=64)
    of = verbs.add_parser("cut", help="write a cut-out of each thing of a generated set")
    of.add_argument("generated", type=Path, help="set of `ensonify dataset`, or folder that `make` wrote")
    of.add_argument("-o", "--out", type=Path, required=True, help="folder for a folder of each class, and groups.csv: a group is a scene")
    of.add_argument("--seed", type=int, default=1, help="of displays")
    of = verbs.add_parser("realism", help="compare speckle and texture of real and generated pictures")
    of.add_argument("one", type=Path, help="XTF file, set of `ensonify dataset`, or folder of pictures")
    of.add_argument("other", type=Path, help="another one")
    of.add_argument("--json", type=Path, help="numbers as JSON")
    return parser


def choose_real(of: argparse.ArgumentParser, steps: int, size: int) -> None:
    of.add_argument("--real", type=Path, required=True, help="labelled pictures, in any form that `test` reads")
    of.add_argument("--groups", type=Path, help="CSV of file, group; default: the real folder's own, or what looks alike")
    of.add_argument("-o", "--out", type=Path, required=True, help="folder of the nets, which stay, and of the scores as JSON")
    of.add_argument("--steps", type=int, default=steps, help="of each training; of cut-outs with a class alone 200 do")
    of.add_argument("--size", type=int, default=size, choices=(64, 128, 256), help="sides of training pictures in pixels")
    of.add_argument("--jobs", type=int, default=2)
    choose_classes(of)


def choose_classes(of: argparse.ArgumentParser) -> None:
    of.add_argument("--rename", action="append", default=[], metavar="THEIRS=OURS", help="class of theirs that is one of the detector's")
    of.add_argument("--drop", action="append", default=[], metavar="CLASS", help="counts as nothing: finding it is a false alarm")
    of.add_argument("--only", action="append", default=[], metavar="CLASS", help="all others are dropped")
    of.add_argument("--ignore", action="append", default=[], metavar="CLASS", help="neither wanted nor a false alarm")


def main() -> int:
    given = arguments().parse_args()
    if given.verb == "make" and given.pictures is None:
        given.pictures = {"imaging": 2400, "sidescan": 120}[given.kind]
    try:
        return {"make": make, "test": test, "worth": value, "cut": cut, "realism": held_together, "curve": by_count, "effects": by_effect}[given.verb](given)
    except (labelled.Unreadable, scenes.Failed) as error:
        print(f"train_detector: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
