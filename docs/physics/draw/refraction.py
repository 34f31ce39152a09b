#!/usr/bin/python3
"""Draws the picture of the page on refraction from `ensonify physics ray`.

    docs/physics/draw/refraction.py build/dev/bin/ensonify-physics
"""
import matplotlib.pyplot as plt
import numpy as np

from values import physics, save


def draw():
    figure, (rays, table, smile) = plt.subplots(1, 3, figsize=(14, 4.2), constrained_layout=True)

    for degrees in (8, 10, 12, 15, 20, 30, 45, 70):
        path = physics("ray", "--until", "time", "--time-s", "0:0.26:0.004", "--depression-deg", degrees)
        shown = path["depth_m"] <= 80
        rays.plot(path["horizontal_m"][shown], path["depth_m"][shown], "C0", lw=1)
        straight = min(80 / np.tan(np.radians(degrees)), 400)
        rays.plot([0, straight], [0, straight * np.tan(np.radians(degrees))], "0.6", ls=":", lw=0.8)
    rays.plot([], [], "C0", label="through the thermocline")
    rays.plot([], [], "0.6", ls=":", label="straight")
    rays.set(xlim=(0, 400), ylim=(80, 0), xlabel="distance, m", ylabel="depth, m",
             title="Launched 8 to 70 degrees below the horizontal")

    sweep = ("--depression-deg", "3:88:0.5")
    exact, found = physics("ray", *sweep), physics("ray", "--method", "table", *sweep)
    across = np.abs(np.sin(np.radians(exact["arrival_deg"])))
    table.semilogy(exact["launch_deg"], 1e6 * np.abs(found["horizontal_m"] - exact["horizontal_m"]) * across + 1e-3,
                   label="place, across the path, µm")
    table.semilogy(exact["launch_deg"],
                   1e9 * np.abs(found["travel_time_s"] - exact["travel_time_s"]) + 1e-3, label="time, ns")
    table.axhline(1000, color="k", lw=0.8, ls="--", label="1 mm")
    table.set(xlabel="launch angle below the horizontal, degrees", ylabel="|table - exact arcs|",
              title="Error of the table at 80 m depth")

    nadir = np.arange(0, 67, 3)
    depth, gradient, speed = 50, 0.05, 1500
    for sign, colour in ((1, "C0"), (-1, "C1")):
        water = ("--water", "linear", "--gradient-per-s", sign * gradient)
        errors = []
        for angle in nadir:
            time = physics("ray", *water, "--depression-deg", 90 - angle, "--target-depth-m",
                           depth)["travel_time_s"][0]
            seen = physics("ray", "--water", "linear", "--gradient-per-s", 0, "--until", "time", "--time-s",
                           f"{time:.12g}", "--depression-deg", 90 - angle)["depth_m"][0]
            errors.append(seen - depth)
        theory = sign * gradient * depth**2 / (2 * speed) * (np.tan(np.radians(nadir))**2 - 1)
        smile.plot(nadir, errors, f"{colour}o", ms=4, label=f"kernel, {sign * gradient:+} 1/s")
        smile.plot(nadir, theory, colour, lw=1, label="closed form")
    smile.set(xlabel="beam angle from the vertical, degrees", ylabel="depth error, m",
              title="Flat seabed at 50 m, gradient not applied")
    save(figure, "refraction")


draw()
