"""Probability of detection and false alarms of a detector over a set: at one threshold, at all, and against what is known of things."""
from dataclasses import dataclass

import numpy as np

from . import intervals
from .matching import matched
from .pictures import Picture, Thing, Unreadable


@dataclass
class Outcome:
    """What a detector made of a picture."""

    picture: Picture
    things: list
    hit_scores: np.ndarray  # of each thing that of its hit, -inf: none
    alarm_scores: np.ndarray
    km2: float


def outcome(picture: Picture, detector) -> Outcome:
    """Raises Unreadable when the detector does not give boxes and scores of one length."""
    boxes, scores = (np.asarray(one, float) for one in detector(picture))
    if boxes.shape != (len(scores), 4) or scores.ndim != 1:
        raise Unreadable(f"the detector gave boxes of shape {boxes.shape} and scores of shape {scores.shape} for {picture.name}; "
                         "allowed are n x 4 and n")
    if not (np.isfinite(boxes).all() and np.isfinite(scores).all()):
        raise Unreadable(f"the detector gave a box or score of {picture.name} that is no number")
    things = picture.things()
    hit_scores, alarm_scores = matched(np.array([thing.box for thing in things]).reshape(-1, 4), boxes, scores)
    return Outcome(picture, things, hit_scores, alarm_scores, picture.km2())


def threshold_for(outcomes: list, alarms_a_picture: float) -> float:
    """The least threshold at which false alarms are no more than that; -inf where all finds may stand."""
    alarms = np.sort(np.concatenate([of.alarm_scores for of in outcomes]))[::-1]
    allowed = int(np.floor(alarms_a_picture * len(outcomes) + 1e-9))
    return float("-inf") if len(alarms) <= allowed else float(np.nextafter(alarms[allowed], np.inf))


def at(outcomes: list, threshold: float) -> dict:
    """Of all things and pictures, with intervals."""
    found, things = _found(outcomes, threshold)
    alarms = sum(int((of.alarm_scores >= threshold).sum()) for of in outcomes)
    km2 = sum(of.km2 for of in outcomes)
    least, most = intervals.of_count(alarms)
    return {"threshold": threshold, "things": things, "found": found, "probability": found / things if things else None,
            "interval": intervals.of_share(found, things), "false_alarms": alarms, "pictures": len(outcomes), "km2": km2,
            "false_alarms_per_picture": alarms / len(outcomes), "false_alarms_per_km2": alarms / km2 if km2 else None,
            "false_alarms_per_km2_interval": (least / km2, most / km2) if km2 else None}


def _found(outcomes: list, threshold: float) -> tuple:
    return (sum(int((of.hit_scores >= threshold).sum()) for of in outcomes), sum(len(of.things) for of in outcomes))


def curve(outcomes: list, points: int = 40) -> list:
    """The free-response operating characteristic: `at` of thresholds from the strictest to the most lenient."""
    alarms = np.sort(np.concatenate([of.alarm_scores for of in outcomes]))[::-1]
    hits = np.concatenate([of.hit_scores for of in outcomes])
    scores = np.concatenate([alarms, hits[np.isfinite(hits)]])
    if not scores.size:
        return []
    allowed = np.unique(np.geomspace(1, max(len(alarms), 1), points).round().astype(int)) - 1
    thresholds = [float(np.nextafter(alarms[count], np.inf)) for count in allowed if count < len(alarms)]
    return [at(outcomes, threshold) for threshold in [*sorted(set(thresholds), reverse=True), float(scores.min())]]


def against(outcomes: list, threshold: float, axis: str, edges: list | None = None, bins: int = 5) -> list:
    """Rows of probability of detection against what is known of things: of words and truths each value, of numbers between `edges`
    or, without, in bins of equal numbers of things. Raises Unreadable when no thing has it."""
    known = [(thing.known[axis], bool(score >= threshold)) for of in outcomes for thing, score in zip(of.things, of.hit_scores)
             if axis in thing.known]
    if not known:
        raise Unreadable(f"--by {axis}: no thing has it; allowed: {', '.join(names(outcomes))}")
    values = [value for value, _ in known]
    if edges is None and (any(isinstance(value, (str, bool)) for value in values) or len(set(values)) <= bins):
        return [_row(axis, value, value, [hit for one, hit in known if one == value]) for value in sorted(set(values), key=_order)]
    if any(isinstance(value, (str, bool)) for value in values):
        raise Unreadable(f"--by {axis}: is no number; allowed is the name alone")
    numbers, hit = np.array(values, float), np.array([one for _, one in known])
    edges = np.unique(np.quantile(numbers, np.linspace(0, 1, bins + 1))) if edges is None else np.array(edges, float)
    which = np.clip(np.searchsorted(edges, numbers, side="right") - 1, 0, len(edges) - 2)
    inside = (numbers >= edges[0]) & (numbers <= edges[-1])
    return [_row(axis, float(edges[i]), float(edges[i + 1]), hit[inside & (which == i)]) for i in range(len(edges) - 1)]


def _order(value):
    return (isinstance(value, str), value)


def _row(axis: str, low, high, hit) -> dict:
    found, things = int(np.sum(hit)), len(hit)
    return {"axis": axis, "from": low, "to": high, "things": things, "found": found, "probability": found / things if things else None,
            "interval": intervals.of_share(found, things)}


def names(outcomes: list) -> list:
    """What is known of things."""
    return sorted({name for of in outcomes for thing in of.things for name in thing.known})


def missed(outcomes: list, threshold: float) -> list:
    """(picture, thing) of all that were not found."""
    return [(of.picture, thing) for of in outcomes for thing, score in zip(of.things, of.hit_scores) if score < threshold]
