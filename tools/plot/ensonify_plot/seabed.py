"""A seabed as its scenario or tile set has it: depths under a sun, and the sediment classes beside them."""
import dataclasses
import json
import os
import tempfile

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from ensonify_plot.grid import Frame
from ensonify_plot.pictures import Relief, depth_bar, draw_plan, map_axes, map_size_in, new_figure
from ensonify_plot.plan import add_plan, read_plan
from ensonify_plot.programs import run_program
from ensonify_plot.errors import UserError

CLASS_COLOURS = ["#d9cfa8", "#8a5a44", "#e8c98f", "#5b8c5a", "#4d6f94", "#c0504d", "#8064a2", "#7f7f7f"]


def add_seabed(verbs) -> None:
    """The verb `seabed`."""
    text = "A generated or stored seabed: depth in colours under a light from the north-west, and its sediment classes."
    verb = verbs.add_parser("seabed", help=text, description=text)
    verb.set_defaults(act=plot_seabed)
    verb.add_argument("seabed", metavar="SCENARIO|FOLDER", help="a scenario file, or the folder of a tile set")
    verb.add_argument("--out", default="seabed.png", metavar="FILE", help="PNG file; default: seabed.png")
    verb.add_argument("--title", help="above the picture; default: the file's folder")
    verb.add_argument("--around", nargs=3, type=float, metavar=("EAST", "NORTH", "SIDE"), help="a square, in m; default: all of it")
    verb.add_argument("--posts", type=int, default=1000, help="per side, at most; default: 1000")
    verb.add_argument("--latlon", action="store_true", help="latitude and longitude; default: metres from the origin")
    add_plan(verb)


def plot_seabed(options) -> int:
    """`ensonify plot seabed`."""
    frame, up_m, classes, origin = read_seabed(options)
    if not np.isfinite(up_m).any():
        raise UserError(f"{options.seabed}: has no height there")
    title = options.title or os.path.basename(os.path.dirname(os.path.abspath(options.seabed)))
    planned = read_plan(options.plan, origin)
    if options.latlon:
        frame = dataclasses.replace(frame, origin=origin)
    figure = seabed_picture(frame, up_m, classes, title, planned)
    figure.savefig(options.out, pil_kwargs={"compress_level": 9})
    print(options.out)
    return 0


def read_seabed(options):
    """Frame, heights, classes and the world's origin of what was asked for, from `ensonify terrain grid`."""
    with tempfile.NamedTemporaryFile(prefix="ensonify-") as raw:
        words = ["grid", options.seabed, "--out", raw.name, "--posts", str(options.posts)]
        if options.around:
            words += ["--around", *map(str, options.around)]
        facts = json.loads(run_program("terrain", *words))
        with open(raw.name, "rb") as file:
            data = file.read()
    shape = facts["rows"], facts["columns"]
    count = shape[0] * shape[1]
    up_m = np.frombuffer(data, "<f4", count).reshape(shape)
    classes = np.frombuffer(data, np.uint8, count, 4 * count).reshape(shape)
    step = facts["spacing_m"]
    frame = Frame(facts["west_m"] - step / 2, facts["south_m"] - step / 2, step, shape[1], shape[0])
    return frame, up_m, classes, (facts["latitude_deg"], facts["longitude_deg"])


def seabed_picture(frame: Frame, up_m, classes, title: str, planned: list):
    """Depths with planned lines; beside them the classes, if there is more than one."""
    relief = Relief(up_m, frame.cell_m)
    several = np.unique(classes[np.isfinite(up_m)]).size > 1
    width, height = map_size_in(frame)
    wide = frame.cols > 1.6 * frame.rows  # one above the other
    columns, rows = (1, 2) if several and wide else (2, 1) if several else (1, 1)
    figure = new_figure(0.75 * width * columns, 0.75 * height * rows)
    axes = np.atleast_1d(figure.subplots(rows, columns)).ravel()
    mappable = relief.draw(axes[0], frame, up_m)
    map_axes(axes[0], frame, f"{title}\nposts {frame.cell_m:g} m apart, slopes shaded x{relief.exaggeration:g}")
    depth_bar(figure, mappable, axes[0])
    draw_plan(axes[0], planned)
    if several:
        draw_classes(axes[1], frame, up_m, classes)
    return figure


def draw_classes(axes, frame: Frame, up_m, classes) -> None:
    """Each class in a colour of its own."""
    seen = np.unique(classes[np.isfinite(up_m)])
    colours = [CLASS_COLOURS[k % len(CLASS_COLOURS)] for k in seen]
    shown = np.where(np.isfinite(up_m), np.searchsorted(seen, classes), np.nan)
    axes.imshow(shown, extent=frame.extent_m, origin="lower", interpolation="nearest", cmap=ListedColormap(colours),
                vmin=-0.5, vmax=seen.size - 0.5)
    map_axes(axes, frame, "sediment classes\n")
    axes.legend(handles=[Patch(facecolor=c, label=str(k)) for c, k in zip(colours, seen)], loc="upper left",
                bbox_to_anchor=(1.0, 1.0), fontsize=8, frameon=False)
