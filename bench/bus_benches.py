"""The clock and the bus against bare ZeroMQ, and what observers cost."""
import contextlib
import os
import pathlib
import signal
import statistics
import subprocess
import sys
import tempfile
import time

from harness import ROOT, awake_cores, interleaved, row


def bench_start(b):
    """From the last HELLO until time starts, seven processes."""
    times = [b.launch("start")["connect_s"] * 1e3 for _ in range(20)]
    median = statistics.median(times)
    first = statistics.median(first_ping_s(b) for _ in range(b.repeat))
    return [row("start: last HELLO to GO, 7 processes, median of 20", median, "ms", target="<= 50", ok=median <= 50),
            row("start: from nothing past the first ping, 3 processes, real time", first, "s", target="<= 1", ok=first <= 1)]


def first_ping_s(b):
    """Of vehicle, pager and multibeam, until all have ended again: 0.3 s of it are sim time."""
    began = time.monotonic()
    report = b.launch("first_ping")
    took_s = time.monotonic() - began
    assert report["messages"]["pings"] >= 1, report["messages"]
    late = {p["name"]: p["late_events"] for p in report["participants"] if p["late_events"]}
    assert not late, f"late: {late}"
    return took_s


def bench_round(b):
    """Grant rounds against a bare ROUTER/DEALER round of the same size."""
    def ours():
        report = b.launch("round")
        grants = sum(p["grants"] for p in report["participants"])
        assert grants >= 6 * 5900, f"too few grants: {grants}"
        return report["wall_s"] / (grants / 6) * 1e6

    grant_bytes, done_bytes = 17 + 5 * 12, 30 + 2 * 12  # five inputs; token and health
    bare = lambda: 1e6 / b.program("bench_bare_round", 6, 6000, grant_bytes, done_bytes)["rounds_per_s"]
    mine, floor, ratios = interleaved(b.repeat, ours, bare)
    ratio = statistics.median(ratios)
    return [row("grant round, 6 participants", mine, "us", floor, ratio, "<= 1.3", ratio <= 1.3)]


def bench_stream(b):
    """Latency of large messages against bare two-frame ZeroMQ."""
    rows = []
    for size, hz in ((4_000_000, 20), (8_000_000, 40)):
        count = hz * (2 if b.quick else 5)
        run = lambda mode: b.program("bench_stream", mode, size, hz, count)["p50_ms"]  # gaps: exit 5
        mine, floor, ratios = interleaved(b.repeat, lambda: run("link"), lambda: run("bare"))
        ratio = statistics.median(ratios)
        rows.append(row(f"{size // 1_000_000} MB at {hz} Hz, p50 latency, 0 gaps", mine, "ms", floor, ratio, "<= 1.15",
                        ratio <= 1.15))
    return rows


def bench_free(b):
    """How many times faster than real time a survey's traffic runs; the physical limit is that of copying the pings."""
    rows = []
    for size, least in ((4_000_000, 10), (100_000, 40)):
        def factor():
            report = b.launch("free_run", "--arg", f"bytes={size}", "--arg", f"seconds={20 if b.quick else 60}")
            return report["sim_s"] / report["wall_s"]
        median = statistics.median(factor() for _ in range(b.repeat))
        rows.append(row(f"free run with {size // 1000} kB pings at 20 Hz", median, "x real time", target=f">= {least}",
                        ok=median >= least))
    return rows


def bench_python(b):
    """A Python agent in lockstep with a world: from its answer to its next step; the floor is the round with a stub.
    A round wakes a dozen threads in turn, so that it measures the machine's sleep first of all: the target is for cores
    that are awake. Small messages go round fastest with everybody on one core, where nobody waits for another core to
    wake; large ones with a second core that copies: the target is for the better place, the other is reported beside it."""
    rows = []
    with awake_cores() as awake:
        for size, most_us, best in ((100_000, 150, "one core"), (4_000_000, 1000, "all cores")):
            seconds = 50 if b.quick else 200

            def step(name, cpu):
                report = b.launch(name, "--arg", f"bytes={size}", "--arg", f"seconds={seconds}", cpu=cpu)
                if name == "python_step_floor":
                    return report["wall_s"] / (20 * seconds) * 1e6
                agent = report["python_step"]
                assert (agent["rounds"], agent["bytes"]) == (20 * seconds + 1, size), agent
                return agent["p50_us"]

            for place, cpu in (("one core", max(os.sched_getaffinity(0))), ("all cores", None)):
                mine, floor, ratios = interleaved(b.repeat, lambda: step("python_step", cpu),
                                                  lambda: step("python_step_floor", cpu))
                asked = place == best
                name = f"Python step with {size // 1000} kB, p50, {place}{'' if awake else ' (may sleep)'}"
                rows.append(row(name, mine, "us", floor, statistics.median(ratios), f"<= {most_us}" if asked else "",
                                not asked or mine <= most_us))
    return rows


@contextlib.contextmanager
def observed(plane, topic, behaviour):
    """An observer process attached to every run that starts inside; yields the environment for those runs."""
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as runs:
        os.chmod(runs, 0o700)
        watcher = subprocess.Popen([sys.executable, str(ROOT / "bench" / "watch.py"), runs, plane, topic, behaviour],
                                   stdout=subprocess.PIPE, text=True)
        try:
            yield dict(os.environ, XDG_RUNTIME_DIR=runs), watcher
        finally:
            watcher.send_signal(signal.SIGCONT)
            watcher.kill()
            watcher.communicate()


def bench_observers(b):
    """Wall time of a free run without and with an observer of the head's 4 MB pings."""
    seconds = 40 if b.quick else 100
    options = ("--arg", "bytes=4000000", "--arg", f"seconds={seconds}")
    alone = lambda: b.launch("free_run", *options)["wall_s"]

    def watched(plane, behaviour):
        with observed(plane, "head/ping", behaviour) as (environment, watcher):
            wall_s = b.launch("free_run", *options, environment=environment)["wall_s"]
            assert watcher.stdout.readline().strip() == "attached", "the observer saw nothing of the run"
            return wall_s

    rows = []
    for name, plane, behaviour, target, good in (
            ("a stopped observer", "live", "stopped", "< 1.02", lambda r: r < 1.02),
            ("a reading observer", "live", "reading", "< 1.25", lambda r: r < 1.25),
            ("control: a slow reader on the sync plane", "sync", "slow", "> 1.25", lambda r: r > 1.25)):
        mine, floor, ratios = interleaved(b.repeat, lambda: watched(plane, behaviour), alone)
        ratio = statistics.median(ratios)
        rows.append(row(f"free run with {name}", mine, "s", floor, ratio, target, good(ratio)))
    with observed("live", "head/ping", "reading") as (environment, _):
        report = b.launch("free_run", "--arg", "bytes=4000000", "--arg", "seconds=8", "--rate", "1", environment=environment)
    rows.append(row("late events at --rate 1 with a reading observer", report["late_events"], "events", target="0",
                    ok=report["late_events"] == 0))
    return rows
