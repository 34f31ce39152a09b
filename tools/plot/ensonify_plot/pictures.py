"""Maps of a survey: depth with hillshade and track, the true seabed in the same colours, the difference."""
import textwrap

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from matplotlib.figure import Figure

from ensonify_plot.files import geodetic_of, transformed, wgs84, world_crs
from ensonify_plot.grid import Frame

DPI = 130
SUN_AZIMUTH_DEG, SUN_ALTITUDE_DEG = 315.0, 45.0
# Shoal is red and deep is blue, as hydrographers colour it.
DEPTH_COLOURS = LinearSegmentedColormap.from_list(
    "depth", ["#c8262b", "#ec6a2c", "#f6b13a", "#efe267", "#a6d466", "#4cb98a", "#2f95b5", "#315fae", "#33307f"])
UNCOVERED = ListedColormap(["#d62728"])


def new_figure(width_in: float, height_in: float) -> Figure:
    """A figure that needs no screen."""
    figure = Figure(figsize=(width_in, height_in), dpi=DPI, layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def entitle(figure, title: str, facts: list) -> None:
    """A short title above, and below it in small print what a reader must know besides: one line each."""
    figure.suptitle(title, fontsize=10, x=0.02, ha="left")
    figure.supxlabel("\n".join(fact for fact in facts if fact), fontsize=7.5, x=0.02, ha="left", color="0.35")


def hillshade(up_m: np.ndarray, cell_m: float, exaggeration: float) -> np.ndarray:
    """Brightness 0..1 of a surface (row 0 in the south) under a sun in the north-west."""
    slope_north, slope_east = (_slope(up_m, axis) * exaggeration / cell_m for axis in (0, 1))
    azimuth, altitude = np.radians(SUN_AZIMUTH_DEG), np.radians(SUN_ALTITUDE_DEG)
    sun = np.cos(altitude) * np.sin(azimuth), np.cos(altitude) * np.cos(azimuth), np.sin(altitude)
    facing = (-slope_east * sun[0] - slope_north * sun[1] + sun[2]) / np.sqrt(1 + slope_east**2 + slope_north**2)
    return np.clip(facing, 0, 1)


def _slope(values, axis):
    """Central difference; one-sided beside a hole and 0 where both neighbours are missing."""
    step = np.diff(values, axis=axis)
    nothing = np.full_like(np.take(values, [0], axis=axis), np.nan)
    behind, ahead = np.concatenate([nothing, step], axis), np.concatenate([step, nothing], axis)
    known = np.isfinite(behind).astype(np.int8) + np.isfinite(ahead)
    return (np.nan_to_num(behind) + np.nan_to_num(ahead)) / np.maximum(known, 1)


class Relief:
    """Colours for depths: the same limits and the same sun for every picture of one survey."""

    def __init__(self, up_m: np.ndarray, cell_m: float):
        depth = -up_m[np.isfinite(up_m)]
        self.shallow_m, self.deep_m = (float(x) for x in np.percentile(depth, (0.2, 99.8)))
        if self.deep_m - self.shallow_m < 0.1:
            middle = (self.deep_m + self.shallow_m) / 2
            self.shallow_m, self.deep_m = middle - 0.05, middle + 0.05
        slopes = np.hypot(_slope(up_m, 0), _slope(up_m, 1))[np.isfinite(up_m)] / cell_m
        steep = float(np.percentile(slopes, 95)) if slopes.size else 0.0
        self.exaggeration = float(np.clip(np.round(0.6 / max(steep, 1e-3)), 1, 20))

    def draw(self, axes, frame: Frame, up_m: np.ndarray):
        """The surface; returns what a colour bar needs."""
        scaled = (-up_m - self.shallow_m) / (self.deep_m - self.shallow_m)
        rgba = DEPTH_COLOURS(np.nan_to_num(np.clip(scaled, 0, 1)))
        shade = hillshade(up_m, frame.cell_m, self.exaggeration) / np.sin(np.radians(SUN_ALTITUDE_DEG))
        rgba[..., :3] = np.clip(rgba[..., :3] * (0.30 + 0.70 * shade[..., None]), 0, 1)
        rgba[..., 3] = np.isfinite(up_m)
        axes.imshow(rgba, extent=frame.extent_m, origin="lower", interpolation="nearest")
        mappable = axes.imshow(-up_m, extent=frame.extent_m, origin="lower", cmap=DEPTH_COLOURS, vmin=self.shallow_m,
                               vmax=self.deep_m, visible=False)
        return mappable


def map_axes(axes, frame: Frame, title: str) -> None:
    """East and north in metres or longitude and latitude, the same scale on both, a light grid."""
    west, east, south, north = frame.extent_m
    margin = 0.02 * max(east - west, north - south)
    axes.set(xlim=(west - margin, east + margin), ylim=(south - margin, north + margin))
    axes.set_aspect("equal")
    if frame.origin is None:
        axes.set(xlabel="east of origin (m)", ylabel="north of origin (m)")
    else:
        _geodetic_ticks(axes, frame)
    axes.set_title(title, fontsize=10, loc="left")
    axes.set_facecolor("#f2f2f0")
    axes.grid(color="black", alpha=0.12, linewidth=0.5)
    axes.tick_params(labelsize=8)


def _geodetic_ticks(axes, frame: Frame) -> None:
    """Ticks at round latitudes along the west side and round longitudes along the south side, in degrees and minutes."""
    west, east, south, north = frame.extent_m
    latitudes, longitudes = geodetic_of(frame.origin, [west, east, west], [south, south, north])
    parallels = round_minutes(latitudes[0], latitudes[2])
    meridians = round_minutes(longitudes[0], longitudes[1])
    world = world_crs(frame.origin)
    _, north_m = transformed(wgs84(), world, parallels / 60, np.full(len(parallels), longitudes[0]))
    east_m, _ = transformed(wgs84(), world, np.full(len(meridians), latitudes[0]), meridians / 60)
    axes.set_yticks(north_m, in_minutes(parallels, "NS"), rotation=90, va="center")
    axes.set_xticks(east_m, in_minutes(meridians, "EW"))


def round_minutes(low_deg: float, high_deg: float) -> np.ndarray:
    """Two to five round places between two, in minutes of arc."""
    span = 60 * (high_deg - low_deg)
    step = next(size * 10.0**power for power in range(-4, 5) for size in (1, 2, 5) if span / (size * 10.0**power) < 5)
    return step * np.arange(np.ceil(60 * low_deg / step), np.floor(60 * high_deg / step) + 1)


def in_minutes(minutes: np.ndarray, sides: str) -> list:
    """54°17.95'N, degrees and decimal minutes as on charts; with as many decimals as tell them apart."""
    step = np.diff(minutes).min() if len(minutes) > 1 else 1.0
    decimals = max(0, int(np.ceil(-np.log10(step) - 1e-9)))
    texts = []
    for each in minutes:
        degrees, rest = divmod(round(abs(each), decimals), 60)
        texts.append(f"{degrees:.0f}°{rest:0{2 + decimals + (decimals > 0)}.{decimals}f}'{sides[each < 0]}")
    return texts


def colour_bar(figure, mappable, axes, label: str):
    """A bar as high as the axes beside it."""
    bar = figure.colorbar(mappable, cax=axes.inset_axes([1.02, 0.0, 0.025, 1.0]), extend="both")
    bar.set_label(label, fontsize=9)
    bar.ax.tick_params(labelsize=8)
    return bar


def depth_bar(figure, mappable, axes) -> None:
    """Shallow at the top, as the sea is."""
    colour_bar(figure, mappable, axes, "depth below chart datum (m)").ax.invert_yaxis()


def map_size_in(frame: Frame) -> tuple:
    """A figure that fits the map's shape with its bar and labels."""
    west, east, south, north = frame.extent_m
    aspect = (north - south) / (east - west)
    width = 9.5 if aspect < 1.1 else max(5.0, 9.5 / aspect)
    return width, float(np.clip((width - 2.0) * aspect + 1.2, 3.2, 10.5))


def draw_track(axes, survey) -> None:
    """The vehicle's track, begun with a dot; the runlines stand out from the turns where the record gives them."""
    t_s, east, north = survey.track_t_s, survey.track_east_m, survey.track_north_m
    if not t_s.size:
        return
    axes.plot(east, north, color="black", linewidth=0.6, alpha=0.6, linestyle=(0, (4, 2)), label="track")
    for number, line in enumerate(survey.lines):
        part = (t_s >= line.begin_s) & (t_s <= line.end_s)
        if part.any():
            axes.plot(east[part], north[part], color="black", linewidth=1.0, label="runline" if number == 0 else None)
            axes.annotate(textwrap.shorten(line.name, 12, placeholder="…"), (east[part][0], north[part][0]), fontsize=7, ha="center", va="center",
                          parse_math=False, bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "linewidth": 0.6})
    axes.legend(loc="upper right", fontsize=7, framealpha=0.9)


def draw_plan(axes, planned: list) -> None:
    """Planned lines over a map, each with a dot where it begins."""
    for number, line in enumerate(planned):
        axes.plot(*line.T, color="#c2007a", linewidth=3, alpha=0.5, label="planned" if number == 0 else None)
        axes.plot(*line[0], color="#c2007a", marker="o", markersize=5)
    if planned:
        axes.legend(loc="upper right", fontsize=7, framealpha=0.9)


def survey_picture(survey, frame: Frame, up_m, relief: Relief) -> Figure:
    """Hillshaded survey with track."""
    figure = new_figure(*map_size_in(frame))
    axes = figure.subplots()
    mappable = relief.draw(axes, frame, up_m)
    map_axes(axes, frame, _survey_title(survey, frame, relief))
    draw_track(axes, survey)
    depth_bar(figure, mappable, axes)
    return figure


def _survey_title(survey, frame, relief):
    heads = ", ".join(survey.heads)
    return (f"Survey ({heads}): {len(survey.soundings):,} soundings of {survey.ping_count:,} pings\n"
            f"mean per {frame.cell_m:g} m cell, hillshade x{relief.exaggeration:g}")


def truth_picture(frame: Frame, up_m, relief: Relief) -> Figure:
    """The true seabed on the survey's frame, in the survey's colours."""
    figure = new_figure(*map_size_in(frame))
    axes = figure.subplots()
    mappable = relief.draw(axes, frame, up_m)
    map_axes(axes, frame, f"True seabed: tiles as recorded, at the centres of {frame.cell_m:g} m cells\n"
                          f"colours and hillshade as the survey's (x{relief.exaggeration:g})")
    depth_bar(figure, mappable, axes)
    return figure


def side_by_side(survey, frame: Frame, survey_up_m, truth_up_m, relief: Relief) -> Figure:
    """Survey and truth in one picture, above each other where the area is wide."""
    width, height = map_size_in(frame)
    tall = height > 0.75 * width
    figure = new_figure(width * (1.7 if tall else 1), height * (1 if tall else 1.85))
    left, right = figure.subplots(1, 2, sharey=True) if tall else figure.subplots(2, 1, sharex=True)
    mappable = relief.draw(left, frame, survey_up_m)
    if not tall:
        depth_bar(figure, mappable, left)
    map_axes(left, frame, _survey_title(survey, frame, relief))
    draw_track(left, survey)
    mappable = relief.draw(right, frame, truth_up_m)
    map_axes(right, frame, "True seabed")
    if tall:
        right.set_ylabel("")
    else:
        left.set_xlabel("")
    depth_bar(figure, mappable, right)
    return figure


def difference_picture(survey, frame: Frame, difference_m, error_m, statistics: dict) -> Figure:
    """Map of survey minus truth, histogram of all soundings, and how the error grows with the beam angle."""
    tall = map_size_in(frame)[1] > 0.75 * map_size_in(frame)[0]
    figure = new_figure(11.0 if tall else 12.5, 7.2 if tall else 5.6)
    left, right = figure.subfigures(1, 2, width_ratios=(1.25 if tall else 1.75, 1))
    limit = max(3 * robust_std(error_m), 0.01)
    axes = left.subplots()
    mappable = axes.imshow(difference_m, extent=frame.extent_m, origin="lower", interpolation="nearest", cmap="RdBu_r",
                           vmin=-limit, vmax=limit)
    map_axes(axes, frame, "")
    left.suptitle(f"Survey minus truth, mean per {frame.cell_m:g} m cell\n{_in_words(statistics)}", x=0.02, ha="left",
                  fontsize=10)
    colour_bar(left, mappable, axes, "survey minus truth (m); red: too shallow, blue: too deep")
    histogram, by_angle = right.subplots(2, 1)
    _draw_histogram(histogram, error_m, statistics)
    _draw_by_angle(by_angle, survey.soundings, error_m)
    return figure


def robust_std(values) -> float:
    """Standard deviation of a Gaussian with the values' median deviation: outliers do not count."""
    known = values[np.isfinite(values)]
    return 1.4826 * float(np.median(np.abs(known - np.median(known))))


def _in_words(s):
    return (f"bias {s['bias_m']:+.3f} m, standard deviation {s['std_m']:.3f} m, 95 % within {s['within_95_m']:.3f} m\n"
            f"inside IHO S-44 Special Order: {100 * s['inside_special_order']:.1f} % of {s['soundings']:,} soundings")


def _draw_histogram(axes, error_m, statistics):
    known = error_m[np.isfinite(error_m)]
    spread = max(5 * robust_std(known), 0.01)
    outside = np.mean(np.abs(known) > spread)
    axes.hist(known, bins=np.linspace(-spread, spread, 81), color="#3a86bd")
    axes.set_title(f"{100 * outside:.2f} % lie outside", fontsize=8, loc="right")
    axes.axvline(0, color="black", linewidth=0.8)
    axes.axvline(statistics["bias_m"], color="#c0392b", linewidth=1.2, label=f"bias {statistics['bias_m']:+.3f} m")
    axes.set(xlabel="sounding minus truth, up (m)", ylabel="soundings")
    axes.yaxis.set_major_formatter("{x:,.0f}")
    axes.legend(fontsize=7)
    axes.tick_params(labelsize=8)


def _draw_by_angle(axes, soundings, error_m):
    angle = np.degrees(soundings.beam_angle_rad)
    edges = np.linspace(angle.min(), angle.max() + 1e-6, 66)
    number = np.clip(np.digitize(angle, edges) - 1, 0, 64)
    known = np.isfinite(error_m)
    count = np.bincount(number[known], minlength=65)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.bincount(number[known], error_m[known], 65) / count
        spread = np.sqrt(np.maximum(np.bincount(number[known], error_m[known] ** 2, 65) / count - mean**2, 0))
    middle = (edges[:-1] + edges[1:]) / 2
    axes.fill_between(middle, mean - 2 * spread, mean + 2 * spread, color="#3a86bd", alpha=0.3, linewidth=0,
                      label="mean ± 2 standard deviations")
    axes.plot(middle, mean, color="#2b2a66", linewidth=1.2, label="mean")
    reported = np.isfinite(soundings.tvu_m)
    if reported.any():
        with np.errstate(invalid="ignore", divide="ignore"):
            tvu_m = np.bincount(number[reported], soundings.tvu_m[reported], 65) / np.bincount(number[reported], minlength=65)
        for side, label in ((1, "predicted TVU, 95 %"), (-1, None)):
            axes.plot(middle, side * tvu_m, color="#c0392b", linewidth=1.0, linestyle="--", label=label)
    axes.axhline(0, color="black", linewidth=0.8)
    reach = 3 * float(np.nanmedian(np.abs(mean) + 2 * spread))
    axes.set_ylim(-reach, reach)
    axes.set(xlabel="beam angle, positive to starboard (°)", ylabel="sounding minus truth (m)")
    axes.legend(fontsize=7, loc="upper center")
    axes.grid(alpha=0.2)
    axes.tick_params(labelsize=8)
