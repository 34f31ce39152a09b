"""The water column: one ping, beam against range, or one beam, straight down unless asked otherwise, over many pings."""
import numpy as np

import ensonify
from ensonify_plot import geometry
from ensonify_plot.received import ReceivedPing, require_soundings, one_of_process
from ensonify_plot.level import Gain, gain_for, level_db, limits_of
from ensonify_plot.ping import ECHOES, EMPTY, FINDS, PERCENTILES, Show, bar, draw_beams, headline, levels
from ensonify_plot.pictures import new_figure
from ensonify_plot.stack import Track, second_axis, span_headline, stacked
from ensonify_plot.errors import UserError

CELLS = 500  # in range
FARTHEST_RAD = np.radians(15.0)  # a head may roll or be mounted aslant; farther off its beam is not what was asked for


def beam_picture(received: ReceivedPing, soundings: ensonify.Soundings | None, show: Show):
    """One ping, beam against slant range, its detections on top."""
    gain = gain_for(show.gain, received.ping, Gain())
    limits = limits_of(levels(received, gain), show.limits_db, PERCENTILES)
    figure = new_figure(9.5, 6.5)
    axes = figure.subplots()
    bar(figure, draw_beams(axes, received, gain, limits, soundings), axes, gain, limits)
    headline(figure, "Water column", received)
    return figure


def beam_towards(received: ReceivedPing, from_vertical_rad: float) -> int:
    """Index of the beam nearest to an angle from the vertical, or from the head's down axis if the ping gives no attitude. Raises
    UserError if none points there."""
    angle = received.angle_rad - (received.vertical_rad() or 0.0)
    beam = int(np.argmin(np.abs(angle - from_vertical_rad)))
    if abs(angle[beam] - from_vertical_rad) > FARTHEST_RAD:
        first_deg, last_deg = np.degrees([angle.min(), angle.max()])
        raise UserError(f"ping {received.ping.ping} of {received.topic} has no beam near {np.degrees(from_vertical_rad):+g}° from straight "
                        f"down; its beams run from {first_deg:+.0f}° to {last_deg:+.0f}°")
    return beam


def lines_of(pings: list, beams: list, gain: Gain, cell_m: float, cells: int) -> np.ndarray:
    """Ping x range cell: mean power of the chosen beam of each ping."""
    return np.array([geometry.ground_line(received.power_upa2[beam] * np.power(10.0, gain.db(received.range_m) / 10),
                                          received.first_range_m, received.step_m, 0.0, cell_m, cells)
                     for received, beam in zip(pings, beams)])


def detections_of(record: ensonify.Record, pings: list, beams: list) -> tuple:
    """(time of transmission, slant range) of what was detected in the chosen beam of each ping."""
    topic = one_of_process(record, pings[0].topic, ensonify.Soundings)
    if topic is None:
        return tracked(record, pings)
    chosen = {received.ping.ping: (received, beam) for received, beam in zip(pings, beams)}
    found = []
    for message in record.messages(topic):
        s = message.content
        if s.ping not in chosen:
            continue
        received, beam = chosen[s.ping]
        entries = (s.beam if s.beam.size else np.arange(len(s.valid))) == beam
        for time_s in s.travel_time_s[entries & (s.valid == 1)]:
            found.append((received.t_s, float(time_s) * received.ping.sound_speed_mps / 2))
    return tuple(np.array(found).reshape(-1, 2).T)


def tracked(record: ensonify.Record, pings: list) -> tuple:
    """The same of a head that publishes no soundings but a bottom track, such as an echosounder."""
    topic = one_of_process(record, pings[0].topic, ensonify.BottomTrack)
    t_s = {received.ping.ping: received.t_s for received in pings}
    tracks = (m.content for m in record.messages(topic)) if topic else ()
    return tuple(np.array([(t_s[m.ping], m.altitude_m) for m in tracks if m.valid and m.ping in t_s]).reshape(-1, 2).T)


def stack_picture(record: ensonify.Record, pings: list, from_vertical_deg: float, show: Show):
    """Range downwards, time to the right."""
    gain = gain_for(show.gain, pings[0].ping, Gain())
    beams = [beam_towards(received, np.radians(from_vertical_deg)) for received in pings]
    strongest = np.array([received.power_upa2[beam].max() for received, beam in zip(pings, beams)])
    require_soundings(f"{record.file}: {pings[0].topic}, beam {beams[0]}", strongest)
    t_s, range_m = detections_of(record, pings, beams)
    reach_m = max(received.end_m for received in pings)
    if len(range_m):
        reach_m = min(reach_m, 1.5 * range_m.max())  # what lies deeper is noise, or the bottom once more
    stack = stacked([received.t_s for received in pings], lines_of(pings, beams, gain, reach_m / CELLS, CELLS))
    image = level_db(stack.rows)
    limits = limits_of(image, show.limits_db, PERCENTILES)
    figure = new_figure(11.5, 6.0)
    axes = figure.subplots()
    mappable = axes.imshow(image.T, extent=(stack.begin, stack.end, reach_m, 0.0), aspect="auto", cmap=ECHOES,
                           vmin=limits.low_db, vmax=limits.high_db, interpolation="nearest")
    axes.set_facecolor(EMPTY)
    if len(t_s):
        axes.plot(t_s, range_m, ".", color=FINDS, markersize=2, label=f"detected ({len(t_s)})")
        axes.legend(loc="upper right", fontsize=7, markerscale=4)
    track = Track.of(pings)
    axes.set(xlabel=track.time_scale()[0], ylabel="slant range from the head (m)")
    axes.tick_params(labelsize=8)
    second_axis(axes, "top", track.time_scale(), track.other_scale())
    bar(figure, mappable, axes, gain, limits)
    what = "straight down" if from_vertical_deg == 0 else f"{from_vertical_deg:+g}° from straight down"
    by = "straight down by the measured attitude" if pings[0].vertical_rad() is not None else "straight down by the head's down axis"
    averaged = f"; {stack.averaged} pings averaged per column" if stack.averaged > 1 else ""
    span_headline(figure, f"Water column {what}", pings[0], pings[-1], [by + averaged])
    return figure
