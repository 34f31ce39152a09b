"""A trained detector: things in a picture of any size."""
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import torch

from net import Net, peaks, seen

LEAST_SIDE, LONGEST_SIDE = 128, 640  # of a picture as the network takes it


class Found(NamedTuple):
    """What is found in a picture, the surest first."""

    boxes: np.ndarray  # things x 4: left, top, right, bottom, by edges of pixels
    scores: np.ndarray  # things, 0..1: that something is there, by both looks
    kinds: np.ndarray  # things x classes: share of each class
    masks: list  # of each thing rows x columns, bool, within its box


@dataclass
class Detector:
    net: Net
    names: list  # of classes
    threshold: float  # of scores, fixed on generated pictures
    about: dict  # how it was made

    def save(self, file: Path) -> None:
        weights = {name: value.half() if value.is_floating_point() else value for name, value in self.net.state_dict().items()}
        torch.save({"weights": weights, "names": self.names, "threshold": self.threshold, "about": self.about}, file)

    @staticmethod
    def load(file: Path) -> "Detector":
        held = torch.load(file, map_location="cpu")
        net = Net(len(held["names"]))
        net.load_state_dict({name: value.float() if value.is_floating_point() else value for name, value in held["weights"].items()})
        return Detector(net.eval(), held["names"], held["threshold"], held["about"])

    def find(self, grey: np.ndarray, least_score: float = 0.02, most: int = 100) -> Found:
        """Things in a picture (rows x columns, uint8). Overlapping boxes are one thing, whatever their classes."""
        rows, columns = grey.shape
        scale = np.clip(max(rows, columns), LEAST_SIDE, LONGEST_SIDE) / max(rows, columns)
        size = tuple(max(32, int(round(side * scale / 32)) * 32) for side in (rows, columns))
        picture = torch.from_numpy(np.ascontiguousarray(grey)).float()[None, None] / 255
        small = torch.nn.functional.interpolate(picture, size=size, mode="bilinear", align_corners=False, antialias=True)[0]
        with torch.no_grad():
            there, edges, pixels, features = self.net(seen(small))
            first, boxes = peaks(there[0, 0], edges[0], 0.1 * least_score, 2 * most)
            kept = separate(boxes.numpy(), first.numpy(), 0.7)[:most]
            said, boxes = self.net.look(features, torch.nn.functional.pad(boxes[kept], (1, 0)))
        kinds = torch.softmax(said, 1).numpy()
        scores, kinds = np.sqrt(first[kept].numpy() * (1 - kinds[:, -1])), kinds[:, :-1] / kinds[:, :-1].sum(1, keepdims=True).clip(1e-9)
        kept = [i for i in separate(boxes.numpy(), scores) if scores[i] >= least_score]
        boxes, scores, kinds = boxes.numpy()[kept], scores[kept], kinds[kept]
        boxes = (boxes * np.array([columns / size[1], rows / size[0]] * 2)).clip(0, [columns, rows] * 2)
        share = torch.sigmoid(torch.nn.functional.interpolate(pixels, size=(rows, columns), mode="bilinear", align_corners=False))[0, 0]
        return Found(boxes, scores, kinds, [_within(share.numpy() > 0.5, box) for box in boxes])


def separate(boxes: np.ndarray, scores: np.ndarray, overlap: float = 0.45) -> list:
    """Places of boxes that no surer one overlaps."""
    kept: list = []
    for i in np.argsort(-scores, kind="stable"):
        if all(iou(boxes[i], boxes[j]) < overlap for j in kept):
            kept.append(i)
    return kept


def iou(one: np.ndarray, other: np.ndarray) -> float:
    wide, high = np.minimum(one[2:], other[2:]) - np.maximum(one[:2], other[:2])
    both = max(wide, 0.0) * max(high, 0.0)
    return both / max(area(one) + area(other) - both, 1e-9)


def area(box: np.ndarray) -> float:
    return max(box[2] - box[0], 0.0) * max(box[3] - box[1], 0.0)


def _within(pixels: np.ndarray, box: np.ndarray) -> np.ndarray:
    left, top, right, bottom = (int(round(edge)) for edge in box)
    mask = np.zeros_like(pixels)
    mask[top:bottom, left:right] = pixels[top:bottom, left:right]
    return mask
