#!/usr/bin/python3
"""Draws the pictures of README.md, docs/manual/plots.md and docs/manual/first-survey.md from runs, by the commands that the pages give.

    docs/draw_plots.py demo.mcap first.mcap forward_looking.mcap scanning.mcap sidescan.mcap targets.mcap

The records are those of launch/demo.yaml, of docs/manual/first-survey.md with `amplitude_every: 1`, and of the launches named like them.
"""
import os
import pathlib
import sys
import tempfile

from PIL import Image

DOCS = pathlib.Path(__file__).resolve().parent
for folder in ("tools/plot", "clients/python"):
    sys.path.insert(0, str(DOCS.parent / folder))
from ensonify_plot import forward_looking, pictures, waterfall  # noqa: E402
from ensonify_plot.main import main  # noqa: E402

pictures.DPI = 80  # small files: fewer pixels, cells and colours than the commands give
forward_looking.CELLS, waterfall.CELLS = 300, 300
COLOURS = 128


def draw(name, *command, of=None):
    """One command's picture; `of` several."""
    with tempfile.TemporaryDirectory() as folder:
        if main([*map(str, command), "--out", folder]) != 0:
            sys.exit(f"{name}: not drawn")
        [file] = pathlib.Path(folder).glob(of or "*.png")
        picture = Image.open(file).convert("RGB")
        small = picture.quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
        small.save(DOCS / "pictures" / f"{name}.png", optimize=True)


def draw_all(demo, survey, ahead, around, aside, targets):
    draw("survey_and_truth", "survey", demo, of="survey_and_truth.png")
    draw("plot_coverage", "coverage", demo)
    draw("plot_fls", "fls", ahead)
    draw("plot_scan", "scan", around)
    draw("ping", "ping", survey, "--ping", 45)
    draw("plot_fan", "fan", survey, "--ping", 45)
    draw("plot_water_column", "water-column", survey)
    draw("sidescan", "waterfall", aside, "--ping", "370:592")
    draw("plot_waterfall", "waterfall", aside)
    draw("plot_waterfall_ground", "waterfall", aside, "--ground")
    draw("plot_angular_response", "angular-response", demo)
    draw("targets_fls", "fls", targets)
    draw("targets_scene", "scene", "scenarios/targets/scenario.yaml", "--record", targets)
    draw("object_shapes", "scene", "scenarios/object_shapes/scenario.yaml")


if __name__ == "__main__":
    if len(sys.argv) != 7:
        sys.exit(__doc__)
    records = [os.path.abspath(record) for record in sys.argv[1:]]
    os.chdir(DOCS.parent)  # scenarios by the names that pages give
    draw_all(*records)
