"""Reading what python -m ensonify.labels wrote, or sets of others in these forms, for training."""
import json
import tarfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Callable, NamedTuple

import numpy as np
from PIL import Image

from ensonify.session import EXIT_BAD_INPUT, RunError


class Sample(NamedTuple):
    """A picture and its boxes."""

    image: np.ndarray  # rows x columns, uint8
    boxes: np.ndarray  # objects x 4, float32: left, top, right, bottom, by the edges of pixels
    classes: np.ndarray  # objects, int64: places in Dataset.names
    name: str


class Dataset:
    """A folder of labelled pictures: COCO (annotations.json), YOLO (data.yaml), Pascal VOC (Annotations) or WebDataset shards, the
    first of these that is there. Length and items as torch.utils.data wants them of a map-style data set; it needs no torch.

        loader = torch.utils.data.DataLoader(Dataset("out/set", transform=to_tensors), batch_size=8, collate_fn=list)

    transform: from a Sample to an item. Raises RunError for a folder without any of them, or with a file that cannot be read."""

    def __init__(self, folder: str | Path, transform: Callable | None = None):
        self.folder, self.transform = Path(folder), transform
        self.names: list = []  # of classes
        self._read: list = []  # (name, reader of the image, boxes, classes)
        for there, load in ((self.folder / "annotations.json", self._coco), (self.folder / "data.yaml", self._yolo),
                            (self.folder / "Annotations", self._voc)):
            if there.exists():
                return self._load(load, there)
        shards = sorted(self.folder.glob("*.tar"))
        if not shards:
            raise RunError(f"{folder}: has no labelled pictures; allowed are annotations.json (COCO), data.yaml (YOLO), Annotations "
                           "(Pascal VOC) and .tar (WebDataset)", EXIT_BAD_INPUT)
        for shard in shards:
            self._load(self._shard, shard)

    def _load(self, load: Callable, file: Path) -> None:
        try:
            load(file)
        except (OSError, ValueError, KeyError, IndexError, TypeError, AttributeError, tarfile.TarError,
                ElementTree.ParseError) as error:
            raise RunError(f"{file}: {type(error).__name__}: {error}", EXIT_BAD_INPUT) from None

    def __len__(self) -> int:
        return len(self._read)

    def __getitem__(self, i: int):
        name, image, boxes, classes = self._read[i]
        sample = Sample(image(), np.array(boxes, np.float32).reshape(-1, 4), np.array(classes, np.int64), name)
        return self.transform(sample) if self.transform else sample

    def _number(self, name: str) -> int:
        if name not in self.names:
            self.names.append(name)
        return self.names.index(name)

    def _coco(self, file: Path) -> None:
        whole = json.loads(file.read_text())
        self.names = [category["name"] for category in sorted(whole["categories"], key=lambda category: category["id"])]
        names = {category["id"]: category["name"] for category in whole["categories"]}
        of_image: dict = {}
        for annotation in whole["annotations"]:
            of_image.setdefault(annotation["image_id"], []).append(annotation)
        for image in whole["images"]:
            marks = of_image.get(image["id"], [])
            boxes = [[x, y, x + wide, y + high] for x, y, wide, high in (mark["bbox"] for mark in marks)]
            self._read.append((Path(image["file_name"]).stem, _opener(self.folder / image["file_name"]), boxes,
                               [self.names.index(names[mark["category_id"]]) for mark in marks]))

    def _yolo(self, file: Path) -> None:
        for line in file.read_text().splitlines():
            number, colon, name = line.strip().partition(":")
            if colon and number.isdecimal():
                self.names.append(json.loads(name) if name.strip().startswith('"') else name.strip())
        for image in sorted((self.folder / "images").glob("*.png")):
            lines = (self.folder / "labels" / f"{image.stem}.txt").read_text().split("\n")
            rows = [line.split() for line in lines if line]
            with Image.open(image) as opened:
                width, height = opened.size
            boxes = []
            for row in rows:
                numbers = np.array(row[1:], float)
                if len(numbers) == 4:
                    x, y, wide, high = numbers
                    numbers = np.array([x - wide / 2, y - high / 2, x + wide / 2, y + high / 2])
                corners = numbers.reshape(-1, 2) * (width, height)
                boxes.append([*corners.min(0), *corners.max(0)])
            self._read.append((image.stem, _opener(image), boxes, [int(row[0]) for row in rows]))

    def _voc(self, folder: Path) -> None:
        for file in sorted(folder.glob("*.xml")):
            root = ElementTree.parse(file).getroot()
            boxes, classes = [], []
            for thing in root.iter("object"):
                at = {side.tag: float(side.text) for side in thing.find("bndbox")}
                boxes.append([at["xmin"] - 1, at["ymin"] - 1, at["xmax"], at["ymax"]])
                classes.append(self._number(thing.findtext("name")))
            self._read.append((file.stem, _opener(self.folder / "images" / root.findtext("filename")), boxes, classes))

    def _shard(self, file: Path) -> None:
        with tarfile.open(file) as shard:
            facts = [(member.name[:-len(".json")], json.load(shard.extractfile(member))) for member in shard
                     if member.name.endswith(".json")]
        for name, of in facts:
            things = [thing for thing in of["objects"] if thing["box"]]
            boxes = [[x, y, x + wide, y + high] for x, y, wide, high in (thing["box"] for thing in things)]
            self._read.append((name, _member_opener(file, f"{name}.png"), boxes, [self._number(thing["class"]) for thing in things]))


def _opener(file: Path) -> Callable:
    def read():
        with Image.open(file) as image:
            return np.array(image.convert("L"))

    return read


def _member_opener(shard: Path, name: str) -> Callable:
    def read():
        with tarfile.open(shard) as open_shard:
            return np.array(Image.open(open_shard.extractfile(name)).convert("L"))

    return read
