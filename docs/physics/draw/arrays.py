#!/usr/bin/python3
"""Draws the pictures of docs/physics/acoustics/arrays.md from `ensonify physics`, beside the formulas that they are checked by.

    docs/physics/draw/arrays.py build/dev/bin/ensonify-physics
"""
import matplotlib.pyplot as plt
import numpy as np

from values import physics, save

WAVES = 64.0  # the verb's default line: 128 elements of half a wavelength


def panels(rows, height, **more):
    return plt.subplots(rows, 1, figsize=(9, height), constrained_layout=True, **more)


def draw_shading():
    expected = {  # window: (half-power width in degrees lambda / L, highest side lobe in dB)
        "uniform": (50.76, -13.26), "hann": (81.9, -31.5), "hamming": (75.0, -42.6), "dolph-chebyshev": (61.0, -30.0),
        "taylor": (64.4, -30.3)}
    figure, axes = panels(5, 11, sharex=True)
    for axis, (window, (width_deg, side_lobe_db)) in zip(axes, expected.items()):
        beam = physics("pattern", "--shading", window, "--angle-deg", "-8:8:0.005")
        u = np.sin(np.radians(beam["angle_deg"])) * WAVES
        axis.plot(u, beam["pattern_db"], lw=0.9, label=f"{window}, kernel")
        axis.axhline(side_lobe_db, color="C3", ls="--", lw=0.8, label=f"side lobe {side_lobe_db} dB")
        half = 0.5 * np.radians(width_deg)
        axis.plot([-half, half], [-3.01, -3.01], "k|", ms=14, label=f"half power {width_deg}° λ/L")
        axis.set(ylim=(-70, 3), ylabel="dB", xlim=(-8, 8))
        axis.grid(alpha=0.3)
        axis.legend(loc="upper right", fontsize=8)
    axes[-1].set_xlabel("sin(angle) × L/λ")
    figure.suptitle("Patterns of 128 shaded elements, 64 λ long")
    save(figure, "arrays_shading")


def draw_steering():
    steer = np.arange(-85.0, 85.5, 1.0)
    beam = physics("pattern", "--steer-deg", "-85:85:1")
    kernel = beam["upper_edge_deg"] - beam["lower_edge_deg"]
    sine = np.sin(np.radians(steer))
    exact = np.degrees(np.arcsin(np.minimum(1, sine + 0.44295 / WAVES)) - np.arcsin(np.maximum(-1, sine - 0.44295 / WAVES)))
    cosine = 50.76 / WAVES / np.cos(np.radians(steer))
    figure, (width, error) = panels(2, 6, sharex=True)
    width.plot(steer, exact, label="asin(sin β ± 0.44295 λ/L)")
    width.plot(steer, cosine, "--", label="50.76° λ/L / cos β")
    width.plot(steer[::5], kernel[::5], "k.", label="kernel")
    width.set(ylabel="half-power width, deg", ylim=(0, 8))
    error.plot(steer, 100 * (kernel / exact - 1), "k.", ms=3, label="kernel over exact")
    error.plot(steer, 100 * (cosine / exact - 1), "C1--", label="1/cos β over exact")
    error.set(ylabel="difference, %", xlabel="steered to, deg", ylim=(-4, 1))
    for axis in (width, error):
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.suptitle("Half-power width of a steered line, 64 λ long")
    save(figure, "arrays_steering")


def fresnel_loss_db(v):
    """20 log10 |C(v) - i S(v)| / v by the midpoint rule."""
    t = (np.arange(20000) + 0.5) / 20000 * v[:, None]
    return 20 * np.log10(np.abs(np.exp(-0.5j * np.pi * t**2).mean(axis=1)))


def draw_near_field():
    near_m = 0.32**2 / 0.005  # L^2 / lambda of the default line
    ranges = near_m * np.logspace(-1.3, 1, 60)
    loss = np.array([physics("pattern", "--range-m", r)["pattern_db"][0] for r in ranges])
    figure, (axis, across) = panels(2, 7.5)
    axis.semilogx(ranges / near_m, fresnel_loss_db(np.sqrt(near_m / (2 * ranges))), label="|C(v) − iS(v)|/v, v = L/√(2λR)")
    axis.semilogx(ranges / near_m, loss, "k.", ms=4, label="kernel, unfocused")
    axis.set(xlabel="range × λ/L²", ylabel="axis, dB", ylim=(-20, 1))
    for part, colour in ((1.0, "C0"), (0.25, "C1"), (0.1, "C2")):
        beam = physics("pattern", "--range-m", near_m * part, "--angle-deg", "-6:6:0.01")
        across.plot(beam["angle_deg"], beam["pattern_db"], colour, lw=0.9, label=f"unfocused, {part} L²/λ")
    beam = physics("pattern", "--range-m", 0.1 * near_m, "--focus-m", 0.1 * near_m, "--angle-deg", "-6:6:0.01")
    across.plot(beam["angle_deg"], beam["pattern_db"], "k", lw=0.9, label="focused, 0.1 L²/λ")
    across.set(xlabel="angle, deg", ylabel="dB", ylim=(-40, 2), xlim=(-6, 6))
    for each in (axis, across):
        each.grid(alpha=0.3, which="both")
        each.legend(fontsize=8)
    figure.suptitle("A uniform line in its near field")
    save(figure, "arrays_near_field")


def draw_sectors():
    figure, axis = panels(1, 4)
    for centre, colour in ((-45, "C0"), (0, "C1"), (45, "C2")):
        width = 60 if centre == 0 else 30
        beam = physics("pattern", "--aperture", "sector", "--steer-deg", centre, "--sector-width-deg", width,
                       "--angle-deg", "-90:90:0.1")
        axis.plot(beam["angle_deg"], beam["pattern_db"], colour, lw=1)
        for edge in (centre - width / 2, centre + width / 2):
            axis.axvline(edge, color=colour, ls=":", lw=0.8)
    axis.axhline(-6.02, color="k", ls="--", lw=0.8, label="−6.02 dB at the edges (dotted)")
    axis.axhline(-50, color="C3", ls="--", lw=0.8, label="−50 dB beyond the roll-off")
    axis.set(xlabel="angle, deg", ylabel="dB", ylim=(-80, 3), xlim=(-90, 90))
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8, loc="lower center")
    figure.suptitle("Three transmit sectors, roll-off 0.2 in sine (36 elements)")
    save(figure, "arrays_sectors")


def draw_stabilisation():
    figure, (angle, error) = panels(2, 6.5, sharex=True)
    common = ["stabilisation", "--sensor-error-deg", 0.05, "--latency-s", 0.02, "--time-s", "0:12:0.02"]
    for words, colour, label in (((), "C0", "stabilised"), (("--roll-stabilised", "no"), "C1", "not stabilised")):
        edge = physics(*common, *words)
        angle.plot(edge["time_s"], edge["true_across_deg"], colour, label=label)
    held = physics(*common)
    error.plot(held["time_s"], held["error_deg"], "C0", label="kernel")
    for sign in (-1, 1):
        error.axhline(sign * held["bound_deg"][0], color="C3", ls="--", lw=0.9,
                      label="± (sensor error + latency × roll rate)" if sign > 0 else None)
    angle.set(ylabel="true angle of the 65° edge, deg")
    error.set(ylabel="error, deg", xlabel="time, s", ylim=(-0.4, 0.4))
    for axis in (angle, error):
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8, loc="upper right")
    figure.suptitle("Roll ±10° in 6 s, sensor error 0.05°, latency 20 ms")
    save(figure, "arrays_stabilisation")


if __name__ == "__main__":
    for draw in (draw_shading, draw_steering, draw_near_field, draw_sectors, draw_stabilisation):
        draw()
