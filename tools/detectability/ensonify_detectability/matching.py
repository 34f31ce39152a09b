"""Which find is which thing.

A find hits a thing when their boxes overlap by a fifth (intersection over union), or the middle of one lies in the other and their areas
differ by a factor of 4 at most. The surest find of a thing is its hit; further ones count neither way; a find of nothing is a false alarm.
"""
import numpy as np

LEAST_OVERLAP, LARGEST_RATIO = 0.2, 4.0


def matched(things: np.ndarray, finds: np.ndarray, scores: np.ndarray) -> tuple:
    """(score of each thing's hit, -inf where there is none; scores of the false alarms). Boxes are n x 4: left, top, right, bottom."""
    best, alarms = np.full(len(things), -np.inf), []
    for i in np.argsort(-scores, kind="stable"):
        touched = [j for j in range(len(things)) if hits(things[j], finds[i])]
        free = [j for j in touched if np.isneginf(best[j])]
        if free:
            best[max(free, key=lambda j: overlap(things[j], finds[i]))] = scores[i]
        elif not touched:
            alarms.append(scores[i])
    return best, np.array(alarms, float)


def hits(one: np.ndarray, other: np.ndarray) -> bool:
    if overlap(one, other) >= LEAST_OVERLAP:
        return True
    ratio = area(one) / max(area(other), 1e-9)
    return 1 / LARGEST_RATIO <= ratio <= LARGEST_RATIO and (_middle_in(one, other) or _middle_in(other, one))


def overlap(one: np.ndarray, other: np.ndarray) -> float:
    """Intersection over union."""
    wide, high = np.minimum(one[2:], other[2:]) - np.maximum(one[:2], other[:2])
    both = max(wide, 0.0) * max(high, 0.0)
    return both / max(area(one) + area(other) - both, 1e-9)


def area(box: np.ndarray) -> float:
    return max(box[2] - box[0], 0.0) * max(box[3] - box[1], 0.0)


def _middle_in(box: np.ndarray, other: np.ndarray) -> bool:
    middle = 0.5 * (box[:2] + box[2:])
    return bool((middle >= other[:2]).all() and (middle <= other[2:]).all())
