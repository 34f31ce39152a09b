"""A sidescan waterfall: port and starboard over time, in slant range or over ground."""
import numpy as np
from matplotlib.colors import LinearSegmentedColormap

import ensonify
from ensonify_plot import geometry
from ensonify_plot.received import Span, choose_topic, has_two_sides, require_soundings, of_heads, one_of_process, pings_in
from ensonify_plot.level import Gain, Limits, gain_for, level_db, limits_of
from ensonify_plot.ping import EMPTY, FINDS, Show, bar
from ensonify_plot.pictures import new_figure
from ensonify_plot.stack import ALONG, Track, second_axis, span_headline, stacked
from ensonify_plot.errors import UserError

COPPER = LinearSegmentedColormap.from_list("copper", ["#000000", "#3a1d08", "#8a4b12", "#cf8a2c", "#f3c870", "#fff6dc"])
PERCENTILES = (2, 99.7)  # of the seabed
WITH_COLUMN = (25, 99.7)  # of all, where nothing separates the water column from the seabed
LEVELLED = Gain(30.0)  # a seabed cut by the pulse, where the head has no gain law
CELLS = 480  # of a side
WIDTH_IN = 9.0  # of both sides together
LEAST_IN, MOST_IN = 2.0, 36.0  # along the track; beyond, a picture to scale is of no use


def read(record: ensonify.Record, topic: str | None, numbers: Span, times: Span, ground: bool) -> tuple:
    """(pings, valid bottom tracks by ping number) of a span."""
    fits = of_heads(record, False, has_two_sides, lambda _, ping: has_two_sides(ping))
    topic = choose_topic(record, topic, fits, "sidescan pings (one beam to port, one to starboard)")
    pings = list(pings_in(record, topic, numbers, times))
    odd = next((received for received in pings if not has_two_sides(received.ping)), None)
    if odd:
        raise UserError(f"{record.file}: ping {odd.ping.ping} of {topic} has {len(odd.angle_rad)} beams; a waterfall needs one to "
                        "port (beam_angle_rad below 0) and one to starboard")
    for side, beam in (("port", np.argmin), ("starboard", np.argmax)):
        require_soundings(f"{record.file}: {topic}, {side}, pings {pings[0].ping.ping} to {pings[-1].ping.ping}",
                   np.array([received.power_upa2[beam(received.angle_rad)].max() for received in pings]))
    source = one_of_process(record, topic, ensonify.BottomTrack)
    tracks = {m.content.ping: m.content for m in record.messages(source)} if source else {}
    tracks = {received.ping.ping: tracks[received.ping.ping] for received in pings
              if received.ping.ping in tracks and tracks[received.ping.ping].valid}
    if ground and not tracks:
        why = f"{source} has no bottom for these pings" if source else f"no bottom_track/1 of {pings[0].head} was recorded"
        raise UserError(f"{record.file}: {why}; without the instrument's own bottom track there is no ground range; leave out "
                        "--ground for slant range")
    return pings, tracks


def lines_of(pings: list, altitudes_m: list, gain: Gain, cell_m: float, cells: int) -> np.ndarray:
    """Ping x cell, port mirrored to the left of starboard. An altitude of NaN leaves its line empty."""
    lines = np.full((len(pings), 2 * cells), np.nan, np.float32)
    for line, received, altitude_m in zip(lines, pings, altitudes_m):
        if not np.isfinite(altitude_m):
            continue
        power = received.power_upa2 * np.power(10.0, gain.db(received.range_m) / 10)
        sides = [geometry.ground_line(power[beam(received.angle_rad)], received.first_range_m, received.step_m, altitude_m, cell_m,
                                      cells) for beam in (np.argmin, np.argmax)]
        line[:] = np.concatenate([sides[0][::-1], sides[1]])
    return lines


def waterfall_picture(pings: list, tracks: dict, ground: bool, show: Show):
    """Runs upwards, so that port is left and starboard right as on deck: by distance, to scale, where the track is known, else by time."""
    gain = gain_for(show.gain, pings[0].ping, LEVELLED)
    known_m = [tracks[received.ping.ping].altitude_m if received.ping.ping in tracks else np.nan for received in pings]
    altitudes_m = known_m if ground else [0.0] * len(pings)
    reach_m = max(float(geometry.ground_range_m(received.end_m, altitude)) if np.isfinite(altitude) else 0.0
                  for received, altitude in zip(pings, altitudes_m))
    cell_m = reach_m / CELLS
    track = Track.of(pings)
    distance_m = track.distance_m()
    main, other = (track.time_scale(), track.other_scale()) if distance_m is None else ((ALONG, distance_m), track.time_scale())
    stack = stacked(main[1], lines_of(pings, altitudes_m, gain, cell_m, CELLS), track.t_s)
    image = level_db(stack.rows)
    limits = colours(image, reach_m, 0.0 if ground else np.nanmax(known_m) if tracks else None, show)
    high_in = WIDTH_IN * (stack.end - stack.begin) / (2 * reach_m)
    to_scale = distance_m is not None and LEAST_IN <= high_in <= MOST_IN
    figure = new_figure(WIDTH_IN + 1.5, (high_in if to_scale else 6.0) + 2.0)
    axes = figure.subplots()
    mappable = axes.imshow(image, extent=(-reach_m, reach_m, stack.begin, stack.end), origin="lower", aspect="equal" if to_scale else "auto",
                           cmap=COPPER, vmin=limits.low_db, vmax=limits.high_db, interpolation="nearest")
    axes.set_facecolor(EMPTY)
    dress(axes, ground, main, other)
    if tracks and not ground:
        draw_bottom(axes, main[1], known_m)
    bar(figure, mappable, axes, gain, limits)
    notes = remarks(pings, known_m, ground, stack.averaged)
    if distance_m is not None and not to_scale:
        notes.append("along the track not to scale; fewer or more pings, --ping A:B, are")
    span_headline(figure, f"Sidescan, {'ground' if ground else 'slant'} range", pings[0], pings[-1], notes)
    return figure


def colours(image, reach_m: float, column_m: float | None, show: Show) -> Limits:
    """By the seabed alone, beyond the widest water column: that is nearly silent and would take all the contrast."""
    if column_m is None:
        return limits_of(image, show.limits_db, WITH_COLUMN)
    across_m = np.abs(np.linspace(-1, 1, 2 * image.shape[1] + 1)[1::2]) * reach_m
    seabed = image[:, across_m > column_m]
    if not np.isfinite(seabed).any():
        return limits_of(image, show.limits_db, WITH_COLUMN)
    return limits_of(seabed, show.limits_db, PERCENTILES, " of the seabed")


def remarks(pings: list, known_m: list, ground: bool, averaged: int) -> list:
    """What a reader must know of how the picture was made."""
    notes = []
    if ground:
        blank = int(np.count_nonzero(~np.isfinite(known_m)))
        notes.append("level bottom at the instrument's own bottom track, "
                    f"{np.nanmin(known_m):.1f} to {np.nanmax(known_m):.1f} m below"
                    + (f"; {blank} of {len(pings)} pings without one are left empty" if blank else ""))
    if averaged > 1:
        notes.append(f"{averaged} pings averaged per row")
    return ["; ".join(notes)] if notes else []


def dress(axes, ground: bool, main: tuple, other: tuple) -> None:
    """Scales: range to both sides; upwards the main one of (label, values of the pings), the other on the right."""
    axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
    axes.set(xlabel=f"port     {'ground' if ground else 'slant'} range (m)     starboard", ylabel=main[0])
    axes.tick_params(labelsize=8)
    second_axis(axes, "right", main, other)


def draw_bottom(axes, along: np.ndarray, altitude_m: list) -> None:
    """The first bottom as the instrument tracked it, on both sides."""
    for side in (-1, 1):
        axes.plot(side * np.array(altitude_m), along, color=FINDS, linewidth=0.8,
                  label="first bottom" if side > 0 else None)
    axes.legend(loc="upper right", fontsize=7)
