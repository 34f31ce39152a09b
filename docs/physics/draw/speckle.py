#!/usr/bin/python3
"""Draws how soon pings decorrelate (docs/physics/acoustics/echo.md) from what the test of heads prints, beside theory.

    docs/physics/draw/speckle.py build/dev/tests/acoustics_speckle_test
"""
import subprocess
import sys

import matplotlib.pyplot as plt

from values import columns, save

if __name__ == "__main__":
    done = subprocess.run([sys.argv[1], "[.speckle-csv]"], capture_output=True, text=True, check=True)
    lines = [line for line in done.stdout.splitlines() if line.count(",") == 3]
    data = columns("\n".join(sorted(lines, key=lambda line: line[0].isdigit())))
    figure, axes = plt.subplots(1, 3, figsize=(11, 4), constrained_layout=True, sharey=True)
    for axis, kind, title, moved in ((axes[0], 0, "sidescan, 0.5°, 15-100 m", "moved along the track / length of the line"),
                                     (axes[1], 2, "multibeam, 1°, 43-60°", "moved along the track / length of the line"),
                                     (axes[2], 1, "sidescan, 100 µs", "moved across the track, m")):
        chosen = data["kind"] == kind
        axis.plot(data["moved"][chosen], data["theory"][chosen], "C2", label="theory")
        axis.plot(data["moved"][chosen], data["correlation"][chosen], "ko", ms=4, label="simulated")
        axis.set(title=title, xlabel=moved)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    axes[0].set(ylabel="correlation of the powers of two pings", ylim=(-0.1, 1.05))
    save(figure, "echo_decorrelation")
