"""Is the stated uncertainty of soundings honest? A hundred surveys with acoustics, each wrong in its own way by what it states."""
import pathlib
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass

import numpy as np

from harness import ROOT, row

sys.path += [str(ROOT / "tools/plot"), str(ROOT / "clients/python")]
import ensonify  # noqa: E402
from ensonify_plot.true_places import Judged, Mounting, judge  # noqa: E402

SURVEYS, QUICK_SURVEYS = 100, 5
CLASSES = 10  # of beam angle, as many soundings in each
SETTLED_S = 30  # by then the navigation filter is settled, its heading last: the alignment that a run starts with is assumed
LEAST, MOST = 0.93, 0.97  # of the errors are to be inside what is stated at 95 %

WATER_MPS = 1490  # of the bay
# What launch/uncertainty.yaml states, and what is entered there: argument -> (entered, standard deviations of its errors).
ERRORS = {
    "roll_deg": (0, [0.01]), "pitch_deg": (0, [0.03]), "yaw_deg": (0, [0.03]),
    "forward_m": (1.5, [0.005]), "starboard_m": (0.2, [0.005]), "down_m": (0.8, [0.005]),
    "antenna_down_m": (-3, [0.01, 0.01, 0.02]),  # draught, squat, tide
    "cast_mps": (WATER_MPS, [0.3]), "face_mps": (0, [0.05]),
    "position_latency_s": (0, [0.005]), "attitude_latency_s": (0, [0.0005]),
}


def drawn_errors(surveys: int) -> list:
    """Arguments of each survey: normal errors of the stated deviations. Each source has one value in every `surveys`-th of its
    distribution (a Latin hypercube), then all are mixed a little so that over the surveys they are uncorrelated and of mean 0 and exactly
    their deviation: so then is what any sum of them does to a sounding. What the navigation errs by for most of a survey, above all its heading,
    is not drawn here and not spread evenly: docs/manual/uncertainty.md."""
    draw = np.random.default_rng(20250601)
    deviations = [(name, deviation) for name, (_, several) in ERRORS.items() for deviation in several]
    levels = np.stack([(draw.permutation(surveys) + draw.random(surveys)) / surveys for _ in deviations], axis=1)
    normal = np.vectorize(statistics.NormalDist().inv_cdf)(levels)
    normal -= normal.mean(axis=0)
    normal = normal @ np.linalg.inv(np.linalg.cholesky(normal.T @ normal / surveys)).T
    arguments = []
    for row_of_survey in normal:
        errors = dict.fromkeys(ERRORS, 0.0)
        for (name, deviation), value in zip(deviations, row_of_survey):
            errors[name] += deviation * value
        # A position is late, never early; all errors with the other sign make soundings err by as much the other way.
        mirror = -1 if errors["position_latency_s"] < 0 else 1
        errors = {name: mirror * error for name, error in errors.items()}
        errors["attitude_latency_s"] = abs(errors["attitude_latency_s"])  # waves turn the vehicle to either side alike
        arguments.append({name: entered + errors[name] for name, (entered, _) in ERRORS.items()})
    return arguments


def survey(run: pathlib.Path, seed: int, arguments: dict, *options) -> Judged:
    """Runs one, all in one process; `run` is ensonify-run."""
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as out:
        command = [str(run), str(ROOT / "launch/uncertainty.yaml"), "--free", "--in-process", "--quiet", "--out", out,
                   "--arg", f"seed={seed}", *options]
        for name, value in arguments.items():
            command += ["--arg", f"{name}={value:.6f}"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"uncertainty, seed {seed}: exit {done.returncode}: {done.stderr}")
        return judged(pathlib.Path(out) / "survey.mcap", arguments)


def judged(record: pathlib.Path, arguments: dict) -> Judged:
    actual = Mounting(np.array([arguments[name] for name in ("forward_m", "starboard_m", "down_m")]),
                      *(arguments[name] for name in ("roll_deg", "pitch_deg", "yaw_deg")))
    with ensonify.Record(record) as opened:
        return judge(opened, "bow", "boat", actual, WATER_MPS)


@dataclass
class Inside:
    """Share of the errors inside what is stated, in a class of beam angle."""

    middle_deg: float
    share: float
    deviation: float  # of the share, by how the surveys differ


def inside(surveys: list, stated: str) -> list:
    """One Inside a class, of "tvu" or "thu". Soundings whose truth is not known count nowhere."""
    angles, kept, number = [], [], []
    for i, s in enumerate(surveys):
        error_m, limit_m = (np.abs(s.up_error_m), s.tvu_m) if stated == "tvu" else (np.hypot(*s.level_error_m.T), s.thu_m)
        known = np.isfinite(error_m) & (s.t_s > SETTLED_S)
        angles.append(np.degrees(s.angle_rad[known]))
        kept.append((error_m <= limit_m)[known])
        number.append(np.full(np.count_nonzero(known), i))
    angles, kept, number = (np.concatenate(parts) for parts in (angles, kept, number))
    classes = np.array_split(np.argsort(angles, kind="stable"), CLASSES)
    result = []
    for c in classes:
        by_survey = [kept[c][number[c] == i].mean() for i in range(len(surveys)) if np.any(number[c] == i)]
        result.append(Inside(float(np.median(angles[c])), float(kept[c].mean()),
                             statistics.stdev(by_survey) / len(by_survey)**0.5))
    return result


def bench_uncertainty(b):
    """Errors inside TVU and THU by tenths of the beam angle. `--quick`: a tenth of the surveys, which show nothing of what all of them
    have wrong from beginning to end: no target then."""
    run, count = b.build / "bin/ensonify-run", QUICK_SURVEYS if b.quick else SURVEYS
    surveys = [survey(run, seed, arguments) for seed, arguments in enumerate(drawn_errors(SURVEYS)[:count], start=1)]
    rows = []
    for stated in ("tvu", "thu"):
        for c in inside(surveys, stated):
            name = f"errors inside {stated.upper()} at {c.middle_deg:+.0f} degrees, sd by survey {c.deviation:.3f}"
            target, ok = ("", True) if b.quick else (f"{LEAST} to {MOST}", LEAST <= c.share <= MOST)
            rows.append(row(name, c.share, "of all", target=target, ok=ok))
    return rows
