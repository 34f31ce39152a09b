"""The card of a set: what is in it, as one HTML file."""
import base64
from html import escape

import numpy as np

from ensonify.labels import outlines
from ensonify.labels.formats import png
from ensonify.labels.pictures import Picture

EXAMPLES = 20
BINS = 20
STYLE = """body { font: 15px sans-serif; max-width: 60em; margin: 2em auto; }
table { border-collapse: collapse; } td, th { border: 1px solid #bbb; padding: 2px 8px; text-align: right; }
td:first-child, th:first-child { text-align: left; } figure { display: inline-block; margin: 6px; } figcaption { font-size: 12px; }
img, svg.over { height: 180px; image-rendering: pixelated; }"""
LIMITS = """<p>All pictures are simulated. Seabeds, objects and water are those that the recipe draws, and no others: a detector knows what
varies here. Objects are rigid and do not resonate; smooth ones send no echo by way of the surface. Labels are geometry: no pulse, no side
lobes. No public labelled sonar set was used, to make this one or to choose what is in it.</p>"""


class Card:
    """Takes a picture and its row of the manifest, one by one."""

    def __init__(self, recipe: dict):
        self.recipe = recipe
        self.counts: dict = {}  # (split, class, "" of pictures without any): number
        self.pictures: dict = {}  # by split
        self.not_seen: dict = {}  # by split, pictures made for an object that is not labelled in them
        self.values: dict = {}  # of each key, numbers
        self.words: dict = {}  # of each key, word: number
        self.examples: list = []  # (row, PNG, boxes, size): half of them with something in it

    def add(self, row: dict, picture: Picture) -> None:
        split = row["split"]
        self.pictures[split] = self.pictures.get(split, 0) + 1
        if row["kind"] and not row["shows"]:
            self.not_seen[split] = self.not_seen.get(split, 0) + 1
        for name in [thing["class"] for thing in row["objects"]] or [""]:
            self.counts[split, name] = self.counts.get((split, name), 0) + 1
        for key, value in [*row["drawn"].items(), ("range of the head, m", row["settings"]["range_m"])]:
            self._value(without_number(key), value)
        for thing in row["objects"]:
            for key, value in (("pixels of an object", thing["pixels"]), ("distance of an object, m", thing["range_m"]),
                               ("visible part", thing["visible"]), ("buried part", thing["buried"])):
                self._value(key, value)
        alike = sum(bool(other["objects"]) == bool(row["objects"]) for other, *_ in self.examples)
        if alike < EXAMPLES // 2:
            boxes = [outlines.box(thing.mask) for thing in picture.things]
            self.examples.append((row, png(picture.grey), [box for box in boxes if box], picture.grey.shape))

    def _value(self, key: str, value) -> None:
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            self.values.setdefault(key, []).append(float(value))
        else:
            words = self.words.setdefault(key, {})
            words[str(value)] = words.get(str(value), 0) + 1

    def html(self) -> str:
        parts = [f"<!DOCTYPE html><html lang=en><meta charset=utf-8><title>Data card</title><style>{STYLE}</style><h1>Data card</h1>",
                 "<h2>Pictures</h2>", self._counts(), "<h2>What varies</h2>", *self._ranges(), "<h2>Examples</h2>",
                 *map(example, self.examples), "<h2>Known limits</h2>", LIMITS, "<h2>Recipe</h2>", f"<pre>{escape(self.recipe['text'])}</pre></html>\n"]
        return "\n".join(parts)

    def _counts(self) -> str:
        splits = [name for name in ("train", "val", "test") if name in self.pictures]
        rows = [("pictures", [self.pictures[split] for split in splits])]
        rows.append(("without an object", [self.counts.get((split, ""), 0) for split in splits]))
        rows.append(("whose object is too small or hidden", [self.not_seen.get(split, 0) for split in splits]))
        rows += [(f"objects: {name}", [self.counts.get((split, name), 0) for split in splits]) for name in self.recipe["classes"]]
        body = "".join(f"<tr><td>{escape(what)}</td>{''.join(f'<td>{number}</td>' for number in [*numbers, sum(numbers)])}</tr>"
                       for what, numbers in rows)
        return f"<table><tr><th></th>{''.join(f'<th>{split}</th>' for split in splits)}<th>all</th></tr>{body}</table>"

    def _ranges(self) -> list:
        return [histogram(key, numbers) for key, numbers in sorted(self.values.items())] + [
            f"<p>{escape(key)}: {', '.join(f'{escape(word)} ({number})' for word, number in sorted(words.items()))}</p>"
            for key, words in sorted(self.words.items())]


def without_number(key: str) -> str:
    """A thing's key is of its kind: mine_3_1.sphere.diameter_m is mine.sphere.diameter_m."""
    name, dot, rest = key.partition(".")
    parts = name.rsplit("_", 2)
    return parts[0] + dot + rest if len(parts) == 3 and parts[1].isdigit() and parts[2].isdigit() else key


def histogram(title: str, numbers: list) -> str:
    least, most = min(numbers), max(numbers)
    counts, _ = np.histogram(numbers, BINS, (least, most if most > least else least + 1))
    bars = "".join(f'<rect x="{10 * i}" y="{60 - 60 * count / counts.max():.1f}" width="9" height="{60 * count / counts.max():.1f}"/>'
                   for i, count in enumerate(counts))
    return (f"<figure><svg width={10 * BINS} height=60 fill='#479'>{bars}</svg><figcaption>{escape(title)}<br>"
            f"{least:.4g} to {most:.4g}, mean {np.mean(numbers):.4g}</figcaption></figure>")


def example(of: tuple) -> str:
    row, picture, boxes, (height, width) = of
    drawn = "".join(f'<rect x="{x}" y="{y}" width="{wide}" height="{high}" fill="none" stroke="orange" vector-effect="non-scaling-stroke"/>'
                    for x, y, wide, high in boxes)
    names = ", ".join(thing["class"] for thing in row["objects"]) or "empty"
    return (f'<figure><svg class="over" viewBox="0 0 {width} {height}"><image width="{width}" height="{height}" '
            f'href="data:image/png;base64,{base64.b64encode(picture).decode()}"/>{drawn}</svg>'
            f"<figcaption>{row['name']}: {escape(names)}</figcaption></figure>")
