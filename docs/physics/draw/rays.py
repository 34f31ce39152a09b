#!/usr/bin/python3
"""Draws the picture of docs/physics/acoustics/rays.md from one ping over boulders.

    docs/physics/draw/rays.py build/dev/tests/experiments
"""
import sys

import matplotlib.pyplot as plt
import numpy as np

from values import save, table

NULL, TENTH, HEAD_M, RESOLUTION_M = 1 / 50, 0.738 / 50, (0.1, 0.2), 0.075

if __name__ == "__main__":
    rays = table(sys.argv[1], "rays")
    main = np.abs(rays["sine"]) < NULL
    figure, axes = plt.subplots(4, 1, figsize=(9, 13), constrained_layout=True)

    axis = axes[0]
    axis.hist(rays["across_deg"], bins=np.arange(-68, 68.1, 0.5), weights=np.full(main.size, 2.0), color="0.8",
              label="all rays")
    axis.hist(rays["across_deg"][main], bins=np.arange(-68, 68.1, 0.5), weights=np.full(main.sum(), 2.0), color="C0",
              label="in the main lobe")
    axis.set(xlabel="angle across-track, degrees (starboard positive)", ylabel="rays per degree", xlim=(-68, 68))
    axis.legend()

    axis = axes[1]
    inside = (np.abs(rays["sine"]) < TENTH) & (rays["across_deg"] > 0)
    edges = np.arange(19, 50, RESOLUTION_M)
    counts, _ = np.histogram(rays["range_m"][inside], edges)
    axis.step(edges[:-1], counts, where="post", lw=0.8)
    axis.axhline(10, color="C3", ls="--", label="10, asked for")
    axis.set(xlabel="slant range, m (starboard half)", ylabel="rays per range cell of 7.5 cm\nwithin -10 dB along-track",
             yscale="log", ylim=(1, None))
    axis.legend()
    axis.grid(alpha=0.3)

    axis = axes[2]
    axis.scatter(rays["east_m"], rays["north_m"] - HEAD_M[1], s=0.2, c=np.where(main, "C0", "0.6"), linewidths=0)
    axis.set(xlabel="across-track, m", ylabel="along-track, m", ylim=(-3, 3), xlim=(-50, 50),
             title="places that rays hit; blue: main lobe; gaps: shadows of boulders")

    # The tallest thing in the main lobe, from the side.
    axis = axes[3]
    aside = main & (np.abs(rays["east_m"]) > 12) & (np.abs(rays["east_m"]) < 40)
    smooth = -20.0
    top = rays["east_m"][aside][np.argmax(rays["up_m"][aside] - smooth)]
    near = main & (np.abs(rays["east_m"] - top) < 5)
    axis.scatter(rays["east_m"][near], rays["up_m"][near], s=2, linewidths=0)
    order = np.argsort(rays["east_m"][near])
    east, up = rays["east_m"][near][order], rays["up_m"][near][order]
    last = np.argmax(np.diff(east))  # the last hit before the shadow
    axis.plot([HEAD_M[0] + (east[last] - HEAD_M[0]) * f for f in (0, 2)], [up[last] * f for f in (0, 2)], "C1:", lw=1,
              label="line of sight past its edge")
    axis.set(xlabel="across-track, m", ylabel="up, m", xlim=(top - 5, top + 5),
             ylim=(rays["up_m"][near].min() - 0.3, rays["up_m"][near].max() + 0.3), aspect="equal",
             title="a boulder and its shadow: hits in the main lobe, seen from aft")
    axis.legend(loc="upper right")
    save(figure, "rays")
