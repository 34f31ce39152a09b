"""Pictures of all scenes as one set: SET/train, val and test in the recipe's formats, manifest.jsonl, card.html."""
import hashlib
import json
import os
import shutil
from pathlib import Path

from ensonify.dataset import store
from ensonify.dataset.card import Card
from ensonify.dataset.plan import Plan
from ensonify.labels import formats, outlines
from ensonify.labels.pictures import Picture
from ensonify.session import EXIT_BAD_INPUT, RunError

EXIT_DIFFER = 6


def join(folder: str, pictures: int, only: int | None = None, sources: list | None = None) -> Path:
    """Writes FOLDER/set of the first `pictures`, or of one alone. Sources are folders of other shards."""
    plan = Plan(folder)
    files = found(plan, [plan, *map(Plan, sources or [])])
    whole, part = plan.folder / "set", plan.folder / "set.part"
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir()
    splits: dict = {}
    card = Card(plan.recipe)
    with open(part / "manifest.jsonl", "w", encoding="utf-8") as manifest:
        for scene, file in files:
            for sample, picture in zip(scene["samples"], store.load(file)):
                if sample["number"] != only if only is not None else sample["number"] >= pictures:
                    continue
                split = splits.setdefault(scene["split"], Split(part / scene["split"], plan.recipe))
                split.add(picture)
                row = row_of(plan.recipe, scene, sample, picture)
                manifest.write(json.dumps(row) + "\n")
                card.add(row, picture)
    for split in splits.values():
        split.close()
    if "yolo" in plan.recipe["formats"]:
        (part / "data.yaml").write_text(yolo_yaml(plan.recipe["classes"], splits))
    (part / "recipe.yaml").write_text(plan.recipe["text"])
    (part / "card.html").write_text(card.html(), encoding="utf-8")
    os.replace(part, whole)
    return whole


def found(plan: Plan, plans: list) -> list:
    """(scene, its file) of all scenes. Raises RunError where one is missing, or is not the same in two folders."""
    for other in plans:
        if other.recipe != plan.recipe:
            raise RunError(f"{other.folder}: is of another recipe than {plan.folder}", EXIT_BAD_INPUT)
    files, missing = [], []
    for scene in plan.scenes():
        there = [file for file in (other.pictures_of(scene) for other in plans) if file.exists()]
        if not there:
            missing.append(f"{scene['scene']} {scene['pair']}".rstrip())
            continue
        if len({file.read_bytes() for file in there}) > 1:
            raise RunError(f"scene {scene['scene']}: {there[0]} and {there[1]} differ", EXIT_DIFFER)
        files.append((scene, there[0]))
    if missing:
        raise RunError(f"{plan.folder}: {len(missing)} scenes are missing, the first is {missing[0]}; run all shards, and name their folders",
                       EXIT_BAD_INPUT)
    return files


class Split:
    """The files of one side."""

    def __init__(self, folder: Path, recipe: dict):
        kinds = recipe["formats"]
        self.writers: list = [] if kinds == ["webdataset"] else [formats.Images(folder)]
        for kind in kinds:
            writer = formats.WRITERS[kind](folder, recipe["box"])
            if hasattr(writer, "classes"):
                writer.classes.names.update(recipe["classes"])  # the same numbers on all sides
            self.writers.append(writer)

    def add(self, picture: Picture) -> None:
        for writer in self.writers:
            writer.add(picture)

    def close(self) -> None:
        for writer in self.writers:
            writer.close()


def row_of(recipe: dict, scene: dict, sample: dict, picture: Picture) -> dict:
    """A line of the manifest."""
    content = hashlib.sha256()
    for pixels in (picture.grey, picture.linear, picture.layer):
        content.update(pixels.tobytes())
    objects = [{"name": thing.name, "class": thing.class_name, "instance": thing.instance, "pixels": int(thing.mask.sum()),
                "shadow_pixels": int(thing.shadow.sum()), "box": outlines.box(thing.mask), **thing.facts} for thing in picture.things]
    slot = 0 if recipe["chip"] is None else sample["number"] % recipe["samples"]
    shows = any(one["name"].startswith(f"{sample['kind']}_{slot}_") for one in objects) if sample["kind"] else False
    return {"picture": sample["number"], "name": picture.name, "pair": scene["pair"], "split": scene["split"], "scene": scene["scene"], "id": scene["id"],
            "seed": scene["seed"], "kind": sample["kind"], "shows": shows, "place": sample["place"], "ground": scene["ground"], "sha256": content.hexdigest(),
            "drawn": scene["drawn"], "settings": picture.facts, "objects": objects}


def yolo_yaml(classes: list, splits: dict) -> str:
    sides = "".join(f"{name}: {name}/images\n" for name in ("train", "val", "test") if name in splits)
    return f"path: .\n{sides}names:\n" + "".join(f"  {i}: {json.dumps(name)}\n" for i, name in enumerate(sorted(classes)))
