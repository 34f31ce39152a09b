#!/usr/bin/python3
"""Writes the casts of this folder: waters that behave as measured ones do (README.md), made of smooth steps.

    scenarios/casts/make.py [FOLDER]
"""
import math
import pathlib
import sys


def step(depth_m, at_m, width_m):
    """From 0 to 1, three quarters of it within width_m of at_m."""
    return 0.5 * (1 + math.tanh((depth_m - at_m) / width_m))


# name: what it is, greatest depth and distance of samples in m, temperature in deg C and salinity by depth in m
CASTS = {
    "mixed": ("a shallow tropical gulf, stirred by tides", 20, 5, lambda z: 28.0, lambda z: 34.0),
    "summer_thermocline": ("an estuary's mouth in August, warm above 7 m", 22, 1,
                           lambda z: 18.3 - 4.6 * step(z, 7, 2.0) - 2.1 * step(z, 15, 4), lambda z: 31.3),
    "salt_wedge": ("the sea below a river's water", 54, 1,
                   lambda z: 17.8 - 0.3 * step(z, 13, 4), lambda z: 26.1 + 4.6 * step(z, 13, 4.5)),
    "cold_mid_layer": ("winter's water left between a warm surface and a salty depth", 264, 4,
                       lambda z: 20.9 - 5.3 * step(z, 25, 16) - 0.5 * step(z, 60, 30) - 0.4 * step(z, 200, 50),
                       lambda z: 37.4 + 1.1 * step(z, 120, 50)),
    "deep_channel": ("a warm ocean with the sound channel at 800 m", 2000, 10,
                     lambda z: 24.2 - 6.5 * step(z, 110, 24) - 13.9 * step(z, 385, 250),
                     lambda z: 35.2 - 0.9 * step(z, 250, 80)),
}


def text(name):
    what, deepest_m, every_m, temperature, salinity = CASTS[name]
    lines = [f"# {what}; made by make.py", "depth_m,temperature_degc,salinity_psu"]
    lines += [f"{z},{temperature(z):.3f},{salinity(z):.3f}" for z in range(0, deepest_m + 1, every_m)]
    return "\n".join(lines) + "\n"


def main() -> None:
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    folder = folder if folder.is_dir() else folder.parent
    for name in CASTS:
        (folder / f"{name}.csv").write_text(text(name), encoding="utf-8")


if __name__ == "__main__":
    main()
