"""The command `ensonify plot`."""
import argparse
import json
import os
import sys

import numpy as np
from osgeo import osr

import ensonify
from ensonify_plot import files, grid, pictures, reduction, uncertainty
from ensonify_plot.received import choose_ping, heads_with_soundings, process_of, soundings_of
from ensonify_plot.ping import ping_picture
from ensonify_plot.results import Writer, folder_of, open_record
from ensonify_plot.summary import depth_statistics, run_facts
from ensonify_plot.errors import UserError
from ensonify_plot.survey import Survey, read_survey
from ensonify_plot.verbs import RECORD_HELP, add_verbs, multibeam_topic


def main(arguments=None) -> int:
    """Exit code 0, or 2 when the user's files or arguments are wrong."""
    options = parse(arguments)
    try:
        return options.act(options)
    except (UserError, ensonify.RunError, ensonify.DecodeError) as error:
        print(f"ensonify plot: {error}", file=sys.stderr)
    except OSError as error:
        print(f"ensonify plot: {error.filename or options.out}: {error.strerror or error}", file=sys.stderr)
    return 2


def parse(arguments) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="ensonify plot", description="Pictures, grids and numbers from a record.")
    verbs = parser.add_subparsers(required=True, metavar="VERB")
    text = "Gridded bathymetry (GeoTIFF), soundings (CSV), pictures (PNG), summary.json."
    survey = verbs.add_parser("survey", help=text, description=text)
    survey.set_defaults(act=plot_survey)
    survey.add_argument("record", nargs="?", metavar="RECORD", help=RECORD_HELP)
    survey.add_argument("--out", metavar="DIR", help="folder for the results; default: where the record is")
    survey.add_argument("--cell", type=float, metavar="M", help="cell size in m; default: the finest of 0.1, 0.2, 0.5, ... m at "
                        f"which {grid.WELL_FILLED:.0%} of the cells hold {grid.MIN_COUNT} soundings".replace("%", "%%"))
    survey.add_argument("--turns", action="store_true", help="soundings of turns, run-ins and run-outs too; default: of lines alone, where the "
                        "record states the mission")
    survey.add_argument("--utm", action="store_true", help="bathymetry.tif in the UTM zone of the survey; default: in the scenario's own "
                        "transverse Mercator")
    survey.add_argument("--latlon", action="store_true", help="maps with latitude and longitude; default: metres from the origin")
    how = survey.add_mutually_exclusive_group()
    how.add_argument("--gauge", metavar="FILE", help="heights by tide gauge: water levels in m above chart datum, lines \"2025-06-01T12:00:00Z,"
                     "1.35\", less settlement, plus the measured heave; default: the estimate's heights")
    how.add_argument("--separation", metavar="FILE", help="heights by satellite: those of position/1 above the ellipsoid less this grid that GDAL "
                     "reads, chart datum above the ellipsoid in m, in metres of the world or with a coordinate system; default: the estimate's heights")
    survey.add_argument("--settlement", type=_settlement, metavar="S:L,...", help="with --gauge: how much lower, L in m, the vehicle's reference "
                        "point runs at a speed S in m/s over ground than the still water; default: 0:0")
    survey.add_argument("--json", action="store_true", help="print summary.json's content instead of text")
    add_verbs(verbs)
    for command in (parser, *verbs.choices.values()):
        command.add_argument("--version", action="version", version=f"ensonify {ensonify.__version__}")
    return parser.parse_args(arguments)


def _settlement(text: str) -> list:
    try:
        return reduction.settlement_of(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not speeds, rising, and metres, such as 0:0,4:0.06") from None


def plot_survey(options) -> int:
    """`ensonify plot survey`."""
    record = open_record(options.record)
    out = Writer(options.out or folder_of(record), options.json)
    survey = read_survey(record, options.turns)
    if options.utm and survey.origin is None:
        raise UserError(f"--utm: {record.file} does not state where the world is (no chart/1)")
    if options.settlement and not options.gauge:
        raise UserError("--settlement: needs --gauge")
    heights = "by the estimate"
    if options.gauge or options.separation:
        heights = reduction.reduce(survey, record, options.gauge, options.settlement, options.separation)
    summary = draw_survey(survey, options, out)
    draw_a_ping(record, out)
    summary = {"record": os.path.basename(record.file), "whole_record": record.whole, "heights": heights, **summary, **run_facts(out.folder),
               "files": [*out.files, "summary.json"]}
    with open(out.path("summary.json"), "w", encoding="utf-8") as stream:
        json.dump(summary, stream, indent=2)
        stream.write("\n")
    print(json.dumps(summary) if options.json else in_words(summary))
    return 0


def draw_a_ping(record: ensonify.Record, out: Writer) -> None:
    """The ping in the middle of the record, if pings were recorded. One that gives no picture is no reason to give up a survey."""
    if not any(process_of(topic) in heads_with_soundings(record) for topic in record.topics_of(ensonify.Ping)):
        return
    try:
        received = choose_ping(record, multibeam_topic(record, None, or_first=True))
    except UserError as error:
        print(f"ensonify plot: no ping.png: {error}", file=sys.stderr)
        return
    out.picture("ping.png", ping_picture(received, soundings_of(record, received)))


def draw_survey(survey: Survey, options, out: Writer) -> dict:
    """Everything about the seabed; returns its part of the summary."""
    s = survey.soundings
    frame = survey.frame(options.cell, options.latlon)
    cell_m = frame.cell_m
    gridder = grid.Gridder(frame, s.east_m, s.north_m)
    up_m = gridder.mean(s.up_m)
    stated = uncertainty.stated(s.tvu_m, s.thu_m, -s.up_m)
    latitude_deg, longitude_deg = files.geodetic_of(survey.origin, s.east_m, s.north_m)
    write_bathymetry(survey, cell_m, files.utm_crs(latitude_deg.mean(), longitude_deg.mean()) if options.utm else None, out)
    write_soundings(survey, latitude_deg, longitude_deg, out)
    relief = pictures.Relief(up_m, cell_m)
    out.picture("survey.png", pictures.survey_picture(survey, frame, up_m, relief))
    statistics = None
    if survey.seabed:
        true_grid_m = survey.seabed.height_m(*frame.centres())
        out.picture("truth.png", pictures.truth_picture(frame, true_grid_m, relief))
        out.picture("survey_and_truth.png", pictures.side_by_side(survey, frame, up_m, true_grid_m, relief))
        true_up_m = survey.seabed.height_m(s.east_m, s.north_m)
        statistics = depth_statistics(s.up_m, true_up_m)
        if statistics:
            error_m = s.up_m - true_up_m
            statistics |= uncertainty.kept(error_m, s.tvu_m, s.beam_angle_rad) or {}
            statistics["order"] = uncertainty.order_of_errors(error_m, -true_up_m)
            picture = pictures.difference_picture(survey, frame, gridder.mean(error_m), error_m, statistics)
            out.picture("difference.png", picture)
    return {
        "heads": survey.heads, "lines": [line.name for line in survey.lines], "pings": survey.ping_count, "beams": survey.beam_count,
        "soundings": len(s), "left_out_in_turns": survey.in_turns,
        "accepted": (len(s) + survey.in_turns) / survey.beam_count, "cell_m": cell_m, "end_s": survey.end_s,
        "depth_m": {"least": float(-s.up_m.max()), "mean": float(-s.up_m.mean()), "greatest": float(-s.up_m.min())},
        "coverage": coverage(survey, frame), "depth_against_truth": statistics, "uncertainty": stated,
        "warning": uncertainty.warning(statistics, stated),
    }


def write_bathymetry(survey: Survey, cell_m: float, utm: osr.SpatialReference | None, out: Writer) -> None:
    """bathymetry.tif: cells of the world, or of UTM."""
    s = survey.soundings
    world = files.world_crs(survey.origin)
    east_m, north_m = (s.east_m, s.north_m) if utm is None else files.transformed(world, utm, s.east_m, s.north_m)
    frame = grid.frame_around(east_m, north_m, cell_m)
    gridder = grid.Gridder(frame, east_m, north_m)
    facts = {"ENSONIFY_VERSION": survey.info.get("version", ""), "SEED": survey.info.get("seed", ""), "CELL_SIZE_M": cell_m,
             "VERTICAL_DATUM": "chart datum of the scenario"}
    tvu_m = gridder.mean(s.tvu_m) if np.isfinite(s.tvu_m).any() else None
    files.write_geotiff(out.path("bathymetry.tif"), frame, gridder.mean(s.up_m), gridder.count, tvu_m, utm or world, facts)


def write_soundings(survey: Survey, latitude_deg, longitude_deg, out: Writer) -> None:
    """soundings.csv. What the record does not state is left empty."""
    s = survey.soundings
    times_s, ping = np.unique(s.t_s, return_inverse=True)
    files.write_csv(out.path("soundings.csv"), [
        ("t_s", s.t_s, 6), ("utc", ping, utc_texts(survey.utc_start_ns, times_s)),
        ("line", s.line, [*(line.name for line in survey.lines), ""]),  # index -1 is the last
        ("head", s.head, survey.heads), ("ping", s.ping, 0), ("beam", s.beam, 0),
        ("latitude_deg", latitude_deg, 9), ("longitude_deg", longitude_deg, 9),
        ("east_m", s.east_m, 3), ("north_m", s.north_m, 3), ("depth_m", -s.up_m, 3), ("received_level_db", s.received_level_db, 2),
        ("tvu_m", s.tvu_m, 3), ("thu_m", s.thu_m, 3)])


def utc_texts(utc_start_ns: int | None, times_s: np.ndarray) -> list:
    """Sim times as 2025-06-01T12:00:00.123456Z."""
    if utc_start_ns is None:
        return [""] * len(times_s)
    utc = np.datetime64(utc_start_ns, "ns") + np.rint(times_s * 1e9).astype("timedelta64[ns]")
    return [text + "Z" for text in np.datetime_as_string(utc, unit="us").tolist()]


def coverage(survey: Survey, frame: grid.Frame) -> dict:
    """Share of the surveyed area that has soundings. The area is the convex hull of what was seen on the runlines (or, if
    the record does not state these, at any time)."""
    s = survey.soundings
    on_line = s.line >= 0
    reported = bool(on_line.any())
    part = on_line if reported else np.ones(len(s), bool)
    cells = frame.cols * frame.rows
    index = frame.index(s.east_m, s.north_m)
    covered_on_line = np.bincount(index[part], minlength=cells).reshape(frame.rows, frame.cols) > 0
    covered = np.bincount(index, minlength=cells).reshape(frame.rows, frame.cols) > 0
    area = grid.inside(frame, grid.outline(frame, covered_on_line))
    share = np.count_nonzero(covered & area) / max(np.count_nonzero(area), 1)
    return {"share": share, "area_m2": float(np.count_nonzero(area) * frame.cell_m**2),
            "with_soundings_m2": float(np.count_nonzero(covered) * frame.cell_m**2),
            "of": "convex hull of the soundings on the runlines" if reported else "convex hull of all soundings"}


def in_words(summary: dict) -> str:
    """The summary for people, in some lines: what is true before what is claimed."""
    turns = f", {summary['left_out_in_turns']:,} of turns left out" if summary["left_out_in_turns"] else ""
    lines = [f"{summary['soundings']:,} soundings of {summary['pings']:,} pings ({summary['accepted']:.1%} of the beams accepted{turns}), depth "
             f"{summary['depth_m']['least']:.2f} to {summary['depth_m']['greatest']:.2f} m, cells of {summary['cell_m']:g} m",
             f"coverage {summary['coverage']['share']:.1%} of {summary['coverage']['area_m2'] / 1e4:.2f} ha "
             f"({summary['coverage']['of']})"]
    stated, truth = summary["uncertainty"], summary["depth_against_truth"]
    if truth:
        lines.append(f"against the true seabed: bias {truth['bias_m']:+.3f} m, standard deviation {truth['std_m']:.3f} m, 95 % "
                     f"within {truth['within_95_m']:.3f} m, {truth['inside_special_order']:.1%} inside IHO S-44 Special Order; "
                     f"heights keep {truth['order'] or 'no order'}")
    else:
        lines.append("the record holds no tiles below the soundings: nothing to compare with")
    if stated:
        lines.append(f"as stated at 95 %: TVU {stated['tvu_m']:.3f} m, THU {stated['thu_m']:.3f} m (medians); IHO S-44 (6th edition), "
                     f"uncertainty only: {stated['order'] or 'no order'}")
    if truth and "inside_tvu" in truth:
        shares = truth["inside_tvu_by_angle"]
        lines.append(f"errors inside the stated TVU: {truth['inside_tvu']:.1%}; by beam angle {min(shares):.1%} to {max(shares):.1%}")
    if summary["warning"]:
        lines.append(f"warning: {summary['warning']}")
    if summary.get("real_time_factor"):
        lines.append(f"{summary['sim_s']:.1f} s in {summary['wall_s']:.1f} s: {summary['real_time_factor']:.1f} times real time, "
                     f"{summary['late_events']} late events")
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
