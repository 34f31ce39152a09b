"""Training pictures out of generated ones: each time another part, size, turn, display of what `ensonify dataset` made.

Only generated pictures are read here. What is random follows from a numpy generator, so that a training can be repeated.
"""
import json
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
import torch
from PIL import Image

LEAST_PIXELS = 20  # of a thing in a training picture; fewer are neither wanted nor forbidden
CUT_OUTS = 0.2  # share of pictures that a thing fills
WITHIN = 0.8  # share of a sidescan's pictures that show no more than its waterfall
LEAST_CONTRAST_DB = 3.0  # of a thing's mean level in decibels to that around it, either way; less cannot be seen
GLINT_DB = 10.0  # of its mean square, where a few points of it shine
FINEST = 3.0  # pixels of a training picture to a sample: nobody enlarges more


class Example(NamedTuple):
    """A training picture."""

    grey: np.ndarray  # rows x columns, float32, 0..1
    boxes: np.ndarray  # things x 4
    kinds: np.ndarray  # things, places in the list of classes
    owner: np.ndarray  # rows x columns, int16: place of the thing, from 1; 0 none; -1 one that does not count


@dataclass
class Master:
    """A generated picture as it was received: amplitude behind the gain, and which thing each sample belongs to."""

    folder: Path
    name: str
    facts: dict

    def read(self) -> tuple:
        amplitude = np.array(Image.open(self.folder / "amplitude" / f"{self.name}.png"), np.float32)
        return amplitude, np.array(Image.open(self.folder / "masks" / f"{self.name}.png"), np.int32)


def masters(folders: list, split: str) -> list:
    """Pictures of a split of several sets, all facts read."""
    found = []
    for folder in folders:
        for file in sorted((Path(folder) / "set" / split / "facts").glob("*.json")):
            found.append(Master(file.parent.parent, file.stem, json.loads(file.read_text())))
    return found


class Examples:
    """Draws examples of `size` x `size` pixels from masters."""

    def __init__(self, of: list, names: list, size: int, random: np.random.Generator):
        self.masters, self.names, self.size, self.random = of, names, size, random
        self.held: dict = {}  # amplitude and owners by place
        self.last = ""  # name of the master drawn last

    def draw(self) -> Example:
        place = int(self.random.integers(len(self.masters)))
        master = self.masters[place]
        self.last = f"{master.folder.parent.parent.name}_{master.name}"
        if place not in self.held:
            amplitude, owner = master.read()
            self.held[place] = (amplitude.astype(np.uint16), owner.astype(np.int16))
        amplitude, owner = self.held[place]
        where = self._where(master, amplitude, owner)
        amplitude, owner = sampled(amplitude, owner, where)
        if self.random.random() < 0.5:
            amplitude, owner = amplitude[:, ::-1], owner[:, ::-1]
        turns = self._quarter_turns(master)
        amplitude, owner = np.rot90(amplitude, turns), np.rot90(owner, turns)
        return self._labelled(master, np.ascontiguousarray(amplitude), np.ascontiguousarray(owner))

    def _quarter_turns(self, master: Master) -> int:
        """An imaging head is mostly at the bottom of its picture, else on top; waterfalls run any way."""
        sidescan = master.facts["kind"] == "sidescan"
        return int(self.random.choice([0, 1, 2, 3])) if sidescan else int(self.random.choice([0, 2], p=[0.8, 0.2]))

    def _where(self, master: Master, amplitude: np.ndarray, owner: np.ndarray) -> np.ndarray:
        """Row and column of the master (size x size x 2) that each pixel shows; beyond it -1."""
        form = form_of(master.facts, owner.shape, self.random)
        if owner.any() and self.random.random() < CUT_OUTS:
            middle, side = self._cut_out(form, owner)
        else:
            of = min(form.extent) if master.facts["kind"] == "sidescan" and self.random.random() < WITHIN else max(form.extent)
            side = max(float(np.exp(self.random.uniform(np.log(0.22), np.log(1.15)))) * of, self.size / FINEST)
            middle = self._middle(form, amplitude, owner, side)
            if side < of <= min(form.extent):
                middle = tuple(float(np.clip(at, 0.5 * side, extent - 0.5 * side)) for at, extent in zip(middle, form.extent))
        turn = self.random.normal(0, 0.08)
        grid = (np.arange(self.size) + 0.5) / self.size - 0.5
        y, x = np.meshgrid(grid * side, grid * side * np.exp(self.random.normal(0, 0.1)), indexing="ij")
        return form.to_master(middle[0] + x * np.sin(turn) + y * np.cos(turn), middle[1] + x * np.cos(turn) - y * np.sin(turn))

    def _cut_out(self, form, owner: np.ndarray) -> tuple:
        """Middle and side of a part that a thing fills, in the picture's own unit."""
        rows, columns = np.nonzero(owner == self.random.choice(np.unique(owner[owner > 0])))
        y, x = form.from_master(rows, columns)
        side = max(max(np.ptp(y), np.ptp(x), 8.0) * self.random.uniform(1.1, 2.2), self.size / FINEST)
        return (y.min() + np.ptp(y) / 2 + self.random.normal(0, 0.05) * side, x.min() + np.ptp(x) / 2 + self.random.normal(0, 0.05) * side), side

    def _middle(self, form, amplitude: np.ndarray, owner: np.ndarray, side: float) -> tuple:
        """Of a part: mostly such that a thing is in it, else the strongest of three points."""
        things = np.unique(owner[owner > 0])
        if things.size and self.random.random() < 0.75:
            rows, columns = np.nonzero(owner == self.random.choice(things))
            y, x = form.from_master(rows.mean(), columns.mean())
            return y + self.random.uniform(-0.35, 0.35) * side, x + self.random.uniform(-0.35, 0.35) * side
        rows, columns = (self.random.integers(count, size=3) for count in amplitude.shape)
        best = int(amplitude[rows, columns].argmax())
        return form.from_master(rows[best], columns[best])

    def _labelled(self, master: Master, amplitude: np.ndarray, owner: np.ndarray) -> Example:
        boxes, kinds, of_place = [], [], np.zeros(owner.shape, np.int16)
        for thing in master.facts["objects"]:
            mask = owner == thing["instance"]
            pixels = int(mask.sum())
            if pixels == 0:
                continue
            if pixels < LEAST_PIXELS or not stands_out(amplitude, mask):
                of_place[mask] = -1
                continue
            rows, columns = np.nonzero(mask)
            boxes.append([columns.min(), rows.min(), columns.max() + 1, rows.max() + 1])
            kinds.append(self.names.index(thing["class"]))
            of_place[mask] = len(boxes)
        return Example(displayed(amplitude, self.random), np.array(boxes, np.float32).reshape(-1, 4), np.array(kinds, np.int64), of_place)


def stands_out(amplitude: np.ndarray, mask: np.ndarray) -> bool:
    """Whether the mean level within, or its mean square, differs from that of the box around it, twice as wide."""
    rows, columns = np.nonzero(mask)
    margin = max(4, (np.ptp(rows) + np.ptp(columns)) // 4)
    around = np.s_[max(rows.min() - margin, 0):rows.max() + margin + 1, max(columns.min() - margin, 0):columns.max() + margin + 1]
    inside = mask[around]
    power = amplitude[around].astype(np.float64) ** 2 + 1
    if inside.all():
        return True
    level_db = 10 * np.log10(power)
    return bool(abs(level_db[inside].mean() - level_db[~inside].mean()) >= LEAST_CONTRAST_DB or
                10 * np.log10(power[inside].mean() / power[~inside].mean()) >= GLINT_DB)


class Flat:
    """A picture as it is stored: sample by beam, or lines of a waterfall; a pixel's height over its width is `stretch`."""

    def __init__(self, shape: tuple, stretch: float):
        self.shape, self.stretch = shape, stretch
        self.extent = (shape[0] * stretch, float(shape[1]))

    def to_master(self, y, x):
        return np.stack([y / self.stretch, x], -1)

    def from_master(self, row, column):
        return row * self.stretch, column


class Fan:
    """A ping of an imaging head as on a chart, the head at the bottom. Unit: samples."""

    def __init__(self, shape: tuple, from_rad: float, to_rad: float):
        self.shape, self.from_rad, self.to_rad = shape, from_rad, to_rad
        widest = min(max(abs(from_rad), abs(to_rad)), np.pi / 2)
        self.extent = (float(shape[0]), 2 * shape[0] * float(np.sin(widest)))

    def to_master(self, y, x):
        ahead, aside = self.extent[0] - y, x - 0.5 * self.extent[1]
        angle = np.arctan2(aside, ahead)
        column = (angle - self.from_rad) / (self.to_rad - self.from_rad) * self.shape[1]
        return np.stack([self.shape[0] - np.hypot(ahead, aside), column], -1)

    def from_master(self, row, column):
        range_, angle = self.shape[0] - row, self.from_rad + (self.to_rad - self.from_rad) * column / self.shape[1]
        return self.extent[0] - range_ * np.cos(angle), 0.5 * self.extent[1] + range_ * np.sin(angle)


def form_of(facts: dict, shape: tuple, random: np.random.Generator):
    if facts["kind"] == "sidescan":
        across_m = 0.5 * facts["sound_speed_mps"] * facts["sample_period_s"]
        return Flat(shape, facts["line_spacing_m"] / across_m * np.exp(random.normal(0, 0.35)))
    if random.random() < 0.7:
        return Fan(shape, facts["beam_from_rad"], facts["beam_to_rad"])
    return Flat(shape, shape[1] / shape[0] * np.exp(random.normal(0.2, 0.35)))


def sampled(amplitude: np.ndarray, owner: np.ndarray, where: np.ndarray) -> tuple:
    """Amplitude (between samples) and owner (the nearest sample's) at rows and columns; 0 beyond the picture. Where pixels are larger
    than samples, the mean square of what they cover is taken, as displays of small windows do."""
    step = np.abs(np.diff(where[..., 0], axis=0)).mean(), np.abs(np.diff(where[..., 1], axis=1)).mean()
    halves = [max(1, int(round(one))) for one in step]
    power = torch.from_numpy(amplitude.astype(np.float32) ** 2)[None, None]
    if max(halves) > 1:
        power = torch.nn.functional.avg_pool2d(power, halves, 1, [half // 2 for half in halves], count_include_pad=False)
    size = torch.tensor(amplitude.shape, dtype=torch.float32)
    grid = (2 * torch.from_numpy(where.astype(np.float32)) / size - 1).flip(-1)[None]
    read = torch.nn.functional.grid_sample(power[..., :amplitude.shape[0], :amplitude.shape[1]], grid, "bilinear", "zeros", False)[0, 0]
    rows, columns = np.floor(where[..., 0]).astype(int), np.floor(where[..., 1]).astype(int)
    inside = (rows >= 0) & (rows < owner.shape[0]) & (columns >= 0) & (columns < owner.shape[1])
    of = np.where(inside, owner[rows.clip(0, owner.shape[0] - 1), columns.clip(0, owner.shape[1] - 1)], 0)
    return np.where(inside, np.sqrt(read.clamp(min=0).numpy()), 0.0), of


def displayed(amplitude: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """Grey levels 0..1 as some display shows them: decibels or a power law, gain by the picture's own levels, errors of the gain with
    range, quantised; sometimes smoothed, with a frame or marks. Where nothing was received it is black."""
    rows, columns = amplitude.shape
    lit = amplitude > 0
    if not lit.any():
        return np.zeros(amplitude.shape, np.float32)
    slope_db = random.normal(0, 3, 2)
    y, x = np.linspace(-1, 1, rows)[:, None], np.linspace(-1, 1, columns)[None]
    uneven = amplitude * 10 ** ((slope_db[0] * y + slope_db[1] * x) / 20)
    white = np.percentile(uneven[lit], random.uniform(97.0, 99.9)) + 1e-6
    if random.random() < 0.5:
        range_db = random.uniform(22, 50)
        grey = 1 + 20 * np.log10(np.maximum(uneven / white, 1e-6)) / range_db
    else:
        grey = (uneven / white) ** random.uniform(0.4, 1.1)
    grey = torch.from_numpy((grey * lit).astype(np.float32))[None, None]
    if random.random() < 0.25:  # of a picture of fewer pixels
        few = [max(16, int(side / random.uniform(1.5, 5))) for side in amplitude.shape]
        grey = torch.nn.functional.interpolate(grey, size=few, mode="area")
        grey = torch.nn.functional.interpolate(grey, size=amplitude.shape, mode="bilinear", align_corners=False)
    elif random.random() < 0.35:
        grey = torch.nn.functional.avg_pool2d(grey, 3, 1, 1, count_include_pad=False)
    grey = grey[0, 0].numpy().clip(0, 1) * random.uniform(0.7, 1.0) + random.choice([0.0, random.uniform(0, 0.15)])
    grey = grey + random.normal(0, random.uniform(0, 0.03), grey.shape)
    levels = random.choice([16, 64, 255])
    grey = np.rint(grey.clip(0, 1) * levels) / levels
    return _marked(grey, random).astype(np.float32)


def _marked(grey: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """Sometimes lines of range or of a grid, and a margin."""
    size = grey.shape[0]
    if random.random() < 0.12:
        step, level = int(random.integers(size // 6, size // 2)), random.uniform(0.4, 1.0)
        first = int(random.integers(step))
        if random.random() < 0.5:
            grey[first::step] = level
        else:
            grey[:, first::step] = level
    if random.random() < 0.1:
        width, level = int(random.integers(2, size // 10)), random.choice([0.0, 1.0])
        side = int(random.integers(4))
        grey[(np.s_[:width], np.s_[-width:], np.s_[:, :width], np.s_[:, -width:])[side]] = level
    return grey
