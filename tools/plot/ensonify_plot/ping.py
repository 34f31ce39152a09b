"""One ping: what every beam heard over time, and the same seen as a section through the water."""
import numpy as np

import ensonify
from ensonify_plot.pictures import colour_bar, new_figure
from ensonify_plot.survey import UserError


def find_ping(record: ensonify.Record, topic: str | None, number: int | None) -> tuple:
    """(topic, ping, soundings of the same ping or None). Without a number the one in the middle of the record."""
    topics = record.topics_of(ensonify.Ping)
    if not topics:
        raise UserError(f"{record.file}: holds no pings (no topic of type ping/1 was recorded)")
    if topic is not None and topic not in topics:
        raise UserError(f"{record.file}: {topic} is no recorded ping topic; there are {', '.join(topics)}")
    topic = topic or topics[0]
    numbers = [message.content.ping for message in record.messages(topic)]
    if not numbers:
        raise UserError(f"{record.file}: {topic} was recorded, but holds no ping")
    if number is None:
        number = numbers[len(numbers) // 2]
    if number not in numbers:
        near = min(numbers, key=lambda n: abs(n - number))
        raise UserError(f"{record.file}: ping {number} of {topic} was not recorded; the nearest is {near}, "
                        f"and there are {len(numbers)} from {numbers[0]} to {numbers[-1]}")
    ping = next(m.content for m in record.messages(topic) if m.content.ping == number)
    head = topic.rsplit("/", 1)[0]
    for other in record.topics_of(ensonify.Soundings):
        if other.rsplit("/", 1)[0] == head:
            return topic, ping, next((m.content for m in record.messages(other) if m.content.ping == number), None)
    return topic, ping, None


def ping_picture(topic: str, ping: ensonify.Ping, soundings: ensonify.Soundings | None):
    """Beam-time image in dB re 1 uPa with its detections, beside a section across the track."""
    level_db = 20 * np.log10(np.maximum(ping.amplitude_upa, 1e-3))
    low, high = np.percentile(level_db, 20), level_db.max()
    low, high = max(low, high - 90), max(high, low + 1)
    figure = new_figure(13, 5.8)
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.35))
    mappable = _draw_beam_time(left, ping, level_db, low, high, soundings)
    _draw_section(right, ping, level_db, low, high, deepest_m(ping, soundings))
    colour_bar(figure, mappable, right, "received level, rms (dB re 1 µPa)")
    figure.suptitle(f"{topic}: ping {ping.ping} at t = {ping.stamp_ns * 1e-9:.3f} s; {ping.frequency_hz / 1e3:g} kHz, pulse "
                    f"{ping.pulse_length_s * 1e3:g} ms, source level {ping.source_level_db:g} dB re 1 µPa at 1 m, sound speed "
                    f"{ping.sound_speed_mps:g} m/s", fontsize=10)
    return figure


def _draw_beam_time(axes, ping, level_db, low, high, soundings):
    beams, samples = level_db.shape
    first_ms, last_ms = (1e3 * (ping.first_sample_s + n * ping.sample_period_s) for n in (0, samples))
    mappable = axes.imshow(level_db.T, extent=(-0.5, beams - 0.5, last_ms, first_ms), aspect="auto", cmap="inferno",
                           vmin=low, vmax=high, interpolation="nearest")
    if soundings is not None:
        found = soundings.valid == 1
        axes.plot(np.flatnonzero(found), 1e3 * soundings.travel_time_s[found], ".", color="#6fe3ff", markersize=1.6,
                  label=f"detections ({np.count_nonzero(found)} of {beams} beams)")
        axes.legend(loc="upper center", fontsize=7, markerscale=5)
    axes.set(xlabel=f"beam (0 = {np.degrees(ping.beam_angle_rad[0]):.0f}°, "
                    f"{beams - 1} = {np.degrees(ping.beam_angle_rad[-1]):+.0f}°, positive to starboard)",
             ylabel="time after transmission (ms)")
    half_speed = ping.sound_speed_mps / 2e3
    ranges = axes.secondary_yaxis("right", functions=(lambda ms: ms * half_speed, lambda m: m / half_speed))
    ranges.set_ylabel("slant range (m)")
    axes.set_title("Every beam over time", fontsize=10, loc="left")
    return mappable


def deepest_m(ping: ensonify.Ping, soundings: ensonify.Soundings | None) -> float:
    """Depth below the head down to which a section is worth drawing."""
    whole_m = (ping.first_sample_s + ping.amplitude_upa.shape[1] * ping.sample_period_s) * ping.sound_speed_mps / 2
    found = soundings is not None and soundings.valid == 1
    if not np.any(found):
        return whole_m
    seen_m = (soundings.travel_time_s * np.cos(soundings.beam_angle_rad))[found] * ping.sound_speed_mps / 2
    return min(whole_m, 1.4 * float(seen_m.max()))


def _draw_section(axes, ping, level_db, low, high, bottom_m):
    beams, samples = level_db.shape
    time_s = ping.first_sample_s + np.arange(samples + 1) * ping.sample_period_s
    step = max(1, samples // 1200)  # no finer than the picture's pixels
    trimmed = level_db[:, :samples // step * step].reshape(beams, -1, step).max(axis=2)
    range_m = time_s[: trimmed.shape[1] * step + 1 : step] * ping.sound_speed_mps / 2
    angle = np.asarray(ping.beam_angle_rad, float)
    middle = (angle[1:] + angle[:-1]) / 2
    edges = np.concatenate([[2 * angle[0] - middle[0]], middle, [2 * angle[-1] - middle[-1]]]) if beams > 1 else angle[0] + \
        np.array([-0.01, 0.01])
    across, down = np.outer(np.sin(edges), range_m), np.outer(np.cos(edges), range_m)
    axes.pcolormesh(across, down, trimmed, cmap="inferno", vmin=low, vmax=high, shading="flat", rasterized=True)
    axes.set(xlabel="across, positive to starboard (m)", ylabel="below the head along its down axis (m)")
    axes.set_aspect("equal")
    axes.set_xlim(across.min(), across.max())
    axes.set_ylim(max(bottom_m, 1e-3), min(down.min(), 0))
    axes.set_facecolor("#222222")
    axes.set_title("Section across the track (straight rays)", fontsize=10, loc="left")
