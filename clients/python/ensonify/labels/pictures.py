"""Labelled pictures of a record: pings of an imaging head as they are or as a fan, lines of a sidescan as a waterfall.

Levels are never scaled by what is in a picture: the same amplitude at the same range and settings is the same number in all.
"""
from dataclasses import dataclass, field
from typing import Iterator

import numpy as np

from ensonify import labels as of
from ensonify.labels import energies
from ensonify.messages import Ping


@dataclass
class Display:
    """From amplitudes to numbers. Both kinds have the head's own gain S log10(R) + 2 A R + O."""

    white_db: float = -30.0  # level of white behind the gain, over the source level
    range_db: float = 55.0  # from black to white, of 8 bits
    full_scale_db: float = 10.0  # level of 65535 behind the gain, over the source level


@dataclass
class Thing:
    """An object in a picture."""

    instance: int
    name: str
    class_name: str
    class_id: int
    mask: np.ndarray  # rows x columns, bool
    shadow: np.ndarray
    facts: dict = field(default_factory=dict)  # of the ping in which most of it is visible: visible, occluded, buried, ...


@dataclass
class Picture:
    """A picture and what is in it. Row 0 is on top."""

    name: str
    grey: np.ndarray  # rows x columns, uint8, decibels
    linear: np.ndarray  # uint16: amplitude behind the gain, in steps of scale_upa
    scale_upa: float
    things: list  # of Thing, those with a mask or a shadow
    layer: np.ndarray  # int32: the instance of each pixel, 0: none
    seabed_shadow: np.ndarray  # bool
    facts: dict  # of the record, head and pings


def amplitude_with_gain(ping: Ping) -> np.ndarray:
    """Amplitude (beam x sample) behind the head's gain, uPa; of a head with a converter its counts, in its own unit."""
    if not ping.amplitude_upa.size:
        return ping.amplitude_count.astype(np.float64) * ping.count_upa
    time_s = ping.first_sample_s + ping.sample_period_s * np.arange(ping.amplitude_upa.shape[1])
    range_m = np.maximum(0.5 * ping.sound_speed_mps * time_s, 0.1)
    gain_db = ping.gain_spreading_db * np.log10(range_m) + 2 * ping.gain_absorption_dbpm * range_m + ping.gain_offset_db
    return ping.amplitude_upa * 10 ** (gain_db / 20)


def _numbers(amplitude: np.ndarray, source_level_db: float, display: Display) -> tuple:
    """(grey, linear, step of linear in uPa)."""
    level_db = 20 * np.log10(np.maximum(amplitude, 1e-12)) - source_level_db
    grey = np.rint(255 * np.clip(1 + (level_db - display.white_db) / display.range_db, 0, 1)).astype(np.uint8)
    scale_upa = 10 ** ((source_level_db + display.full_scale_db) / 20) / 65535
    return grey, np.minimum(np.rint(amplitude / scale_upa), 65535).astype(np.uint16), scale_upa


_FACTS = ("inside", "visible", "occluded", "buried", "hit_enu_m", "range_m", "grazing_rad", "aspect_rad", "sediment", "smooth")


def _response(pair: of.Labelled, instance: int) -> np.ndarray:
    """Samples of which an object sends at least half."""
    place = energies.object_places(pair.energies).get(instance)
    return np.zeros((pair.labels.beams, pair.labels.samples), bool) if place is None else energies.response(pair.energies, place)


def _layer(pair: of.Labelled, response: bool) -> np.ndarray:
    """One mask of all."""
    if not response:
        return of.layer(pair.labels)
    cells = np.zeros((pair.labels.beams, pair.labels.samples), np.int32)
    for instance, place in energies.object_places(pair.energies).items():
        cells[energies.response(pair.energies, place)] = instance
    return cells


def _things(pairs: list, arrange, response: bool) -> list:
    """Objects of one or several pings; arrange(one array per ping, beams x samples) makes a picture of them."""
    seen: dict = {}  # by instance: (object that is seen best, places by ping)
    for number, pair in enumerate(pairs):
        for place, thing in enumerate(pair.labels.objects):
            best, places = seen.get(thing.instance, (thing, {}))
            places[number] = place
            seen[thing.instance] = (thing if thing.visible > best.visible else best, places)
    things = []
    for instance, (best, places) in sorted(seen.items()):
        none = np.iinfo(np.int32).max

        def arranged(cells):
            return arrange([cells(pair.labels, places.get(number, none)) for number, pair in enumerate(pairs)])

        mask = arrange([_response(pair, instance) for pair in pairs]) if response else arranged(of.mask)
        thing = Thing(instance, best.name, best.class_name, best.class_id, mask, arranged(of.shadow),
                      {fact: getattr(best, fact) for fact in _FACTS})
        if thing.mask.any() or thing.shadow.any():
            things.append(thing)
    return things


def _picture(name: str, pairs: list, arrange, display: Display, facts: dict, response: bool) -> Picture:
    ping = pairs[0].ping
    amplitude = arrange([amplitude_with_gain(pair.ping) for pair in pairs])
    grey, linear, scale_upa = _numbers(amplitude, ping.source_level_db, display)
    facts = _settings(pairs, scale_upa, display, {**facts, "mask": "response" if response else "geometry"})
    return Picture(name, grey, linear, scale_upa, _things(pairs, arrange, response), arrange([_layer(pair, response) for pair in pairs]),
                   arrange([of.shadow(pair.labels, of.SEABED) for pair in pairs]), facts)


def _settings(pairs: list, scale_upa: float, display: Display, facts: dict) -> dict:
    ping = pairs[0].ping
    if ping.kind == "sidescan":
        facts = {**facts, "line_spacing_m": _line_spacing_m(pairs)}
    else:
        facts = {**facts, "beam_from_rad": float(ping.beam_angle_rad.min()), "beam_to_rad": float(ping.beam_angle_rad.max())}
    return {**facts, "kind": ping.kind, "first_ping": ping.ping, "pings": len(pairs), "stamp_ns": ping.stamp_ns,
            "sample_period_s": ping.sample_period_s, "sound_speed_mps": ping.sound_speed_mps, "range_m": ping.range_m,
            "frequency_hz": ping.frequency_hz, "source_level_db": ping.source_level_db, "scale_upa": scale_upa,
            "gain_spreading_db": ping.gain_spreading_db, "gain_absorption_dbpm": ping.gain_absorption_dbpm,
            "gain_offset_db": ping.gain_offset_db, "white_db": display.white_db, "range_db": display.range_db}


def _line_spacing_m(pairs: list) -> float:
    """Of a waterfall, on the mean, by the head's estimated poses; 0 where there are none."""
    at = [(line, np.asarray(pair.ping.pose_position_enu_m[0])) for line, pair in enumerate(pairs) if len(pair.ping.pose_position_enu_m)]
    if len(at) < 2:
        return 0.0
    (first, start), (last, end) = at[0], at[-1]
    return float(np.linalg.norm(end - start)) / (last - first)


def of_ping(pair: of.Labelled, view: str, display: Display, facts: dict, response: bool = False) -> Picture:
    """A ping of an imaging head: sample by beam, or a fan. response: masks are where things send at least half."""
    arrange = _fan(pair.ping) if view == "cartesian" else _upright(pair.ping)
    return _picture("", [pair], arrange, display, {**facts, "view": view}, response)


def of_waterfall(pairs: list, left: int, width: int, display: Display, facts: dict) -> Picture:
    """`width` columns of a sidescan's lines, from column `left` of the waterfall on."""
    samples = pairs[0].labels.samples

    def columns(beam: int, first: int, end: int) -> slice:
        """Of a run, in the picture."""
        first, end = (samples + first, samples + end) if beam else (samples - end, samples - first)
        return slice(min(max(first - left, 0), width), min(max(end - left, 0), width))

    amplitude = _waterfall([amplitude_with_gain(pair.ping) for pair in pairs])[:, left:left + width]
    grey, linear, scale_upa = _numbers(amplitude, pairs[0].ping.source_level_db, display)
    layer, seabed_shadow = np.zeros(grey.shape, np.int32), np.zeros(grey.shape, bool)
    best: dict = {}  # by instance, the ping in which it is seen best
    parts: dict = {}  # by instance, mask and shadow
    for line, pair in enumerate(pairs):
        labels = pair.labels
        for thing in labels.objects:
            if thing.instance not in best or thing.visible > best[thing.instance].visible:
                best[thing.instance] = thing
        for kind, runs in enumerate((labels.mask_run, labels.shadow_run)):
            for whose, beam, first, end in runs.tolist():
                where = columns(beam, first, end)
                if where.start == where.stop:
                    continue
                if whose == of.SEABED:
                    seabed_shadow[line, where] = True
                    continue
                instance = labels.objects[whose].instance
                parts.setdefault(instance, np.zeros((2, *grey.shape), bool))[kind, line, where] = True
        for whose, beam, first, end in labels.layer_run.tolist():
            layer[line, columns(beam, first, end)] = labels.objects[whose].instance
    things = [Thing(instance, best[instance].name, best[instance].class_name, best[instance].class_id, mask, shadow,
                    {fact: getattr(best[instance], fact) for fact in _FACTS}) for instance, (mask, shadow) in sorted(parts.items())]
    return Picture("", grey, linear, scale_upa, things, layer, seabed_shadow, _settings(pairs, scale_upa, display, {**facts, "mask": "geometry"}))


def _upright(ping: Ping):
    """Port left, the farthest sample on top."""
    port_first = np.argsort(ping.beam_angle_rad, kind="stable")
    return lambda cells: cells[0][port_first].T[::-1]


def _fan(ping: Ping, height: int = 512):
    """A fan as on a chart: the head at the bottom; pixels by the nearest sample and beam, black outside."""
    order = np.argsort(ping.beam_angle_rad, kind="stable")
    angles = ping.beam_angle_rad[order].astype(np.float64)
    half = 0.5 * float(np.mean(np.diff(angles)))
    last_s = ping.first_sample_s + ping.sample_period_s * (max(ping.amplitude_upa.shape[1], ping.amplitude_count.shape[-1]) - 1)
    reach_m = 0.5 * ping.sound_speed_mps * last_s
    widest = max(abs(angles[0]), abs(angles[-1])) + half
    width = int(np.ceil(2 * height * np.sin(min(widest, np.pi / 2))))
    y, x = np.mgrid[0:height, 0:width] + 0.5
    ahead_m, aside_m = (height - y) * reach_m / height, (x - 0.5 * width) * reach_m / height
    sample = np.rint((np.hypot(ahead_m, aside_m) * 2 / ping.sound_speed_mps - ping.first_sample_s) / ping.sample_period_s).astype(int)
    angle = np.arctan2(aside_m, ahead_m)
    beam = np.clip(np.searchsorted(0.5 * (angles[1:] + angles[:-1]), angle), 0, len(angles) - 1)
    samples = int(round((last_s - ping.first_sample_s) / ping.sample_period_s)) + 1
    inside = (sample >= 0) & (sample < samples) & (angle >= angles[0] - half) & (angle <= angles[-1] + half)

    def arrange(cells):
        read = cells[0][order[beam], np.clip(sample, 0, samples - 1)]
        return np.where(inside, read, np.zeros((), read.dtype))

    return arrange


def _waterfall(cells: list) -> np.ndarray:
    """Lines from top to bottom, port left, its farthest sample first."""
    return np.stack([np.concatenate([line[0][::-1], line[1]]) for line in cells])


def pictures(record, topic: str, *, view: str = "polar", lines: int = 256, display: Display = Display(),
             mask: str = "geometry") -> Iterator[Picture]:
    """Labelled pictures of a topic's pings: one for each ping, of a sidescan one for so many lines (a shorter last one too).

    view: polar, sample by beam, port left and the farthest on top; or cartesian, a fan 512 pixels high, made of the nearest
    samples, masks like levels. Of a sidescan the view is the waterfall in slant range.
    mask: geometry, or response: the samples of which an object sends at least half, which needs `labels: energies`."""
    stem = topic.replace("/", "_")
    facts = {"topic": topic, "record": record.file.rsplit("/", 1)[-1], "seed": record.info.get("seed", "")}
    held: list = []
    response = mask == "response"

    def waterfall():
        picture = _picture(f"{stem}_{held[0].ping.ping:06d}", held, _waterfall, display, facts, response)
        held.clear()
        return picture

    for pair in of.labelled(record, topic, energies=response):
        ping = pair.ping
        if ping.kind != "sidescan":
            arrange = _fan(ping) if view == "cartesian" else _upright(ping)
            yield _picture(f"{stem}_{ping.ping:06d}", [pair], arrange, display, {**facts, "view": view}, response)
            continue
        if held and (held[0].labels.samples != pair.labels.samples or len(held) == lines):
            yield waterfall()
        held.append(pair)
    if held:
        yield waterfall()
