#!/usr/bin/python3
"""Draws the picture of docs/physics/acceptance.md from the numbers in its tables: what was reached over what is allowed.

    docs/physics/draw/acceptance.py
"""
import pathlib
import re

import matplotlib.pyplot as plt

from values import save

PAGE = pathlib.Path(__file__).resolve().parent.parent / "acceptance.md"

# Which numbers of a row are compared: how its promise begins, what the bar is called, which of the numbers of "reached"
# and which of "allowed". Rows whose reached is the allowed itself ("within 5 %") are not drawn.
AT_MOST = [
    ("sidescan, level sand", "level, sidescan, 100-900 kHz", 0, 0),
    ("multibeam, level sand", "level, multibeam's kernels", 0, 0),
    ("multibeam head through", "level, multibeam head", 0, 0),
    ("range at which a sidescan's", "range in noise, sidescan, 100 kHz", 0, 0),
    ("range at which a sidescan's", "range in noise, sidescan, 300 kHz", 1, 0),
    ("range at which a sidescan's", "range in noise, sidescan, 900 kHz", 2, 0),
    ("range at which a multibeam", "range in noise, multibeam, 100 kHz", 0, 0),
    ("range at which a multibeam", "range in noise, multibeam, 300 kHz", 1, 0),
    ("range at which a multibeam", "range in noise, multibeam, 450 kHz", 2, 0),
    ("rigid sphere", "rigid sphere", 0, 0),
    ("rays x4", "four times the rays", 0, 0),
    ("mesh x4", "four times the mesh", 0, 0),
    ("sample rate x2", "twice the sample rate", 0, 0),
    ("terrain turned", "terrain turned with the head", 0, 0),
    ("arc of side lobes", "arc of side lobes, kernels", 0, 0),
    ("the same of a whole head", "arc of side lobes, whole head", 0, 0),
    ("tapered tone", "strength by a tapered tone", 0, 0),
    ("near field of a sidescan", "near field of a sidescan's line", 0, 0),
    ("facets unhit", "facets unhit, small objects", 0, 0),
    ("facets unhit", "facets unhit, smooth seabed", 1, 0),
    ("facets unhit", "facets unhit, rough seabed", 2, 0),
    ("Rayleigh amplitude", "Rayleigh amplitude: rejected", 0, 0),
    ("coefficient of variation", "speckle's coefficient of variation", 1, 0),
    ("decorrelates", "speckle decorrelates with movement", 0, 0),
    ("1.2 one-way beam widths", "points 0.7 beam widths apart are one", 1, 1),
    ("strips 1.2 one-way", "strips 0.7 beam widths apart are one", 2, 2),
    ("bias on a plane", "detector's bias, to 60 degrees", 0, 0),
    ("bias on a plane", "detector's bias, to 70 degrees", 1, 1),
    ("sonar-only error", "detector's error of 95 %", 0, 0),
    ("the whole head, 10-20 dB", "head's bias, to 60 degrees", 0, 0),
    ("the whole head, 10-20 dB", "head's bias, to 70 degrees", 1, 1),
    ("the whole head: standard", "head's standard deviation", 1, 0),
    ("the whole head: standard", "head's error of 95 %", 2, 1),
]
AT_LEAST = [
    ("arc of side lobes", "arc stands out, kernels", 1, 1),
    ("the same of a whole head", "arc stands out, whole head", 1, 1),
    ("rays in a resolution cell", "rays in a resolution cell", 0, 0),
    ("chirps 1.2 x", "two chirps part", 0, 0),
    ("1.2 one-way beam widths", "two points part along track", 0, 0),
    ("strips of seabed 1.2", "sidescan: two strips part across track", 0, 0),
    ("strips 1.2 x c / 2B", "sidescan's chirp: two strips part", 0, 0),
    ("strips 1.2 x c tau / 2 apart, a whole multibeam", "multibeam: two strips part", 0, 0),
    ("the same of a forward-looking", "forward-looking: two strips part", 0, 0),
    ("strips 1.2 one-way", "two strips part along track", 0, 0),
    ("cube of 0.5 m", "cubes of 0.5 m with 9 soundings", 0, 0),
    ("cube of 1 m", "cubes of 1 m with 9 soundings", 0, 0),
]


def rows():
    """(promise, numbers reached, numbers allowed) of the page's tables."""
    for line in PAGE.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("|") and len(cells) == 4:
            # Signs do not matter here, and a hyphen between digits is a range.
            yield cells[0], *([float(n) for n in re.findall(r"\d+(?:\.\d+)?(?:e-\d+)?", cell)] for cell in cells[2:])


def shares(table, used):
    """Names and how much of the tolerance each takes."""
    found = []
    for begins, name, reached, allowed in used:
        (row,) = [row for row in table if row[0].startswith(begins)]
        found.append((name, row[1][reached], row[2][allowed]))
    return found


table = list(rows())
bars = [(name, reached / allowed, "C0") for name, reached, allowed in shares(table, AT_MOST)]
bars += [(name, allowed / reached, "C1") for name, reached, allowed in shares(table, AT_LEAST)]
for name, share, _ in bars:
    print(f"{share:5.2f}  {name}")
figure, axis = plt.subplots(figsize=(9, 10), constrained_layout=True)
names, values, colours = zip(*bars)
axis.barh(range(len(bars)), values, color=colours)
for place, value in enumerate(values):
    axis.text(value + 0.01, place, f"{value:.2f}", va="center", fontsize=7)
axis.axvline(1.0, color="C3", lw=1)
axis.barh([0], [0], color="C0", label="at most: reached over allowed")
axis.barh([0], [0], color="C1", label="at least: required over reached")
axis.set_yticks(range(len(bars)), names, fontsize=8)
axis.invert_yaxis()
axis.set(xlabel="share of the tolerance", xlim=(0, 1.1))
axis.margins(y=0.01)
axis.legend(fontsize=8, loc="upper right")
axis.grid(axis="x", alpha=0.3)
save(figure, "acceptance")
