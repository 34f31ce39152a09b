#!/usr/bin/python3
"""Draws the pictures of docs/manual/plots.md (and the ping of docs/manual/first-survey.md) by the commands that the page gives.

    docs/draw_plots.py first.mcap forward_looking.mcap scanning.mcap

The first record is that of docs/manual/first-survey.md with `amplitude_every: 1`, the others those of launch/forward_looking.yaml and
launch/scanning.yaml. What these heads cannot show is drawn from echoes made by formula (tools/plot/tests/synthetic_heads.py, which needs the package mcap).
"""
import pathlib
import sys
import tempfile

from PIL import Image

DOCS = pathlib.Path(__file__).resolve().parent
for folder in ("tools/plot", "tools/plot/tests", "clients/python"):
    sys.path.insert(0, str(DOCS.parent / folder))
import synthetic_heads as made  # noqa: E402
from ensonify_plot import forward_looking, pictures, waterfall  # noqa: E402
from ensonify_plot.main import main  # noqa: E402

pictures.DPI = 80  # small files: fewer pixels, cells and colours than the commands give
forward_looking.CELLS, waterfall.CELLS = 300, 300
COLOURS = 64


def draw(name, *command):
    """One command's picture."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "picture.png"
        if main([*map(str, command), "--out", str(file)]) != 0:
            sys.exit(f"{name}: not drawn")
        picture = Image.open(file).convert("RGB")
        small = picture.quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
        small.save(DOCS / "pictures" / f"{name}.png", optimize=True)


def draw_all(survey, ahead, around):
    draw("plot_fls", "fls", ahead)
    draw("plot_scan", "scan", around)
    draw("ping", "ping", survey, "--ping", 45)
    draw("plot_fan", "fan", survey, "--ping", 45)
    draw("plot_water_column", "water-column", survey)
    with tempfile.TemporaryDirectory() as folder:
        fish, bow = (pathlib.Path(folder) / f"{name}.mcap" for name in ("fish", "bow"))
        made.write(fish, made.sidescan(pings=160))
        made.write(bow, made.soundings())
        draw("plot_waterfall", "waterfall", fish)
        draw("plot_waterfall_ground", "waterfall", fish, "--ground")
        draw("plot_angular_response", "angular-response", bow)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    draw_all(*sys.argv[1:])
