"""An adaptive survey from above: what soundings have covered, the depths found, the lines run, and lines that were planned."""
import json
import pathlib

import numpy as np

import ensonify
from ensonify_plot.pictures import new_figure
from ensonify_plot.survey import UserError


def coverage_picture(record: ensonify.Record, plan: str | None):
    """Depth with the lines run above, soundings of each cell below; with a plan its lines above both."""
    topics = record.topics_of(ensonify.Coverage)
    if not topics:
        raise UserError("the record has no coverage/1; record the topic of a coverage process")
    last = [m.content for m in record.messages(topics[0])][-1]
    planned = read_plan(plan) if plan else []
    figure = new_figure(10, 2.2 * (3 if planned else 2) + 0.6)
    panels = list(figure.subplots(3 if planned else 2, 1, sharex=True))
    shape = np.array(last.soundings.shape) * last.cell_m
    extent = (0.0, shape[0], 0.0, shape[1])  # across to starboard of the first line, along it
    depth_m, count = -np.asarray(last.height_m, float).T, np.asarray(last.soundings, float).T
    if planned:
        _depths(panels[0], depth_m, extent)
        lines = [_in_rectangle(np.array(line), last) for line in planned]
        for line in lines:
            panels[0].plot(*line.T, color="black", linewidth=0.8)
        panels[0].set_title(f"planned: {len(lines)} lines, {sum(map(_length_m, lines)) / 1e3:.2f} km", fontsize=10)
    image = _depths(panels[-2], depth_m, extent)
    figure.colorbar(image, ax=panels[-2], label="depth (m)", pad=0.01)
    track = _in_rectangle(_track(record), last)
    if track.size:
        panels[-2].plot(*track.T, color="black", linewidth=0.6)
    panels[-2].set_title(f"flown: {last.lines} lines, {last.track_m / 1e3:.2f} km, {last.elapsed_s / 60:.0f} min with turns", fontsize=10)
    shown = np.where(count >= last.needed, count, np.nan)
    image = panels[-1].imshow(shown, origin="lower", extent=extent, aspect="auto", cmap="viridis", interpolation="nearest",
                              vmin=last.needed, vmax=np.percentile(count, 98))
    panels[-1].set_facecolor("red")  # what shows through is not covered
    figure.colorbar(image, ax=panels[-1], label=f"soundings in {last.cell_m:g} m", pad=0.01)
    panels[-1].set_title(f"{100 * last.covered:.2f} % covered by {last.needed} soundings and more (red: not); each covered cell by "
                         f"{last.overlapped:.2f} lines on average", fontsize=10)
    panels[-1].set_xlabel("across the lines (m)")
    for panel in panels:
        panel.set(xlim=extent[:2], ylim=extent[2:], ylabel="along (m)")
    if planned:  # as wide as those with a scale beside them
        figure.colorbar(image, ax=panels[0], pad=0.01).ax.set_visible(False)
    return figure


def read_plan(path: str) -> list:
    """Places of each line of `ensonify plan lines --json`."""
    try:
        return [line["places"] for line in json.loads(pathlib.Path(path).read_text())["lines"]]
    except (OSError, ValueError, KeyError, TypeError) as fault:
        raise UserError(f"{path}: cannot be read as a plan ({fault}); allowed: what ensonify plan lines --json prints") from fault


def _depths(panel, depth_m: np.ndarray, extent: tuple):
    return panel.imshow(depth_m, origin="lower", extent=extent, aspect="auto", cmap="viridis_r", interpolation="nearest")


def _length_m(line: np.ndarray) -> float:
    return float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())


def _track(record: ensonify.Record) -> np.ndarray:
    topics = record.topics_of(ensonify.Estimate)
    return np.array([m.content.position_enu_m[:2] for m in record.messages(topics[0])]) if topics else np.empty((0, 2))


def _in_rectangle(places_enu_m: np.ndarray, coverage: ensonify.Coverage) -> np.ndarray:
    """Across to starboard and along, from the rectangle's rear port corner."""
    if not places_enu_m.size:
        return places_enu_m
    off = places_enu_m - np.array(coverage.corner_enu_m)
    sine, cosine = np.sin(coverage.heading_grid_rad), np.cos(coverage.heading_grid_rad)
    return np.stack([off @ [cosine, -sine], off @ [sine, cosine]], axis=1)
