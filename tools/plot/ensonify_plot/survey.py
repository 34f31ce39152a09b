"""A record's survey as flat arrays: soundings, track, true seabed."""
from dataclasses import dataclass, field, fields, replace

import numpy as np

import ensonify
from ensonify_plot import grid
from ensonify_plot.errors import UserError
from ensonify_plot.truth import Seabed


TRACK_NS = 100_000_000  # finer than this no picture shows a track
WORKING = ("on_line", "pass", "keep", "orbit")  # states of a mission whose soundings are wanted; the others are ways between


@dataclass
class Soundings:
    """Every accepted sounding, in the order of the record."""

    t_s: np.ndarray  # of transmission, sim time
    head: np.ndarray  # index into Survey.heads
    line: np.ndarray  # index into Survey.lines; -1: on none
    ping: np.ndarray
    beam: np.ndarray
    beam_angle_rad: np.ndarray
    east_m: np.ndarray
    north_m: np.ndarray
    up_m: np.ndarray  # from chart datum
    received_level_db: np.ndarray  # re 1 uPa, uncorrected
    tvu_m: np.ndarray  # predicted at 95 %; NaN: not given
    thu_m: np.ndarray

    def __len__(self) -> int:
        return len(self.t_s)

    def chosen(self, which: np.ndarray) -> "Soundings":
        """Those of a mask."""
        return Soundings(**{each.name: getattr(self, each.name)[which] for each in fields(self)})


@dataclass(frozen=True)
class Line:
    """A runline as it was run once."""

    begin_s: float  # sim time
    end_s: float  # infinite where the record ends first
    name: str  # the mission's; or its number, the first is 1


@dataclass
class Survey:
    """What a record says about a survey."""

    file: str  # of the record
    soundings: Soundings
    heads: list  # topic names without the port
    ping_count: int
    beam_count: int  # beams of all pings, accepted or not
    track_t_s: np.ndarray
    track_east_m: np.ndarray
    track_north_m: np.ndarray
    lines: list  # in the order run; empty if the record does not state them
    seabed: Seabed
    origin: tuple | None  # latitude, longitude in degrees of the world's origin, None if the record does not state
    end_s: float = 0.0
    info: dict = field(default_factory=dict)
    utc_start_ns: int | None = None
    in_turns: int = 0  # accepted soundings that were left out because they are of turns and other ways

    def frame(self, cell_m: float | None = None, latlon: bool = False) -> grid.Frame:
        """Around the soundings, of the user's cells or of what the soundings can fill. Raises UserError."""
        s = self.soundings
        if len(s) == 0 and self.in_turns:
            raise UserError(f"{self.file}: all {self.in_turns:,} accepted soundings are of turns and other ways; --turns takes them")
        if len(s) == 0:
            raise UserError(f"{self.file}: none of the {self.beam_count:,} beams of {self.ping_count:,} pings has an accepted sounding")
        if latlon and self.origin is None:
            raise UserError(f"--latlon: {self.file} does not state where the world is (no chart/1)")
        if cell_m is None:
            cell_m = grid.choose_cell_m(s.east_m, s.north_m)
        if not cell_m > 0 or grid.cells_of(s.east_m, s.north_m, cell_m) > grid.MAX_CELLS:
            raise UserError(f"--cell {cell_m:g}: must be positive and give at most {grid.MAX_CELLS:,} cells")
        return grid.frame_around(s.east_m, s.north_m, cell_m, self.origin if latlon else None)


def read_survey(record: ensonify.Record, turns: bool = False) -> Survey:
    """A record's survey; soundings of turns, run-ins and run-outs only if they are asked for, or if the record does not state the
    mission. Raises UserError if the record holds no soundings."""
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
    lines, working_s = _mission(record)
    soundings = _flattened(parts, lines)
    wanted = np.full(len(soundings), turns or not working_s)
    for begin_s, end_s in working_s:
        wanted |= (soundings.t_s >= begin_s) & (soundings.t_s < end_s)
    utc_start_ns = record.utc_start_ns if "utc_start_ns" in record.info else None
    return Survey(record.file, soundings.chosen(wanted), heads, pings, beams, *track, lines, _seabed(record), origin_of(record),
                  max(ends, default=0) * 1e-9, record.info, utc_start_ns, int(np.count_nonzero(~wanted)))


def _flattened(parts: list, lines: list) -> Soundings:
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

    t_s = [message.stamp_ns * 1e-9 for message in messages]
    return Soundings(
        t_s=each(t_s, np.float64),
        line=each([next((n for n, line in enumerate(lines) if line.begin_s <= t < line.end_s), -1) for t in t_s], np.int32),
        head=each([head for head, _ in parts], np.int16),
        ping=each([message.ping for message in messages], np.int64),
        beam=whole([np.arange(length) for length in lengths], np.int32)[valid],
        beam_angle_rad=whole([message.beam_angle_rad for message in messages], np.float32)[valid],
        east_m=position[valid, 0],
        north_m=position[valid, 1],
        up_m=position[valid, 2],
        received_level_db=whole([message.backscatter_db for message in messages], np.float32)[valid],
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


def _mission(record: ensonify.Record) -> tuple:
    """The lines as they were run, and (begin, end) of whatever was no way to somewhere, sim time; of all missions in the record. A state
    lasts until the next message, the last one for ever."""
    lines, working_s = [], []
    for topic in record.topics_of(ensonify.MissionState):
        working, line = False, None
        for message in record.messages(topic):
            state, t_s = message.content, message.content.stamp_ns * 1e-9
            now = state.line if state.state == "on_line" else None
            if working and state.state not in WORKING:
                working_s[-1][1] = t_s
            if line is not None and now != line:
                lines[-1] = replace(lines[-1], end_s=t_s)
            if state.state in WORKING and not working:
                working_s.append([t_s, np.inf])
            if now is not None and now != line:
                lines.append(Line(t_s, np.inf, state.line_name or str(now + 1)))
            working, line = state.state in WORKING, now
    return sorted(lines, key=lambda line: line.begin_s), working_s


def _seabed(record: ensonify.Record) -> Seabed:
    topics = record.topics_of(ensonify.Tile)
    return Seabed([message.content for message in record.messages(*topics)] if topics else [])


def origin_of(record: ensonify.Record) -> tuple | None:
    """Latitude and longitude of the world's origin, degrees; None if the record does not state it."""
    topics = record.topics_of(ensonify.Chart)
    for message in record.messages(*topics) if topics else []:
        return message.content.origin_latitude_deg, message.content.origin_longitude_deg
    return None
