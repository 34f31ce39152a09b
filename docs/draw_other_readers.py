#!/usr/bin/env python3
"""Draws what other people's software reads of our files: pictures/other_readers.png (docs/manual/convert.md).

  ensonify run launch/acquisition.yaml --arg seconds=240 --free --out out/acquisition
  pip install themachinethatgoesping pyxtf
  docs/draw_other_readers.py out/acquisition
"""
import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import pyxtf
from themachinethatgoesping import echosounders

FOLDER, PICTURE = pathlib.Path(sys.argv[1]), pathlib.Path(__file__).parent / "pictures/other_readers.png"
ORIGIN = 42.25, -70.70
METRES = 111_090.0, 82_500.0  # of a degree north and east, there
READERS = {".all": (echosounders.kongsbergall.KongsbergAllFileHandler, True), ".kmall": (echosounders.kmall.KMALLFileHandler, False)}


def soundings(ending):
    """East and north from the origin, and depth, of all files; how many pings they have."""
    handler, below_head = READERS[ending]
    pings = handler(sorted(str(file) for file in FOLDER.glob("*" + ending)), show_progress=False).get_pings()
    parts = []
    for ping in pings:
        xyz, place = ping.bottom.get_xyz(), ping.get_geolocation()
        x, y, z = (np.asarray(axis, float) for axis in (xyz.x, xyz.y, xyz.z))
        heading = np.radians(place.yaw)
        east = (place.longitude - ORIGIN[1]) * METRES[1] + x * np.sin(heading) + y * np.cos(heading)
        north = (place.latitude - ORIGIN[0]) * METRES[0] + x * np.cos(heading) - y * np.sin(heading)
        parts.append(np.stack([east, north, z + (place.z if below_head else 0)])[:, z > 1])
    return np.concatenate(parts, axis=1), len(pings)


def waterfall():
    _, packets = pyxtf.xtf_read(str(sorted(FOLDER.glob("*.xtf"))[0]))
    rows = [np.concatenate(packet.data) for packet in packets[pyxtf.XTFHeaderType.sonar]]
    return 20 * np.log10(np.maximum(np.stack([row for row in rows if len(row) == len(rows[0])]).astype(float), 1))


figure, (left, right, side) = plt.subplots(1, 3, figsize=(11, 4.2), constrained_layout=True, width_ratios=[1, 1.15, 1.5])
for axes, ending in ((left, ".all"), (right, ".kmall")):
    (east, north, depth), pings = soundings(ending)
    drawn = axes.scatter(east[::3], north[::3], c=depth[::3], s=0.2, cmap="viridis_r", vmin=13, vmax=21, rasterized=True)
    axes.set(title=f"{ending}, {pings} pings", aspect="equal", xlabel="east / m", ylabel="north / m")
figure.colorbar(drawn, ax=right, label="depth / m")
image = waterfall()
side.imshow(image, aspect="auto", cmap="copper", vmin=30, vmax=80, extent=(-50, 50, len(image), 0))
side.set(title=".xtf, sidescan", xlabel="slant range to starboard / m", ylabel="ping")
figure.savefig(PICTURE, dpi=90)
