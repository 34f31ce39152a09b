#!/usr/bin/python3
"""Draws the pictures of docs/physics/seabed/backscatter.md, surface.md and materials.md from `ensonify physics`, beside the
numbers that they are checked by.

    docs/physics/draw/scattering.py build/dev/bin/ensonify-physics
"""
import matplotlib.pyplot as plt
import numpy as np

from values import physics, save

SEDIMENTS = ["rough-rock", "rock", "cobble", "sandy-gravel", "very-coarse-sand", "coarse-sand", "medium-sand",
             "fine-sand", "very-fine-sand", "coarse-silt", "medium-silt", "fine-silt", "silty-clay", "clay"]
COLOURS = plt.get_cmap("turbo_r")(np.linspace(0.04, 0.96, len(SEDIMENTS)))
EVERY_DEGREE = ["--grazing-deg", "0.5:90:0.25"]


def panels(columns, width, height, **more):
    return plt.subplots(1, columns, figsize=(width, height), constrained_layout=True, **more)


def label(axis, title):
    axis.set(xlim=(0, 90), xlabel="grazing angle, deg", title=title)
    axis.grid(alpha=0.3)


def draw_sediments():
    checks = {  # an independent implementation at 100 kHz: dB at 10, 30, 45, 60 and 90 degrees
        "rough-rock": (-8.8, -4.9, -4.0, -3.8, -4.2), "cobble": (-21.1, -13.7, -12.3, -11.7, -11.3),
        "coarse-sand": (-27.2, -20.1, -18.9, -17.1, -10.8), "medium-sand": (-29.8, -22.6, -21.3, -19.4, -9.8),
        "clay": (-36.4, -30.1, -28.4, -27.4, -10.6)}
    figure, axes = panels(2, 12, 6, sharey=True)
    for axis, frequency_hz in zip(axes, (100e3, 300e3)):
        for sediment, colour in zip(SEDIMENTS, COLOURS):
            curve = physics("backscatter", "--sediment", sediment, "--frequency-hz", frequency_hz, *EVERY_DEGREE)
            axis.plot(curve["grazing_deg"], curve["total_db"], color=colour, lw=1.2, label=sediment)
        diffuser = -4.97 + 20 * np.log10(np.sin(np.radians(curve["grazing_deg"])))
        axis.plot(curve["grazing_deg"], diffuser, "k:", lw=1, label="perfect diffuser")
        label(axis, f"{frequency_hz / 1e3:g} kHz" + (", extrapolated" if frequency_hz > 100e3 else ""))
    for sediment, values in checks.items():
        axes[0].plot([10, 30, 45, 60, 90], values, "k.", ms=7, clip_on=False, zorder=3,
                     label="check values" if sediment == "clay" else None)
    axes[0].set(ylim=(-55, 5), ylabel="backscatter strength, dB re 1 m² per m²")
    axes[0].legend(fontsize=7, ncol=2, loc="lower right")
    save(figure, "backscatter_sediments")


def draw_table_3():
    degrees = [10, 20, 40, 60, 80, 90]
    printed = {30e3: (-35.4, -28.3, -23.5, -21.2, -10.8, -3.1), 100e3: (-29.8, -24.2, -21.7, -19.5, -12.2, -9.7)}
    parts = {"kirchhoff_db": "Kirchhoff", "composite_db": "composite roughness", "volume_db": "volume"}
    figure, axes = panels(2, 12, 4.5, sharey=True)
    for axis, (frequency_hz, values) in zip(axes, printed.items()):
        curve = physics("backscatter", "--sediment", "medium-sand", "--sound-speed-mps", 1528, "--frequency-hz",
                        frequency_hz, *EVERY_DEGREE)
        for column, name in parts.items():
            axis.plot(curve["grazing_deg"], curve[column], "--", lw=0.9, label=name)
        axis.plot(curve["grazing_deg"], curve["total_db"], "k", lw=1.3, label="total")
        axis.plot(degrees, values, "C3o", ms=5, clip_on=False, zorder=3, label="report, table 3")
        label(axis, f"medium sand, {frequency_hz / 1e3:g} kHz, 1528 m/s")
    axes[0].set(ylim=(-60, 0), ylabel="dB")
    axes[0].legend(fontsize=8, loc="upper left")
    save(figure, "backscatter_table_3")


def draw_table_error():
    frequencies_hz = np.geomspace(10e3, 1000e3, 21)
    figure, axis = panels(1, 9, 4.5)
    for sediment, colour in zip(SEDIMENTS, COLOURS):
        worst = []
        for frequency_hz in frequencies_hz:
            curve = physics("backscatter", "--sediment", sediment, "--frequency-hz", frequency_hz, "--grazing-deg",
                            "0:90:0.05")
            worst.append(np.abs(curve["table_db"] - curve["total_db"]).max())
        axis.semilogx(frequencies_hz / 1e3, worst, ".-", color=colour, lw=0.9, label=sediment)
    axis.axhline(0.1, color="C3", ls="--", label="allowed")
    axis.set(xlabel="frequency, kHz", ylabel="greatest error over 0-90°, dB", ylim=(0, 0.11),
             title="Look-up table against the law, 1801 angles")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=7, ncol=3)
    save(figure, "backscatter_table_error")


def draw_facets():
    """A plane's law, and what facets tilted at random return with that law and with their own."""
    rng = np.random.default_rng(1)
    cases = (("medium-silt", 300e3, 2.604), ("coarse-sand", 100e3, 9.447))  # posts of 0.1 m: atan sqrt(2 C^2 d^-0.75)
    figure, axes = panels(2, 12, 4.5, sharey=True)
    for axis, (sediment, frequency_hz, slope_deg) in zip(axes, cases):
        curve = physics("backscatter", "--sediment", sediment, "--frequency-hz", frequency_hz, "--facet-slope-deg", slope_deg,
                        "--grazing-deg", "0:90:0.25")
        east, north = rng.normal(0, np.tan(np.radians(slope_deg)) / np.sqrt(2), (2, 20000))
        area = np.sqrt(1 + east**2 + north**2)

        def tilted(column):
            degrees = np.arange(2, 90.1, 2)
            sums = []
            for theta in np.radians(degrees):
                sine = np.clip((np.sin(theta) - east * np.cos(theta)) / area, -1, 1)
                level = np.interp(np.degrees(np.arcsin(sine)), curve["grazing_deg"], curve[column])
                sums.append(10 * np.log10(np.mean(np.where(sine > 0, area * 10 ** (0.1 * level), 0))))
            return degrees, sums

        axis.plot(curve["grazing_deg"], curve["total_db"], "k", lw=1.3, label="plane")
        axis.plot(curve["grazing_deg"], curve["facets_db"], "C0", lw=1, label="law of a facet")
        axis.plot(*tilted("total_db"), "C3x", ms=5, label="facets with the plane's law: counted twice")
        axis.plot(*tilted("facets_db"), "C0o", ms=4, mfc="none", label="facets with their own")
        label(axis, f"{sediment.replace('-', ' ')}, {frequency_hz / 1e3:g} kHz, facets of {slope_deg:.1f}° rms")
    axes[0].set(ylim=(-50, 0), ylabel="backscatter strength, dB re 1 m² per m²")
    axes[0].legend(fontsize=8, loc="upper left")
    save(figure, "backscatter_facets")


def draw_surface():
    read_off = {15e3: [(3.5, 20, -47.0, -45.0)], 70e3: [(8, 30, -26.0, -22.0), (8, 60, -21.0, -17.0)]}
    figure, axes = panels(3, 14, 5, sharey=True)
    for axis, frequency_hz in zip(axes, (15e3, 70e3, 300e3)):
        for i, wind_mps in enumerate((1, 3.5, 5, 8, 12, 18)):
            curve = physics("surface", "--frequency-hz", frequency_hz, "--wind-speed-mps", wind_mps, *EVERY_DEGREE)
            axis.plot(curve["grazing_deg"], curve["total_db"], color=f"C{i}", lw=1.1, label=f"{wind_mps} m/s")
        for wind_mps, degrees, low_db, high_db in read_off.get(frequency_hz, []):
            axis.plot([degrees, degrees], [low_db, high_db], "k_-", ms=8, lw=2, zorder=3)
            axis.annotate(f"figure, {wind_mps} m/s", (degrees, high_db), (degrees - 2, high_db), fontsize=8, ha="right")
        label(axis, f"{frequency_hz / 1e3:g} kHz" + (", extrapolated" if frequency_hz > 100e3 else ""))
    axes[0].set(ylim=(-70, 12), ylabel="backscatter strength, dB re 1 m² per m²")
    axes[0].legend(fontsize=8, loc="upper left", title="wind")
    save(figure, "surface_backscatter")


def draw_materials():
    figure, axis = panels(1, 9, 4.5)
    for material in ("rigid", "metal", "concrete", "wood"):
        curve = physics("material", "--material", material, *EVERY_DEGREE)
        axis.plot(curve["grazing_deg"], curve["total_db"], lw=1.2, label=material)
    axis.plot(curve["grazing_deg"], -4.97 + 20 * np.log10(np.sin(np.radians(curve["grazing_deg"]))), "k:", lw=1,
              label="perfect diffuser")
    label(axis, "Materials of objects")
    axis.set(ylim=(-60, 12), ylabel="dB re 1 m² per m²")
    axis.legend(fontsize=8, loc="upper left")
    save(figure, "materials")


draw_sediments()
draw_table_3()
draw_table_error()
draw_facets()
draw_surface()
draw_materials()
