"""Where a vehicle went and how well that was known: track, error of the estimate against truth, Allan deviation of inertial
sensors, spectra of motion."""
from dataclasses import dataclass

import numpy as np

import ensonify
from ensonify_plot.pictures import new_figure
from ensonify_plot.errors import UserError

SEGMENTS = 8  # of a spectrum, half overlapping


@dataclass(frozen=True)
class Track:
    """Poses over time: true or estimated."""

    t_s: np.ndarray
    position_enu_m: np.ndarray  # (n, 3)
    enu_from_body: np.ndarray   # (n, 4), w x y z
    sigma_m: np.ndarray         # (n, 3), NaN where not given
    sigma_heading_rad: np.ndarray

    def angles_rad(self) -> np.ndarray:
        """Heading (clockwise from grid north), pitch, roll; (n, 3), heading without jumps."""
        w, x, y, z = self.enu_from_body.T
        forward = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])
        starboard_up, down_up = 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)
        return np.stack([np.unwrap(np.arctan2(forward[0], forward[1])), np.arcsin(np.clip(forward[2], -1, 1)),
                         np.arctan2(-starboard_up, -down_up)], axis=1)


def read_track(record: ensonify.Record, kind) -> Track | None:
    """The record's only or first topic of Pose or Estimate."""
    topics = record.topics_of(kind)
    if not topics:
        return None
    messages = [m.content for m in record.messages(topics[0])]
    diagonal = [0, 4, 8]

    def sigmas(field):
        rows = np.array([getattr(m, field, np.zeros(9)) for m in messages], float).reshape(len(messages), 9)[:, diagonal]
        return np.where(rows > 0, np.sqrt(np.maximum(rows, 0)), np.nan)

    return Track(np.array([m.stamp_ns for m in messages]) * 1e-9, np.array([m.position_enu_m for m in messages], float),
                 np.array([m.enu_from_body for m in messages], float), sigmas("position_covariance_enu_m2"),
                 sigmas("rotation_covariance_enu_rad2")[:, 2])


def errors_of(estimate: Track, truth: Track) -> tuple:
    """Times (s), estimate less truth (m, east north up) and of heading (rad), where both are known."""
    inside = (estimate.t_s >= truth.t_s[0]) & (estimate.t_s <= truth.t_s[-1])
    t_s = estimate.t_s[inside]
    true_at = np.stack([np.interp(t_s, truth.t_s, column) for column in truth.position_enu_m.T], axis=1)
    true_heading = np.interp(t_s, truth.t_s, truth.angles_rad()[:, 0])
    heading = estimate.angles_rad()[inside, 0] - true_heading
    return inside, t_s, estimate.position_enu_m[inside] - true_at, (heading + np.pi) % (2 * np.pi) - np.pi


def allan_deviation(readings: np.ndarray, interval_s: float) -> tuple:
    """Averaging times (s) and overlapping Allan deviation, octave by octave, as `kernels/instruments/inertial/testing/allan.h`."""
    integral = np.concatenate([[0.0], np.cumsum(readings) * interval_s])
    times, deviations, m = [], [], 1
    while 9 * m <= len(readings):
        second = integral[2 * m:] - 2 * integral[m:-m] + integral[:-2 * m]
        times.append(m * interval_s)
        deviations.append(np.sqrt(np.mean(second**2) / 2) / (m * interval_s))
        m *= 2
    return np.array(times), np.array(deviations)


def spectrum(values: np.ndarray, interval_s: float) -> tuple:
    """Frequencies (Hz) and one-sided power density by Welch's method: Hann windows over half overlapping segments."""
    length = 2 * len(values) // (SEGMENTS + 1)
    window = np.hanning(length)
    power = [np.abs(np.fft.rfft(window * (piece - piece.mean()))) ** 2
             for piece in (values[i:i + length] for i in range(0, len(values) - length + 1, max(length // 2, 1)))]
    return np.fft.rfftfreq(length, interval_s)[1:], 2 * interval_s * np.mean(power, axis=0)[1:] / np.sum(window**2)


def navigation_picture(record: ensonify.Record):
    """Five panels; what was not recorded says so."""
    truth, estimate = read_track(record, ensonify.Pose), read_track(record, ensonify.Estimate)
    increments = record.topics_of(ensonify.InertialIncrements)
    if truth is None and estimate is None and not increments:
        raise UserError(f"{record.file}: none of pose/1, estimate/1 and inertial_increments/1 was recorded, so there is nothing to draw")
    figure = new_figure(16, 8.5)
    panels = figure.subplot_mosaic([["track", "place", "heading"], ["track", "noise", "motion"]])
    _draw_track(panels["track"], record, truth, estimate)
    _draw_errors(panels["place"], panels["heading"], estimate, truth)
    _draw_allan(panels["noise"], [m.content for m in record.messages(increments[0])] if increments else [])
    _draw_spectra(panels["motion"], truth)
    return figure


def _nothing(axes, why):
    axes.text(0.5, 0.5, why, ha="center", va="center", transform=axes.transAxes, color="0.4")


def _draw_track(axes, record, truth, estimate):
    """From above, one metre as long east as north: the first vehicle's truth and estimate, its fixes, lines that an adaptive survey laid."""
    axes.set_title("Track")
    lines = record.topics_of(ensonify.NextLine)
    planned = [m.content for m in record.messages(lines[0])] if lines else []
    for n, line in enumerate(line for line in planned if not line.done):
        ends = np.array([line.start_enu_m, line.end_enu_m])
        axes.plot(*ends.T, color="0.5", linewidth=0.9, linestyle="--", label="planned lines" if n == 0 else None)
    if truth is not None:
        axes.plot(*truth.position_enu_m[:, :2].T, color="0.75", linewidth=3, label="truth")
    if positions := record.topics_of(ensonify.Position):
        fixes = np.array([m.content.position_enu_m[:2] for m in record.messages(positions[0])]).reshape(-1, 2)
        axes.plot(*fixes.T, ".", color="tab:orange", markersize=2, label="fixes")
    if estimate is not None:
        axes.plot(*estimate.position_enu_m[:, :2].T, color="tab:blue", linewidth=0.9, label="estimate")
    axes.set(xlabel="east (m)", ylabel="north (m)")
    axes.set_aspect("equal", adjustable="datalim")
    axes.grid(alpha=0.3)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="best")
    else:
        _nothing(axes, "needs pose/1, estimate/1 or position/1")


def _draw_errors(place, heading, estimate, truth):
    place.set_title("Estimate less truth: position")
    heading.set_title("Estimate less truth: heading")
    if estimate is None or truth is None:
        for axes in (place, heading):
            _nothing(axes, "needs estimate/1 and pose/1")
        return
    inside, t_s, error_m, heading_rad = errors_of(estimate, truth)
    for axis, (name, colour) in enumerate((("east", "tab:blue"), ("north", "tab:orange"), ("up", "tab:green"))):
        place.plot(t_s, error_m[:, axis], color=colour, linewidth=0.9, label=name)
        for sign in (-3, 3):
            place.plot(t_s, sign * estimate.sigma_m[inside, axis], color=colour, linewidth=0.8, linestyle="--")
    heading.plot(t_s, np.degrees(heading_rad), color="tab:blue", linewidth=0.9)
    for sign in (-3, 3):
        heading.plot(t_s, np.degrees(sign * estimate.sigma_heading_rad[inside]), color="tab:blue", linewidth=0.8,
                     linestyle="--")
    reported = np.isfinite(estimate.sigma_m).any()
    place.set(xlabel="sim time (s)", ylabel="m")
    place.legend(title="dashed: 3 sigma of the filter" if reported else "the filter states no sigma", loc="upper left")
    heading.set(xlabel="sim time (s)", ylabel="degrees")
    for axes in (place, heading):
        axes.grid(alpha=0.3)


def _draw_allan(axes, increments):
    axes.set_title("Allan deviation of the inertial sensors")
    if len(increments) < 20:
        _nothing(axes, "needs 20 inertial_increments/1")
        return
    interval_s = float(np.median([m.interval_s for m in increments]))
    right = axes.twinx()
    for axis, (name, colour) in enumerate((("x", "tab:blue"), ("y", "tab:orange"), ("z", "tab:green"))):
        gyro = np.array([m.angle_rad[axis] / m.interval_s for m in increments])
        force = np.array([m.velocity_mps[axis] / m.interval_s for m in increments])
        t_s, deviation = allan_deviation(gyro, interval_s)
        axes.loglog(t_s, np.degrees(deviation) * 3600, color=colour, label=f"gyro {name}")
        t_s, deviation = allan_deviation(force, interval_s)
        right.loglog(t_s, deviation / 9.80665e-6, color=colour, linestyle="--")
    axes.set(xlabel="averaging time (s)", ylabel="gyros, deg/h")
    right.set_ylabel("accelerometers (dashed), µg")
    axes.legend(loc="best")
    axes.grid(alpha=0.3, which="both")


def _draw_spectra(axes, truth):
    axes.set_title("Spectra of the true motion")
    if truth is None or len(truth.t_s) < 4 * SEGMENTS:
        _nothing(axes, f"needs {4 * SEGMENTS} pose/1")
        return
    step_s = float(np.median(np.diff(truth.t_s)))
    even = np.arange(truth.t_s[0], truth.t_s[-1], step_s)
    angles = np.degrees(truth.angles_rad())
    for name, values, unit in (("roll", angles[:, 2], "deg²/Hz"), ("pitch", angles[:, 1], "deg²/Hz"),
                               ("heave", truth.position_enu_m[:, 2], "m²/Hz")):
        f_hz, density = spectrum(np.interp(even, truth.t_s, values), step_s)
        if np.any(density > 1e-12):
            axes.loglog(f_hz, np.maximum(density, 1e-12), label=f"{name}, {unit}")
    axes.set(xlabel="frequency (Hz)", ylabel="power density", xlim=(None, 2.0))
    axes.grid(alpha=0.3, which="both")
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="best")
    else:
        _nothing(axes, "neither roll nor pitch nor heave")
