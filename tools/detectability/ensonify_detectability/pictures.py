"""Pictures of a set that `ensonify dataset` made, as a detector gets them, and what is known of the things in them."""
import json
import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from PIL import Image

DEGREES = ("grazing", "aspect")  # angles of the labels, in radians there


class Unreadable(Exception):
    """A set, detector or question with which nothing can be done."""


@dataclass
class Thing:
    """A labelled thing: name, edges (left, top, right, bottom in pixels) and what is known of it by name."""

    name: str
    box: np.ndarray
    known: dict


class Picture:
    """What a detector gets.

    amplitude: rows x columns, float32, uPa behind the head's gain. grey: rows x columns, uint8, as a display shows it. settings: of
    head and ping, as `settings` in the manifest. name, split."""

    def __init__(self, folder: Path, row: dict):
        self.name, self.split, self.number, self.scene, self.seed = row["name"], row["split"], row["picture"], row["scene"], row["seed"]
        self.settings, self._row, self._folder = row["settings"], row, folder / row["split"]

    @cached_property
    def counts(self) -> np.ndarray:
        return self._read("amplitude").astype(np.float32)

    @property
    def amplitude(self) -> np.ndarray:
        return self.counts * np.float32(self.settings["scale_upa"])

    @property
    def grey(self) -> np.ndarray:
        return self._read("images")

    def _read(self, kind: str) -> np.ndarray:
        file = self._folder / kind / f"{self.name}.png"
        try:
            return np.array(Image.open(file))
        except (OSError, ValueError) as error:
            raise Unreadable(f"{file}: {error}; allowed is what `ensonify dataset` wrote") from None

    def km2(self) -> float:
        """Area that the picture shows, by slant range: of a fan its sector, of a waterfall its length times its width."""
        rows, columns = self.counts.shape
        of = self.settings
        if of["kind"] == "sidescan":
            return 1e-6 * rows * of["line_spacing_m"] * columns * self.sample_m
        return 1e-6 * 0.5 * of["range_m"] ** 2 * (of["beam_to_rad"] - of["beam_from_rad"])

    @property
    def sample_m(self) -> float:
        return 0.5 * self.settings["sound_speed_mps"] * self.settings["sample_period_s"]

    def things(self) -> list:
        """All labelled things of which the picture shows something."""
        return [self._thing(of) for of in self._row["objects"] if of["box"] is not None]

    def _thing(self, of: dict) -> Thing:
        x, y, wide, high = of["box"]
        known = {key: value for key, value in of.items() if isinstance(value, (int, float, bool, str)) and key not in ("name", "instance")}
        for angle in DEGREES:
            known[f"{angle}_deg"] = math.degrees(known.pop(f"{angle}_rad"))
        edges = np.array([x, y, x + wide, y + high], float)
        known |= {"split": self.split, "size_m": self._size_m(of), "contrast_db": contrast_db(self.counts, edges),
                  "frequency_khz": self.settings["frequency_hz"] / 1000}
        for key, value in self._row["drawn"].items():
            known[key.removeprefix(f"{of['name']}.").removeprefix("draw.").removeprefix("args.")] = value
        return Thing(of["name"], edges, known)

    def _size_m(self, of: dict) -> float:
        """The longer side of its box; of a fan as a chart that in samples."""
        _, _, wide, high = of["box"]
        settings = self.settings
        if settings["kind"] == "sidescan":
            return max(wide * self.sample_m, high * settings["line_spacing_m"])
        if settings["view"] == "cartesian":
            return max(wide, high) * settings["range_m"] / self.counts.shape[0]
        beam_rad = (settings["beam_to_rad"] - settings["beam_from_rad"]) / max(self.counts.shape[1] - 1, 1)
        return max(high * self.sample_m, wide * beam_rad * of["range_m"])


def contrast_db(amplitude: np.ndarray, box: np.ndarray) -> float:
    """Mean square within a box over that of the frame around it, twice as wide."""
    left, top, right, bottom = (int(edge) for edge in box)
    aside, along = max((right - left) // 2, 2), max((bottom - top) // 2, 2)
    power = amplitude.astype(np.float64) ** 2 + 1
    outer = power[max(top - along, 0):bottom + along, max(left - aside, 0):right + aside]
    inner = power[top:bottom, left:right]
    around = (outer.sum() - inner.sum()) / max(outer.size - inner.size, 1)
    return float(10 * np.log10(inner.mean() / max(around, 1)))


def read(folder: Path) -> list:
    """All pictures of a set, without those of its pairs."""
    file = folder / "manifest.jsonl"
    if not file.is_file():
        raise Unreadable(f"{file}: is not there; allowed is a folder that `ensonify dataset` made, or a recipe with -o")
    try:
        rows = [json.loads(line) for line in file.read_text().splitlines()]
        found = [Picture(folder, row) for row in rows if not row["pair"]]
    except (ValueError, KeyError, TypeError) as error:
        raise Unreadable(f"{file}: {type(error).__name__}: {error}; allowed is what `ensonify dataset` wrote") from None
    if found and not (folder / found[0].split / "amplitude").is_dir():
        raise Unreadable(f"{folder}: has no amplitudes; allowed are the recipe's formats coco, yolo, voc and masks")
    return found
