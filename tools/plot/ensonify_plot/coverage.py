"""A survey from above: what soundings have covered, the depths found, the lines run, and lines that were planned."""
import numpy as np

import ensonify
from ensonify_plot import grid, pictures
from ensonify_plot.pictures import DEPTH_COLOURS, new_figure
from ensonify_plot.survey import Survey


def adaptive_picture(record: ensonify.Record, topic: str, planned: list):
    """What a coverage process counted: depth with the lines run above, soundings of each cell below; with a plan its lines above both."""
    last = [m.content for m in record.messages(topic)][-1]
    figure = new_figure(10, 2.2 * (3 if planned else 2) + 0.6)
    panels = list(figure.subplots(3 if planned else 2, 1, sharex=True))
    shape = np.array(last.soundings.shape) * last.cell_m
    extent = (0.0, shape[0], 0.0, shape[1])  # across to starboard of the first line, along it
    depth_m, count = -np.asarray(last.height_m, float).T, np.asarray(last.soundings, float).T
    if planned:
        _depths(panels[0], depth_m, extent)
        lines = [_in_rectangle(line, last) for line in planned]
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


def survey_picture(survey: Survey, frame: grid.Frame, needed: int, planned: list):
    """Any survey: depth with the track and planned lines, and beside it the soundings of each cell; cells of the area that hold fewer
    than are needed are red."""
    s = survey.soundings
    gridder = grid.Gridder(frame, s.east_m, s.north_m)
    up_m = gridder.mean(s.up_m)
    area = grid.inside(frame, grid.outline(frame, gridder.count > 0))
    width, height = pictures.map_size_in(frame)
    tall = height > 0.75 * width
    figure = new_figure(width * (1.7 if tall else 1), height * (1 if tall else 1.85))
    left, right = figure.subplots(1, 2, sharey=True) if tall else figure.subplots(2, 1, sharex=True)
    relief = pictures.Relief(up_m, frame.cell_m)
    mappable = relief.draw(left, frame, up_m)
    covered = np.count_nonzero((gridder.count >= needed) & area) / max(np.count_nonzero(area), 1)
    pictures.map_axes(left, frame, f"Depth: {len(s):,} soundings, {len(survey.lines)} lines")
    pictures.draw_track(left, survey)
    pictures.draw_plan(left, planned)
    pictures.depth_bar(figure, mappable, left)
    counted = np.where(gridder.count >= needed, gridder.count, np.nan).astype(float)
    right.imshow(np.where(area, 1.0, np.nan), extent=frame.extent_m, origin="lower", cmap=pictures.UNCOVERED, interpolation="nearest")
    mappable = right.imshow(counted, extent=frame.extent_m, origin="lower", cmap="viridis", interpolation="nearest", vmin=needed,
                            vmax=max(np.percentile(gridder.count[gridder.count > 0], 98), needed + 1))
    pictures.map_axes(right, frame, f"{covered:.2%} of the area covered by {needed} or more in {frame.cell_m:g} m (red: not)")
    pictures.colour_bar(figure, mappable, right, "soundings")
    return figure


def _depths(panel, depth_m: np.ndarray, extent: tuple):
    return panel.imshow(depth_m, origin="lower", extent=extent, aspect="auto", cmap=DEPTH_COLOURS, interpolation="nearest")


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
