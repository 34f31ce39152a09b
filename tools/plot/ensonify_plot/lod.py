"""The mesh that one transmission makes of a seabed: its blocks, coloured by level of detail."""
import json

import matplotlib
import numpy as np
from matplotlib.collections import PatchCollection
from matplotlib.patches import Patch, Rectangle

from ensonify_plot.pictures import new_figure
from ensonify_plot.programs import run_program

LEVELS = 6
OWN = "#c2410c"  # triangles of an irregular mesh as they are in their source
COLOURS = matplotlib.colormaps["viridis"](np.linspace(1.0, 0.0, LEVELS))


def add_lod(verbs) -> None:
    """The verb `lod`."""
    text = ("The mesh that one transmission of a multibeam makes of a seabed, seen from above and coloured by level of detail, and "
            "of the irregular meshes within its range, from the side.")
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
    words = ["mesh", options.seabed, "--at", *options.at]
    for name in ("altitude", "heading", "swath", "beam", "side_lobes"):
        words += ["--" + name.replace("_", "-"), getattr(options, name)]
    return json.loads(run_program("terrain", *words))


def lod_picture(mesh: dict):
    """Each block in the colour of its level, from above; below, from the side, what it makes of each irregular mesh."""
    blocks = np.array(mesh["blocks"])
    west, south, east, north, level = blocks.T
    figure = new_figure(8.6, 7.0 + 2.2 * len(mesh["meshes"]))
    axes, *below = figure.subplots(1 + len(mesh["meshes"]), squeeze=False, height_ratios=[7.0] + [2.2] * len(mesh["meshes"]))[:, 0]
    boxes = [Rectangle((w, s), e - w, n - s) for w, s, e, n in blocks[:, :4]]
    axes.add_collection(PatchCollection(boxes, facecolor=COLOURS[level.astype(int)], edgecolor="white", linewidth=0.15))
    axes.plot(*mesh["head_enu_m"][:2], "r+", markersize=10)
    axes.set(xlim=(west.min(), east.max()), ylim=(south.min(), north.max()), aspect="equal", xlabel="east (m)",
             ylabel="north (m)")
    ratio = mesh["triangles_of_all_posts"] / mesh["triangles"]
    axes.set_title(f"{mesh['triangles']:,} triangles, 1/{ratio:.0f} of those of all posts", fontsize=10)
    axes.legend(handles=[Patch(facecolor=COLOURS[k], label=f"{mesh['spacing_m'] * 2**k:g} m") for k in np.unique(level.astype(int))],
                title="posts apart", loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8, frameon=False)
    for side, irregular in zip(below, mesh["meshes"], strict=True):
        axes.triplot(*np.array(irregular["places_enu_m"]).T[:2], irregular["triangles"], color=OWN, linewidth=0.4)
        draw_from_the_side(side, irregular, np.array(mesh["head_enu_m"]))
    return figure


def draw_from_the_side(axes, irregular: dict, head: np.ndarray) -> None:
    """The triangles of an irregular mesh, along the longer of its sides against height."""
    places, triangles = np.array(irregular["places_enu_m"]), np.array(irregular["triangles"])
    own = irregular["of_the_source"]
    _, _, (along, _) = np.linalg.svd(places[:, :2] - places[:, :2].mean(axis=0), full_matrices=False)
    x = (places[:, :2] - head[:2]) @ (along * np.sign(along.sum()))  # towards the east, or the north
    for some, colour, label in ((triangles[own:], "#8a8a8a", "moved"), (triangles[:own], OWN, "as in the source")):
        if len(some):
            axes.triplot(x, places[:, 2], some, color=colour, linewidth=0.4, label=label)
    axes.plot(0, head[2], "r+", markersize=10)
    low, high = places[:, 2].min(), max(places[:, 2].max(), head[2])
    fine = x[triangles[:own] if own else triangles]
    middle, half = (fine.min() + fine.max()) / 2, max((fine.max() - fine.min()) / 2, 2 * (high - low))
    axes.set(aspect="equal", xlim=(middle - half, middle + half), ylim=(low - 1, high + 1), xlabel="along it, from the head (m)",
             ylabel="height (m)")
    axes.set_title(f"{irregular['name']} from the side: {len(triangles):,} triangles of {irregular['triangles_of_all']:,}", fontsize=10)
    handles, labels = axes.get_legend_handles_labels()
    named = dict(zip(labels, handles, strict=True))  # of a line of triangles, the last
    axes.legend(named.values(), named.keys(), loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=8, frameon=False)
