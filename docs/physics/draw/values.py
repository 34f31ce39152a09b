"""What the drawing scripts share: values from `ensonify physics`, panels, small files."""
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


def physics(*words):
    """The numeric columns that one call prints, as arrays. The program is the script's first argument."""
    done = subprocess.run([sys.argv[1], *map(str, words)], capture_output=True, text=True, check=True)
    rows = list(csv.DictReader(io.StringIO(done.stdout)))
    columns = {}
    for name in rows[0]:
        try:
            columns[name] = np.array([float(row[name]) for row in rows])
        except ValueError:
            continue  # a choice
    return columns


def save(figure, name):
    for axis in figure.axes:
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    drawn = io.BytesIO()
    figure.savefig(drawn, dpi=80, metadata={"Software": None})
    plt.close(figure)
    # 64 colours are plenty, and a third of the bytes.
    Image.open(drawn).convert("RGB").quantize(64).save(PICTURES / f"{name}.png", optimize=True)
