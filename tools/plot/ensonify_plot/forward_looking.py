"""A forward-looking image: as the sea lies ahead, and as the head samples it."""
import numpy as np
from matplotlib.ticker import MaxNLocator

from ensonify_plot import geometry
from ensonify_plot.received import ReceivedPing
from ensonify_plot.level import Gain, gain_for, level_db, limits_of
from ensonify_plot.ping import CELLS, EMPTY, Show, bar, headline
from ensonify_plot.pictures import new_figure

AMBER = "afmhot"
PERCENTILES = (10, 99.8)
LEVELLED = Gain(30.0)  # a seabed cut by the pulse, where the head has no gain law


def polar_panel(received: ReceivedPing, power) -> tuple:
    """(level image, extent) of the plane ahead of the head: x to starboard, y forward."""
    left, right, behind, ahead = geometry.polar_bounds_m(received.angle_rad, max(received.first_range_m, 0.0), received.end_m)
    cell_m = max((right - left) / CELLS, (ahead - behind) / CELLS, received.step_m / 2)
    power, first_m, step_m = geometry.thinned(power, received.first_range_m, received.step_m, cell_m)
    starboard = np.arange(left, right, cell_m) + cell_m / 2
    forward = np.arange(min(behind, 0.0), ahead, cell_m) + cell_m / 2
    image = geometry.polar_image(power, received.angle_rad, first_m, step_m, starboard[None, :], forward[:, None])
    return level_db(image), (left, left + len(starboard) * cell_m, min(behind, 0.0), min(behind, 0.0) + len(forward) * cell_m)


def rectangular_panel(received: ReceivedPing, power) -> tuple:
    """(level image, extent) over azimuth in degrees and slant range."""
    edges = geometry.beam_edges_rad(received.angle_rad)
    power, first_m, step_m = geometry.thinned(power, received.first_range_m, received.step_m, received.end_m / CELLS)
    azimuth = np.linspace(edges[0], edges[-1], 2 * CELLS + 1)
    beam = geometry.beam_at(received.angle_rad, (azimuth[1:] + azimuth[:-1]) / 2)
    extent = (*np.degrees(edges[[0, -1]]), first_m - step_m / 2, first_m + (power.shape[1] - 0.5) * step_m)
    return level_db(power[beam].T), extent


def forward_looking_picture(received: ReceivedPing, show: Show):
    """Polar and rectangular, side by side, in the same colours."""
    gain = gain_for(show.gain, received.ping, LEVELLED)
    power = received.power_upa2 * np.power(10.0, gain.db(received.range_m) / 10)
    polar, extent_m = polar_panel(received, power)
    limits = limits_of(polar, show.limits_db, PERCENTILES)
    width, height = extent_m[1] - extent_m[0], extent_m[3] - extent_m[2]
    figure = new_figure(13, float(np.clip(1.5 + 6.6 * height / width, 4.2, 8.0)))
    left, right = figure.subplots(1, 2, width_ratios=(1.35, 1))
    colours = {"cmap": AMBER, "vmin": limits.low_db, "vmax": limits.high_db, "origin": "lower", "interpolation": "nearest"}
    left.imshow(polar, extent=extent_m, **colours)
    left.set_facecolor("white")
    left.set(xlabel="starboard of the head (m)", ylabel="ahead of the head (m)")
    range_arcs(left, received)
    image, extent = rectangular_panel(received, power)
    mappable = right.imshow(image, extent=extent, aspect="auto", **colours)
    right.set_facecolor(EMPTY)
    right.set(xlabel="azimuth in the head's frame, positive to starboard (°)", ylabel="slant range (m)")
    for axes in (left, right):
        axes.tick_params(labelsize=8)
    bar(figure, mappable, [left, right], gain, limits)
    headline(figure, "Forward-looking image", received)
    return figure


def range_arcs(axes, received: ReceivedPing, at_rad: float | None = None) -> None:
    """Thin arcs of equal slant range, labelled at this angle, by default at the starboard edge."""
    edges = geometry.beam_edges_rad(received.angle_rad)
    rim = np.linspace(edges[0], edges[-1], 181)
    label_rad = rim[-1] if at_rad is None else at_rad
    on_picture = {} if at_rad is None else {"color": "white"}
    for range_m in MaxNLocator(5).tick_values(0, received.end_m):
        if not max(received.first_range_m, 0.0) < range_m <= received.end_m:
            continue
        axes.plot(range_m * np.sin(rim), range_m * np.cos(rim), color="white", linewidth=0.5, alpha=0.5)
        axes.annotate(f"{range_m:g} m", range_m * np.array([np.sin(label_rad), np.cos(label_rad)]), (3, -2),
                      textcoords="offset points", fontsize=7, va="top", annotation_clip=False, **on_picture)
