"""Which ping to draw, and what it holds: amplitudes as power with their angles and ranges."""
from dataclasses import dataclass
from typing import Callable, Iterator

import numpy as np

import ensonify
from ensonify_plot import geometry
from ensonify_plot.level import Gain
from ensonify_plot.errors import UserError

PULSES = {"cw": "CW", "cw_tapered": "tapered CW", "fm_up": "FM up", "fm_down": "FM down"}


@dataclass
class ReceivedPing:
    """One ping, ready to draw. Sample k of any beam stands at first_range_m + k step_m."""

    topic: str
    ping: ensonify.Ping
    power_upa2: np.ndarray  # beam x sample, mean square of the pressure at the receiver
    angle_rad: np.ndarray  # of the beams, in the head frame, positive to starboard
    first_range_m: float
    step_m: float

    @property
    def head(self) -> str:
        """The process that published it; the whole topic where that has several."""
        return process_of(self.topic) if self.topic.endswith("/ping") else self.topic

    @property
    def t_s(self) -> float:
        """Time of transmission, sim time."""
        return self.ping.stamp_ns * 1e-9

    @property
    def range_m(self) -> np.ndarray:
        """Slant range of every sample."""
        return self.first_range_m + np.arange(self.power_upa2.shape[1]) * self.step_m

    @property
    def end_m(self) -> float:
        """Where reception ended."""
        return self.first_range_m + (self.power_upa2.shape[1] - 0.5) * self.step_m

    def vertical_rad(self) -> float | None:
        """Head-frame angle that points straight down by the measured attitude; None if the ping does not state its attitude."""
        attitude = self.ping.pose_enu_from_head
        return geometry.vertical_rad(attitude[0]) if attitude.ndim == 2 and len(attitude) else None

    def facts(self) -> str:
        """The settings in one line."""
        return settings_line(self.ping)

    def name(self) -> str:
        """Ping, time, head."""
        return f"{self.head}, ping {self.ping.ping} at t = {self.t_s:.3f} s"


def settings_line(p) -> str:
    """Settings of a ping or of soundings in one line."""
    return (f"{p.frequency_hz / 1e3:g} kHz, {PULSES.get(p.pulse, p.pulse)} {p.pulse_length_s * 1e3:.3g} ms, source level "
            f"{p.source_level_db:g} dB re 1 µPa at 1 m, sound speed {p.sound_speed_mps:g} m/s")


def process_of(topic: str) -> str:
    """`bow` of `bow/ping`."""
    return topic.rsplit("/", 1)[0]


def received(topic: str, ping: ensonify.Ping) -> ReceivedPing:
    """Raises UserError for a ping that gives no picture: no samples, no sound at all, or not what ping/1 says."""
    who = f"ping {ping.ping} of {topic}"
    amplitude = np.asarray(ping.amplitude_upa if ping.amplitude_upa.size else ping.amplitude_count, np.float32)
    if amplitude.size == 0:
        raise UserError(f"{who} holds no samples: neither amplitude_upa nor amplitude_count")
    if amplitude.ndim != 2 or len(amplitude) != ping.beam_angle_rad.size:
        raise UserError(f"{who}: amplitudes of shape {amplitude.shape} do not fit {ping.beam_angle_rad.size} beam angles; "
                        "allowed: beam x sample")
    if not (ping.sample_period_s > 0 and ping.sound_speed_mps > 0):
        raise UserError(f"{who}: sample_period_s {ping.sample_period_s:g} s and sound_speed_mps {ping.sound_speed_mps:g} m/s must "
                        "be above 0: without them samples have no range")
    if not np.isfinite(amplitude).all():
        raise UserError(f"{who}: {np.count_nonzero(~np.isfinite(amplitude))} of {amplitude.size} amplitudes are not finite")
    half_speed = ping.sound_speed_mps / 2
    made = ReceivedPing(topic, ping, np.square(amplitude), np.asarray(ping.beam_angle_rad, float), ping.first_sample_s * half_speed,
                 ping.sample_period_s * half_speed)
    if not ping.amplitude_upa.size:
        in_force = Gain(ping.gain_spreading_db, ping.gain_absorption_dbpm).db(made.range_m) + ping.gain_offset_db
        made.power_upa2 *= np.square(ping.count_upa) * np.power(10.0, -in_force / 10)
    return made


def require_soundings(who: str, power_upa2) -> None:
    """A picture of nothing is refused, never drawn black. NaN values are gaps."""
    if not np.any(np.nan_to_num(power_upa2) > 0):
        raise UserError(f"{who}: all amplitudes are zero, there is nothing to draw; the head's health and log say why (range "
                        "below the altitude, no terrain, wrong frame)")


def from_forward(record: ensonify.Record, topic: str) -> bool | None:
    """Whether a head's beam angles count from its forward axis, as it declares; None where no declaration was recorded."""
    head = record.declared(ensonify.HeadDeclaration).get(process_of(topic))
    return None if head is None else head.beam_axis == "forward"


def of_heads(record: ensonify.Record, forward: bool, beams: Callable[[ensonify.Ping], bool],
             guess: Callable[[str, ensonify.Ping], bool]) -> Callable[[str, ensonify.Ping], bool]:
    """Fits the pings of heads that count their beams from this axis and have such beams. Without a known axis they are guessed."""

    def fits(topic: str, ping: ensonify.Ping) -> bool:
        axis = from_forward(record, topic)
        return guess(topic, ping) if axis is None else axis == forward and beams(ping)

    return fits


def is_fan(ping: ensonify.Ping) -> bool:
    """Many beams."""
    return ping.beam_angle_rad.size > 2


def is_single(ping: ensonify.Ping) -> bool:
    """One beam."""
    return ping.beam_angle_rad.size == 1


def has_two_sides(ping: ensonify.Ping) -> bool:
    """Two beams, one to each side."""
    angle = ping.beam_angle_rad
    return angle.size == 2 and bool((angle < 0).any() and (angle > 0).any())


def choose_topic(record: ensonify.Record, asked: str | None, fits: Callable[[str, ensonify.Ping], bool], what: str,
                 or_first: bool = False) -> str:
    """The topic that the user names, else the only one that fits (or the first that does)."""
    first = {}
    for topic in record.topics_of(ensonify.Ping):
        first.update((topic, message.content) for message in _head(record.messages(topic)))
    if not first:
        raise UserError(f"{record.file}: holds no pings (no message of type ping/1 was recorded)")
    there = ", ".join(f"{topic} (beams: {ping.beam_angle_rad.size})" for topic, ping in first.items())
    if asked is not None:
        if asked not in first:
            raise UserError(f"{record.file}: {asked} is no recorded ping topic; there are {there}")
        return asked
    fitting = [topic for topic, ping in first.items() if fits(topic, ping)]
    if not fitting:
        raise UserError(f"{record.file}: no topic is known to hold {what}; name one with --topic: {there}")
    if len(fitting) > 1 and not or_first:
        raise UserError(f"{record.file}: several topics hold {what}; name one with --topic: {', '.join(fitting)}")
    return fitting[0]


def _head(messages: Iterator) -> list:
    return [message for message, _ in zip(messages, range(1))]


def heads_with_soundings(record: ensonify.Record) -> set:
    """Processes that publish soundings."""
    return {process_of(topic) for topic in record.topics_of(ensonify.Soundings)}


def one_of_process(record: ensonify.Record, topic: str, message_type: type) -> str | None:
    """The topic of a type that belongs to a ping topic: of the same process and, where that has several, with the same ending
    (`fish/bottom_low` for `fish/ping_low`)."""
    of_process = [other for other in record.topics_of(message_type) if process_of(other) == process_of(topic)]
    ending = topic.rsplit("/", 1)[1].removeprefix("ping")
    same = [other for other in of_process if len(of_process) == 1 or (ending and other.endswith(ending))]
    return same[0] if len(same) == 1 else None


def soundings_of(record: ensonify.Record, received_: ReceivedPing) -> ensonify.Soundings | None:
    """The soundings of the same ping, if they were recorded."""
    topic = one_of_process(record, received_.topic, ensonify.Soundings)
    found = (m.content for m in record.messages(topic) if m.content.ping == received_.ping.ping) if topic else iter(())
    return next(found, None)


@dataclass(frozen=True)
class Span:
    """Pings or times from first to last, both included; None is open."""

    first: float | None = None
    last: float | None = None

    @property
    def single(self) -> bool:
        """One value was given, not two."""
        return self.first is not None and self.first == self.last

    def holds(self, value: float) -> bool:
        """Whether a value lies in it."""
        return (self.first is None or value >= self.first) and (self.last is None or value <= self.last)


def place_of(record: ensonify.Record, topic: str, number: int | None, t_s: float | None, otherwise: Callable[[int], int]) -> int:
    """Which of a topic's pings this number is, or the first one at or after this time; without both `otherwise` of their count."""
    pings = [(message.content.ping, message.content.stamp_ns * 1e-9) for message in record.messages(topic)]
    if number is not None:
        chosen = next((at for at, (n, _) in enumerate(pings) if n == number), None)
    elif t_s is not None:
        chosen = next((at for at, (_, t) in enumerate(pings) if t >= t_s), None)
    else:
        chosen = otherwise(len(pings))
    if chosen is None and number is not None:
        near = min((n for n, _ in pings), key=lambda n: abs(n - number))
        raise UserError(f"{record.file}: ping {number} of {topic} was not recorded; the nearest is {near}, and there are "
                        f"{len(pings)} from {pings[0][0]} to {pings[-1][0]}")
    if chosen is None:
        raise UserError(f"{record.file}: no ping of {topic} at or after t = {t_s:g} s; {_extent(pings)}")
    return chosen


def choose_ping(record: ensonify.Record, topic: str, number: int | None = None, t_s: float | None = None) -> ReceivedPing:
    """The ping of this number, or the first one at or after this time, or the one in the middle of the record."""
    chosen = place_of(record, topic, number, t_s, lambda count: count // 2)
    message = next(m for at, m in enumerate(record.messages(topic)) if at == chosen)
    found = received(topic, message.content)
    require_soundings(f"{record.file}: ping {found.ping.ping} of {topic}", found.power_upa2)
    return found


def pings_in(record: ensonify.Record, topic: str, numbers: Span, times: Span) -> Iterator[ReceivedPing]:
    """The pings of a span, in order. Raises UserError if there is none, or if time stands still between two."""
    seen, before_ns = [], None
    found = False
    for message in record.messages(topic):
        ping = message.content
        seen.append((ping.ping, ping.stamp_ns * 1e-9))
        if numbers.holds(ping.ping) and times.holds(ping.stamp_ns * 1e-9):
            if before_ns is not None and ping.stamp_ns <= before_ns:
                raise UserError(f"{record.file}: ping {ping.ping} of {topic} does not come after the one before it in time")
            found, before_ns = True, ping.stamp_ns
            yield received(topic, ping)
    if not found:
        raise UserError(f"{record.file}: no ping of {topic} lies in what was asked for; {_extent(seen)}")


def _extent(pings: list) -> str:
    (first, first_s), (last, last_s) = pings[0], pings[-1]
    return f"there are {len(pings)}, from {first} (t = {first_s:.3f} s) to {last} (t = {last_s:.3f} s)"
