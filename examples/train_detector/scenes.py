"""Generated scenes: made by `ensonify dataset`, shown as a detector is tested on them."""
import shutil
import subprocess
from pathlib import Path

import numpy as np

import generated
from labelled import Labelled, Thing

HERE = Path(__file__).resolve().parent
RECIPES = {"imaging": ("imaging_lens", "imaging_wide", "imaging_far"), "sidescan": ("sidescan_small", "sidescan_large")}


class Failed(Exception):
    """A command that did not do what it should."""


def make(kind: str, pictures: int, folder: Path, jobs: int, say=print) -> list:
    """Sets of all recipes of a kind, together so many pictures; made already, they stay. Gives their folders."""
    sets = []
    for name in RECIPES[kind]:
        sets.append(folder / name)
        count = -(-pictures // len(RECIPES[kind]))
        say(f"{name}: {count} pictures")
        generate(HERE / "recipes" / f"{name}.yaml", count, sets[-1], jobs)
    return sets


def generate(recipe: Path, pictures: int, folder: Path, jobs: int) -> None:
    """A set of `ensonify dataset`; made already, it stays."""
    program = shutil.which("ensonify")
    if program is None:
        raise Failed("ensonify is not on PATH; allowed is build/*/bin of a build, or an installed one")
    command = [program, "dataset", str(recipe), "-n", str(pictures), "-o", str(folder), "--jobs", str(jobs)]
    if subprocess.run(command).returncode != 0:
        raise Failed(f"{' '.join(command)}: did not end well")


def classes(sets: list) -> list:
    """Names of all that is labelled in them."""
    return sorted({thing["class"] for split in ("train", "val", "test") for master in generated.masters(sets, split)
                   for thing in master.facts["objects"]})


class Shown(Labelled):
    """A part of a generated picture as somebody's display shows it."""

    def __init__(self, example: generated.Example, names: list, name: str, group: str):
        things = [Thing(names[kind], box.astype(float)) for box, kind in zip(example.boxes, example.kinds)]
        for place, thing in enumerate(things, 1):
            thing.mask = lambda shape, place=place: example.owner == place
        rows, columns = np.nonzero(example.owner < 0)
        if rows.size:
            things.append(Thing("", np.array([columns.min(), rows.min(), columns.max() + 1, rows.max() + 1], float), ignored=True))
        super().__init__(Path(name), things, group)
        self.picture = np.rint(255 * example.grey).astype(np.uint8)

    def grey(self) -> np.ndarray:
        return self.picture


def shown(sets: list, split: str, names: list, count: int, seed: int = 7) -> list:
    """So many pictures of a split, drawn as in training but with numbers of their own; a group is a scene."""
    masters = generated.masters(sets, split)
    if not masters:
        raise Failed(f"{', '.join(str(folder) for folder in sets)}: no pictures of {split}; allowed is a set of more pictures")
    drawn = []
    for i in range(count):
        one = generated.Examples(masters, names, 256, np.random.default_rng([seed, i]))
        example = one.draw()
        drawn.append(Shown(example, names, f"{split}_{i:04d}", one.last))
    return drawn
