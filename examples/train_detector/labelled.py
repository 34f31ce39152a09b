"""Labelled pictures to test on, in the forms that people have: COCO, YOLO, Pascal VOC, pairs of picture and mask, a folder for each class."""
import csv
import json
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

KINDS = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".gif", ".webp")


class Unreadable(Exception):
    """A folder or file that is not what it should be: place, cause, what is allowed."""


@dataclass
class Thing:
    """What a label says. box: left, top, right, bottom, by edges of pixels; None: somewhere in the picture."""

    name: str
    box: np.ndarray | None
    polygons: list = field(default_factory=list)  # of numbers x, y, x, y, ...
    mask_of: tuple | None = None  # (file, value) of a mask, or run lengths (counts, rows, columns)
    ignored: bool = False  # neither wanted nor forbidden

    def mask(self, shape: tuple) -> np.ndarray | None:
        """Its pixels (rows x columns), where the label has them."""
        if self.polygons:
            drawn = Image.new("1", (shape[1], shape[0]))
            for polygon in self.polygons:
                ImageDraw.Draw(drawn).polygon([float(x) for x in polygon], fill=1)
            return np.array(drawn)
        if self.mask_of is None:
            return None
        of, value = self.mask_of
        if isinstance(of, Path):
            parts = components(np.array(Image.open(of)), value[0])
            return parts == value[1]
        return run_lengths(of, value)


@dataclass
class Labelled:
    """A picture and what is in it."""

    file: Path
    things: list
    group: str = ""  # pictures of one group show the same; "": not known

    def grey(self) -> np.ndarray:
        """Rows x columns, uint8: of colours their luminance, so that most maps of colours rise with the level. Of 16 bits the
        decibels of the highest 50."""
        try:
            with Image.open(self.file) as picture:
                if picture.mode.startswith(("I", "F")):
                    level = np.array(picture, np.float64)
                    level = 20 * np.log10(np.maximum(level, 1e-3) / max(float(level.max()), 1e-3))
                    return (255 * np.clip(1 + level / 50, 0, 1)).astype(np.uint8)
                return np.array(picture.convert("L"))
        except (OSError, ValueError, Image.DecompressionBombError) as error:
            raise Unreadable(f"{self.file}: {error}; allowed is a picture of one of {', '.join(KINDS)}") from None


def read(folder: Path) -> list:
    """All labelled pictures of a folder: the first form of which it has something. Raises Unreadable."""
    folder = Path(folder)
    if not folder.is_dir():
        raise Unreadable(f"{folder}: is no folder")
    try:
        for form in (_coco, _yolo, _voc, _masks, _classes):
            pictures = form(folder)
            if pictures:
                return _grouped(folder, pictures)
    except (OSError, ValueError, KeyError, IndexError, TypeError, AttributeError, ElementTree.ParseError) as error:
        raise Unreadable(f"{folder}: {type(error).__name__}: {error}") from None
    raise Unreadable(f"{folder}: has no labelled pictures; allowed are COCO (a .json with images, annotations and categories), YOLO (labels/*.txt), "
                     "Pascal VOC (.xml), a folder `masks` beside `images`, and a folder for each class")


def _coco(folder: Path) -> list:
    pictures = []
    for file in sorted(folder.rglob("*.json")):
        whole = json.loads(file.read_text())
        if not isinstance(whole, dict) or not {"images", "annotations", "categories"} <= whole.keys():
            continue
        names = {category["id"]: str(category["name"]) for category in whole["categories"]}
        of_picture: dict = {}
        for annotation in whole["annotations"]:
            of_picture.setdefault(annotation["image_id"], []).append(annotation)
        places = _pictures_by_name(folder)
        for image in whole["images"]:
            found = next((at for at in (file.parent / image["file_name"], folder / image["file_name"]) if at.is_file()),
                         places.get(Path(image["file_name"]).name))
            if found is None:
                raise Unreadable(f"{file}: {image['file_name']}: there is no such picture under {folder}")
            things = [_coco_thing(annotation, names) for annotation in of_picture.get(image["id"], [])]
            pictures.append(Labelled(found, things, str(image.get("group", ""))))
    return pictures


def _coco_thing(annotation: dict, names: dict) -> Thing:
    x, y, wide, high = (float(number) for number in annotation["bbox"])
    outline = annotation.get("segmentation") or []
    polygons = outline if isinstance(outline, list) else []
    runs = None
    if isinstance(outline, dict):
        counts = outline["counts"] if isinstance(outline["counts"], list) else _counts_of_text(outline["counts"])
        runs = (counts, tuple(outline["size"]))
    return Thing(names[annotation["category_id"]], np.array([x, y, x + wide, y + high]), polygons, runs, bool(annotation.get("iscrowd", 0)))


def _counts_of_text(text: str) -> list:
    """COCO's run lengths as text: numbers of 5 bits a character, from the third on differences to the last but one."""
    counts, at = [], 0
    while at < len(text):
        value, shift, more = 0, 0, True
        while more:
            bits = ord(text[at]) - 48
            value |= (bits & 0x1F) << shift
            more, shift, at = bool(bits & 0x20), shift + 5, at + 1
        if bits & 0x10:
            value |= -1 << shift
        counts.append(value + counts[-2] if len(counts) > 2 else value)
    return counts


def run_lengths(counts: list, size: tuple) -> np.ndarray:
    """Rows x columns out of runs down the columns, the first of zeros."""
    flat = np.repeat(np.arange(len(counts)) % 2 == 1, counts)
    whole = np.zeros(size[0] * size[1], bool)
    whole[:flat.size] = flat[:whole.size]
    return whole.reshape(size[1], size[0]).T


def _pictures_by_name(folder: Path) -> dict:
    return {file.name: file for file in sorted(folder.rglob("*")) if file.suffix.lower() in KINDS}


def _yolo(folder: Path) -> list:
    texts = [file for file in sorted(folder.rglob("*.txt")) if file.parent.name == "labels" or "labels" in file.parts[len(folder.parts):]]
    if not texts:
        return []
    names = _yolo_names(folder)
    by_stem = {}
    for file in _pictures_by_name(folder).values():
        by_stem.setdefault(file.stem, file)
    rows_of = {text.stem: text for text in texts}
    pictures = []
    for stem, picture in sorted(by_stem.items()):
        if stem not in rows_of and not any(part == "images" for part in picture.parts[len(folder.parts):]):
            continue
        with Image.open(picture) as opened:
            size = np.array(opened.size, float)
        things = []
        for row in (rows_of[stem].read_text().split("\n") if stem in rows_of else []):
            if not row.strip():
                continue
            kind, *numbers = row.split()
            corners = np.array(numbers, float)
            if corners.size == 4:
                things.append(Thing(_yolo_name(names, kind), np.concatenate([(corners[:2] - corners[2:] / 2) * size,
                                                                               (corners[:2] + corners[2:] / 2) * size])))
            else:
                corners = corners[:corners.size // 2 * 2].reshape(-1, 2) * size
                things.append(Thing(_yolo_name(names, kind), np.concatenate([corners.min(0), corners.max(0)]), [corners.ravel().tolist()]))
        pictures.append(Labelled(picture, things))
    return pictures


def _yolo_name(names: list, kind: str) -> str:
    return names[int(kind)] if int(kind) < len(names) else kind


def _yolo_names(folder: Path) -> list:
    """Of classes: from data.yaml (a list or a map), or classes.txt; none: their numbers."""
    for file in sorted(folder.glob("*.y*ml")):
        try:
            import yaml
        except ImportError:
            raise Unreadable(f"{file}: PyYAML is needed to read it: pip install pyyaml") from None
        names = (yaml.safe_load(file.read_text()) or {}).get("names")
        if isinstance(names, dict):
            return [str(names[number]) for number in sorted(names)]
        if isinstance(names, list):
            return [str(name) for name in names]
    for file in (*folder.rglob("classes.txt"), *folder.rglob("obj.names")):
        return file.read_text().split("\n")
    return []


def _voc(folder: Path) -> list:
    pictures = []
    places: dict = {}
    for file in sorted(folder.rglob("*.xml")):
        root = ElementTree.parse(file).getroot()
        if root.tag != "annotation":
            continue
        places = places or _pictures_by_name(folder)
        picture = places.get(Path(root.findtext("filename") or "").name) or next(
            (at for name, at in places.items() if Path(name).stem == file.stem), None)
        if picture is None:
            raise Unreadable(f"{file}: its picture {root.findtext('filename')} is not under {folder}")
        things = []
        for thing in root.iter("object"):
            at = {side.tag: float(side.text) for side in thing.find("bndbox")}
            things.append(Thing(thing.findtext("name").strip(), np.array([at["xmin"] - 1, at["ymin"] - 1, at["xmax"], at["ymax"]])))
        pictures.append(Labelled(picture, things))
    return pictures


def _masks(folder: Path) -> list:
    """images/NAME.* and masks/NAME.png: of each value but 0 the parts that hang together are things, all of the class `object`, or of
    the names that classes.txt has (line by line, value by value from 1)."""
    images, masks = (next((at for at in folder.rglob(name) if at.is_dir()), None) for name in ("images", "masks"))
    if images is None or masks is None:
        return []
    names = (folder / "classes.txt").read_text().splitlines() if (folder / "classes.txt").is_file() else []
    of_stem = {file.stem.removesuffix("_mask"): file for file in sorted(masks.iterdir()) if file.suffix.lower() in KINDS}
    pictures = []
    for picture in sorted(images.iterdir()):
        if picture.suffix.lower() not in KINDS:
            continue
        things = []
        if picture.stem in of_stem:
            values = np.array(Image.open(of_stem[picture.stem]))
            flat = values.reshape(*values.shape[:2], -1).max(2)
            for value in np.unique(flat[flat > 0]):
                parts = components(values, int(value))
                for part in range(1, parts.max() + 1):
                    rows, columns = np.nonzero(parts == part)
                    if rows.size >= 4:
                        name = names[value - 1] if value <= len(names) else "object"
                        box = np.array([columns.min(), rows.min(), columns.max() + 1, rows.max() + 1], float)
                        things.append(Thing(name, box, mask_of=(of_stem[picture.stem], (int(value), part))))
        pictures.append(Labelled(picture, things))
    return pictures


def components(values: np.ndarray, value: int) -> np.ndarray:
    """Rows x columns: the number, from 1, of the part of this value (in any channel the largest) that hangs together; 0: none."""
    flat = values.reshape(*values.shape[:2], -1).max(2)
    runs, parents, by_row = [], [], []
    for row in flat == value:  # runs of a row, joined to those of the row above that they touch
        edges = np.flatnonzero(np.diff(np.concatenate([[0], row.astype(np.int8), [0]])))
        here = []
        for start, end in zip(edges[::2], edges[1::2]):
            parents.append(len(runs))
            here.append(len(runs))
            runs.append((len(by_row), start, end))
            for other in (by_row[-1] if by_row else []):
                if runs[other][1] <= end and runs[other][2] >= start:
                    parents[_root(parents, other)] = _root(parents, here[-1])
        by_row.append(here)
    parts, numbers = np.zeros(flat.shape, np.int32), {}
    for i, (row, start, end) in enumerate(runs):
        parts[row, start:end] = numbers.setdefault(_root(parents, i), len(numbers) + 1)
    return parts


def _root(parents: list, i: int) -> int:
    while parents[i] != i:
        parents[i] = parents[parents[i]]
        i = parents[i]
    return i


def _classes(folder: Path) -> list:
    """A folder for each class; pictures in one called `empty` or `background` have nothing in them."""
    pictures = []
    for of_class in sorted(at for at in folder.iterdir() if at.is_dir()):
        for file in sorted(of_class.rglob("*")):
            if file.suffix.lower() in KINDS:
                things = [] if of_class.name in ("empty", "background") else [Thing(of_class.name, None)]
                pictures.append(Labelled(file, things))
    return pictures


def _grouped(folder: Path, pictures: list) -> list:
    return with_groups(folder / "groups.csv", pictures) if (folder / "groups.csv").is_file() else pictures


def with_groups(table: Path, pictures: list) -> list:
    """By a CSV of file, group."""
    try:
        with open(table, newline="") as file:
            groups = {Path(row[0]).name: row[1] for row in csv.reader(file) if len(row) >= 2}
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise Unreadable(f"{table}: {error}; allowed is a CSV of file, group") from None
    for picture in pictures:
        picture.group = groups.get(picture.file.name, picture.group)
    return pictures


def chosen(pictures: list, rename: dict, drop: list, only: list, ignore: list) -> list:
    """Labels under other names; things of `drop` count as nothing, of `ignore` neither way; `only` drops all others."""
    for picture in pictures:
        kept = []
        for thing in picture.things:
            thing.name = rename.get(thing.name, thing.name)
            if thing.name in drop or (only and thing.name not in only and thing.name not in ignore):
                continue
            thing.ignored = thing.ignored or thing.name in ignore
            kept.append(thing)
        picture.things = kept
    return pictures
