"""The mesh that one transmission makes of a seabed: its blocks, coloured by level of detail."""
import json
import os
import subprocess

import matplotlib
import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.patches import Patch, Rectangle

from ensonify_plot.pictures import new_figure
from ensonify_plot.survey import UserError

LEVELS = 6
COLOURS = matplotlib.colormaps["viridis"](np.linspace(1.0, 0.0, LEVELS))


def add_lod(verbs) -> None:
    """The verb `lod`."""
    text = "The mesh that one transmission of a multibeam makes of a seabed, seen from above and coloured by level of detail."
    verb = verbs.add_parser("lod", help=text, description=text)
    verb.set_defaults(act=plot_lod)
    verb.add_argument("seabed", metavar="SCENARIO|FOLDER", help="a scenario file, or the folder of a tile set")
    verb.add_argument("--at", nargs=2, required=True, metavar=("EAST", "NORTH"), help="where the head is, in m")
    verb.add_argument("--altitude", default="50", metavar="M", help="of the head above the seabed, in m; default: 50")
    verb.add_argument("--heading", default="0", metavar="DEGREES", help="from north; default: 0")
    verb.add_argument("--swath", default="130", metavar="DEGREES", help="default: 130")
    verb.add_argument("--beam", default="1", metavar="DEGREES", help="width of a beam; default: 1")
    verb.add_argument("--side-lobes", default="2", metavar="LEVEL", help="level that side lobes see, 0 to 5; default: 2")
    verb.add_argument("--out", default="lod.png", metavar="FILE", help="PNG file; default: lod.png")


def plot_lod(options) -> int:
    """`ensonify plot lod`."""
    figure = lod_picture(read_mesh(options))
    figure.savefig(options.out, pil_kwargs={"compress_level": 9})
    print(options.out)
    return 0


def read_mesh(options) -> dict:
    """What `ensonify terrain mesh` says."""
    program = os.path.join(os.environ["ENSONIFY_BIN"], "ensonify-terrain")
    words = [program, "mesh", options.seabed, "--at", *options.at]
    for name in ("altitude", "heading", "swath", "beam", "side_lobes"):
        words += ["--" + name.replace("_", "-"), getattr(options, name)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise UserError(done.stderr.strip() or f"{program} failed")
    return json.loads(done.stdout)


def lod_picture(mesh: dict):
    """Each block in the colour of its level, from above."""
    blocks = np.array(mesh["blocks"])
    west, south, east, north, level = blocks.T
    figure = new_figure(8.6, 7.0)
    axes = figure.subplots()
    boxes = [Rectangle((w, s), e - w, n - s) for w, s, e, n in blocks[:, :4]]
    axes.add_collection(PatchCollection(boxes, facecolor=COLOURS[level.astype(int)], edgecolor="white", linewidth=0.15))
    axes.plot(*mesh["head_enu_m"][:2], "r+", markersize=10)
    axes.set(xlim=(west.min(), east.max()), ylim=(south.min(), north.max()), aspect="equal", xlabel="east (m)",
             ylabel="north (m)")
    ratio = mesh["triangles_of_all_posts"] / mesh["triangles"]
    axes.set_title(f"{mesh['triangles']:,} triangles, 1/{ratio:.0f} of those of all posts", fontsize=10)
    axes.legend(handles=[Patch(facecolor=COLOURS[k], label=f"{mesh['spacing_m'] * 2**k:g} m") for k in np.unique(level.astype(int))],
                title="posts apart", loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8, frameon=False)
    return figure
