"""The table of speed (docs/performance.md): pings per second of wall time in a free run, and what a ping costs.

Each row is a configuration that others publish or that a launch file ships, windy (5 m/s, no path by the surface) and calm (with echoes
by way of the surface). Pings are counted, and the rays of a ping asserted, before a speed is stated.
"""
import os
import time
from dataclasses import dataclass, field

from harness import ROOT, row


@dataclass
class Case:
    name: str
    kind: str
    launch: str  # of bench/launch
    head: str  # process of it
    seconds: float  # of sim time
    least_rays: int = 0  # of a ping
    scenario: str = ""
    set: dict = field(default_factory=dict)
    goal: tuple = (None, None)  # pings per second, windy and calm


CASES = [
    Case("multibeam, 256 beams, 2.56 million rays, 50 m, posts 0.1 m", "multibeam", "table", "bow", 2.0, 2_560_000,
         "bench/launch/table_sand.yaml",
         {"beams": 256, "auto_range": "false", "range_m": 150, "swath_deg": 130, "ping_rate_hz": 5, "quality": 4, "most_rays": 3_200_000, "amplitude_every": 1000}, (8, 6.5)),
    Case("multibeam, quality 1, 25 m, posts 0.25 m", "multibeam", "table", "bow", 10.0, 80_000, "scenarios/bay/scenario.yaml",
         {"auto_range": "false", "range_m": 75, "ping_rate_hz": 10, "quality": 1, "amplitude_every": 1000}, (110, None)),
    Case("multibeam, quality 0.25, 25 m, posts 0.25 m", "multibeam", "table", "bow", 20.0, 20_000, "scenarios/bay/scenario.yaml",
         {"auto_range": "false", "range_m": 75, "ping_rate_hz": 10, "quality": 0.25, "amplitude_every": 1000}, (150, None)),
    Case("sidescan, 2 x 2,000 samples, 100 rays a sample, 100 m", "sidescan", "table", "bow", 5.0, 400_000, "scenarios/bay/scenario.yaml",
         {"channels": "[{name: main, frequency_hz: 400000, range_m: 100}]", "ping_rate_hz": 7, "quality": 4.3}, (40, 30)),
    Case("sidescan, quality 0.25, 100 m", "sidescan", "table", "bow", 20.0, 10_000, "scenarios/bay/scenario.yaml",
         {"channels": "[{name: main, frequency_hz: 400000, range_m: 100}]", "ping_rate_hz": 7, "quality": 0.25}, (100, None)),
    Case("forward-looking, 512 beams, 58,000 rays, 60 m, 1,000 samples", "forward_looking", "table_eye", "eye", 5.0, 50_000, "",
         {"range_m": 60, "most_samples": 1000, "ping_rate_hz": 10, "quality": 0.25, "most_rays": 58368}, (60, 50)),
    Case("forward-looking, 512 beams, quality 0.25, 30 m, 1,000 samples", "forward_looking", "table_eye", "eye", 5.0, 100_000, "",
         {"range_m": 30, "most_samples": 1000, "ping_rate_hz": 10, "quality": 0.25}, (24, 16)),
    Case("forward-looking, 512 beams, quality 0.25, 60 m, 1,000 samples", "forward_looking", "table_eye", "eye", 3.0, 100_000, "",
         {"range_m": 60, "most_samples": 1000, "ping_rate_hz": 10, "quality": 0.25}, (10, 7)),
    Case("forward-looking, 128 beams, 256 samples, 20 m, 20,000 rays", "forward_looking", "table_eye", "eye", 10.0, 20_000, "",
         {"beams": 128, "beamwidth_deg": 1.2, "aperture_deg": 130, "range_m": 20, "most_samples": 256, "ping_rate_hz": 30, "quality": 0.25, "most_rays": 21000}, (250, None)),
    Case("scanning, 40 m", "scanning", "table", "bow", 20.0, 10_000, "scenarios/bay/scenario.yaml",
         {"range_m": 40, "tilt_deg": 25, "ping_rate_hz": 100}, (500, None)),
    Case("echosounder, 25 m of water, 100 m", "echosounder", "table", "bow", 20.0, 10_000, "scenarios/bay/scenario.yaml",
         {"ping_rate_hz": 100}, (250, None)),
]


def measured(b, case, wind_mps):
    """Pings a second of wall time, processor time of the head a ping (ms), rays a ping, and processor time a ray (ns)."""
    options = ["--free", "--set", f"water.wind_speed_mps={wind_mps}"]
    options += ["--arg", f"seconds={case.seconds}"]
    if case.scenario:
        options += ["--arg", f"kind={case.kind}", "--arg", f"scenario={ROOT / case.scenario}"]
    for key, value in case.set.items():
        options += ["--set", f"{case.head}.{key}={value}"]
    wall_s = b.launch(case.launch, *options)["wall_s"]
    report = b.launch(case.launch, *options, "--profile")
    profile = report["profile"][case.head]
    pings = report["messages"]["pings"]
    rays = profile["stages"]["trace"]["items"] / pings
    assert rays >= case.least_rays, f"{case.name}: {rays:.0f} rays a ping; the row asks for {case.least_rays}"
    processor_s = profile["processor_s"] / pings
    return pings / wall_s, 1e3 * processor_s, rays, 1e9 * processor_s / rays


def whole_launch(b):
    """A survey with three heads, graded navigation and a recorder, in real time."""
    seconds = 30 if b.quick else 600
    report = b.launch("table_whole", "--arg", f"seconds={seconds}")
    share = 100 * sum(process.get("cpu_s", 0.0) for process in report["processes"]) / report["wall_s"] / os.cpu_count()
    late = report["late_events"]
    pings = ", ".join(f"{count} {name}" for name, count in report["messages"].items())
    return row(f"whole launch in real time, {seconds} s: {pings}; {late} events late", share, "% of the cores", target="at most 60, none late",
               ok=share <= 60 and late == 0) | {"whole": {"seconds": seconds, "late": late, "pings": pings}}


def demo(b, quality, goal, pictures):
    """The demo's survey, once or with what it draws afterwards, in sim seconds a wall second."""
    began = time.monotonic()
    report = b.launch("../../launch/demo", "--free", "--set", f"bow.quality={quality}")
    times = report["sim_s"] / (time.monotonic() - began if pictures else report["wall_s"])
    text = f"the demo at quality {quality}{', with its pictures' if pictures else ''}"
    return row(text, times, "x real time", target=f"goal {goal}", ok=times >= goal) | {"demo": text, "goal": goal}


def bench_whole(b):
    demos = [] if b.quick else [demo(b, 0.25, 12, False), demo(b, 1, 8, False), demo(b, 1, 6, True)]
    return [*demos, whole_launch(b)]


def bench_table(b):
    rows = []
    for case in CASES:
        for wind_mps, name, goal in ((5, "windy", case.goal[0]), (0, "calm", case.goal[1])):
            once = sorted(measured(b, case, wind_mps) for _ in range(max(1, b.repeat // 2)))
            pings, processor_ms, rays, ray_ns = once[len(once) // 2]
            text = f"{case.name}, {name} ({rays:,.0f} rays; {processor_ms:.1f} ms of a core, {ray_ns:.0f} ns a ray)"
            rows.append(row(text, pings, "pings/s", target=f"goal {goal}" if goal else "", ok=not goal or pings >= goal) | {
                "case": case.name, "sea": name, "rays": rays, "processor_ms": processor_ms, "goal": goal})
    return rows
