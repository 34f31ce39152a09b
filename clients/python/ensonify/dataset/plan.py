"""The folder of `ensonify dataset`: recipe.json, scenes.jsonl, runs/ID/pictures.npz."""
import json
from pathlib import Path

from ensonify.session import EXIT_BAD_INPUT, RunError


class Plan:
    """What the folder is for."""

    def __init__(self, folder: str | Path):
        self.folder = Path(folder)
        try:
            self.recipe: dict = json.loads((self.folder / "recipe.json").read_text())
        except (OSError, ValueError) as error:
            raise RunError(f"{self.folder}: is no folder of `ensonify dataset`: {error}", EXIT_BAD_INPUT) from error

    def scenes(self) -> list:
        with open(self.folder / "scenes.jsonl", encoding="utf-8") as lines:
            return [json.loads(line) for line in lines]

    def pictures_of(self, scene: dict) -> Path:
        return self.folder / "runs" / scene["id"] / "pictures.npz"
