"""The command lines of pictures of pings: what can be asked, and which picture answers."""
import argparse
import math

import ensonify
from ensonify_plot import angular_response, coverage, grid, scanning, water_column, waterfall
from ensonify_plot.forward_looking import forward_looking_picture
from ensonify_plot.received import (Span, choose_ping, choose_topic, has_two_sides, heads_with_soundings, is_fan, is_single, of_heads,
                                     pings_in, process_of, soundings_of)
from ensonify_plot.level import Gain
from ensonify_plot.lod import add_lod
from ensonify_plot.navigation import navigation_picture
from ensonify_plot.ping import Show, fan_picture, ping_picture
from ensonify_plot.plan import add_plan, read_plan
from ensonify_plot.results import open_record, save_picture
from ensonify_plot.scene import add_scene
from ensonify_plot.seabed import add_seabed
from ensonify_plot.errors import UserError
from ensonify_plot.survey import origin_of, read_survey

GAIN_HELP = ("added to the received level for display: S,A for S log10 R + 2 A R (S in dB, A in dB/km, R slant range in m, held "
             "below 1 m); none; head: the head's own law without its offset; or auto: head, or ")
RECORD_HELP = "an MCAP file, or a folder with one; default: $ENSONIFY_OUT"


def add_verbs(verbs) -> None:
    """The verbs that make one picture each."""
    ping = _verb(verbs, "ping", plot_ping,
                 "One multibeam ping: beam against slant range with its detections, beside the fan.")
    _one_ping(ping)
    _colours(ping, "none")
    fan = _verb(verbs, "fan", plot_fan,
                "One multibeam ping as a section: across track against depth (m), same scale both ways, in dB re 1 uPa. Upright by "
                "the measured attitude if the ping states it.")
    _one_ping(fan)
    _colours(fan, "none")
    fls = _verb(verbs, "fls", plot_fls,
                "One forward-looking ping: polar (m ahead against m to starboard) and rectangular (azimuth in degrees against slant "
                "range in m).")
    _one_ping(fls)
    _colours(fls, "auto")
    scan = _verb(verbs, "scan", plot_scan,
                 "What a mechanically scanned head saw around it (m ahead against m to starboard): the newest row of every direction "
                 "up to a ping.")
    _one_ping(scan, "the last")
    _colours(scan, "auto")
    _add_waterfall(verbs)
    _add_water_column(verbs)
    _add_angular_response(verbs)
    _verb(verbs, "navigation", plot_navigation,
          "Where the vehicle went and how well that was known: track (m), error of the estimate (m, degrees) against the recorded truth with the filter's 3 sigma, "
          "Allan deviation of the inertial sensors, spectra of the motion.")
    _add_coverage(verbs)
    add_seabed(verbs)
    add_lod(verbs)
    add_scene(verbs)


def _add_waterfall(verbs) -> None:
    fall = _verb(verbs, "waterfall", plot_waterfall,
                 "A sidescan waterfall: port and starboard against time (s), in slant range (m) or, with --ground, over ground (m) by "
                 "the instrument's own bottom track and a level bottom.")
    _span(fall, "all")
    _colours(fall, "auto")
    fall.add_argument("--ground", action="store_true",
                      help="ground range sqrt(R^2 - H^2), H in m from the head's bottom_track/1; pings without a bottom are left "
                      "empty; default: slant range")


def _add_water_column(verbs) -> None:
    column = _verb(verbs, "water-column", plot_water_column,
                   "With --ping N or --t S one ping: beam against slant range (m), detections on top; else one beam, straight down, "
                   "over time (s).")
    _span(column, "all, one beam over time")
    _colours(column, "none")
    column.add_argument("--angle", type=_number(-90, 90), default=0.0, metavar="DEG",
                        help="of the beam that is drawn over time, in degrees from straight down, positive to starboard; "
                        "default: 0")


def _add_coverage(verbs) -> None:
    command = _verb(verbs, "coverage", plot_coverage,
                    "A survey from above: depths (m) with the lines run, and the soundings of each cell. Of an adaptive survey what its "
                    "coverage process counted.")
    command.add_argument("--cell", type=_number(0.01, 1e4), metavar="M", help="cell size in m; default: as of plot survey")
    command.add_argument("--soundings", type=_count, metavar="N",
                         help=f"accepted soundings that a covered cell has at least; default: {grid.MIN_COUNT}")
    command.add_argument("--turns", action="store_true", help="soundings of turns, run-ins and run-outs too; default: of lines alone")
    command.add_argument("--latlon", action="store_true", help="latitude and longitude; default: metres from the origin")
    add_plan(command)


def _add_angular_response(verbs) -> None:
    curve = _verb(verbs, "angular-response", plot_angular_response,
                  "Backscatter (dB) against grazing angle (degrees) from soundings: means of linear power with their spread. The "
                  "picture says what was corrected.")
    _span(curve, "all", "soundings")
    curve.add_argument("--class", dest="class_deg", type=_number(0.1, 30), default=1.0, metavar="DEG",
                       help="width of a class of angles, 0.1 to 30 degrees; default: 1")
    curve.add_argument("--absorption", type=_number(0, 2000), metavar="DB_PER_KM",
                       help="compute strengths from levels with this absorption, 0 to 2000 dB/km; default: the head's strengths, or "
                       "where it has none its operator's absorption")


def _verb(verbs, name: str, act, text: str) -> argparse.ArgumentParser:
    command = verbs.add_parser(name, help=text, description=text)
    command.set_defaults(act=act)
    command.add_argument("record", nargs="?", metavar="RECORD", help=RECORD_HELP)
    command.add_argument("--out", metavar="FILE.png",
                         help="the picture, or a folder for it; default: beside the record, named after the verb and the ping")
    return command


def _one_ping(command, default: str = "the one in the middle of the record") -> None:
    command.add_argument("--topic", help="the head's ping topic; default: the only one that fits")
    which = command.add_mutually_exclusive_group()
    which.add_argument("--ping", type=int, metavar="N", help=f"ping number; default: {default}")
    which.add_argument("--t", type=_number(), metavar="S", help="the first ping at or after this sim time, in s")


def _span(command, default: str, what: str = "pings") -> None:
    command.add_argument("--topic", help=f"the head's topic of {what}; default: the only one that fits")
    which = command.add_mutually_exclusive_group()
    which.add_argument("--ping", type=_span_of(int), default=Span(), metavar="N|A:B",
                       help=f"a ping number, or the first and last of a span (A: and :B leave an end open); default: {default}")
    which.add_argument("--t", type=_span_of(float), default=Span(), metavar="S|A:B", help="the same by sim time in s")


def _colours(command, gain: str) -> None:
    otherwise = {"none": "none", "auto": "30,0"}[gain]
    command.add_argument("--gain", type=_gain, default=gain, metavar="S,A",
                         help=f"{GAIN_HELP}{otherwise} if it has none; default: {gain}")
    command.add_argument("--db", nargs=2, type=_number(), metavar=("LOW", "HIGH"),
                         help="levels of the darkest and the brightest colour, in dB; default: percentiles, named in the picture")


def _count(text: str) -> int:
    if not text.isascii() or not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text}: allowed: a whole number from 1 on")
    return int(text)


def _number(least: float = -math.inf, most: float = math.inf):
    def number(text: str) -> float:
        value = float(text)
        if not (math.isfinite(value) and least <= value <= most):
            within = "" if math.isinf(least) else f" in [{least:g}, {most:g}]"
            raise argparse.ArgumentTypeError(f"{text}: allowed: a number{within}")
        return value

    return number


def _span_of(kind):
    def span(text: str) -> Span:
        try:
            ends = [kind(part) if part else None for part in text.split(":")]
        except ValueError:
            ends = []
        if len(ends) == 1 and ends[0] is not None:
            return Span(ends[0], ends[0])
        if len(ends) != 2 or (None not in ends and ends[0] > ends[1]):
            raise argparse.ArgumentTypeError(f"{text}: allowed: a number, or A:B with A <= B, either of which may be left out")
        return Span(*ends)

    return span


def _gain(text: str):
    if text in ("none", "head", "auto"):
        return text
    try:
        spreading_db, absorption_db_per_km = (float(part) for part in text.split(","))
    except ValueError:
        spreading_db = absorption_db_per_km = math.nan
    if not (0 <= spreading_db <= 100 and 0 <= absorption_db_per_km <= 2000):
        raise argparse.ArgumentTypeError(f"{text}: allowed: none, head, auto, or S,A with S in [0, 100] dB and A in [0, 2000] "
                                         "dB/km")
    return Gain(spreading_db, absorption_db_per_km / 1e3)


def _show(options) -> Show:
    limits = tuple(options.db) if options.db else None
    if limits and not limits[0] < limits[1]:
        raise ensonify.RunError(f"--db {limits[0]:g} {limits[1]:g}: LOW must be below HIGH", 2)
    return Show(options.gain, limits)


def multibeam_topic(record: ensonify.Record, asked: str | None, or_first: bool = False) -> str:
    """The ping topic of the head that sounds, or, where no soundings were recorded, the one with many beams."""
    sounding = heads_with_soundings(record)

    def guess(topic, ping):
        return is_fan(ping) and (not sounding or process_of(topic) in sounding)

    return choose_topic(record, asked, of_heads(record, False, is_fan, guess), "pings of a multibeam", or_first)


def downward_topic(record: ensonify.Record, asked: str | None) -> str:
    """The ping topic of the head that sounds, a single beam included, or where no soundings were recorded that of no sidescan."""
    sounding = heads_with_soundings(record)

    def guess(topic, ping):
        return process_of(topic) in sounding if sounding else not has_two_sides(ping)

    fits = of_heads(record, False, lambda ping: not has_two_sides(ping), guess)
    return choose_topic(record, asked, fits, "pings of a head that points down")


def plot_ping(options) -> int:
    """`ensonify plot ping`."""
    record = open_record(options.record)
    received = choose_ping(record, multibeam_topic(record, options.topic, or_first=True), options.ping, options.t)
    figure = ping_picture(received, soundings_of(record, received), _show(options))
    save_picture(record, options.out, f"ping_{received.ping.ping}.png", figure)
    return 0


def plot_fan(options) -> int:
    """`ensonify plot fan`."""
    record = open_record(options.record)
    received = choose_ping(record, multibeam_topic(record, options.topic), options.ping, options.t)
    figure = fan_picture(received, soundings_of(record, received), _show(options))
    save_picture(record, options.out, f"fan_{received.ping.ping}.png", figure)
    return 0


def plot_fls(options) -> int:
    """`ensonify plot fls`."""
    record = open_record(options.record)
    sounding = heads_with_soundings(record)

    def guess(topic, ping):
        return is_fan(ping) and process_of(topic) not in sounding

    topic = choose_topic(record, options.topic, of_heads(record, True, is_fan, guess), "forward-looking pings")
    received = choose_ping(record, topic, options.ping, options.t)
    save_picture(record, options.out, f"fls_{received.ping.ping}.png", forward_looking_picture(received, _show(options)))
    return 0


def plot_scan(options) -> int:
    """`ensonify plot scan`."""
    record = open_record(options.record)
    fits = of_heads(record, True, is_single, lambda _, ping: is_single(ping))
    topic = choose_topic(record, options.topic, fits, "pings of a scanning head")
    turn = scanning.turn_of(record, topic, options.ping, options.t)
    save_picture(record, options.out, f"scan_{turn[-1].ping.ping}.png", scanning.scan_picture(turn, _show(options)))
    return 0


def plot_waterfall(options) -> int:
    """`ensonify plot waterfall`."""
    record = open_record(options.record)
    pings, tracks = waterfall.read(record, options.topic, options.ping, options.t, options.ground)
    figure = waterfall.waterfall_picture(pings, tracks, options.ground, _show(options))
    save_picture(record, options.out, "waterfall_ground.png" if options.ground else "waterfall.png", figure)
    return 0


def plot_water_column(options) -> int:
    """`ensonify plot water-column`."""
    record = open_record(options.record)
    if options.ping.single or options.t.single:
        topic = multibeam_topic(record, options.topic)
        received = choose_ping(record, topic, options.ping.first, options.t.first)
        figure = water_column.beam_picture(received, soundings_of(record, received), _show(options))
        save_picture(record, options.out, f"water_column_{received.ping.ping}.png", figure)
        return 0
    pings = list(pings_in(record, downward_topic(record, options.topic), options.ping, options.t))
    figure = water_column.stack_picture(record, pings, options.angle, _show(options))
    save_picture(record, options.out, "water_column.png", figure)
    return 0


def plot_angular_response(options) -> int:
    """`ensonify plot angular-response`."""
    record = open_record(options.record)
    absorption_dbpm = None if options.absorption is None else options.absorption / 1e3
    response = angular_response.read(record, options.topic, options.ping, options.t, absorption_dbpm)
    figure = angular_response.angular_response_picture(response, options.class_deg)
    save_picture(record, options.out, "angular_response.png", figure)
    return 0


def plot_navigation(options) -> int:
    """`ensonify plot navigation`."""
    record = open_record(options.record)
    save_picture(record, options.out, "navigation.png", navigation_picture(record))
    return 0


def plot_coverage(options) -> int:
    """`ensonify plot coverage`."""
    record = open_record(options.record)
    if topics := record.topics_of(ensonify.Coverage):
        given = [name for name in ("cell", "soundings", "turns", "latlon") if getattr(options, name)]
        if given:
            raise UserError(f"--{given[0]}: {record.file} holds coverage/1, whose cells are those of its coverage process; allowed: --plan")
        figure = coverage.adaptive_picture(record, topics[0], read_plan(options.plan, origin_of(record)))
    else:
        survey = read_survey(record, options.turns)
        planned = read_plan(options.plan, survey.origin)
        figure = coverage.survey_picture(survey, survey.frame(options.cell, options.latlon), options.soundings or grid.MIN_COUNT, planned)
    save_picture(record, options.out, "coverage.png", figure)
    return 0
