#!/usr/bin/python3
"""Draws the picture of interference.md: launch/interference.yaml, run with each kind of trigger.

    docs/physics/draw/interference.py build/dev/bin/ensonify
"""
import pathlib
import subprocess
import sys
import tempfile

import matplotlib.pyplot as plt
import numpy as np

from values import save

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "clients/python"))
import ensonify  # noqa: E402  (found beside this script)

SPEED_MPS = 1490.0  # of scenarios/bay
RUNS = (("free: each on its own ping rate", ()),
        ("slave: the sidescan follows the multibeam", ("--arg", "side=slave")),
        ("interleaved: in turns", ("--arg", "side=interleaved", "--arg", "bow=interleaved")))


def run(arguments):
    """Starboard levels by (ping, cell), their slant ranges, times of the pings, and those and the ranges at which the
    multibeam's sound is to stand."""
    with tempfile.TemporaryDirectory(prefix="ens-") as folder:
        subprocess.run([sys.argv[1], "run", ROOT / "launch/interference.yaml", "--free", "--quiet", "--out", folder, *arguments],
                       check=True)
        record = ensonify.Record(pathlib.Path(folder) / "interference.mcap")
        pings = [message.content for message in record.messages("side/ping_main")]
        sent_s = np.array([message.content.stamp_ns for message in record.messages("bow/transmit")]) * 1e-9
    # A pulse lasts two samples: the strongest of six is drawn, so that none falls between two points of the picture.
    cells = pings[0].amplitude_upa.shape[1] // 6
    level_db = np.array([20 * np.log10(np.maximum(ping.amplitude_upa[1, :6 * cells].reshape(cells, 6).max(axis=1), 1))
                         for ping in pings])
    range_m = 0.5 * SPEED_MPS * 6 * np.arange(cells) * pings[0].sample_period_s
    time_s = np.array([ping.stamp_ns for ping in pings]) * 1e-9
    straight = [(t, 0.5 * SPEED_MPS * (sent - t)) for t in time_s for sent in sent_s]
    return level_db, range_m, time_s, np.array([(t, r) for t, r in straight if 0 <= r < range_m[-1]]).reshape(-1, 2)


def draw():
    figure, axes = plt.subplots(1, 3, figsize=(13, 5.5), constrained_layout=True, sharey=True)
    for axis, (title, arguments) in zip(axes, RUNS):
        level_db, range_m, time_s, straight = run(arguments)
        shown = axis.imshow(level_db + 30 * np.log10(np.maximum(range_m, 1)), origin="lower", aspect="auto", cmap="gray",
                            extent=(0, range_m[-1], time_s[0], time_s[-1]), vmin=125, vmax=165, interpolation="nearest")
        if len(straight):
            axis.plot(straight[::15, 1], straight[::15, 0], "c.", ms=4, label="c (sent - ping) / 2")
            axis.legend(fontsize=8, loc="upper right")
        axis.set(title=title, xlabel="slant range to starboard, m")
    axes[0].set_ylabel("time of the sidescan's ping, s")
    figure.colorbar(shown, ax=axes, label="level + 30 log R, dB re 1 µPa²", fraction=0.03)
    save(figure, "interference")


draw()
