"""Statistics by which generated sonar pictures are held against real ones: shape of the K distribution, speckle contrast, texture.

Amplitudes come from XTF files and from the 16-bit pictures of `ensonify dataset`. They are judged in windows; of each the mean over pings is
taken out, which leaves the bottom's trend with range out of all numbers. Of pictures for the eye nobody knows the curve from echo to grey:
of them texture alone can be compared, since it is that of ranks, which no rising curve changes.
"""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.special import polygamma

import labelled

WINDOW = 64  # sides of a window in samples
LEAST_SIDE = 24  # of a picture; smaller ones have no texture to measure
LEVELS, STEPS = 8, ((1, "down", (1, 0)), (1, "across", (0, 1)), (4, "down", (4, 0)), (4, "across", (0, 4)))  # rows of a waterfall are pings


@dataclass
class Windows:
    """Parts of pictures, and the group of each: what is drawn again together."""

    parts: list
    groups: list
    are_amplitudes: bool


def inverse_shape_by_moments(intensity: np.ndarray) -> float:
    """1 / nu of K-distributed intensity [Jakeman1976]: E[I^2] / E[I]^2 = 2 (1 + 1 / nu). 0: Rayleigh amplitude; below 0: less varied."""
    return float((intensity ** 2).mean() / (2 * intensity.mean() ** 2) - 1)


def inverse_shape_by_logs(intensity: np.ndarray) -> float:
    """1 / nu by the variance of ln I, which is psi'(1) + psi'(nu) [Nicolas2002]: strong echoes weigh less. 0 where it is below psi'(1)."""
    wanted = np.log(intensity[intensity > 0]).var() - polygamma(1, 1)
    low, high = 1e-4, 1e4  # of nu; psi' falls
    if wanted <= polygamma(1, high):
        return 0.0
    for _ in range(60):
        middle = np.sqrt(low * high)
        low, high = (middle, high) if polygamma(1, middle) > wanted else (low, middle)
    return float(1 / low)


def contrast(amplitude: np.ndarray) -> float:
    """Deviation over mean; sqrt(4 / pi - 1) = 0.5227 of fully developed speckle [Goodman2007]."""
    return float(amplitude.std() / amplitude.mean())


def by_rank(picture: np.ndarray, levels: int = LEVELS) -> np.ndarray:
    """Levels 0 .. levels - 1, each of as many pixels; equal values have one level. No rising curve changes it."""
    values, place, count = np.unique(picture, return_inverse=True, return_counts=True)
    middle = (np.cumsum(count) - 0.5 * count) / picture.size
    return np.minimum((levels * middle).astype(int), levels - 1)[place].reshape(picture.shape)


def cooccurrence(level: np.ndarray, step: tuple, levels: int = LEVELS) -> np.ndarray:
    """Share of pairs of pixels `step` (rows, columns, none below 0) apart that have levels i and j, in either order [Haralick1973]."""
    rows, columns = step
    one, other = level[:level.shape[0] - rows, :level.shape[1] - columns], level[rows:, columns:]
    table = np.bincount((one * levels + other).ravel(), minlength=levels * levels).reshape(levels, levels).astype(float)
    table += table.T
    return table / table.sum()


def texture(table: np.ndarray) -> dict:
    """[Haralick1973]: contrast in levels squared, correlation, energy (angular second moment), entropy in bit."""
    i, j = np.indices(table.shape)
    mean = (i * table).sum()
    spread = ((i - mean) ** 2 * table).sum()
    some = table[table > 0]
    return {"contrast": float(((i - j) ** 2 * table).sum()), "correlation": float(((i - mean) * (j - mean) * table).sum() / max(spread, 1e-12)),
            "energy": float((table ** 2).sum()), "entropy": float(-(some * np.log2(some)).sum())}


def numbers(part: np.ndarray, is_amplitude: bool) -> dict:
    """All statistics of a window or picture."""
    found = {}
    if is_amplitude:
        part = part / np.maximum(part.mean(0), 1e-9)  # the trend with range
        found = {"speckle contrast": contrast(part), "1/nu by moments": inverse_shape_by_moments(part ** 2), "1/nu by logs": inverse_shape_by_logs(part ** 2)}
    level = by_rank(part)
    for far, direction, step in STEPS:
        found.update({f"{name}, {far} {direction}": value for name, value in texture(cooccurrence(level, step)).items()})
    return found


def read(source: Path) -> Windows:
    """Of an XTF file, of a set of `ensonify dataset`, or of a folder of pictures. Raises labelled.Unreadable."""
    if source.suffix.lower() == ".xtf":
        return of_xtf(source)
    amplitudes = sorted(source.glob("set/*/amplitude/*.png")) or sorted(source.glob("*/set/*/amplitude/*.png"))
    if amplitudes:
        pictures = [np.array(Image.open(file), float) for file in amplitudes]
        parts = [(part, i) for i, picture in enumerate(pictures) for part in windows(picture)]
        return Windows([part for part, _ in parts], [i for _, i in parts], True)
    files = sorted(file for file in source.rglob("*") if file.suffix.lower() in labelled.KINDS) if source.is_dir() else []
    pictures = [labelled.Labelled(file, []).grey() for file in files]
    pictures = [picture for picture in pictures if min(picture.shape) >= LEAST_SIDE and np.ptp(picture) > 0]
    if not pictures:
        raise labelled.Unreadable(f"{source}: allowed is an XTF file, a set of `ensonify dataset`, or a folder of pictures of {LEAST_SIDE} pixels and more")
    return Windows(pictures, list(range(len(pictures))), False)


def windows(picture: np.ndarray) -> list:
    """What tiles a picture, of what was received: a window with a sample without echo is left out."""
    parts = [picture[row:row + WINDOW, column:column + WINDOW] for row in range(0, picture.shape[0] - WINDOW + 1, WINDOW)
             for column in range(0, picture.shape[1] - WINDOW + 1, WINDOW)]
    return [part for part in parts if (part > 0).mean() > 0.99]


def of_xtf(file: Path) -> Windows:
    """Both sides' waterfalls, in rows of pings, beyond 1.5 altitudes: neither water column nor nadir. Windows of the same pings are one group."""
    try:
        import pyxtf
    except ImportError:
        raise labelled.Unreadable(f"{file}: XTF needs pyxtf: pip install pyxtf") from None
    try:
        _, packets = pyxtf.xtf_read(str(file))
        pings = [ping for ping in packets[pyxtf.XTFHeaderType.sonar] if ping.SensorPrimaryAltitude > 0]
        found = [(part, row) for row in range(0, len(pings) - WINDOW + 1, WINDOW) for side in (0, 1) for part in _of_side(pings[row:row + WINDOW], side)]
    except (OSError, RuntimeError, KeyError, IndexError, ValueError, AttributeError) as error:
        raise labelled.Unreadable(f"{file}: {type(error).__name__}: {error}; allowed is an XTF file with port and starboard of a sidescan") from None
    if not found:
        raise labelled.Unreadable(f"{file}: has no window of {WINDOW} pings; allowed is a file of more pings with altitudes")
    return Windows([part for part, _ in found], [row for _, row in found], True)


def _of_side(pings: list, side: int) -> list:
    picture = np.array([ping.data[side] for ping in pings], float)
    if side == 0:
        picture = picture[:, ::-1]  # port runs from far to near
    range_m = float(pings[0].ping_chan_headers[side].SlantRange)
    first = int(1.5 * max(ping.SensorPrimaryAltitude for ping in pings) / range_m * picture.shape[1])
    return windows(picture[:, first:])


def summary(of: Windows, draws: int = 200, seed: int = 1) -> dict:
    """Median over windows of each number, with 95 % when groups are drawn again."""
    table = [numbers(part, of.are_amplitudes) for part in of.parts]
    values = np.array([list(row.values()) for row in table])
    members = [np.flatnonzero(np.array(of.groups) == group) for group in sorted(set(of.groups))]
    random = np.random.default_rng(seed)
    again = [np.median(values[np.concatenate([members[i] for i in random.integers(len(members), size=len(members))])], 0) for _ in range(draws)]
    low, high = np.percentile(again, [2.5, 97.5], axis=0)
    return {name: {"value": float(value), "interval": [float(a), float(b)]} for name, value, a, b in zip(table[0], np.median(values, 0), low, high)}


def compare(one: Path, other: Path) -> dict:
    """Statistics of both; of amplitudes alone where either has only pictures for the eye, texture only."""
    both = [read(one), read(other)]
    for of in both:
        of.are_amplitudes = all(side.are_amplitudes for side in both)
    return {"names": [one.name, other.name], "windows": [len(of.parts) for of in both], "groups": [len(set(of.groups)) for of in both],
            "amplitudes": both[0].are_amplitudes, "numbers": [summary(of) for of in both]}


def as_text(result: dict) -> str:
    lines = [f"{'':<24}" + "".join(f" {name[:30]:<32}" for name in result["names"]),
             f"{'windows, groups':<24}" + "".join(f" {count:<7}{groups:<25}" for count, groups in zip(result["windows"], result["groups"]))]
    if not result["amplitudes"]:
        lines.append("pictures for the eye: their curve is unknown, so neither speckle nor its distribution can be said; texture of ranks")
    for name in result["numbers"][0]:
        cells = [of[name] for of in result["numbers"]]
        lines.append(f"{name:<24}" + "".join(f" {cell['value']:7.3f}  ({cell['interval'][0]:.3f} to {cell['interval'][1]:.3f}){'':<7}" for cell in cells))
    return "\n".join(lines) + "\nno claim beyond the sites of these files"
