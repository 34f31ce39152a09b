"""Pictures of a scene in one file, until all scenes are there."""
import json
import os
from pathlib import Path

import numpy as np

from ensonify.labels.formats import plain
from ensonify.labels.pictures import Picture, Thing


def save(made: list, file: Path) -> None:
    """Whole or not at all."""
    arrays: dict = {}
    heads = []
    for number, picture in enumerate(made):
        things = [{"instance": thing.instance, "name": thing.name, "class_name": thing.class_name, "class_id": thing.class_id,
                   "facts": plain(thing.facts)} for thing in picture.things]
        heads.append({"name": picture.name, "scale_upa": picture.scale_upa, "facts": plain(picture.facts), "things": things})
        for key in ("grey", "linear", "layer", "seabed_shadow"):
            arrays[f"{number}_{key}"] = getattr(picture, key)
        for key in ("mask", "shadow"):
            masks = [getattr(thing, key) for thing in picture.things]
            arrays[f"{number}_{key}"] = np.array(masks, bool).reshape(len(masks), *picture.grey.shape)
    arrays["heads"] = np.array(json.dumps(heads))
    part = file.with_name(f".{file.name}.part")
    try:
        with open(part, "wb") as to:
            np.savez_compressed(to, **arrays)
            to.flush()
            os.fsync(to.fileno())
        os.replace(part, file)
    finally:
        part.unlink(missing_ok=True)


def load(file: Path) -> list:
    with np.load(file) as arrays:
        made = []
        for number, head in enumerate(json.loads(str(arrays["heads"]))):
            of = {key: arrays[f"{number}_{key}"] for key in ("grey", "linear", "layer", "seabed_shadow", "mask", "shadow")}
            things = [Thing(one["instance"], one["name"], one["class_name"], one["class_id"], of["mask"][i], of["shadow"][i], one["facts"])
                      for i, one in enumerate(head["things"])]
            made.append(Picture(head["name"], of["grey"], of["linear"], head["scale_upa"], things, of["layer"], of["seabed_shadow"],
                                head["facts"]))
    return made
