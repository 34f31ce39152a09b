"""The angular response curve: what the seabed scatters back against the grazing angle, from soundings."""
from dataclasses import dataclass

import numpy as np

import ensonify
from ensonify_plot.received import Span, process_of, settings_line
from ensonify_plot.level import Gain
from ensonify_plot.pictures import entitle, new_figure
from ensonify_plot.errors import UserError

ONE_WAY_EQUIVALENT = 1.1288  # equivalent width of a uniform line's beam over its -3 dB width
FEWEST = 10  # soundings that make a mean


@dataclass
class Response:
    """Soundings with their angles, and what was done to their levels."""

    grazing_rad: np.ndarray
    strength_db: np.ndarray
    starboard: np.ndarray
    unit: str
    corrections: str
    angles: str
    pings: list  # (number, time in s) of the first and the last
    topic: str
    facts: str


def area_m2(range_m, beam_rad, incidence_rad, transmit_rad: float, receive_rad: float):
    """Footprint of a beam on a level bottom from its one-way -3 dB widths: it widens by 1 / cos of the steering, and on the
    ground by 1 / cos of the incidence. The level of a sounding is its echo's energy over the pulse length: all of the
    footprint sends it (`kernels/acoustics/detect/bottom.h`), however short the pulse."""
    widths = np.square(ONE_WAY_EQUIVALENT) * transmit_rad * receive_rad
    return np.square(range_m) * widths / (np.cos(beam_rad) * np.cos(incidence_rad))


def incidence_rad(s: ensonify.Soundings) -> np.ndarray:
    """Angle from the vertical of each sounding, seen from the head, positive to starboard: by where the soundings lie if the
    message gives the head's place, else the beam's angle. On a level bottom its complement is the grazing angle."""
    poses = s.pose_position_enu_m
    if poses.ndim != 2 or len(poses) == 0:
        return np.asarray(s.beam_angle_rad, float)
    line_m = s.position_enu_m - poses[0]
    return np.copysign(np.arctan2(np.hypot(line_m[:, 0], line_m[:, 1]), -line_m[:, 2]), s.beam_angle_rad)


def own_strength_db(s: ensonify.Soundings, settings, absorption_dbpm: float) -> np.ndarray:
    """Strength from the level of each detection: EL - SL + 40 log R + 2 A R - 10 log area; the area only where the settings
    give the beam widths."""
    range_m = s.travel_time_s * settings.sound_speed_mps / 2
    source_db = settings.source_level_db
    if settings.sectors and s.sector.size:
        source_db = np.array([each.source_level_db for each in settings.sectors])[s.sector]
    strength = s.backscatter_db - source_db + Gain(40.0, absorption_dbpm).db(range_m)
    if reports_widths(settings):
        widths_rad = settings.transmit_beamwidth_rad, settings.receive_beamwidth_rad
        strength = strength - 10 * np.log10(area_m2(range_m, s.beam_angle_rad, incidence_rad(s), *widths_rad))
    return strength


def reports_widths(settings) -> bool:
    """Whether beam widths are known."""
    return settings.transmit_beamwidth_rad > 0 and settings.receive_beamwidth_rad > 0


def settings_of(record: ensonify.Record, topic: str, s: ensonify.Soundings):
    """The settings that soundings were made with: their own, or those of the head's first recorded ping."""
    if s.sound_speed_mps > 0:
        return s
    pings = [other for other in record.topics_of(ensonify.Ping) if process_of(other) == process_of(topic)]
    found = next((m.content for m in record.messages(*pings)), None) if pings else None
    if found is None or not found.sound_speed_mps > 0:
        raise UserError(f"{record.file}: {topic} does not state its settings (sound_speed_mps is 0), nor does a recorded ping "
                        f"of {process_of(topic)}: levels cannot be made up for range")
    return found


def read(record: ensonify.Record, topic: str | None, numbers: Span, times: Span, absorption_dbpm: float | None) -> Response:
    """The accepted soundings of a span. Raises UserError if there are none."""
    topic = _topic(record, topic)
    messages = [m.content for m in record.messages(topic)
                if numbers.holds(m.content.ping) and times.holds(m.content.stamp_ns * 1e-9)]
    if not messages:
        raise UserError(f"{record.file}: no soundings of {topic} lie in what was asked for; {_extent(record, topic)}")
    first = messages[0]
    common = settings_of(record, topic, first)
    by_head = absorption_dbpm is None and all(s.backscatter_strength_db.size for s in messages)
    taken_dbpm = common.gain_absorption_dbpm if absorption_dbpm is None else absorption_dbpm
    parts = []
    for s in messages:
        settings = s if s.sound_speed_mps > 0 else common
        strength = s.backscatter_strength_db if by_head else own_strength_db(s, settings, taken_dbpm)
        angle = incidence_rad(s)
        good = (s.valid == 1) & np.isfinite(strength) & np.isfinite(angle)
        parts.append((angle[good], strength[good]))
    angle, strength = (np.concatenate(column).astype(float) for column in zip(*parts))
    if not len(angle):
        raise UserError(f"{record.file}: none of the {sum(len(s.valid) for s in messages):,} entries of {topic} is an accepted "
                        "sounding with a level")
    unit, corrections = _state(common, by_head, taken_dbpm)
    reported = first.pose_position_enu_m.ndim == 2 and len(first.pose_position_enu_m) > 0
    angles = "straight line from head to sounding" if reported else "beam angle from the head's down axis: no pose is recorded"
    ends = [(s.ping, s.stamp_ns * 1e-9) for s in (first, messages[-1])]
    return Response(np.pi / 2 - np.abs(angle), strength, angle > 0, unit, corrections, angles, ends, topic, settings_line(common))


def _topic(record: ensonify.Record, asked: str | None) -> str:
    topics = record.topics_of(ensonify.Soundings)
    if not topics:
        raise UserError(f"{record.file}: holds no soundings (no topic of type soundings/1 was recorded)")
    if asked is not None and asked not in topics:
        raise UserError(f"{record.file}: {asked} is no recorded soundings topic; there are {', '.join(topics)}")
    if asked is None and len(topics) > 1:
        raise UserError(f"{record.file}: several topics hold soundings; name one with --topic: {', '.join(topics)}")
    return asked or topics[0]


def _extent(record, topic) -> str:
    all_ = [(m.content.ping, m.content.stamp_ns * 1e-9) for m in record.messages(topic)]
    return (f"there are pings {all_[0][0]} (t = {all_[0][1]:.3f} s) to {all_[-1][0]} (t = {all_[-1][1]:.3f} s)" if all_
            else "it holds none")


def _state(settings, by_head: bool, absorption_dbpm: float) -> tuple:
    """(quantity of the curve, corrections in words)."""
    strength = "backscattering strength (dB re 1 m² per m²)"
    if by_head:
        return strength, "strength as the head computed it: by its settings, on a flat seabed"
    absorption = f"2 R · {absorption_dbpm * 1e3:g} dB/km" if absorption_dbpm else "no absorption (none is stated)"
    done = f"corrected for source level, 40 log R, {absorption}"
    if reports_widths(settings):
        return strength, f"{done}, footprint of the beam; not for beam patterns"
    return "strength of the footprint (dB re 1 m²)", f"{done}; not for area (beam widths are not recorded)"


@dataclass
class Curve:
    """Means of linear power in classes of grazing angle."""

    grazing_deg: np.ndarray  # middles of the classes
    mean_db: np.ndarray  # NaN where fewer than FEWEST soundings are
    low_db: np.ndarray  # 16 % of the soundings lie below
    high_db: np.ndarray  # 16 % lie above
    count: np.ndarray


def curve(grazing_rad, strength_db, class_deg: float) -> Curve:
    """Classes from 0 to 90 degrees."""
    classes = int(np.ceil(90 / class_deg - 1e-9))
    number = np.clip((np.degrees(grazing_rad) / class_deg).astype(int), 0, classes - 1)
    count = np.bincount(number, minlength=classes)
    enough = count >= FEWEST
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = 10 * np.log10(np.bincount(number, np.power(10.0, np.asarray(strength_db) / 10), classes) / count)
    low, high = np.full(classes, np.nan), np.full(classes, np.nan)
    for each in np.flatnonzero(enough):
        low[each], high[each] = np.percentile(strength_db[number == each], (16, 84))
    return Curve((np.arange(classes) + 0.5) * class_deg, np.where(enough, mean, np.nan), low, high, count)


def angular_response_picture(response: Response, class_deg: float):
    """The curve over both sides with its spread, each side alone, and how many soundings stand behind it."""
    whole = curve(response.grazing_rad, response.strength_db, class_deg)
    if not np.isfinite(whole.mean_db).any():
        raise UserError(f"{response.topic}: no class of {class_deg:g}° holds {FEWEST} soundings; take more pings or a wider "
                        "--class")
    figure = new_figure(9.5, 6.6)
    axes, counts = figure.subplots(2, 1, sharex=True, height_ratios=(5, 1))
    axes.fill_between(whole.grazing_deg, whole.low_db, whole.high_db, color="#3a86bd", alpha=0.25, linewidth=0,
                      label="16 % to 84 % of single soundings")
    for side, colour, name in ((False, "#c0392b", "port"), (True, "#2e8b57", "starboard")):
        part = response.starboard == side
        if part.any():
            one = curve(response.grazing_rad[part], response.strength_db[part], class_deg)
            axes.plot(one.grazing_deg, one.mean_db, color=colour, linewidth=0.8, label=name)
    axes.plot(whole.grazing_deg, whole.mean_db, color="#2b2a66", linewidth=1.8, label="mean of linear power, both sides")
    axes.set(ylabel=response.unit, xlim=_extent_deg(whole))
    axes.legend(fontsize=8, loc="best")
    counts.bar(whole.grazing_deg, whole.count, width=0.9 * class_deg, color="#8a8a8a")
    counts.set(xlabel=f"grazing angle on a level bottom (°), classes of {class_deg:g}°\n{response.angles}", ylabel="soundings")
    counts.yaxis.set_major_formatter("{x:,.0f}")
    incidence = axes.secondary_xaxis("top", functions=(lambda x: 90 - x, lambda x: 90 - x))
    incidence.set_xlabel("incidence, from the vertical (°)")
    for each in (axes, counts, incidence):
        each.tick_params(labelsize=8)
    for each in (axes, counts):
        each.grid(alpha=0.2)
    (first, first_s), (last, last_s) = response.pings
    which = f"{len(response.strength_db):,} soundings of pings {first} to {last}, t = {first_s:.3f} to {last_s:.3f} s"
    entitle(figure, f"Angular response: {process_of(response.topic)}", [which, response.facts, response.corrections])
    return figure


def _extent_deg(whole: Curve) -> tuple:
    known = whole.grazing_deg[whole.count > 0]
    return max(0.0, known.min() - 2), min(90.0, known.max() + 2)
