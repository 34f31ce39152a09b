"""What the drawing scripts share: the columns that a program prints, and small files. Importing it chooses a backend
that needs no window."""
import csv
import io
import pathlib
import subprocess
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

PICTURES = pathlib.Path(__file__).resolve().parent.parent / "pictures"


def columns(text):
    """The numeric columns of CSV with a header, as arrays."""
    rows = list(csv.DictReader(io.StringIO(text)))
    found = {}
    for name in rows[0]:
        try:
            found[name] = np.array([float(row[name]) for row in rows])
        except ValueError:
            continue  # names, such as that of a law
    return found


def table(program, experiment):
    """The columns of one of tests/physics/experiments.cpp."""
    return columns(subprocess.run([program, experiment], capture_output=True, text=True, check=True).stdout)


def physics(*words):
    """The columns of one call of `ensonify physics`, which is the script's last argument."""
    if len(sys.argv) < 2:
        sys.exit(f"{sys.argv[0]}: give the program, such as build/dev/bin/ensonify-physics")
    done = subprocess.run([sys.argv[-1], *map(str, words)], capture_output=True, text=True, check=True)
    return columns(done.stdout)


def save(figure, name):
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=90)
    plt.close(figure)
    # 64 colours are plenty, and a third of the bytes.
    Image.open(drawn).convert("RGB").quantize(64).save(PICTURES / f"{name}.png", optimize=True)
