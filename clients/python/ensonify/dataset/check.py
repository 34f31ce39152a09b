"""Whether a set's splits are apart."""
import json
import math
from pathlib import Path

from ensonify.session import EXIT_BAD_INPUT, RunError


def rows_of(folder: str) -> list:
    """The manifest of a set, or of the folder that it stands in."""
    for file in (Path(folder) / "manifest.jsonl", Path(folder) / "set/manifest.jsonl"):
        if file.exists():
            try:
                return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
            except ValueError as error:
                raise RunError(f"{file}: {error}", EXIT_BAD_INPUT) from error
    raise RunError(f"{folder}: has no manifest.jsonl; allowed is a set that `ensonify dataset` has made", EXIT_BAD_INPUT)


def leaks(rows: list) -> list:
    """Sentences: a scene, an object, a picture or neighbouring places on two sides."""
    found = []
    for what, keys_of in (("scene", lambda row: [row["scene"]]),
                          ("seed", lambda row: [row["seed"]]),
                          ("object", lambda row: [(row["seed"], thing["name"]) for thing in row["objects"]]),
                          ("picture", lambda row: [row["sha256"]])):
        first: dict = {}
        for row in rows:
            for key in keys_of(row):
                other = first.setdefault(key, row)
                if other["split"] != row["split"]:
                    found.append(f"{what}: pictures {other['name']} ({other['split']}) and {row['name']} ({row['split']}) share {key}")
    return found + neighbours(rows)


def neighbours(rows: list) -> list:
    """Pictures of the same ground on two sides whose heads are nearer than both their ranges together."""
    found = []
    cells: dict = {}  # by ground and a raster as wide as the widest pair
    wide = 2 * max((row["settings"]["range_m"] for row in rows), default=1.0)
    for row in rows:
        east, north = row["settings"]["head_enu_m"][:2]
        column, line = math.floor(east / wide), math.floor(north / wide)
        for i in (-1, 0, 1):
            for j in (-1, 0, 1):
                for other in cells.get((row["ground"], column + i, line + j), []):
                    apart_m = math.dist(other["settings"]["head_enu_m"][:2], (east, north))
                    if other["split"] != row["split"] and apart_m < other["settings"]["range_m"] + row["settings"]["range_m"]:
                        found.append(f"place: {other['name']} ({other['split']}) and {row['name']} ({row['split']}) are {apart_m:.1f} m apart")
        cells.setdefault((row["ground"], column, line), []).append(row)
    return found
