"""Many pings side by side: an image whose one axis is time."""
from dataclasses import dataclass

import numpy as np

from ensonify_plot import geometry
from ensonify_plot.received import ReceivedPing

MOST_PINGS = 800  # across a picture; more are averaged in groups, in power


@dataclass
class Stack:
    """Rows of power over time: row 0 is the earliest. `begin_s` and `end_s` are the image's edges."""

    rows: np.ndarray
    begin_s: float
    end_s: float
    averaged: int  # pings in a row


def stacked(t_s: list, lines: list) -> Stack:
    """One line of power per ping (NaN where there is none) on rows of equal time; gaps between pings stay empty."""
    size = -(-len(lines) // MOST_PINGS)
    t_s = geometry.grouped(np.asarray(t_s, float), size)
    lines = geometry.grouped(np.asarray(lines), size)
    ping, begin_s, end_s = geometry.ping_of_rows(t_s, 2 * MOST_PINGS)
    return Stack(np.where((ping >= 0)[:, None], lines[ping], np.nan), begin_s, end_s, size)


def span_headline(figure, what: str, first: ReceivedPing, last: ReceivedPing, remarks: list) -> None:
    """Two lines over a picture: what, which pings of which head when; with which settings, of the first ping."""
    span = (f"pings {first.ping.ping} to {last.ping.ping}, t = {first.t_s:.3f} to {last.t_s:.3f} s")
    figure.suptitle("\n".join([f"{what}: {first.head}, {span}", first.facts(), *remarks]), fontsize=9.5, x=0.02, ha="left")


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

    def scale(self) -> tuple:
        """(label, values at t_s), rising, for a second axis."""
        if self.position_enu_m is not None and len(self.t_s) > 1:
            steps_m = np.hypot(*np.diff(self.position_enu_m[:, :2], axis=0).T)
            if (steps_m > 0).all():
                return "along the track, by the head's estimate (m)", np.concatenate([[0.0], np.cumsum(steps_m)])
        return "ping", self.ping


def second_axis(axes, side: str, track: Track) -> None:
    """A second scale opposite to the time axis; `side` is "right" or "top"."""
    label, values = track.scale()
    if len(values) < 2:
        return
    upright = side == "right"
    axis = (axes.secondary_yaxis if upright else axes.secondary_xaxis)(
        side, functions=(lambda t: extended(t, track.t_s, values), lambda value: extended(value, values, track.t_s)))
    axis.tick_params(labelsize=8)
    (axis.set_ylabel if upright else axis.set_xlabel)(label)


def extended(x, known, values):
    """Linear interpolation that goes on straight beyond the ends, so that an axis can be read backwards."""
    x = np.asarray(x, float)
    inside = np.interp(x, known, values)
    before = values[0] + (x - known[0]) * (values[1] - values[0]) / (known[1] - known[0])
    after = values[-1] + (x - known[-1]) * (values[-1] - values[-2]) / (known[-1] - known[-2])
    return np.where(x < known[0], before, np.where(x > known[-1], after, inside))
