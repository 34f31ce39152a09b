"""One multibeam ping: as a fan through the water, and as what every beam received over range."""
from dataclasses import dataclass

import numpy as np

import ensonify
from ensonify_plot import geometry
from ensonify_plot.received import ReceivedPing
from ensonify_plot.level import Gain, Limits, gain_for, level_db, limits_of
from ensonify_plot.pictures import entitle, new_figure

ECHOES = "inferno"  # dark to bright, evenly, also for the colour-blind and on paper
FINDS = "#6fe3ff"  # detections on top of it
EMPTY = "#2a2a2a"  # where no beam pointed
PERCENTILES = (20, 99.9)
CELLS = 900  # pixels across a picture


@dataclass(frozen=True)
class Show:
    """What the user asks of the colours."""

    gain: object = "none"  # see level.gain_for
    limits_db: tuple | None = None


def levels(received: ReceivedPing, gain: Gain) -> np.ndarray:
    """Beam x sample, dB."""
    return level_db(received.power_upa2) + gain.db(received.range_m)


def bar(figure, mappable, axes, gain: Gain, limits: Limits) -> None:
    """The colour scale, below the axes (one or several): quantity, reference, and where its ends come from."""
    below = figure.colorbar(mappable, ax=axes, location="bottom", shrink=0.7, aspect=50, pad=0.02, extend="both")
    below.set_label(f"{gain.label()}; colours: {limits.origin}", fontsize=9)
    below.ax.tick_params(labelsize=8)


def headline(figure, what: str, received: ReceivedPing) -> None:
    """What, and which ping of which head; when and with which settings below."""
    entitle(figure, f"{what}: {received.head}, ping {received.ping.ping}", [f"t = {received.t_s:.3f} s; {received.facts()}"])


def fan_picture(received: ReceivedPing, soundings: ensonify.Soundings | None, show: Show):
    """A section across the track with the same scale both ways."""
    gain = gain_for(show.gain, received.ping, Gain())
    fan = fan_image(received, gain, deepest_m(received, soundings))
    limits = limits_of(fan.level_db, show.limits_db, PERCENTILES)
    west, east, bottom, top = fan.extent_m
    figure = new_figure(9.5, float(np.clip(1.5 + 9.0 * (bottom - top) / (east - west), 3.0, 10.0)))
    axes = figure.subplots()
    bar(figure, draw_fan(axes, fan, limits), axes, gain, limits)
    headline(figure, "Fan", received)
    return figure


@dataclass
class Fan:
    """A section as an image with its place: west, east, bottom, top in metres."""

    level_db: np.ndarray
    extent_m: tuple
    upright: bool  # turned by the measured attitude; else about the head's own down axis


def fan_image(received: ReceivedPing, gain: Gain, bottom_m: float) -> Fan:
    """Every pixel gets the mean power of the nearest beam about its range."""
    vertical = received.vertical_rad()
    angle = received.angle_rad - (vertical or 0.0)
    left, right, top, bottom = geometry.polar_bounds_m(angle, max(received.first_range_m, 0.0), received.end_m)
    bottom = min(bottom, bottom_m)
    reach = max(abs(x) for x in (left, right))
    if bottom < received.end_m:  # nothing is drawn below: nor is what lies out of the fan at that depth
        reach = min(reach, bottom * max(np.tan(np.minimum(np.abs(geometry.beam_edges_rad(angle)), 1.4))))
    left, right = max(left, -reach), min(right, reach)
    cell_m = max((right - left) / CELLS, received.step_m / 2)
    power = received.power_upa2 * np.power(10.0, gain.db(received.range_m) / 10)
    power, first_m, step_m = geometry.thinned(power, received.first_range_m, received.step_m, cell_m)
    across = np.arange(left, right, cell_m) + cell_m / 2
    down = np.arange(min(top, 0.0), bottom, cell_m) + cell_m / 2
    image = geometry.polar_image(power, angle, first_m, step_m, across[None, :], down[:, None])
    extent = (left, left + len(across) * cell_m, min(top, 0.0) + len(down) * cell_m, min(top, 0.0))
    return Fan(level_db(image), extent, vertical is not None)


def deepest_m(received: ReceivedPing, soundings: ensonify.Soundings | None) -> float:
    """Depth below the head down to which a section is worth drawing: somewhat beyond the deepest sounding."""
    found = soundings is not None and (soundings.valid == 1) & np.isfinite(soundings.travel_time_s)
    if not np.any(found):
        return received.end_m
    angle = soundings.beam_angle_rad[found] - (received.vertical_rad() or 0.0)
    seen_m = soundings.travel_time_s[found] * np.cos(angle) * received.ping.sound_speed_mps / 2
    return min(received.end_m, 1.25 * float(seen_m.max()))


def draw_fan(axes, fan: Fan, limits: Limits):
    """Returns what a colour bar needs."""
    axes.set_facecolor(EMPTY)
    mappable = axes.imshow(fan.level_db, extent=fan.extent_m, cmap=ECHOES, vmin=limits.low_db, vmax=limits.high_db,
                           interpolation="nearest")
    down = "upright by the measured attitude" if fan.upright else "along the head's down axis"
    axes.set(xlabel="across track, positive to starboard (m)", ylabel="below the head (m)")
    axes.tick_params(labelsize=8)
    axes.set_title(f"{down}; straight rays at the head's sound speed", fontsize=8, loc="right")
    return mappable


def draw_beams(axes, received: ReceivedPing, gain: Gain, limits: Limits, soundings: ensonify.Soundings | None):
    """Beam number against slant range, with detections; returns what a colour bar needs."""
    beams = len(received.power_upa2)
    power = received.power_upa2 * np.power(10.0, gain.db(received.range_m) / 10)
    power, first_m, step_m = geometry.thinned(power, received.first_range_m, received.step_m, received.end_m / CELLS)
    far_m = first_m + (power.shape[1] - 0.5) * step_m
    mappable = axes.imshow(level_db(power).T, extent=(-0.5, beams - 0.5, far_m, first_m - step_m / 2), aspect="auto",
                           cmap=ECHOES, vmin=limits.low_db, vmax=limits.high_db, interpolation="nearest")
    half_speed = received.ping.sound_speed_mps / 2e3
    if soundings is not None:
        draw_detections(axes, soundings, beams, half_speed * 1e3)
    axes.set_facecolor(EMPTY)
    first_deg, last_deg = np.degrees(received.angle_rad[[0, -1]])
    axes.set(xlabel=f"beam (0: {first_deg:+.0f}°, {beams - 1}: {last_deg:+.0f}° from the head's down axis, positive to starboard)",
             ylabel="slant range (m)")
    time = axes.secondary_yaxis("right", functions=(lambda m: m / half_speed, lambda ms: ms * half_speed))
    time.set_ylabel("time after transmission (ms)")
    for each in (axes, time):
        each.tick_params(labelsize=8)
    return mappable


def draw_detections(axes, soundings, beams: int, half_speed_mps: float) -> None:
    """A dot at every valid detection."""
    found = (soundings.valid == 1) & np.isfinite(soundings.travel_time_s)
    beam = soundings.beam if soundings.beam.size else np.arange(len(soundings.valid))
    axes.plot(beam[found], half_speed_mps * soundings.travel_time_s[found], ".", color=FINDS, markersize=1.6,
              label=f"detections ({np.unique(beam[found]).size} of {beams} beams)")
    axes.legend(loc="upper center", fontsize=7, markerscale=5)


def ping_picture(received: ReceivedPing, soundings: ensonify.Soundings | None, show: Show = Show()):
    """Beam-range image with its detections, beside the fan."""
    gain = gain_for(show.gain, received.ping, Gain())
    limits = limits_of(levels(received, gain), show.limits_db, PERCENTILES)
    figure = new_figure(13, 5.8)
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.6))
    draw_beams(left, received, gain, limits, soundings)
    mappable = draw_fan(right, fan_image(received, gain, deepest_m(received, soundings)), limits)
    bar(figure, mappable, [left, right], gain, limits)
    headline(figure, "Beams and fan", received)
    return figure
