#!/usr/bin/python3
"""Draws the pictures of docs/physics/acoustics/echo.md, multipath.md and gain.md from experiments with the echo kernel and `ensonify physics`, beside theory.

    docs/physics/draw/echo.py build/dev/tests/experiments build/dev/bin/ensonify-physics
"""
import sys

import matplotlib.pyplot as plt
import numpy as np

from values import physics, save, table

SPEED_MPS, PULSE_S = 1500.0, 100e-6


def finish(figure, name):
    for axis in figure.axes:
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    save(figure, name)


def multibeam_peak_db(angle_rad, length=50.76, depth_m=20.0, alpha=0.07):
    """Peak level of a beam of 1 x 1 degree over a Lambert seabed of -25 dB, SL 220: the area integral along sine."""
    axis = np.sin(angle_rad)
    sine = np.linspace(max(axis - 0.3, -0.995), min(axis + 0.3, 0.995), 60001)
    cosine = np.sqrt(1 - sine ** 2)
    range_m = depth_m / cosine
    per_sine = (np.sinc(length * (sine - axis)) ** 2 * 10 ** -2.5 * cosine ** 2 * range_m ** -4
                * 10 ** (-0.2 * alpha * range_m) * range_m / length * depth_m / cosine ** 3)
    order = np.argsort(range_m)
    energy = np.concatenate([[0], np.cumsum(per_sine[order]) * (sine[1] - sine[0])])
    starts = np.searchsorted(range_m[order], range_m[order] - 0.5 * SPEED_MPS * PULSE_S)
    return 220 + 10 * np.log10((energy[1:] - energy[starts]).max())


def sidescan_db(range_m, depth_m=10.0, alpha=0.1):
    """SL 210, the same 0.5 degree line both ways, Lambert -25 dB: exact strip between the pulse's two edges."""
    width = 2 / 3 * np.sin(np.radians(0.25)) / 0.442946
    edges = range_m[:, None] + np.array([-0.25, 0.25]) * SPEED_MPS * PULSE_S
    ground = np.sqrt(np.maximum(edges ** 2 - depth_m ** 2, 0))
    area = range_m * width * (ground[:, 1] - ground[:, 0])
    return (210 - 40 * np.log10(range_m) - 2 * alpha * range_m - 25 + 20 * np.log10(depth_m / range_m)
            + 10 * np.log10(area))


def draw_levels():
    data = table(sys.argv[1], "levels")
    figure, axes = plt.subplots(2, 2, figsize=(10, 7), constrained_layout=True, height_ratios=[3, 1], sharex="col")
    for column, (head, name, reference) in enumerate(((0, "beam angle, degrees", multibeam_peak_db),
                                                      (1, "slant range, m", sidescan_db))):
        x, level = data["axis"][data["head"] == head], data["level_db"][data["head"] == head]
        exact = np.array([reference(np.radians(a)) for a in x]) if head == 0 else reference(x)
        axes[0, column].plot(x, exact, "C2", label="area integral")
        axes[0, column].plot(x, level, "k.", label="simulated mean")
        axes[1, column].plot(x, level - exact, "k.-", ms=4, lw=0.8, label="difference")
        axes[1, column].set(xlabel=name, ylabel="dB", ylim=(-0.5, 0.5))
        print(name, "largest difference", np.abs(level - exact).max().round(3), "dB")
    axes[0, 0].set(title="multibeam, 1 x 1°, 20 m: peak of each beam", ylabel="dB re 1 µPa²")
    axes[0, 1].set(title="sidescan, 0.5°, 10 m: mean level", ylabel="dB re 1 µPa²")
    finish(figure, "echo_levels")


def draw_speckle():
    data = table(sys.argv[1], "speckle")
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    moved, coherence = data["x"][data["kind"] == 0], data["y"][data["kind"] == 0]
    axes[0].plot(moved, np.clip(1 - 2 * moved, 0, None), "C2", label="1 - 2d/L")
    axes[0].plot(moved, coherence, "ko", ms=4, label="simulated, 40 seabeds")
    axes[0].set(xlabel="displacement along-track / transmit length", ylabel="coherence of two pings", ylim=(0, 1.05))
    amplitude, share = data["x"][data["kind"] == 1], data["y"][data["kind"] == 1]
    axes[1].plot(amplitude, 1 - np.exp(-amplitude ** 2), "C2", lw=3, alpha=0.6, label="Rayleigh")
    axes[1].plot(amplitude, share, "k", lw=0.9, label=f"simulated, {9 * len(share)} amplitudes")
    axes[1].set(xlabel="amplitude / rms", ylabel="share below")
    finish(figure, "echo_speckle")


def draw_pattern():
    line = ("pattern", "--elements=100", "--spacing-m=0.0025", f"--steer-deg={np.degrees(np.arcsin(0.3))}",
            "--angle-deg=-78:78:0.05")
    figure, axis = plt.subplots(figsize=(10, 4.5), constrained_layout=True)
    for shading, label in (("uniform", "uniform, 100 elements"), ("taylor", "Taylor 30 dB")):
        data = physics(*line, f"--shading={shading}")
        axis.plot(np.sin(np.radians(data["angle_deg"])), data["pattern_db"], lw=0.9, label=label)
    axis.axhline(-13.26, color="k", ls=":", lw=0.8, label="-13.26 dB")
    axis.set(xlabel="sine of beam axis", ylabel="dB", ylim=(-80, 3), title="all beams, one echo from sine 0.3")
    finish(figure, "echo_pattern")


def draw_pulses():
    def envelope(*words):
        return physics("pulse", "--time-s=-150e-6:150e-6:0.25e-6", *words)

    chirp = ("--pulse=chirp", "--pulse-length-s=2e-3", "--bandwidth-hz=50e3", "--dynamic-range-db=60")
    tone = envelope()
    data = {"time_s": tone["time_s"], "tone": tone["envelope"], "tapered": envelope("--tapered-fraction=0.5")["envelope"],
            "chirp": envelope(*chirp)["envelope"], "hann": envelope(*chirp, "--window=hann")["envelope"]}
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    time_us = 1e6 * data["time_s"]
    axes[0].plot(time_us, data["tone"], label="tone, 100 µs")
    axes[0].plot(time_us, data["tapered"], label="Tukey 0.5")
    axes[0].set(ylabel="envelope")
    x = np.pi * 50e3 * data["time_s"] + 1e-12
    theory = np.abs(np.sin(x * (1 - np.abs(data["time_s"]) / 2e-3)) / x)
    axes[1].plot(time_us, 20 * np.log10(theory + 1e-9), "C2", lw=3, alpha=0.5, label="theory, no window")
    axes[1].plot(time_us, 20 * np.log10(np.abs(data["chirp"]) + 1e-9), "k", lw=0.8, label="chirp 50 kHz, 2 ms")
    axes[1].plot(time_us, 20 * np.log10(np.abs(data["hann"]) + 1e-9), "C1", lw=0.8, label="the same, Hann")
    axes[1].axhline(-13.26, color="k", ls=":", lw=0.8)
    axes[1].set(ylabel="dB", ylim=(-65, 2))
    for axis in axes:
        axis.set(xlabel="time after arrival, µs")
    finish(figure, "echo_pulses")


def draw_multipath():
    data = physics("multipath", "--ground-range-m=0:80:4", "--head-depth-m=4", "--altitude-m=20", "--frequency-hz=100e3",
                   "--source-level-db=200", "--bottom-loss-db=12")
    x, H, D, d, alpha = np.linspace(0, 80, 400), 20.0, 24.0, 4.0, 0.05
    R1, bounce, second = np.hypot(x, H), np.hypot(x, D + d), np.hypot(x, H + 2 * D)
    figure, axes = plt.subplots(2, 1, figsize=(9, 8), constrained_layout=True, sharex=True)
    for name, label, path, loss in (("direct", "direct", R1, 0), ("one_bounce", "seabed - surface, both orders", bounce, -6.02),
                                    ("second_bottom", "seabed - surface - seabed, both orders", second, 12 - 6.02)):
        line, = axes[0].plot(x, 1e3 * (R1 + path) / SPEED_MPS, lw=1, label=f"{label}: image source")
        axes[0].plot(data["ground_range_m"], 1e3 * data[f"{name}_s"], "o", ms=4, color=line.get_color())
        level = 200 - 40 - 20 * np.log10(R1 * path) - alpha * (R1 + path) - loss
        axes[1].plot(x, level, lw=1, color=line.get_color(), label=f"{label}: image source")
        axes[1].plot(data["ground_range_m"], data[f"{name}_db"], "o", ms=4, color=line.get_color())
    axes[0].set(ylabel="arrival, ms", title="a scatterer of 1 cm² 20 m below a head at 4 m; dots: simulated")
    axes[1].set(xlabel="ground range, m", ylabel="dB re 1 µPa²")
    finish(figure, "multipath")


def draw_gain():
    def gain_db(*words):
        return physics("gain", "--range-m=7.5:150:0.3", "--spreading-db=30", "--offset-db=-60", *words)

    data = {"range_m": gain_db()["range_m"]}
    R, random = data["range_m"], np.random.default_rng(1)
    noise = 10 ** (95 / 20) * (random.standard_normal(R.size) + 1j * random.standard_normal(R.size)) / np.sqrt(2)
    echo = np.abs(10 ** ((180 - 30 * np.log10(R) - 0.14 * R) / 20) + noise)
    data["echo_db"] = 20 * np.log10(echo)
    for name, words in (("right", ["--absorption-dbpm=0.07"]), ("wrong", ["--absorption-dbpm=0.05"]),
                        ("steps", ["--absorption-dbpm=0.07", "--max-db=12", "--step-db=2"])):
        data[f"{name}_gain_db"] = gain_db(*words)["gain_db"]
        counts = np.clip(np.round(echo * 10 ** (data[f"{name}_gain_db"] / 20) / (1e7 / 4095)), 0, 4095)
        data[f"{name}_db"] = 20 * np.log10(counts * 1e7 / 4095 + 1e-4)
    figure, axes = plt.subplots(2, 1, figsize=(9, 8), constrained_layout=True, sharex=True)
    axes[0].plot(R, data["right_gain_db"], label="30 log R + 2 · 0.07 R - 60")
    axes[0].plot(R, data["wrong_gain_db"], label="30 log R + 2 · 0.05 R - 60")
    axes[0].plot(R, data["steps_gain_db"], lw=0.9, label="steps of 2 dB, at most 12 dB")
    axes[0].set(ylabel="gain, dB")
    axes[1].plot(R, data["echo_db"], "0.6", lw=0.6, label="before gain: 180 - 30 log R - 2 · 0.07 R, and noise of 95 dB")
    axes[1].plot(R, data["right_db"], lw=0.6, label="after the right gain")
    axes[1].plot(R, data["wrong_db"], lw=0.6, label="after gain with 0.05 dB/m")
    axes[1].plot(R, 120 - 0.04 * R, "k:", lw=1, label="theory: 120 - 2 (0.07 - 0.05) R")
    axes[1].set(xlabel="range, m", ylabel="dB re 1 µPa²")
    finish(figure, "gain")


draw_levels()
draw_speckle()
draw_pattern()
draw_pulses()
draw_multipath()
draw_gain()
