"""Groups of pictures that show nearly the same, so that an interval does not count them twice."""
import numpy as np
from PIL import Image

LIKE = 0.9  # normalised cross-correlation of thumbnails from which on two pictures are of one group
SIDE = 24


def groups_of(pictures: list) -> np.ndarray:
    """A number for each picture: by the groups that are known, else by what the pictures look like."""
    named = [picture.group for picture in pictures]
    if all(named):
        return np.unique(named, return_inverse=True)[1]
    thumbnails = np.stack([_thumbnail(picture.grey()) for picture in pictures])
    group = np.arange(len(pictures))
    for first in range(0, len(pictures), 1024):  # a stripe of the table at a time
        alike = thumbnails[first:first + 1024] @ thumbnails.T > LIKE
        for i, row in enumerate(alike, first):
            others = np.flatnonzero(row[:i])
            if others.size:
                joined = np.unique(np.concatenate([group[others], [group[i]]]))
                group[np.isin(group, joined)] = joined[0]
    return np.unique(group, return_inverse=True)[1]


def _thumbnail(grey: np.ndarray) -> np.ndarray:
    small = np.array(Image.fromarray(grey).resize((SIDE, SIDE), Image.BOX), np.float64).ravel()
    small -= small.mean()
    return small / max(np.linalg.norm(small), 1e-9)
