"""Decibels: what is added to a received level for display, and the limits of its colours."""
from dataclasses import dataclass

import numpy as np

NEAREST_M = 1.0  # nearer than this a gain is held


@dataclass(frozen=True)
class Gain:
    """S log10 R + 2 A R with R in metres, no nearer than 1 m (as `kernels/acoustics/echo/gain.h`)."""

    spreading_db: float = 0.0
    absorption_dbpm: float = 0.0

    def db(self, range_m) -> np.ndarray:
        """The gain at slant ranges."""
        held_m = np.maximum(range_m, NEAREST_M)
        return self.spreading_db * np.log10(held_m) + 2 * self.absorption_dbpm * held_m

    def label(self) -> str:
        """The quantity of a picture with this gain, its reference included."""
        parts = []
        if self.spreading_db:
            parts.append(f" + {self.spreading_db:g} log R")
        if self.absorption_dbpm:
            parts.append(f" + 2 R · {self.absorption_dbpm * 1e3:g} dB/km")
        unit = "dB re 1 µPa, R in m" if parts else "dB re 1 µPa"
        return f"received level, rms{''.join(parts)} ({unit})"


def gain_for(choice, ping, otherwise: Gain) -> Gain:
    """The gain that a picture of this ping shows: one that the user states, none, the head's own without its offset ("head"),
    or the head's own if it has one, else `otherwise` ("auto")."""
    if isinstance(choice, Gain):
        return choice
    own = Gain(ping.gain_spreading_db, ping.gain_absorption_dbpm)
    return {"none": Gain(), "head": own, "auto": own if own != Gain() else otherwise}[choice]


def level_db(power_upa2) -> np.ndarray:
    """10 log10 of mean squares; NaN where there is no sound or no sample."""
    power = np.asarray(power_upa2, float)
    return 10 * np.log10(np.where(power > 0, power, np.nan))


@dataclass(frozen=True)
class Limits:
    """The levels of the darkest and the brightest colour, and where they come from."""

    low_db: float
    high_db: float
    origin: str


def limits_of(level, given: tuple | None, percentiles: tuple, of: str = "") -> Limits:
    """What the user gives, else percentiles of the picture's own values (or of a part, `of` in words), at least 1 dB apart."""
    if given is not None:
        return Limits(*given, "as given")
    low, high = (float(x) for x in np.nanpercentile(level, percentiles))
    return Limits(low, max(high, low + 1.0), f"percentiles {percentiles[0]:g} to {percentiles[1]:g}{of}")
