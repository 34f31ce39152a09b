"""Draws the pairs of docs/physics/gallery.md: runs Ensonify twice for each artefact, by the commands that the page gives.

    docs/physics/draw/gallery.py build/dev/bin/ensonify [NAME ...]

Left the artefact, right the same with its cause switched off, in the same colours.
"""
import pathlib
import shlex
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from typing import Callable

import numpy as np
from values import plt, save

PROJECT = pathlib.Path(__file__).resolve().parents[3]
for folder in ("tools/plot", "clients/python"):
    sys.path.insert(0, str(PROJECT / folder))
import ensonify  # noqa: E402
from ensonify_plot import geometry, grid, pictures, water_column, waterfall  # noqa: E402
from ensonify_plot.forward_looking import AMBER, polar_panel  # noqa: E402
from ensonify_plot.received import Span, choose_ping, pings_in  # noqa: E402
from ensonify_plot.level import Gain, gain_for, level_db  # noqa: E402
from ensonify_plot.ping import ECHOES, FINDS, fan_image  # noqa: E402
from ensonify_plot.stack import stacked  # noqa: E402
from ensonify_plot.survey import read_survey  # noqa: E402

ALL = Span()


@dataclass(frozen=True)
class Artefact:
    """One pair. `always` is set in both runs, `on` and `off` in one each. `draw` puts a record on axes and gives what the colour bar
    shows; `draw_off` where the right side is drawn in another way. Colours run between percentiles of both sides, or `limits`."""

    name: str
    launch: str
    draw: Callable
    titles: tuple
    always: tuple = ()
    on: tuple = ()
    off: tuple = ()
    draw_off: Callable | None = None
    percentiles: tuple = (3, 99.7)
    limits: tuple | None = None
    size_in: tuple = (10.0, 4.6)

    def command(self, sets: tuple) -> str:
        """As the page gives it."""
        words = ["ensonify", "run", f"docs/physics/gallery/{self.launch}.yaml", "--out", "out"]
        for one in (*self.always, *sets):
            words += ["--set", one]
        return shlex.join(words)


def the(record: ensonify.Record, message_type: type) -> str:
    """The one topic of a type."""
    topic, = record.topics_of(message_type)
    return topic


def waterfall_panel(record, axes, ground: bool):
    """Time upwards; `ground` as `ensonify plot waterfall --ground`."""
    pings, tracks = waterfall.read(record, None, ALL, ALL, False)
    pings = [received for received in pings if received.ping.ping in tracks]
    gain = gain_for("auto", pings[0].ping, waterfall.LEVELLED)
    known_m = [tracks[received.ping.ping].altitude_m for received in pings]
    altitudes_m = known_m if ground else [0.0] * len(pings)
    reach_m = max(float(geometry.ground_range_m(pings[0].end_m, altitude_m)) for altitude_m in altitudes_m)
    stack = stacked([received.t_s for received in pings], waterfall.lines_of(pings, altitudes_m, gain, reach_m / 300, 300))
    drawn = axes.imshow(level_db(stack.rows), extent=(-reach_m, reach_m, stack.begin, stack.end), origin="lower", aspect="auto",
                        cmap=waterfall.COPPER, interpolation="nearest")
    axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
    axes.set(xlabel=f"port     {'ground' if ground else 'slant'} range (m)     starboard", ylabel="time (s)")
    return drawn, gain.label()


def slant(record, axes):
    return waterfall_panel(record, axes, False)


def ground(record, axes):
    return waterfall_panel(record, axes, True)


def echogram(record, axes):
    """The echosounder's beam over time."""
    pings = list(pings_in(record, the(record, ensonify.Ping), ALL, ALL))
    gain = Gain(20.0, pings[0].ping.gain_absorption_dbpm)
    reach_m = pings[0].end_m
    stack = stacked([received.t_s for received in pings], water_column.lines_of(pings, [0] * len(pings), gain, reach_m / 500, 500))
    drawn = axes.imshow(level_db(stack.rows).T, extent=(stack.begin, stack.end, reach_m, 0.0), aspect="auto", cmap=ECHOES,
                        interpolation="nearest")
    axes.set(xlabel="time (s)", ylabel="range below the sounder (m)")
    return drawn, gain.label()


def chart(record, axes):
    """Soundings of a multibeam on the middle of its lines, gridded: depth in colours, lit from the north-west."""
    survey = read_survey(record)
    soundings = survey.soundings
    on_line = soundings.line >= 0
    middle = on_line & (np.abs(soundings.north_m) < 30)
    east_m, north_m, up_m = (values[middle] for values in (soundings.east_m, soundings.north_m, soundings.up_m))
    frame = grid.frame_around(east_m, north_m, 1.0)
    mean_m = grid.Gridder(frame, east_m, north_m).mean(up_m)
    drawn = axes.imshow(-mean_m, extent=frame.extent_m, origin="lower", cmap=pictures.DEPTH_COLOURS, interpolation="nearest")
    shade = pictures.hillshade(mean_m, frame.cell_m, 8.0) / np.sin(np.radians(pictures.SUN_ALTITUDE_DEG))
    shadow = np.zeros((*shade.shape, 4))
    shadow[..., 3] = np.where(np.isfinite(mean_m), np.clip(0.6 * (1 - shade), 0, 0.6), 0)
    axes.imshow(shadow, extent=frame.extent_m, origin="lower", interpolation="nearest")
    axes.set(xlabel="east (m)", ylabel="north (m)")
    axes.set_facecolor("#f2f2f0")
    return drawn, "depth of the soundings (m), 1 m cells; hillshade x8"


def strength(record, axes):
    """Backscattering strength of a multibeam's soundings along the middle of its line, before any processing."""
    found = [message.content for message in record.messages(the(record, ensonify.Soundings))]
    places = np.concatenate([soundings.position_enu_m[soundings.valid == 1] for soundings in found])
    strength_db = np.concatenate([soundings.backscatter_strength_db[soundings.valid == 1] for soundings in found])
    middle = np.abs(places[:, 1]) < 30
    east_m, north_m = places[middle, 0], places[middle, 1]
    frame = grid.frame_around(east_m, north_m, 1.0)
    mean_db = 10 * np.log10(grid.Gridder(frame, east_m, north_m).mean(np.power(10.0, strength_db[middle] / 10)))
    drawn = axes.imshow(mean_db, extent=frame.extent_m, origin="lower", cmap="gray", interpolation="nearest")
    axes.set(xlabel="east (m)", ylabel="north (m)")
    return drawn, "backscattering strength of the soundings (dB), 1 m cells"


def section(record, axes):
    """The fan of a multibeam's ping, as deep as the bottom."""
    received = choose_ping(record, the(record, ensonify.Ping))
    gain = gain_for("auto", received.ping, Gain(30.0))
    fan = fan_image(received, gain, 26.0)
    drawn = axes.imshow(fan.level_db, extent=fan.extent_m, aspect="equal", cmap=ECHOES, interpolation="nearest")
    axes.set(xlabel="starboard of the head (m)", ylabel="below the head (m)")
    return drawn, gain.label()


def ahead(record, axes):
    """A forward-looking image as the sea lies ahead."""
    received = choose_ping(record, the(record, ensonify.Ping))
    gain = gain_for("auto", received.ping, Gain(30.0))
    image, extent = polar_panel(received, received.power_upa2 * np.power(10.0, gain.db(received.range_m) / 10))
    drawn = axes.imshow(image, extent=extent, origin="lower", cmap=AMBER, interpolation="nearest")
    axes.set(xlabel="starboard of the head (m)", ylabel="ahead of the head (m)")
    return drawn, gain.label()


FISH = "mission.depth_m=5"  # 15 m above the bed
NO_SURFACE = "side.effects.multipath=false"  # where its echoes would distract
CAST = "water.profile=[{depth_m: 0, sound_speed_mps: 1500}, {depth_m: 6, sound_speed_mps: 1500}, {depth_m: 10, sound_speed_mps: 1475}]"
THREE_LINES = "mission={speed_mps: 4, run_in_m: 10, lawnmower: {centre_m: [0, 0], heading_deg: 0, length_m: 60, spacing_m: 55, count: 3}}"
STILL = "mission.runlines=[{from_m: [0, -6], to_m: [0, 6]}]"
SECTORS = "bow.sectors=[{frequency_hz: 290e3}, {frequency_hz: 300e3}, {frequency_hz: 310e3}]"

ARTEFACTS = (
    Artefact("nadir_gap", "sidescan", ground, ("as it is: dark below the fish", "directivity switched off"),
             always=(FISH, NO_SURFACE), off=("side.effects.directivity=false",)),
    Artefact("first_bottom", "sidescan", slant, ("slant range: the water column, then the first bottom", "ground range by the bottom track"),
             always=(FISH, NO_SURFACE, "seabed.layers.ridge={ridge: {from_m: [-80, -15], to_m: [80, -25], height_m: 5, width_m: 16}, sediment: 1, shows_above_m: 2.5}"),
             draw_off=ground, limits=(105, 160)),
    Artefact("second_echo", "echosounder", echogram, ("as it is", "multipath switched off"),
             off=("sounder.effects.multipath=false",), limits=(70, 160)),
    Artefact("surface_return", "sidescan", slant, ("as it is: a line at 5 m", "multipath switched off"),
             always=(FISH,), off=("side.effects.multipath=false",), limits=(95, 160)),
    Artefact("cross_talk", "cross_talk", slant, ("as it is: lines of a multibeam's pings", "interference switched off"),
             always=(FISH, NO_SURFACE), off=("side.effects.interference=false",), limits=(95, 160)),
    Artefact("refraction", "multibeam", chart, ("applied: 1500 m/s everywhere", "applied: the true profile"),
             always=(CAST, THREE_LINES), on=("water.applied.sound_speed_mps=1500",), size_in=(10.0, 3.0)),
    Artefact("roll_wobble", "multibeam", chart, ("attitude 0.1 s late", "attitude in time"),
             always=("vehicles.boat.roll={amplitude_deg: 6, period_s: 5}",), on=("nav.motion_latency_s=0.1",)),
    Artefact("heave_ribbing", "multibeam", chart, ("heave 0.3 s late", "heave in time"),
             always=("vehicles.boat.heave={amplitude_m: 0.5, period_s: 6}",), on=("nav.motion_latency_s=0.3",)),
    Artefact("side_lobe_arc", "forward_looking", ahead, ("uniform array, first side lobe -13 dB", "side lobes switched off (-60 dB)"),
             always=("mission.depth_m=14", "seabed.layers.boulders={boulders: {per_km2: 2500, smallest_radius_m: 1, largest_radius_m: 2, size_exponent: 1}, sediment: 2}",
                     "seabed.sediments={0: {lambert_mu_db: -40}, 2: {lambert_mu_db: -10}}"),
             off=("eye.effects.side_lobes=false",), limits=(105, 165), size_in=(10.0, 4.0)),
    Artefact("water_column_arc", "multibeam", section, ("line shaded to -30 dB: a bow at the nadir's range", "side lobes switched off (-60 dB)"),
             always=(STILL, "bow.mode=water_column"), off=("bow.effects.side_lobes=false",), limits=(85, 165)),
    Artefact("sector_edges", "multibeam", strength, ("three sectors", "one sector"),
             on=(SECTORS,), percentiles=(1, 99)),
    Artefact("layover", "sidescan", slant, ("steep ridge: its top answers before its foot", "the same height on a gentle slope"),
             always=(FISH, NO_SURFACE), limits=(105, 165),
             on=("seabed.layers.ridge={ridge: {from_m: [14, -38], to_m: [14, -18], height_m: 6, width_m: 3}, sediment: 1, shows_above_m: 3}",),
             off=("seabed.layers.ridge={ridge: {from_m: [14, -38], to_m: [14, -18], height_m: 6, width_m: 16}, sediment: 1, shows_above_m: 3}",)),
)


def run(program: str, artefact: Artefact, sets: tuple, out: str) -> ensonify.Record:
    """The record of one run by the page's command."""
    words = shlex.split(artefact.command(sets))
    words[0] = program
    words[words.index("out")] = out
    subprocess.run([*words, "--quiet"], cwd=PROJECT, check=True)
    return ensonify.Record(pathlib.Path(out) / "record.mcap")


def draw(program: str, artefact: Artefact) -> None:
    figure, axes = plt.subplots(1, 2, figsize=artefact.size_in, layout="constrained", sharey=True)
    sides = []
    how = (artefact.draw, artefact.draw_off or artefact.draw)
    for panel, sets, title, draw_panel in zip(axes, (artefact.on, artefact.off), artefact.titles, how):
        with tempfile.TemporaryDirectory(prefix="ens-") as out:
            drawn, label = draw_panel(run(program, artefact, sets, out), panel)
        sides.append(drawn)
        panel.set_title(title, fontsize=10, loc="left")
    seen = np.concatenate([np.ma.filled(drawn.get_array(), np.nan).ravel() for drawn in sides])
    for drawn in sides:
        drawn.set_clim(*(artefact.limits or np.nanpercentile(seen, artefact.percentiles)))
    axes[1].set_ylabel("")
    bar = figure.colorbar(sides[0], ax=list(axes), location="right", shrink=0.9, aspect=30, pad=0.02, extend="both")
    bar.set_label(label, fontsize=8)
    save(figure, f"gallery_{artefact.name}")


def main() -> None:
    program, *names = sys.argv[1:] or [""]
    page = (PROJECT / "docs/physics/gallery.md").read_text(encoding="utf-8")
    for artefact in ARTEFACTS:
        for sets in (artefact.on, artefact.off):
            if artefact.command(sets) not in page:
                sys.exit(f"docs/physics/gallery.md does not give the command\n{artefact.command(sets)}")
    for artefact in ARTEFACTS:
        if not names or artefact.name in names:
            draw(program, artefact)


if __name__ == "__main__":
    main()
