"""The trained detector as `ensonify detectability` calls one:

    DETECTOR=out/detector ensonify detectability RECIPE -o out/limits --split test --detector examples/train_detector/finds.py:find
"""
import functools
import os
from pathlib import Path

import torch

from detector import Detector


@functools.cache
def trained() -> Detector:
    torch.set_num_threads(int(os.environ.get("JOBS", "2")))
    return Detector.load(Path(os.environ["DETECTOR"]) / "detector.pt")


def find(picture) -> tuple:
    """(boxes: things x 4, scores 0..1) of a picture of a set."""
    found = trained().find(picture.grey)
    return found.boxes, found.scores
