"""Training pictures out of labelled ones of somebody's, for the yardsticks of `worth`: no net that is trained on them is shipped."""
import numpy as np
from PIL import Image

from generated import Example

LEAST_SHARE = 0.4  # of a thing's box in the part that is shown; less neither counts nor is forbidden


class Taken:
    """Draws examples from labelled pictures: a part, mirrored or not, with another gain and curve. `size` and `random` are set from outside."""

    def __init__(self, pictures: list, names: list):
        self.pictures, self.names, self.size, self.random = pictures, names, 256, np.random.default_rng(1)
        self.held: dict = {}

    def draw(self) -> Example:
        place = int(self.random.integers(len(self.pictures)))
        if place not in self.held:
            self.held[place] = self.pictures[place].grey()
        grey, things = self.held[place], self.pictures[place].things
        rows, columns = grey.shape
        side = max(rows, columns) * self.random.uniform(0.5, 1.1) if things else max(rows, columns) * self.random.uniform(0.9, 1.1)
        middle = np.array([columns, rows]) / 2
        if things:
            box = things[int(self.random.integers(len(things)))].box
            middle = (box[:2] + box[2:]) / 2 + self.random.uniform(-0.3, 0.3, 2) * side
            middle = np.clip(middle, np.minimum(side / 2, middle.clip(0)), np.maximum(np.array([columns, rows]) - side / 2, 0.5 * np.array([columns, rows])))
        corner = middle - side / 2
        shown = Image.fromarray(grey).transform((self.size, self.size), Image.AFFINE, (side / self.size, 0, corner[0], 0, side / self.size, corner[1]),
                                                Image.BILINEAR if side < 2 * self.size else Image.BICUBIC)
        level = np.asarray(shown, np.float32) / 255
        boxes, kinds, owner = [], [], np.zeros((self.size, self.size), np.int16)
        for thing in things:
            edges = (thing.box - np.tile(corner, 2)) * self.size / side
            inside = edges.clip(0, self.size)
            share = np.prod(inside[2:] - inside[:2]) / max(np.prod(edges[2:] - edges[:2]), 1e-9)
            part = np.s_[int(inside[1]):int(np.ceil(inside[3])), int(inside[0]):int(np.ceil(inside[2]))]
            if share <= 0:
                continue
            if thing.ignored or share < LEAST_SHARE or thing.name not in self.names:
                owner[part] = -1
                continue
            boxes.append(inside)
            kinds.append(self.names.index(thing.name))
            owner[part] = len(boxes)
        boxes = np.array(boxes, np.float32).reshape(-1, 4)
        if self.random.random() < 0.5:
            level, owner = level[:, ::-1], owner[:, ::-1]
            boxes[:, [0, 2]] = self.size - boxes[:, [2, 0]]
        level = (level ** self.random.uniform(0.7, 1.4) * self.random.uniform(0.7, 1.2)).clip(0, 1)
        return Example(np.ascontiguousarray(level), boxes, np.array(kinds, np.int64), np.ascontiguousarray(owner))


class Both:
    """Draws from one or the other, alike."""

    def __init__(self, one, other):
        self.one, self.other, self.size, self.random = one, other, 256, np.random.default_rng(1)

    def draw(self) -> Example:
        of = self.one if self.random.random() < 0.5 else self.other
        of.size, of.random = self.size, self.random
        return of.draw()

