"""A scenario's objects on their seabed: seen from above with track and swath, and as they stand, under a sun."""
import dataclasses
import json
import os

import ensonify
import matplotlib
import numpy as np
from matplotlib.colors import LightSource
from matplotlib.lines import Line2D
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ensonify_plot.errors import UserError
from ensonify_plot.grid import Frame
from ensonify_plot.pictures import DEPTH_COLOURS, SUN_ALTITUDE_DEG, SUN_AZIMUTH_DEG, Relief, depth_bar, entitle, map_axes, new_figure
from ensonify_plot.programs import run_program
from ensonify_plot.results import open_record
from ensonify_plot.seabed import read_seabed

CLASS_COLOURS = matplotlib.colormaps["tab10"].colors
LEAST_SIDE_M = 10.0
MARGIN = 1.3         # of the square around the objects
POSTS_3D = 160       # of the seabed, a side
NAMED = 30           # objects; more are not named in the picture
LISTED = 10  # classes; more would hide the map


@dataclasses.dataclass
class Scene:
    """What the picture shows; places in m, east, north, up."""
    objects: list
    frame: Frame
    up_m: np.ndarray
    track: np.ndarray          # n x 2, empty without a record
    swath: list                # polygons, n x 2


def add_scene(verbs) -> None:
    """The verb `scene`."""
    text = ("The objects of a scenario on their seabed: from above, coloured by class, with the track and the swath of a record, and "
            "as they stand, to scale.")
    verb = verbs.add_parser("scene", help=text, description=text)
    verb.set_defaults(act=plot_scene)
    verb.add_argument("seabed", metavar="SCENARIO", help="a scenario file with objects")
    verb.add_argument("--record", metavar="RECORD", help="an MCAP file, or a folder with one: its track, and the swath of its soundings")
    verb.add_argument("--around", nargs=3, type=float, metavar=("EAST", "NORTH", "SIDE"),
                      help="a square, in m; default: around all objects, and the track")
    verb.add_argument("--view", nargs=2, type=float, default=(35.0, 200.0), metavar=("UP", "FROM"),
                      help="from where the view is: degrees above the horizon, and heading in degrees from the scene; default: 35 200")
    verb.add_argument("--posts", type=int, default=600, help="of the seabed per side, at most; default: 600")
    verb.add_argument("--out", default="scene.png", metavar="FILE", help="PNG file, or a folder for it; default: scene.png")


def plot_scene(options) -> int:
    """`ensonify plot scene`."""
    objects = [one for one in json.loads(run_program("terrain", "objects", options.seabed)) if not one["absent"]]
    if not objects and not options.around:
        raise UserError(f"{options.seabed}: has no objects; allowed: a scenario with `objects:`, or --around EAST NORTH SIDE")
    track, swath = read_way(options.record) if options.record else (np.empty((0, 2)), [])
    options.around = options.around or square_around(objects, track)
    if not options.around[2] > 0:
        raise UserError(f"--around: a side of {options.around[2]:g} m; allowed: more than 0")
    frame, up_m, _, _ = read_seabed(options)
    if not np.isfinite(up_m).any():
        raise UserError(f"{options.seabed}: has no height there")
    figure = scene_picture(Scene(objects, frame, up_m, track, swath), options.seabed, options.view)
    file = os.path.join(options.out, "scene.png") if os.path.isdir(options.out) else options.out
    figure.savefig(file, pil_kwargs={"compress_level": 9})
    print(file)
    return 0


def square_around(objects: list, track: np.ndarray) -> list:
    """East and north of the middle of a square around all of it, and its side."""
    places = np.concatenate([np.array(one["places_enu_m"])[:, :2] for one in objects] + [track])
    low, high = places.min(axis=0), places.max(axis=0)
    side = max(LEAST_SIDE_M, MARGIN * float((high - low).max()))
    return [*(float(x) for x in (low + high) / 2), side]


def read_way(name: str) -> tuple:
    """The track of a record by the truth or else the estimate, and the strip of each head's soundings."""
    record = open_record(name)
    for kind in (ensonify.Pose, ensonify.Estimate):
        if topics := record.topics_of(kind):
            track = np.array([message.position_enu_m[:2] for _, _, message in record.messages(topics[0])])
            break
    else:
        raise UserError(f"{record.file}: has no pose or estimate; allowed: a record of one of these")
    swath = []
    for topic in record.topics_of(ensonify.Soundings):
        edges = []
        for _, _, pinged in record.messages(topic):
            places = np.asarray(pinged.position_enu_m)[:, :2]
            places = places[np.isfinite(places).all(axis=1)]
            if len(places):
                edges.append((places[0], places[-1]))
        if edges:
            port, starboard = (np.array(side) for side in zip(*edges, strict=True))
            swath.append(np.concatenate([port, starboard[::-1]]))
    return track, swath


def class_colours(objects: list) -> dict:
    """A colour for each class, by its number."""
    return {one["class"]: CLASS_COLOURS[(one["class_id"] - 1) % len(CLASS_COLOURS)] for one in objects}


def scene_picture(scene: Scene, title: str, view) -> matplotlib.figure.Figure:
    """From above on the left, as it stands on the right."""
    figure = new_figure(14.0, 6.6)
    left, right = figure.subfigures(1, 2)
    draw_plan_view(left, scene)
    draw_stand(right, scene, view)
    inside = [one for one in scene.objects if is_inside(one, scene.frame)]
    beyond = len(scene.objects) - len(inside)
    facts = [f"{len(inside)} objects" + (f", {beyond} more outside of the picture" if beyond else "") + "; heights and sizes to scale; "
             "the sun stands in the north-west"]
    entitle(figure, title, facts)
    return figure


def is_inside(one: dict, frame: Frame) -> bool:
    """Whether its middle is in the picture."""
    west, east, south, north = frame.extent_m
    return west <= one["position_enu_m"][0] <= east and south <= one["position_enu_m"][1] <= north


def draw_plan_view(figure, scene: Scene) -> None:
    """Depths, outlines of the objects, track and swath."""
    axes = figure.subplots()
    relief = Relief(scene.up_m, scene.frame.cell_m)
    mappable = relief.draw(axes, scene.frame, scene.up_m)
    colours = class_colours(scene.objects)
    for polygon in scene.swath:
        axes.fill(*polygon.T, facecolor="white", alpha=0.25, edgecolor="white", linewidth=0.6)
    if len(scene.track):
        axes.plot(*scene.track.T, color="black", linewidth=0.9)
    side = scene.frame.cell_m * scene.frame.cols
    shown = [one for one in scene.objects if is_inside(one, scene.frame)]
    for one in shown:
        places = np.array(one["places_enu_m"])
        axes.triplot(places[:, 0], places[:, 1], np.array(one["triangles"]), color=colours[one["class"]], linewidth=0.5)
        if np.ptp(places[:, :2], axis=0).max() < 0.01 * side:  # too small to be seen
            axes.plot(*one["position_enu_m"][:2], "o", color=colours[one["class"]], markersize=4, markeredgecolor="white", markeredgewidth=0.5)
        if len(shown) <= NAMED:
            axes.annotate(one["name"], one["position_enu_m"][:2], xytext=(5, 4), textcoords="offset points", fontsize=7, parse_math=False)
    map_axes(axes, scene.frame, f"from above; posts {scene.frame.cell_m:g} m apart, slopes shaded x{relief.exaggeration:g}")
    handles = [Line2D([], [], marker="o", linestyle="", color=colour, label=name) for name, colour in colours.items()
               if len(colours) <= LISTED]
    if len(scene.track):
        handles.append(Line2D([], [], color="black", linewidth=0.9, label="track"))
    if scene.swath:
        handles.append(Line2D([], [], color="white", linewidth=4, alpha=0.6, label="swath"))
    if handles:
        axes.legend(handles=handles, loc="upper right", fontsize=7, facecolor="#cfd8dc")
    depth_bar(figure, mappable, axes)


def above_ground(corners: np.ndarray, east: np.ndarray, north: np.ndarray, up_m: np.ndarray) -> np.ndarray:
    """The triangles whose middle is not in the seabed, by the nearest post."""
    middle = corners.mean(axis=1)
    column, row = (np.clip(np.searchsorted(posts, middle[:, axis]), 0, posts.size - 1) for axis, posts in ((0, east), (1, north)))
    ground = up_m[row, column]
    return corners[~(middle[:, 2] < ground)]


def shaded(corners: np.ndarray, colour, sun: LightSource) -> np.ndarray:
    """A colour for each triangle, darker where it faces away from the sun."""
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    facing = across @ sun.direction / np.linalg.norm(across, axis=1)
    return np.clip(np.asarray(colour) * (0.65 + 0.35 * facing[:, None]), 0, 1)


def draw_stand(figure, scene: Scene, view) -> None:
    """The seabed as a surface, and the objects on it, all axes of one scale."""
    axes = figure.add_subplot(projection="3d", computed_zorder=False)
    step = max(1, int(np.ceil(max(scene.up_m.shape) / POSTS_3D)))
    frame, up_m = scene.frame, scene.up_m[::step, ::step]
    west, _, south, _ = frame.extent_m
    east = west + frame.cell_m * (step * np.arange(up_m.shape[1]) + 0.5)
    north = south + frame.cell_m * (step * np.arange(up_m.shape[0]) + 0.5)
    sun = LightSource(SUN_AZIMUTH_DEG, SUN_ALTITUDE_DEG)
    low, high = np.nanmin(up_m), np.nanmax(up_m)
    scaled = 1.0 - (up_m - low) / max(high - low, 0.1)
    colour = sun.shade_rgb(DEPTH_COLOURS(np.nan_to_num(scaled))[..., :3], np.nan_to_num(up_m, nan=low), vert_exag=1, dx=frame.cell_m * step,
                           dy=frame.cell_m * step, blend_mode="soft")
    axes.plot_surface(*np.meshgrid(east, north), up_m, facecolors=colour, rstride=1, cstride=1, linewidth=0, antialiased=False, shade=False,
                      zorder=1)
    colours = class_colours(scene.objects)
    top = high
    for one in scene.objects:
        if not is_inside(one, frame):
            continue
        corners = above_ground(np.array(one["places_enu_m"])[np.array(one["triangles"])], east, north, up_m)
        axes.add_collection3d(Poly3DCollection(corners, facecolors=shaded(corners, colours[one["class"]], sun), zorder=2))
        top = max(top, corners[..., 2].max(initial=top))
    span = np.array([np.ptp(east), np.ptp(north), max(top - low, 0.05 * np.ptp(east))])
    axes.set(xlim=(east[0], east[-1]), ylim=(north[0], north[-1]), zlim=(low, low + span[2]), xlabel="east (m)", ylabel="north (m)", zlabel="up (m)")
    axes.set_box_aspect(span, zoom=1.05)
    axes.view_init(elev=view[0], azim=90.0 - view[1])  # azim counts from east to north
    axes.locator_params(axis="z", nbins=3)
    axes.tick_params(labelsize=7)
