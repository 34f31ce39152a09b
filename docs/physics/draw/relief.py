#!/usr/bin/python3
"""Draws the pictures of docs/physics/seabed from `ensonify physics relief`: every layer, lit from the north-west.

    docs/physics/draw/relief.py build/dev/bin/ensonify-physics
"""

import matplotlib.pyplot as plt
import numpy as np

import values  # noqa: E402
from values import physics, save  # noqa: E402

POSTS = 400


def heights(layer, spacing_m, *more):
    sweep = f"0:{(POSTS - 1) * spacing_m:.6g}:{spacing_m}"
    found = physics("relief", "--layer", layer, "--spacing-m", spacing_m, "--north-m", sweep, "--east-m", sweep, *more)
    return found["elevation_m"].reshape(POSTS, POSTS)


def show(axis, z, spacing_m, title):
    north, east = np.gradient(z, spacing_m)
    exaggeration = 0.35 / np.sqrt(np.mean(north**2 + east**2))  # the same contrast for all
    x, y = exaggeration * east, exaggeration * north
    light = np.array([-1.0, 1.0, 1.4]) / np.linalg.norm([1.0, 1.0, 1.4])
    shade = (-x * light[0] - y * light[1] + light[2]) / np.sqrt(1 + x**2 + y**2)
    side = POSTS * spacing_m
    axis.imshow(shade, cmap="gray", origin="lower", extent=(0, side, 0, side), vmin=0, vmax=1)
    axis.set_title(f"{title}\n{z.min():.2f} to {z.max():.2f} m, slopes × {exaggeration:.2g}", fontsize=9)
    axis.tick_params(labelsize=7)


def draw(name, panels):
    figure, axes = plt.subplots(1, len(panels), figsize=(4.2 * len(panels), 4.6), constrained_layout=True)
    for axis, (title, layer, spacing_m, more) in zip(np.atleast_1d(axes), panels):
        show(axis, heights(layer, spacing_m, *more), spacing_m, title)
    save(figure, name)


draw("spectral", [
    ("H = 0.3, outer scale 40 m", "spectral", 0.1, ("--hurst", 0.3, "--outer-scale-m", 40)),
    ("H = 0.625, outer scale 40 m", "spectral", 0.1, ("--outer-scale-m", 40)),
    ("H = 0.625, 40 m down to 4 m", "spectral", 0.1, ("--outer-scale-m", 40, "--inner-scale-m", 4))])
draw("multifractal", [
    ("intermittency 0", "multifractal", 0.25, ("--intermittency", 0, "--outer-scale-m", 150, "--rms-m", 1.5)),
    ("intermittency 0.3", "multifractal", 0.25, ("--intermittency", 0.3, "--outer-scale-m", 150, "--rms-m", 1.5)),
    ("the same with sand between", "outcrops", 0.25, ("--intermittency", 0.3, "--outer-scale-m", 150, "--rms-m", 1.5,
                                                      "--fill-m", -0.2))])
draw("ripples", [
    ("disorder 0.1", "ripples", 0.1, ("--disorder", 0.1, "--lee-fraction", 0.35)),
    ("disorder 0.4", "ripples", 0.1, ("--disorder", 0.4, "--lee-fraction", 0.35)),
    ("disorder 1", "ripples", 0.1, ("--disorder", 1, "--lee-fraction", 0.35))])
draw("bodies", [
    ("boulders", "boulders", 0.1, ("--per-km2", 40000, "--smallest-radius-m", 0.3, "--largest-radius-m", 2)),
    ("coral mounds", "mounds", 0.25, ("--per-km2", 4000, "--smallest-radius-m", 2, "--largest-radius-m", 12)),
    ("pockmarks", "pockmarks", 0.25, ("--per-km2", 2500, "--smallest-radius-m", 2, "--largest-radius-m", 8))])
draw("trawl", [
    ("trawl scars", "trawl", 1.0, ("--per-km2", 60, "--heading-deg", 70, "--height-m", 0.2))])
