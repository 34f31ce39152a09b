"""What a generated set is worth: how many groups of real pictures train a net as well.

Of the real groups two of five are held out. The same net, from the same weights and over as many steps, is trained on k of the others, on the
generated set alone, and on it and k of them. Worth is the k at which the curve of real pictures (the median of draws, made monotone, linear
in log k) reaches what the generated set reaches alone. Of pictures with a class alone the net is one for whole cut-outs.
"""
import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import cut_outs
import generated
import judging
import labelled
import scores
import training
import whole
from detector import Detector
from groups import groups_of
from real import Both, Taken

GROUPS = (10, 30, 100, 300)  # k
HELD_OUT = 0.4  # share of the groups
DRAWS = 3  # of each k
SURE = 0.3  # least score of a find whose mask counts


@dataclass
class Answer:
    """What a net made of the held-out pictures."""

    judged: list | None = None  # of scores.Judged, with boxes
    mask_iou: list | None = None  # for each picture a list
    said: np.ndarray | None = None  # class of each picture, of those asked for


class Held:
    """The held-out pictures, and the score that their labels allow: mAP50 of boxes, mean IoU of masks, balanced accuracy of classes."""

    def __init__(self, pictures: list, groups: np.ndarray, names: list):
        self.pictures, self.groups, self.names = pictures, groups, names
        things = [thing for picture in pictures for thing in picture.things if not thing.ignored]
        if not things:
            raise labelled.Unreadable("the held-out real pictures have no labelled thing; allowed is a folder with more groups")
        of_classes = any(thing.box is None for thing in things)
        of_masks = not of_classes and all(thing.polygons or thing.mask_of for thing in things)
        self.kind = "balanced accuracy" if of_classes else "mask IoU" if of_masks else "mAP50"
        self.asked = sorted({names.index(thing.name) for thing in things if thing.name in names})
        self.truth = np.array([next((names.index(thing.name) for thing in picture.things if thing.name in names), -2) for picture in pictures])

    def found(self, detector: Detector) -> Answer:
        of, masks = [], []
        for picture in self.pictures:
            grey = picture.grey()
            masks.append([])
            of.append(judging.judged(picture, detector.find(grey), self.names, grey.shape, masks[-1], SURE))
        return Answer(judged=of, mask_iou=masks)

    def said(self, net: whole.Whole, size: int) -> Answer:
        return Answer(said=whole.said(net, self.pictures, size, self.asked))

    def score(self, answer: Answer, which: np.ndarray) -> float:
        if self.kind == "mask IoU":
            values = [value for i in which for value in answer.mask_iou[i]]
            return float(np.mean(values)) if values else 0.0
        if self.kind == "mAP50":
            pictures = [answer.judged[i] for i in which]
            known = [value for value in (scores.average_precision(pictures, 0.5, kind) for kind in self.asked) if not np.isnan(value)]
            return float(np.mean(known)) if known else 0.0
        which = which[self.truth[which] >= 0]
        return scores.of_classes(self.truth[which], answer.said[which], len(self.names))["balanced accuracy"] if len(which) else 0.0


def equal(curve: dict, reached: float) -> float:
    """The k at which a curve {k: score} reaches a score; 0: below its first k; inf: it does not."""
    counts = sorted(curve)
    rising = np.maximum.accumulate([curve[k] for k in counts])
    if rising[0] >= reached:
        return 0.0
    above = np.flatnonzero(rising >= reached)
    if not above.size:
        return float("inf")
    i = int(above[0])
    share = (reached - rising[i - 1]) / (rising[i] - rising[i - 1])
    return float(np.exp(np.log(counts[i - 1]) + share * np.log(counts[i] / counts[i - 1])))


def as_word(k: float, counts: list) -> str:
    return f"< {min(counts)}" if k == 0 else f"> {max(counts)}" if np.isinf(k) else f"{k:.0f}"


class Detectors:
    """Detectors that differ by their pictures alone. What was trained stays in `folder`."""

    def __init__(self, names: list, masters: list, folder: Path, steps: int, size: int, seed: int, jobs: int):
        self.names, self.masters, self.folder, self.steps, self.size, self.seed, self.jobs = names, masters, folder, steps, size, seed, jobs

    def answer(self, test: Held, name: str, with_generated: bool, pictures: list) -> Answer:
        """Of a detector that is trained on generated pictures, on these real ones, or on both."""
        of = [generated.Examples(self.masters, self.names, self.size, np.random.default_rng(self.seed))] if with_generated else []
        of += [Taken(pictures, self.names)] if pictures else []
        batches = training.Batches(of[0] if len(of) == 1 else Both(*of), self.seed, self.size)
        net = training.train(batches, self.names, self.folder / f"{name}.pt", self.steps, self.seed, self.jobs, say=lambda *_, **__: None)
        return test.found(Detector(net, self.names, SURE, {}))


class Wholes:
    """The same of nets that say the class of a whole cut-out."""

    def __init__(self, names: list, masters: list, folder: Path, steps: int, size: int, seed: int, jobs: int):
        self.names, self.folder, self.steps, self.size, self.seed, self.jobs = names, folder, steps, size, seed, jobs
        self.generated = cut_outs.CutOuts(masters)
        if not self.generated.of_class:
            raise labelled.Unreadable("no thing of the generated set can be seen; allowed is a set of more pictures")

    def answer(self, test: Held, name: str, with_generated: bool, pictures: list) -> Answer:
        sources = ([self.generated] if with_generated else []) + ([whole.Real(pictures)] if pictures else [])
        return test.said(whole.train(sources, self.names, self.folder / f"{name}.pt", self.steps, self.size, self.seed, self.jobs), self.size)


def keep(folder: Path, **of) -> None:
    """Nets of a folder are of one set of pictures and settings. Raises Unreadable where others are there."""
    folder.mkdir(parents=True, exist_ok=True)
    file, now = folder / "of.json", json.dumps(of)
    if file.is_file() and file.read_text() != now:
        raise labelled.Unreadable(f"{folder}: has nets of other pictures or settings ({file.read_text()}); allowed is an empty folder")
    file.write_text(now)


def digest(files: list) -> str:
    """Of names and sizes."""
    return hashlib.sha256("\n".join(f"{file.name} {file.stat().st_size}" for file in files).encode()).hexdigest()[:16]


def of_masters(masters: list) -> str:
    return digest([master.folder / "amplitude" / f"{master.name}.png" for master in masters])


def sets_in(folder: Path) -> list:
    """Sets of `ensonify dataset`: the folder itself, or those in it."""
    found = [at for at in (folder, *sorted(folder.iterdir())) if (at / "set/train/facts").is_dir()] if folder.is_dir() else []
    if not found:
        raise labelled.Unreadable(f"{folder}: has no generated set; allowed is what `ensonify dataset` or `make` made")
    return found


def measure(generated_folder: Path, real: list, folder: Path, steps: int, size: int, seed: int, jobs: int, say=print) -> dict:
    """real: labelled pictures. Gives scores of all nets with intervals of 95 % over groups of held-out pictures, and the worth."""
    masters = generated.masters(sets_in(generated_folder), "train")
    group, random = groups_of(real), np.random.default_rng(seed)
    order = random.permutation(group.max() + 1)
    held = int(np.ceil(HELD_OUT * len(order)))
    counts = [k for k in GROUPS if k <= len(order) - held]
    left_out = [k for k in GROUPS if k > len(order) - held]
    if not counts:
        raise labelled.Unreadable(f"the real pictures are of {len(order)} groups; allowed are {int(np.ceil(GROUPS[0] / (1 - HELD_OUT))) + 1} or more")
    names = sorted({thing["class"] for master in masters for thing in master.facts["objects"]}
                   | {thing.name for picture in real for thing in picture.things if not thing.ignored})
    is_held = np.isin(group, order[:held])
    test = Held([picture for picture, out in zip(real, is_held) if out], group[is_held], names)
    keep(folder, steps=steps, size=size, seed=seed, generated=of_masters(masters), real=digest([picture.file for picture in real]))
    make = (Wholes if test.kind == "balanced accuracy" else Detectors)(names, masters, folder, steps, size, seed, jobs)
    say(f"{len(real)} real pictures of {len(order)} groups, {len(test.pictures)} held out; {len(masters)} generated; score {test.kind}", flush=True)
    answers: dict = {"generated": [make.answer(test, "generated", True, [])]}
    for k in counts:
        answers[f"real {k}"], answers[f"generated and real {k}"] = [], []
        for draw in range(DRAWS):
            chosen = random.choice(order[held:], k, replace=False)
            pictures = [picture for picture, of in zip(real, group) if of in chosen]
            answers[f"real {k}"].append(make.answer(test, f"real_{k}_{draw}", False, pictures))
            answers[f"generated and real {k}"].append(make.answer(test, f"both_{k}_{draw}", True, pictures))
        say(f"  {k} groups trained", flush=True)
    return {**summary(test, answers, counts), "left_out": left_out, "steps": steps, "size": size}


def summary(test: Held, answers: dict, counts: list, draws: int = 200, seed: int = 1) -> dict:
    """Scores and worth of all held-out pictures, and of as many groups drawn again."""
    members = [np.flatnonzero(test.groups == of) for of in np.unique(test.groups)]
    random = np.random.default_rng(seed)

    def of(which: np.ndarray) -> tuple:
        values = {name: float(np.median([test.score(answer, which) for answer in some])) for name, some in answers.items()}
        return values, equal({k: values[f"real {k}"] for k in counts}, values["generated"])

    values, worth = of(np.arange(len(test.pictures)))
    again = [of(np.concatenate([members[i] for i in random.integers(len(members), size=len(members))])) for _ in range(draws)]
    between = {name: np.percentile([one[0][name] for one in again], [2.5, 97.5]).tolist() for name in values}
    low, high = (float(np.sort([one[1] for one in again])[int(at)]) for at in (0.025 * (draws - 1), np.ceil(0.975 * (draws - 1))))
    return {"score": test.kind, "classes": [test.names[kind] for kind in test.asked], "held_out": len(test.pictures),
            "scores": {name: {"value": value, "interval": between[name]} for name, value in values.items()},
            "worth": as_word(worth, counts), "worth_interval": [as_word(low, counts), as_word(high, counts)]}


def as_text(result: dict) -> str:
    lines = [f"{result['score']} of {', '.join(result['classes'])}"]
    lines += [f"  {name:<26} {of['value']:.3f}  ({of['interval'][0]:.3f} to {of['interval'][1]:.3f})" for name, of in result["scores"].items()]
    lines += [f"  {k} groups: left out, there are not so many" for k in result["left_out"]]
    lines.append(f"the generated set is worth {result['worth']} groups of real pictures ({result['worth_interval'][0]} to {result['worth_interval'][1]})")
    return "\n".join(lines)
