"""Many pings side by side: an image whose one axis is time."""
from dataclasses import dataclass

import numpy as np

from ensonify_plot import geometry
from ensonify_plot.pictures import entitle
from ensonify_plot.received import ReceivedPing

MOST_PINGS = 800  # across a picture; more are averaged in groups, in power


@dataclass
class Stack:
    """Rows of power over time, or along the track: row 0 is the earliest. `begin` and `end`, s or m, are the image's edges."""

    rows: np.ndarray
    begin: float
    end: float
    averaged: int  # pings in a row


def stacked(along: list, lines: list, t_s: list | None = None) -> Stack:
    """One line of power per ping (NaN where there is none) on rows of equal time, or of equal distance; gaps between pings stay empty:
    in time where `t_s` is given for pings along a distance."""
    size = -(-len(lines) // MOST_PINGS)
    along, t_s = (None if each is None else geometry.grouped(np.asarray(each, float), size) for each in (along, t_s))
    lines = geometry.grouped(np.asarray(lines), size)
    ping, begin, end = geometry.ping_of_rows(along, 2 * MOST_PINGS, t_s)
    return Stack(np.where((ping >= 0)[:, None], lines[ping], np.nan), begin, end, size)


def span_headline(figure, what: str, first: ReceivedPing, last: ReceivedPing, remarks: list) -> None:
    """What, and of which head; below which pings when, with which settings (of the first ping), and remarks."""
    span = f"pings {first.ping.ping} to {last.ping.ping}, t = {first.t_s:.3f} to {last.t_s:.3f} s"
    entitle(figure, f"{what}: {first.head}", [f"{span}; {first.facts()}", *remarks])


@dataclass
class Track:
    """What runs along the time axis: ping numbers and, where the pings give their poses, the distance covered."""

    t_s: np.ndarray
    ping: np.ndarray
    position_enu_m: np.ndarray | None  # None: not given

    @staticmethod
    def of(pings: list) -> "Track":
        """From pings in order."""
        reported = all(received.ping.pose_position_enu_m.ndim == 2 and len(received.ping.pose_position_enu_m) for received in pings)
        return Track(np.array([received.t_s for received in pings]), np.array([received.ping.ping for received in pings], float),
                     np.array([received.ping.pose_position_enu_m[0] for received in pings]) if reported else None)

    def distance_m(self) -> np.ndarray | None:
        """Covered since the first ping, rising; None where it is not known, or where a head did not move."""
        if self.position_enu_m is None or len(self.t_s) < 2:
            return None
        steps_m = np.hypot(*np.diff(self.position_enu_m[:, :2], axis=0).T)
        return np.concatenate([[0.0], np.cumsum(steps_m)]) if (steps_m > 0).all() else None

    def time_scale(self) -> tuple:
        """(label, values) of the times of transmission."""
        return "time of transmission (s)", self.t_s

    def other_scale(self) -> tuple:
        """(label, values at t_s), rising: what can stand opposite to the times."""
        distance_m = self.distance_m()
        return ("ping", self.ping) if distance_m is None else (ALONG, distance_m)


ALONG = "along the track, by the head's estimate (m)"


def second_axis(axes, side: str, main: tuple, other: tuple) -> None:
    """A second scale opposite to the main one, both (label, values of the pings); `side` is "right" or "top"."""
    (_, known), (label, values) = main, other
    if len(values) < 2:
        return
    upright = side == "right"
    axis = (axes.secondary_yaxis if upright else axes.secondary_xaxis)(
        side, functions=(lambda t: extended(t, known, values), lambda value: extended(value, values, known)))
    axis.tick_params(labelsize=8)
    (axis.set_ylabel if upright else axis.set_xlabel)(label)


def extended(x, known, values):
    """Linear interpolation that goes on straight beyond the ends, so that an axis can be read backwards."""
    x = np.asarray(x, float)
    inside = np.interp(x, known, values)
    before = values[0] + (x - known[0]) * (values[1] - values[0]) / (known[1] - known[0])
    after = values[-1] + (x - known[-1]) * (values[-1] - values[-2]) / (known[-1] - known[-2])
    return np.where(x < known[0], before, np.where(x > known[-1], after, inside))
