"""How well things are found: COCO's average precision, false alarms, classes of whole pictures, with intervals.

Boxes are matched as COCO does: the surest first, each to the thing of the largest overlap that nothing surer has. What overlaps only things
that do not count is left out.
"""
from dataclasses import dataclass, field

import numpy as np

from detector import area, iou

THRESHOLDS = np.arange(0.5, 0.96, 0.05)


@dataclass
class Judged:
    """A picture: what is in it and what was found."""

    boxes: np.ndarray  # things x 4
    kinds: np.ndarray  # things, places in a list of classes; -1: one that counts for no class
    ignored: np.ndarray  # things, bool
    found: np.ndarray  # finds x 4, the surest first
    scores: np.ndarray  # finds
    shares: np.ndarray  # finds x classes
    pixels: int
    memory: dict = field(default_factory=dict)  # what was judged already: pictures are drawn again and again for intervals

    def of_kind(self, least: float, kind: int | None) -> tuple:
        """(scores, hits, number of things) of a class, the surest find first; kind None: of all, blind to class."""
        key = (round(least, 3), kind)
        if key not in self.memory:
            wanted = np.ones(len(self.boxes), bool) if kind is None else (self.kinds == kind) | self.ignored
            score = self.scores if kind is None else self.scores * self.shares[:, kind]
            order = np.argsort(-score, kind="stable")
            ignored = self.ignored[wanted]
            self.memory[key] = score[order], hits(self.boxes[wanted], ignored, self.found[order], least), int((~ignored).sum())
        return self.memory[key]


def hits(truth: np.ndarray, ignored: np.ndarray, found: np.ndarray, least: float) -> np.ndarray:
    """Of each find, the surest first: 1 a hit, 0 a false alarm, -1 neither."""
    is_hit, taken = np.zeros(len(found), int), np.zeros(len(truth), bool)
    for i, box in enumerate(found):
        overlaps = np.array([0 if taken[j] and not ignored[j] else (_inside(box, other) if ignored[j] else iou(box, other))
                             for j, other in enumerate(truth)])
        real = np.where(ignored, 0, overlaps) if len(truth) else overlaps
        if len(truth) and real.max() >= least - 1e-9:
            taken[real.argmax()] = True
            is_hit[i] = 1
        elif len(truth) and np.where(ignored, overlaps, 0).max() >= least - 1e-9:
            is_hit[i] = -1
    return is_hit


def _inside(box: np.ndarray, region: np.ndarray) -> float:
    """Share of a box that lies in a region, as COCO counts crowds."""
    wide, high = np.minimum(box[2:], region[2:]) - np.maximum(box[:2], region[:2])
    return max(wide, 0) * max(high, 0) / max(area(box), 1e-9)


def average_precision(pictures: list, least: float, kind: int | None = None) -> float:
    """COCO's, at 101 recalls. kind None: blind to classes. NaN where nothing is to be found."""
    if not pictures:
        return float("nan")
    scores, is_hit, wanted = zip(*(picture.of_kind(least, kind) for picture in pictures))
    return _area_under(np.concatenate(scores), np.concatenate(is_hit), sum(wanted))


def _area_under(scores: np.ndarray, is_hit: np.ndarray, wanted: int) -> float:
    if wanted == 0:
        return float("nan")
    order = np.argsort(-scores, kind="stable")
    is_hit = is_hit[order][is_hit[order] >= 0]
    recall, precision = np.cumsum(is_hit) / wanted, np.cumsum(is_hit) / np.arange(1, len(is_hit) + 1)
    best = np.maximum.accumulate(precision[::-1])[::-1] if len(precision) else precision
    at = np.searchsorted(recall, np.linspace(0, 1, 101) - 1e-12, side="left")
    return float(np.where(at < len(best), best[np.minimum(at, len(best) - 1)], 0).mean()) if len(best) else 0.0


def near(box: np.ndarray, other: np.ndarray) -> bool:
    """A hit for recall at false alarms: boxes overlap by a fifth, or the middle of one is in the other and areas differ by 4 at most."""
    if iou(box, other) >= 0.2:
        return True
    ratio = area(box) / max(area(other), 1e-9)
    return 0.25 <= ratio <= 4 and (_holds(other, box) or _holds(box, other))


def _holds(box: np.ndarray, other: np.ndarray) -> bool:
    middle = (other[:2] + other[2:]) / 2
    return bool((middle >= box[:2]).all() and (middle <= box[2:]).all())


def alarms(picture: Judged) -> np.ndarray:
    """Of each find, the surest first: 1 the first hit of a thing, 0 a false alarm, -1 neither (a second hit, or what does not count)."""
    if "alarms" in picture.memory:
        return picture.memory["alarms"]
    result, taken = np.zeros(len(picture.found), int), np.zeros(len(picture.boxes), bool)
    for i, box in enumerate(picture.found):
        touched = [j for j, other in enumerate(picture.boxes) if near(box, other)]
        wanted = [j for j in touched if not picture.ignored[j]]
        free = [j for j in wanted if not taken[j]]
        if free:
            taken[max(free, key=lambda j: iou(box, picture.boxes[j]))] = True
            result[i] = 1
        elif wanted or any(picture.ignored[j] and (j in touched or _inside(box, picture.boxes[j]) >= 0.5) for j in range(len(picture.boxes))):
            result[i] = -1
    picture.memory["alarms"] = result
    return result


def recall_at(pictures: list, alarms_a_picture: float) -> float:
    """Share of things found at so many false alarms a picture, over all pictures."""
    wanted = sum(int((~picture.ignored).sum()) for picture in pictures)
    if wanted == 0:
        return float("nan")
    scores, of = np.concatenate([picture.scores for picture in pictures]), np.concatenate([alarms(picture) for picture in pictures])
    order = np.argsort(-scores, kind="stable")
    allowed = np.cumsum(of[order] == 0) <= alarms_a_picture * len(pictures) + 1e-9
    return float(((of[order] == 1) & allowed).sum() / wanted)


def at_threshold(pictures: list, threshold: float) -> dict:
    """Recall, and false alarms on pictures without things: share of these pictures, and number a megapixel."""
    empty = [picture for picture in pictures if not len(picture.boxes)]
    false = [int((picture.scores >= threshold).sum()) for picture in empty]
    found = sum(int(((alarms(picture) == 1) & (picture.scores >= threshold)).sum()) for picture in pictures)
    wanted = sum(int((~picture.ignored).sum()) for picture in pictures)
    return {"recall": found / wanted if wanted else float("nan"),
            "empty_with_alarm": float(np.mean([count > 0 for count in false])) if empty else float("nan"),
            "alarms_per_megapixel": sum(false) / (sum(picture.pixels for picture in empty) / 1e6) if empty else float("nan")}


def of_boxes(pictures: list, kinds: list, threshold: float) -> dict:
    """All scores of pictures with boxes. kinds: places of the classes that are asked for."""
    by_kind = {kind: average_precision(pictures, 0.5, kind) for kind in kinds}
    known = [value for value in by_kind.values() if not np.isnan(value)]
    return {"AP": float(np.mean([average_precision(pictures, least) for least in THRESHOLDS])), "AP50": average_precision(pictures, 0.5),
            "mAP50": float(np.mean(known)) if known else float("nan"),
            **{f"recall at {rate:g} alarms a picture": recall_at(pictures, rate) for rate in (0.25, 1)},
            **at_threshold(pictures, threshold)}


def of_classes(truth: np.ndarray, said: np.ndarray, classes: int) -> dict:
    """Of whole pictures: balanced accuracy (mean recall of the classes that occur) and macro F1. said: -1 nothing found."""
    recalls, f1 = [], []
    for kind in range(classes):
        there, called = truth == kind, said == kind
        if not there.any():
            continue
        right = int((there & called).sum())
        recalls.append(right / there.sum())
        f1.append(2 * right / (there.sum() + called.sum()))
    return {"balanced accuracy": float(np.mean(recalls)), "macro F1": float(np.mean(f1))}


def interval(score, pictures: list, groups: np.ndarray, draws: int = 200, seed: int = 1) -> dict:
    """95 % of each score when groups of pictures are drawn again with replacement. score: from a list of pictures to named numbers."""
    random, members = np.random.default_rng(seed), [np.flatnonzero(groups == group) for group in np.unique(groups)]
    values: dict = {}
    for _ in range(draws):
        drawn = np.concatenate([members[i] for i in random.integers(len(members), size=len(members))])
        for name, value in score([pictures[i] for i in drawn]).items():
            values.setdefault(name, []).append(value)
    return {name: [float(edge) for edge in np.nanpercentile(of, [2.5, 97.5])] if not np.isnan(of).all() else None for name, of in values.items()}
