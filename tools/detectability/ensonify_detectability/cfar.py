"""The detector that is shipped: cell-averaging constant false alarm rate (CFAR).

A pixel's mean square over a small cell is compared with the mean of a frame around it, beyond a guard; connected pixels above a ratio are
one find, and its score is the highest ratio in decibels. Shadows are not used, and nothing is learnt. Finn and Johnson, Adaptive detection
mode with threshold control as a function of spatially sampled clutter-level estimates, RCA Review 29 (1968) 414-464.
"""
import numpy as np
from scipy import ndimage

CELL, GUARD, FRAME = 3, 41, 81  # sides in pixels: of the mean, of what may belong to the thing, of the frame
LEAST_DB = 6.0  # of a find
JOINED = 2  # pixels between parts of one find


def find(picture) -> tuple:
    """(boxes: finds x 4, left, top, right, bottom; scores: decibels over the surroundings)."""
    power = picture.amplitude.astype(np.float64) ** 2
    over_db = ratio_db(power)
    hot = over_db >= LEAST_DB
    parts, _ = ndimage.label(ndimage.binary_dilation(hot, iterations=JOINED))
    parts[~hot] = 0
    boxes, scores = [], []
    for number, where in enumerate(ndimage.find_objects(parts), 1):
        if where is not None:
            rows, columns = where
            boxes.append([columns.start, rows.start, columns.stop, rows.stop])
            scores.append(over_db[where][parts[where] == number].max())
    return np.array(boxes, float).reshape(-1, 4), np.array(scores, float)


def ratio_db(power: np.ndarray, cell: int = CELL) -> np.ndarray:
    """Decibels of each pixel's cell over the mean of its frame; -inf where nothing was received there."""
    there = (power > 0).astype(np.float64)
    sums = {side: side * side * ndimage.uniform_filter(power, side, mode="constant") for side in (cell, GUARD, FRAME)}
    counts = {side: side * side * ndimage.uniform_filter(there, side, mode="constant") for side in (cell, GUARD, FRAME)}
    around = (sums[FRAME] - sums[GUARD]) / np.maximum(counts[FRAME] - counts[GUARD], 1)
    here = sums[cell] / np.maximum(counts[cell], 1)
    known = (counts[FRAME] - counts[GUARD] > 0.5 * FRAME) & (around > 1e-9 * power.max(initial=0)) & (there > 0)
    return np.where(known, 10 * np.log10(np.maximum(here, 1e-300) / np.where(known, around, 1)), -np.inf)
