"""The numbers of a survey: summary.json."""
import json
import os

import numpy as np


def depth_statistics(up_m: np.ndarray, true_up_m: np.ndarray) -> dict | None:
    """Of soundings against the true seabed below the positions that they claim; None if no truth is known. Positive is
    too shallow. The limit is the total vertical uncertainty of IHO S-44 (6th edition), Special Order."""
    error_m = up_m - true_up_m
    known = np.isfinite(error_m)
    if not known.any():
        return None
    error_m, depth_m = error_m[known], -true_up_m[known]
    limit_m = np.hypot(0.25, 0.0075 * depth_m)
    return {
        "soundings": int(error_m.size),
        "bias_m": float(error_m.mean()),
        "std_m": float(error_m.std()),
        "within_95_m": float(np.percentile(np.abs(error_m), 95)),
        "largest_m": float(np.abs(error_m).max()),
        "inside_special_order": float(np.mean(np.abs(error_m) <= limit_m)),
    }


def run_facts(folder: str) -> dict:
    """What launcher and clock wrote about the run: wall time, late events, memory. Empty if they wrote nothing."""
    run, clock = (_json(os.path.join(folder, name)) for name in ("run.json", "clock.json"))
    if not run:
        return {}
    memory = {p["name"]: 1024 * p["max_rss_kib"] for p in run.get("processes", []) if p.get("max_rss_kib") is not None}
    return {"wall_s": run.get("wall_s"), "sim_s": run.get("sim_s"), "real_time_factor": run.get("real_time_factor"),
            "late_events": clock.get("late_events"), "peak_memory_bytes": memory}


def _json(file: str) -> dict:
    try:
        with open(file, encoding="utf-8") as stream:
            return json.load(stream)
    except OSError:
        return {}
