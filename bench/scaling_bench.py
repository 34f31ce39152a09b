"""What a ping of the multibeam costs against rays, beams, posts of the seabed, depth, heads in one launch, and cores.

A cost is the difference between a long run and a short one, so that starts do not count. Pings are counted, and the rays of a ping are
held against the range that its point states.
"""
import os
import pathlib
import tempfile
from dataclasses import dataclass, field

from harness import ROOT, row

SHORT_S, LONG_S = 1, 17
PINGS_HZ = 2
LAUNCH = """
ensonify: launch/1
scenario: {scenario}
clock: {{ rate: free }}
duration_s: {seconds}
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager, config: {{ cache_mb: 0 }} }}
{heads}
expect:
  - {{ name: pings, no_gap: {{ topic: head1/transmit }} }}
"""
HEAD = "  head{number}: {{ run: multibeam, config: {{ ping_rate_hz: {pings_hz}, auto_range: false, amplitude_every: 1000 }} }}"


@dataclass
class Point:
    against: str
    x: float
    set: dict = field(default_factory=dict)  # of each head
    scenario: dict = field(default_factory=dict)
    heads: int = 1
    cores: int = 0  # 0: all
    depth_m: float = 20.0

    def options(self):
        settings = {"beams": 256, "quality": 0.5, "range_m": 3 * self.depth_m} | self.set
        options = [f"seabed.layers.bed.plane.depth_m={self.depth_m}", *(f"{key}={value}" for key, value in self.scenario.items())]
        options += [f"head{n}.{key}={value}" for n in range(1, self.heads + 1) for key, value in settings.items()]
        return [word for option in options for word in ("--set", option)]


# Rays of a ping within each panel, least and most. Neither beams nor posts nor other heads ask for more.
ONE = (220_000, 240_000)
RAYS = {"quality": (110_000, 1_900_000), "beams": ONE, "posts": ONE, "depth, m": (55_000, 2_100_000), "heads": ONE}


def series(cores):
    """The points of each panel, rising."""
    def panel(against, values, **of):
        return [Point(against, x, **{key: make(x) for key, make in of.items()}) for x in values]

    def side(posts):
        return f"[{0.1 * posts**0.5:.0f}, {0.1 * posts**0.5:.0f}]"

    return [panel("quality", (0.25, 0.5, 1, 2, 4), set=lambda x: {"quality": x}),
            panel("beams", (64, 128, 256, 512), set=lambda x: {"beams": x}),
            panel("posts", (1e6, 1e7, 1e8, 1e9, 1e10), scenario=lambda x: {"seabed.size_m": side(x)}),
            panel("depth, m", (10, 20, 40, 60), depth_m=lambda x: x),
            panel("heads", (1, 2, 3, 4), heads=lambda x: x),
            panel("cores", [2**n for n in range(8) if 2**n <= cores], set=lambda x: {"quality": 4}, cores=lambda x: x)]


def run(b, point, seconds, *options):
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as folder:
        heads = "\n".join(HEAD.format(number=n, pings_hz=PINGS_HZ) for n in range(1, point.heads + 1))
        launch = pathlib.Path(folder) / "launch.yaml"
        launch.write_text(LAUNCH.format(scenario=ROOT / "bench/launch/scaling_scenario.yaml", seconds=seconds, heads=heads))
        return b.launch(str(launch.with_suffix("")), *point.options(), *options, cpu=f"0-{point.cores - 1}" if point.cores else None)


def totals(point, report):
    """Of a run: pings of a head and wall time; by its profile rays, and processor time of heads, over posts with the pager's."""
    heads = [f"head{n}" for n in range(1, point.heads + 1)]
    found = {"pings": report["messages"]["pings"], "wall_s": report["wall_s"]}
    if point.cores:
        return found
    profile, pager = report["profile"], ["pager"] if point.against == "posts" else []
    return found | {"processor_s": sum(profile[name]["processor_s"] for name in heads + pager),
                    "rays": sum(profile[name]["stages"]["trace"]["items"] for name in heads)}


def measured(b, point):
    """Of a ping of each head: wall time (ms), or where cores are not counted processor time (ms) and rays."""
    options = [] if point.cores else ["--profile"]
    short, long = (totals(point, run(b, point, seconds, *options)) for seconds in (SHORT_S, LONG_S))
    pings = long["pings"] - short["pings"]
    assert pings == PINGS_HZ * (LONG_S - SHORT_S), f"{point.against} {point.x:g}: {pings} pings"
    each = {key: (long[key] - short[key]) / pings / point.heads for key in long}
    if point.cores:
        return each
    least, most = RAYS[point.against]
    assert least <= each["rays"] <= most, f"{point.against} {point.x:g}: {each['rays']:.0f} rays a ping; stated are {least} to {most}"
    return each


def bench_scaling(b):
    rows = []
    chosen = [panel[::len(panel) - 1] if b.quick and len(panel) > 1 else panel for panel in series(os.cpu_count())]
    for point in (point for panel in chosen for point in panel):
        each = measured(b, point)
        cost = each["wall_s"] if point.cores else each["processor_s"]
        detail = "wall time" if point.cores else f"{each['rays']:,.0f} rays, {1e9 * cost / each['rays']:.0f} ns each"
        rows.append(row(f"a ping at {point.against} {point.x:g} ({detail})", 1e3 * cost, "ms") | {
            "scaling": {"against": point.against, "x": point.x, "ping_ms": 1e3 * cost, "rays": each.get("rays")}})
    return rows
