#!/usr/bin/python3
"""Draws the pictures of docs/physics/acoustics/detection.md and seabed-image.md from detections of a plane, beside theory.

    docs/physics/draw/detection.py build/dev/tests/experiments build/dev/bin/ensonify-physics
"""
import sys

import matplotlib.pyplot as plt
import numpy as np

from values import physics, save, table

LENGTH = 50.76  # waves: 1 degree
DEPTH_M, SPEED_MPS, PULSE_S = 20.0, 1500.0, 100e-6


def draw_accuracy():
    data = table(sys.argv[1], "accuracy")
    print("predicted over measured:", np.round(data["predicted_sd"] / data["sd"], 2))
    figure, axes = plt.subplots(3, 1, figsize=(9, 11), constrained_layout=True, sharex=True)
    for axis, snr_db in zip(axes, (20, 10)):
        own = {name: column[data["snr_db"] == snr_db] for name, column in data.items()}
        angle = own["angle_deg"]
        axis.semilogy(angle, 100 * own["sd"], "ko-", ms=4, label="measured, blended")
        axis.semilogy(angle, 100 * own["predicted_sd"], "C1--", label="as the detector predicts")
        axis.semilogy(angle, 100 * own["amplitude_sd"], "C0.-", lw=0.8, label="measured, amplitude alone")
        axis.semilogy(angle, 100 * own["expected_sd"], "C2-", lw=0.8, label="theory and floor")
        axis.semilogy(angle, 150 * own["expected_sd"], "C2:", lw=0.8, label="allowed: 1.5 times that")
        axis.set(ylabel="standard deviation, % of depth", title=f"{snr_db} dB", ylim=(0.01, 1))
        axis.grid(alpha=0.3, which="both")
        axes[2].plot(angle, 100 * own["bias"], "o-", ms=4, label=f"{snr_db} dB")
    axes[0].legend(fontsize=8)
    for sign in (-1, 1):
        axes[2].plot([0, 60, 60, 70], sign * np.array([0.05, 0.05, 0.15, 0.15]), "C2:",
                     label="allowed" if sign > 0 else None)
    axes[2].set(xlabel="beam angle, degrees", ylabel="bias, % of depth")
    axes[2].legend(fontsize=8)
    axes[2].grid(alpha=0.3)
    save(figure, "detection_accuracy")


def draw_ramps():
    data = table(sys.argv[1], "phase-ramps")
    angles = np.unique(np.round(data["angle_deg"]))
    figure, axes = plt.subplots(len(angles), 1, figsize=(9, 11), constrained_layout=True)
    for axis, angle_deg in zip(axes, angles):
        own = {name: column[np.round(data["angle_deg"]) == angle_deg] for name, column in data.items()}
        true_s = own["true_s"][0]
        nearest_s = true_s * np.cos(np.radians(angle_deg))
        time_s = own["time_s"]
        sine = np.sqrt(np.clip(1 - (nearest_s / time_s) ** 2, 0, None))
        model = 2 * np.pi * 0.5 * LENGTH * (sine - np.sin(np.radians(angle_deg)))
        seen = own["amplitude_upa"] > 0.15 * own["amplitude_upa"].max()
        axis.scatter(1e3 * time_s[seen], own["phase_rad"][seen], s=6, c="k", label="phase between the halves")
        axis.plot(1e3 * time_s, np.where(abs(model) < np.pi, model, np.nan), "C2", lw=0.9, label="level plane")
        axis.axvline(1e3 * true_s, color="C2", lw=0.8, label="true time of the axis")
        axis.axvline(1e3 * own["detected_s"][0], color="C3", ls="--", lw=0.8, label="detected")
        axis.fill_between(1e3 * time_s, -np.pi, -np.pi + 2 * own["amplitude_upa"] / own["amplitude_upa"].max(),
                          color="C0", alpha=0.3, lw=0, label="amplitude")
        axis.set(title=f"{angle_deg:g}°", ylabel="rad", ylim=(-np.pi, np.pi))
    axes[0].legend(fontsize=8, loc="lower right")
    axes[-1].set_xlabel("two-way time, ms")
    save(figure, "detection_ramps")


def lambert_peak_db(angle_rad):
    """Peak level of the beam at an angle over a Lambert seabed of -25 dB, SL 220, and its range: the area integral."""
    axis = np.sin(angle_rad)
    sine = np.linspace(max(axis - 0.25, -0.995), min(axis + 0.25, 0.995), 40001)
    cosine = np.sqrt(1 - sine ** 2)
    range_m = DEPTH_M / cosine
    per_sine = (np.sinc(LENGTH * (sine - axis)) ** 2 * 10 ** -2.5 * cosine ** 2 * range_m ** -4
                * 10 ** (-0.2 * 0.07 * range_m) * range_m / LENGTH * DEPTH_M / cosine ** 3)
    order = np.argsort(range_m)
    energy = np.concatenate([[0], np.cumsum(per_sine[order]) * (sine[1] - sine[0])])
    starts = np.searchsorted(range_m[order], range_m[order] - 0.5 * SPEED_MPS * PULSE_S)
    power = energy[1:] - energy[starts]
    best = np.argmax(power)
    return 220 + 10 * np.log10(power[best]), range_m[order][best] - 0.25 * SPEED_MPS * PULSE_S


def draw_seabed_image():
    def flattening(*words):
        return physics("flattening", "--range-m=20.01:80:0.05", "--absorption-dbpm=0.07", *words)

    found = flattening()
    data = {"range_m": found["range_m"], "area_db": found["area_db"], "lambert_db": found["angular_db"],
            "peaked_db": flattening("--normal-excess-db=12")["angular_db"], "flattened_100db": found["flattened_db"],
            "range_law_100db": found["range_law_db"]}
    angle = np.degrees(np.arccos(DEPTH_M / data["range_m"]))
    figure, axes = plt.subplots(3, 1, figsize=(9, 11), constrained_layout=True, sharex=True)
    axes[0].plot(angle, data["lambert_db"], label="no excess at normal incidence")
    axes[0].plot(angle, data["peaked_db"], label="12 dB of excess")
    axes[0].axvline(25, color="k", ls=":", lw=0.8, label="crossover, 25°")
    axes[0].set(ylabel="assumed strength over BS_O, dB")
    axes[1].plot(angle, data["area_db"], label="assumed area")
    axes[1].set(ylabel="dB re 1 m²")
    beams = np.arange(0, 75.01, 1)
    peaks, ranges = np.array([lambert_peak_db(a) for a in np.radians(beams)]).T
    at = np.interp(ranges, data["range_m"], data["flattened_100db"]) - 100
    law = np.interp(ranges, data["range_m"], data["range_law_100db"]) - 100
    print("flattened minus coefficient:", np.round(peaks + at + 25, 2))
    axes[2].plot(beams, peaks + at, "k.-", label="flattened reflectivity of the exact peak levels")
    axes[2].plot(beams, peaks + law, "C0.-", ms=3, lw=0.8, label="range law 30 log R + 2αR of the same")
    axes[2].axhline(-25, color="C2", label="the seabed's coefficient, -25 dB")
    axes[2].set(xlabel="incidence, degrees", ylabel="dB")
    for axis in axes:
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3)
    save(figure, "seabed_image")


draw_accuracy()
draw_ramps()
draw_seabed_image()
