"""A record's survey as flat arrays: soundings, track, true seabed."""
from dataclasses import dataclass, field

import numpy as np

import ensonify
from ensonify_plot.truth import Seabed


TRACK_NS = 100_000_000  # finer than this no picture shows a track


class UserError(Exception):
    """What the user gave cannot be plotted; the text says why. Exit code 2."""


@dataclass
class Soundings:
    """Every accepted sounding, in the order of the record."""

    t_s: np.ndarray  # of transmission, sim time
    head: np.ndarray  # index into Survey.heads
    ping: np.ndarray
    beam: np.ndarray
    beam_angle_rad: np.ndarray
    east_m: np.ndarray
    north_m: np.ndarray
    up_m: np.ndarray  # from chart datum
    backscatter_db: np.ndarray
    tvu_m: np.ndarray  # predicted at 95 %; NaN: not given
    thu_m: np.ndarray

    def __len__(self) -> int:
        return len(self.t_s)


@dataclass
class Survey:
    """What a record says about a survey."""

    soundings: Soundings
    heads: list  # topic names without the port
    ping_count: int
    beam_count: int  # beams of all pings, accepted or not
    track_t_s: np.ndarray
    track_east_m: np.ndarray
    track_north_m: np.ndarray
    on_line_s: list  # (begin, end) of each runline, sim time; empty if the record does not state
    seabed: Seabed
    origin: tuple | None  # latitude, longitude in degrees of the world's origin, None if the record does not state
    end_s: float = 0.0
    info: dict = field(default_factory=dict)


def read_survey(record: ensonify.Record) -> Survey:
    """Raises UserError if the record holds no soundings."""
    topics = record.topics_of(ensonify.Soundings)
    if not topics:
        raise UserError(f"{record.file}: holds no soundings (no topic of type soundings/1 was recorded)")
    parts, pings, beams = [], 0, 0
    for topic, _, message in record.messages(*topics):
        pings += 1
        beams += len(message.valid)
        parts.append((topics.index(topic), message))
    heads = [topic.rsplit("/", 1)[0] for topic in topics]
    track = _track(record)
    ends = [part[1].stamp_ns for part in parts[-1:]] + [int(t * 1e9) for t in track[0][-1:]]
    return Survey(_flattened(parts), heads, pings, beams, *track, _on_line(record), _seabed(record), _origin(record),
                  max(ends, default=0) * 1e-9, record.info)


def _flattened(parts: list) -> Soundings:
    """One array per quantity from all messages, without what the detector refused."""

    def whole(values, dtype):
        return np.concatenate(values).astype(dtype, copy=False) if values else np.empty(0, dtype)

    messages = [message for _, message in parts]
    lengths = [len(message.valid) for message in messages]
    valid = whole([message.valid for message in messages], np.uint8) == 1
    position = whole([message.position_enu_m for message in messages], np.float64).reshape(-1, 3)
    valid &= np.isfinite(position).all(axis=1)

    def of_soundings(field):
        parts = (getattr(message, field) for message in messages)
        return whole([part if len(part) == length else np.full(length, np.nan) for part, length in zip(parts, lengths)], np.float32)[valid]

    def each(values, dtype):
        return np.repeat(np.array(values, dtype), lengths)[valid]

    return Soundings(
        t_s=each([message.stamp_ns * 1e-9 for message in messages], np.float64),
        head=each([head for head, _ in parts], np.int16),
        ping=each([message.ping for message in messages], np.int64),
        beam=whole([np.arange(length) for length in lengths], np.int32)[valid],
        beam_angle_rad=whole([message.beam_angle_rad for message in messages], np.float32)[valid],
        east_m=position[valid, 0],
        north_m=position[valid, 1],
        up_m=position[valid, 2],
        backscatter_db=whole([message.backscatter_db for message in messages], np.float32)[valid],
        tvu_m=of_soundings("tvu_m"),
        thu_m=of_soundings("thu_m"),
    )


def _track(record: ensonify.Record) -> tuple:
    """Time, east, north of the vehicle: as estimated, else as measured, else as it truly was."""
    for message_type in (ensonify.Estimate, ensonify.Position, ensonify.Pose):
        topics = record.topics_of(message_type)
        if topics:
            messages = record.messages(topics[0], least_apart_ns=TRACK_NS)
            rows = [(m.content.stamp_ns * 1e-9, *m.content.position_enu_m[:2]) for m in messages]
            return tuple(np.array(rows).reshape(-1, 3).T)
    return np.empty(0), np.empty(0), np.empty(0)


def _on_line(record: ensonify.Record) -> list:
    topics = record.topics_of(ensonify.MissionState)
    spans, line = [], None
    for message in record.messages(*topics) if topics else []:
        state, t_s = message.content, message.content.stamp_ns * 1e-9
        now = state.line if state.state == "on_line" else None
        if now is not None and now == line:
            spans[-1][1] = t_s
        elif now is not None:
            spans.append([t_s, t_s])
        line = now
    return [tuple(span) for span in spans]


def _seabed(record: ensonify.Record) -> Seabed:
    topics = record.topics_of(ensonify.Tile)
    return Seabed([message.content for message in record.messages(*topics)] if topics else [])


def _origin(record: ensonify.Record) -> tuple | None:
    topics = record.topics_of(ensonify.Chart)
    for message in record.messages(*topics) if topics else []:
        return message.content.origin_latitude_deg, message.content.origin_longitude_deg
    return None
