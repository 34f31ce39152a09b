#!/usr/bin/python3
"""Draws how soon pings decorrelate (docs/physics/acoustics/echo.md) from two pings of a head, beside theory.

    docs/physics/draw/speckle.py build/dev/tests/experiments
"""
import sys

import matplotlib.pyplot as plt

from values import save, table

if __name__ == "__main__":
    data = table(sys.argv[1], "decorrelation")
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
