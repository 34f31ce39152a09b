"""Cut-outs of generated things, as a display shows them: what folders with a class for each picture are compared with.

A cut-out goes round a thing's mask with a margin. Its display is drawn each time, so that one thing gives many pictures.
"""
import csv
from pathlib import Path

import numpy as np
from PIL import Image

import generated

MARGIN = (1.0, 1.7)  # sides of a cut-out over those of its thing
LEAST_SIDE, LONGEST_SIDE = 32, 256  # pixels of a cut-out
PIXELS = (0.7, 2.5)  # of a cut-out to a sample


class CutOuts:
    """Cut-outs of all things of generated pictures that can be seen, by class."""

    def __init__(self, masters: list):
        self.held: dict = {}  # amplitude and owners by name
        self.of_class: dict = {}  # (master, instance) of each thing
        for master in masters:
            amplitude, owner = master.read()
            for thing in master.facts["objects"]:
                mask = owner == thing["instance"]
                if mask.sum() >= generated.LEAST_PIXELS and generated.stands_out(amplitude, mask):
                    self.of_class.setdefault(thing["class"], []).append((master, thing["instance"]))
                    self.held[master.name, master.folder] = (amplitude.astype(np.uint16), owner.astype(np.int16))

    def limited(self, count: int) -> "CutOuts":
        """The first things alone, as many of each class as of another: `count` in all, or what there is."""
        few = CutOuts([])
        few.held = self.held
        few.of_class = {name: things[:-(-count // len(self.of_class))] for name, things in self.of_class.items()}
        return few

    def count(self) -> int:
        return sum(len(things) for things in self.of_class.values())

    def draw(self, name: str, random: np.random.Generator) -> np.ndarray:
        """A cut-out of some thing of a class: rows x columns, uint8."""
        things = self.of_class[name]
        return self.cut(*things[int(random.integers(len(things)))], random)

    def cut(self, master: generated.Master, instance: int, random: np.random.Generator) -> np.ndarray:
        amplitude, owner = self.held[master.name, master.folder]
        form = generated.form_of(master.facts, owner.shape, random)
        y, x = form.from_master(*np.nonzero(owner == instance))
        high, wide = (max(np.ptp(of), 4.0) * random.uniform(*MARGIN) for of in (y, x))
        fine = np.clip(random.uniform(*PIXELS), LEAST_SIDE / min(high, wide), max(LONGEST_SIDE / max(high, wide), LEAST_SIDE / min(high, wide)))
        middle = (y.min() + np.ptp(y) / 2, x.min() + np.ptp(x) / 2)
        rows, columns = np.meshgrid(*(at + (np.arange(round(side * fine)) + 0.5) / fine - side / 2 for at, side in zip(middle, (high, wide))), indexing="ij")
        where = form.to_master(rows, columns)
        if random.random() < 0.5:  # displays that show the nearest sample
            where = np.floor(where) + 0.5
        part, where = around(where, owner.shape)
        shown, _ = generated.sampled(amplitude[part].astype(np.float32), owner[part], where)
        return np.rint(255 * generated.displayed(shown, random)).astype(np.uint8)


def around(where: np.ndarray, shape: tuple) -> tuple:
    """(part of a picture that places lie in, with a few samples round it; the places in that part)."""
    first = [int(np.clip(where[..., axis].min() - 8, 0, shape[axis] - 1)) for axis in (0, 1)]
    last = [int(np.clip(where[..., axis].max() + 9, first[axis] + 1, shape[axis])) for axis in (0, 1)]
    return np.s_[first[0]:last[0], first[1]:last[1]], where - np.array(first)


def write(cut_outs: CutOuts, folder: Path, seed: int) -> int:
    """One cut-out of each thing in a folder of its class, and groups.csv: things of one scene are one group. Gives their number."""
    rows = []
    for name, things in sorted(cut_outs.of_class.items()):
        (folder / name).mkdir(parents=True, exist_ok=True)
        for number, (master, instance) in enumerate(things):
            file = folder / name / f"{name}_{number:04d}.png"
            Image.fromarray(cut_outs.cut(master, instance, np.random.default_rng([seed, len(rows)]))).save(file)
            rows.append([file.name, f"{master.folder.parent.parent.name}_{master.name}"])
    with open(folder / "groups.csv", "w", newline="") as file:
        csv.writer(file).writerows([["file", "group"], *rows])
    return len(rows)
