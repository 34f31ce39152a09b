"""What a mechanically scanned head saw around it: the newest row of every direction, as on its display."""
import itertools
import math

import numpy as np

import ensonify
from ensonify_plot import geometry
from ensonify_plot.forward_looking import AMBER, LEVELLED, PERCENTILES, polar_panel, range_arcs
from ensonify_plot.received import ReceivedPing, received, require_soundings, place_of
from ensonify_plot.level import gain_for, limits_of
from ensonify_plot.ping import Show, bar
from ensonify_plot.pictures import new_figure
from ensonify_plot.stack import span_headline
from ensonify_plot.errors import UserError

SAME_RAD = math.radians(0.02)  # directions nearer than this are one: no head steps so finely
SAME_STEP = 0.01  # a hundredth of the range, half a pixel


def turn_of(record: ensonify.Record, topic: str, number: int | None, t_s: float | None) -> list:
    """The newest row of every direction up to a ping (the last one, this number, or the first at or after this time), earliest
    first. Rows from before a change of range are left out."""
    end = place_of(record, topic, number, t_s, lambda count: count - 1)
    rows, last = {}, None
    for message in itertools.islice(record.messages(topic), end + 1):
        last = received(topic, message.content)
        if len(last.angle_rad) != 1:
            raise UserError(f"{record.file}: ping {last.ping.ping} of {topic} has {len(last.angle_rad)} beams; a scanning head has one")
        rows[round(float(last.angle_rad[0]) / SAME_RAD)] = last
    turn = [row for row in rows.values() if fits(row, last)]
    require_soundings(f"{record.file}: {topic}, up to ping {last.ping.ping}", np.array([row.power_upa2.max() for row in turn]))
    return sorted(turn, key=lambda row: row.ping.ping)


def fits(row: ReceivedPing, last: ReceivedPing) -> bool:
    """Whether a row stands in one picture with the last: as many samples, as far apart but for a sound speed that changed a little."""
    return row.power_upa2.shape == last.power_upa2.shape and abs(row.step_m / last.step_m - 1) < SAME_STEP


def assembled(turn: list) -> ReceivedPing:
    """The rows as one ping with many beams, in the order of their angles, which rise beyond 180 degrees where the head pointed
    astern: the widest gap between two directions is where they end."""
    angle = np.array([row.angle_rad[0] for row in turn])
    order = np.argsort(angle)
    gaps = np.diff(angle[order], append=angle[order[0]] + 2 * np.pi)
    order = np.roll(order, -1 - int(np.argmax(gaps)))
    rising = angle[order]
    rising = np.where(rising < rising[0], rising + 2 * np.pi, rising)
    last = turn[-1]
    return ReceivedPing(last.topic, last.ping, np.concatenate([turn[i].power_upa2 for i in order]), rising, last.first_range_m, last.step_m)


def moved(turn: list) -> list:
    """How far the head went while it scanned, by its own estimate: the picture is not corrected for it."""
    poses = [row.ping for row in (turn[0], turn[-1])]
    if any(p.pose_position_enu_m.ndim != 2 or not len(p.pose_position_enu_m) for p in poses):
        return []
    way_m = float(np.linalg.norm(poses[1].pose_position_enu_m[0] - poses[0].pose_position_enu_m[0]))
    return [f"seen from where the head was at each ping; it moved {way_m:.1f} m meanwhile"]


def scan_picture(turn: list, show: Show):
    """The plane that the head turns in, its forward axis up."""
    whole = assembled(turn)
    gain = gain_for(show.gain, whole.ping, LEVELLED)
    power = whole.power_upa2 * np.power(10.0, gain.db(whole.range_m) / 10)
    image, extent_m = polar_panel(whole, power)
    limits = limits_of(image, show.limits_db, PERCENTILES)
    figure = new_figure(8.5, 9.0)
    axes = figure.subplots()
    mappable = axes.imshow(image, extent=extent_m, cmap=AMBER, vmin=limits.low_db, vmax=limits.high_db, origin="lower",
                           interpolation="nearest")
    axes.set_facecolor("white")
    axes.set(xlabel="starboard of the head (m)", ylabel="ahead of the head (m)")
    axes.tick_params(labelsize=8)
    range_arcs(axes, whole, at_rad=math.radians(45) if covers(whole, math.radians(45)) else None)
    bearings(axes, whole)
    bar(figure, mappable, axes, gain, limits)
    span_headline(figure, f"Scanning sonar, {len(turn)} directions", turn[0], turn[-1], moved(turn))
    return figure


def covers(whole: ReceivedPing, angle_rad: float) -> bool:
    """Whether the head pointed there."""
    return bool(geometry.beam_at(whole.angle_rad, np.array([angle_rad]))[0] >= 0)


def bearings(axes, whole: ReceivedPing) -> None:
    """Spokes every 30 degrees, named by their angle from the head's forward axis; starboard is positive."""
    for degrees in range(-150, 181, 30):
        at_rad = math.radians(degrees)
        if not covers(whole, at_rad):
            continue
        direction = np.array([math.sin(at_rad), math.cos(at_rad)])
        axes.plot(*np.outer(direction, (max(whole.first_range_m, 0.0), whole.end_m)), color="white", linewidth=0.4, alpha=0.4)
        axes.annotate(f"{degrees:g}°", 1.04 * whole.end_m * direction, fontsize=7, ha="center", va="center", annotation_clip=False)
    reach_m = 1.09 * whole.end_m
    axes.set_xlim(min(axes.get_xlim()[0], -reach_m) if covers(whole, -math.pi / 2) else None,
                  max(axes.get_xlim()[1], reach_m) if covers(whole, math.pi / 2) else None)
    axes.set_ylim(min(axes.get_ylim()[0], -reach_m) if covers(whole, math.pi) else None,
                  max(axes.get_ylim()[1], reach_m) if covers(whole, 0.0) else None)
