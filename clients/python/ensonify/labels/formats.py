"""Labelled pictures as files of common formats. A writer takes pictures one by one and is closed at the end.

Of all: pixel (0, 0) covers [0, 1) x [0, 1). A box goes round the object, the object and its shadow, or the shadow alone.
"""
import io
import json
import os
import tarfile
from pathlib import Path
from xml.sax.saxutils import escape

import numpy as np
from PIL import Image

from ensonify.labels import outlines
from ensonify.labels.pictures import Picture, Thing
from ensonify.session import EXIT_BAD_INPUT, RunError

SEABED_SHADOW = 65535  # in 16 bits, whose shadow it is
AROUND = ("object", "object+shadow", "shadow")


def png(pixels: np.ndarray) -> bytes:
    """A grey PNG of 8 or 16 bits."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG")
    return file.getvalue()


def part(thing: Thing, around: str) -> np.ndarray:
    """Pixels that a label is about."""
    return {"object": thing.mask, "shadow": thing.shadow, "object+shadow": thing.mask | thing.shadow}[around]


class Classes:
    """Names of classes, in the order of their numbers when all are known."""

    def __init__(self):
        self.names: set = set()

    def add(self, picture: Picture) -> None:
        self.names.update(thing.class_name for thing in picture.things)

    def ordered(self) -> list:
        return sorted(self.names)


class Images:
    """images/NAME.png (8 bits, decibels) and amplitude/NAME.png (16 bits, linear), and NAME.json with all that is known."""

    def __init__(self, folder: Path):
        self.folder = folder

    def add(self, picture: Picture) -> None:
        for kind, content, suffix in (("images", png(picture.grey), "png"), ("amplitude", png(picture.linear), "png"),
                                      ("facts", json.dumps(facts_of(picture), indent=1).encode(), "json")):
            _write(self.folder / kind / f"{picture.name}.{suffix}", content)

    def close(self) -> None:
        pass


def facts_of(picture: Picture) -> dict:
    """All that is known of a picture, for JSON."""
    things = [{"instance": thing.instance, "name": thing.name, "class": thing.class_name, "class_id": thing.class_id,
               "box": outlines.box(thing.mask), "shadow_box": outlines.box(thing.shadow), **plain(thing.facts)}
              for thing in picture.things]
    return {**plain(picture.facts), "height": picture.grey.shape[0], "width": picture.grey.shape[1], "objects": things}


def plain(facts: dict) -> dict:
    """The same for JSON."""
    return {key: value.tolist() if isinstance(value, np.ndarray) else value for key, value in facts.items()}


class Masks:
    """masks/NAME.png: 16 bits, the instance of each pixel; shadows/NAME.png: the instance whose shadow it is, 65535 the seabed's."""

    def __init__(self, folder: Path, around: str = "object"):
        self.folder = folder

    def add(self, picture: Picture) -> None:
        _write(self.folder / "masks" / f"{picture.name}.png", png(mask_layer(picture)))
        _write(self.folder / "shadows" / f"{picture.name}.png", png(shadow_layer(picture)))

    def close(self) -> None:
        pass


def mask_layer(picture: Picture) -> np.ndarray:
    """Instance of each pixel, 16 bits. Raises RunError for instances that 16 bits do not hold beside the seabed's shadow."""
    largest = max((thing.instance for thing in picture.things), default=0)
    if largest >= SEABED_SHADOW:
        raise RunError(f"{picture.name}: instance {largest}; masks of 16 bits hold up to {SEABED_SHADOW - 1}", EXIT_BAD_INPUT)
    return picture.layer.astype(np.uint16)


def shadow_layer(picture: Picture) -> np.ndarray:
    """Whose shadow each pixel is: instance, 65535 the seabed's, 0 none."""
    layer = np.where(picture.seabed_shadow, SEABED_SHADOW, 0).astype(np.uint16)
    for thing in picture.things:
        layer[thing.shadow] = thing.instance
    return layer


class Coco:
    """annotations.json: COCO instances. Segmentations are polygons, of masks with several parts or holes run lengths."""

    def __init__(self, folder: Path, around: str = "object"):
        self.folder, self.around, self.classes = folder, around, Classes()
        self.images: list = []
        self.annotations: list = []

    def add(self, picture: Picture) -> None:
        self.classes.add(picture)
        height, width = picture.grey.shape
        self.images.append({"id": len(self.images) + 1, "file_name": f"images/{picture.name}.png", "width": width, "height": height})
        for thing in picture.things:
            pixels = part(thing, self.around)
            box = outlines.box(pixels)
            if box is None:
                continue
            self.annotations.append({
                "id": len(self.annotations) + 1, "image_id": len(self.images), "category_id": thing.class_name, "iscrowd": 0,
                "bbox": list(box), "area": int(pixels.sum()), "segmentation": segmentation(pixels),
                "attributes": {"instance": thing.instance, "name": thing.name, **plain(thing.facts)}})

    def close(self) -> None:
        names = self.classes.ordered()
        for annotation in self.annotations:
            annotation["category_id"] = names.index(annotation["category_id"]) + 1
        categories = [{"id": i + 1, "name": name, "supercategory": "object"} for i, name in enumerate(names)]
        whole = {"info": {"description": "Simulated by Ensonify"}, "images": self.images, "annotations": self.annotations,
                 "categories": categories}
        _write(self.folder / "annotations.json", json.dumps(whole).encode())


def segmentation(pixels: np.ndarray):
    """COCO's: one polygon, or of several parts or holes run lengths down the columns, the first of 0."""
    rings = outlines.rings(pixels)
    if len(rings) == 1:
        return [rings[0].ravel().tolist()]
    flat = np.concatenate([[0], pixels.ravel(order="F").astype(np.int8), [0]])
    edges = np.flatnonzero(np.diff(flat))
    counts = np.diff(np.concatenate([[0], edges, [pixels.size]]))
    return {"size": list(pixels.shape), "counts": counts.tolist() if edges.size and edges[-1] < pixels.size else counts[:-1].tolist()}


class Yolo:
    """labels/NAME.txt beside images/NAME.png, and data.yaml with the names of classes, from 0.

    form: detect (class x y width height of the box), segment (class and the outline of the largest part) or oriented (class
    and four corners), all over the picture's width and height."""

    def __init__(self, folder: Path, around: str = "object", form: str = "detect"):
        self.folder, self.around, self.form, self.classes = folder, around, form, Classes()
        self.lines: list = []  # (picture's name, [(class name, numbers)])

    def add(self, picture: Picture) -> None:
        self.classes.add(picture)
        height, width = picture.grey.shape
        rows = []
        for thing in picture.things:
            numbers = self._numbers(part(thing, self.around), width, height)
            if numbers is not None:
                rows.append((thing.class_name, numbers))
        self.lines.append((picture.name, rows))

    def _numbers(self, pixels: np.ndarray, width: int, height: int):
        box = outlines.box(pixels)
        if box is None:
            return None
        if self.form == "detect":
            x, y, wide, high = box
            return [(x + wide / 2) / width, (y + high / 2) / height, wide / width, high / height]
        corners = outlines.oriented_box(pixels) if self.form == "oriented" else max(outlines.rings(pixels), key=outlines.area)
        return (np.clip(corners / (width, height), 0, 1)).ravel().tolist()

    def close(self) -> None:
        names = self.classes.ordered()
        for name, rows in self.lines:
            text = "".join(f"{names.index(of)} {' '.join(f'{number:.6f}' for number in numbers)}\n" for of, numbers in rows)
            _write(self.folder / "labels" / f"{name}.txt", text.encode())
        listed = "".join(f"  {i}: {json.dumps(name)}\n" for i, name in enumerate(names))
        _write(self.folder / "data.yaml", f"path: .\ntrain: images\nval: images\nnames:\n{listed}".encode())


class Voc:
    """Annotations/NAME.xml: Pascal VOC, whose pixels count from 1."""

    def __init__(self, folder: Path, around: str = "object"):
        self.folder, self.around = folder, around

    def add(self, picture: Picture) -> None:
        height, width = picture.grey.shape
        objects = ""
        for thing in picture.things:
            box = outlines.box(part(thing, self.around))
            if box is None:
                continue
            x, y, wide, high = box
            truncated = int(x == 0 or y == 0 or x + wide == width or y + high == height)
            objects += (f"<object><name>{escape(thing.class_name)}</name><pose>Unspecified</pose><truncated>{truncated}</truncated>"
                        f"<difficult>0</difficult><bndbox><xmin>{x + 1}</xmin><ymin>{y + 1}</ymin><xmax>{x + wide}</xmax>"
                        f"<ymax>{y + high}</ymax></bndbox></object>")
        text = (f"<annotation><folder>images</folder><filename>{escape(picture.name)}.png</filename><size><width>{width}</width>"
                f"<height>{height}</height><depth>1</depth></size><segmented>0</segmented>{objects}</annotation>\n")
        _write(self.folder / "Annotations" / f"{picture.name}.xml", text.encode())

    def close(self) -> None:
        pass


class WebDataset:
    """shard-000000.tar and on: NAME.png, NAME.amplitude.png, NAME.mask.png, NAME.shadow.png and NAME.json of each picture."""

    def __init__(self, folder: Path, around: str = "object", pictures_per_shard: int = 1000):
        self.folder, self.most = folder, pictures_per_shard
        self.count, self.shard = 0, None

    def add(self, picture: Picture) -> None:
        if self.count % self.most == 0:
            self.close()
            self.folder.mkdir(parents=True, exist_ok=True)
            self.shard = tarfile.open(self.folder / f"shard-{self.count // self.most:06d}.tar", "w", format=tarfile.USTAR_FORMAT)
        self.count += 1
        for suffix, content in (("png", png(picture.grey)), ("amplitude.png", png(picture.linear)),
                                ("mask.png", png(mask_layer(picture))), ("shadow.png", png(shadow_layer(picture))),
                                ("json", json.dumps(facts_of(picture)).encode())):
            info = tarfile.TarInfo(f"{picture.name}.{suffix}")
            info.size = len(content)
            self.shard.addfile(info, io.BytesIO(content))

    def close(self) -> None:
        if self.shard is not None:
            self.shard.close()
        self.shard = None


def _write(file: Path, content: bytes) -> None:
    """Whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    partial = file.with_name(f".{file.name}.part")
    partial.write_bytes(content)
    os.replace(partial, file)


WRITERS = {"masks": Masks, "coco": Coco, "yolo": Yolo, "voc": Voc, "webdataset": WebDataset}
