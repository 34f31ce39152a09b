"""How much processor time a vehicle that only navigates takes, and how fast it runs."""
import pathlib
import resource
import statistics
import subprocess
import tempfile
import time

from harness import ROOT, row

LEAST = 100  # times real time


def bench_navigation(b):
    """Sim time over processor time of all processes together (what the machine's other work leaves alone), and over wall time;
    starting up is taken off by a second, shorter run."""
    rows = []
    for rate_hz, way, options in ((100, "processes", ()), (100, "in one process", ("--in-process",)),
                                  (20, "processes", ())):
        longer, shorter = (60, 10) if b.quick else (240, 20)
        factors = []
        for _ in range(b.repeat):
            long_cpu_s, long_wall_s = spent(b, longer, rate_hz, options)
            short_cpu_s, short_wall_s = spent(b, shorter, rate_hz, options)
            factors.append(((longer - shorter) / (long_cpu_s - short_cpu_s), (longer - shorter) / (long_wall_s - short_wall_s)))
        by_cpu, by_wall = (statistics.median(column) for column in zip(*factors))
        name = f"navigation alone at {rate_hz} Hz, {way}"
        rows.append(row(f"{name}: sim time over processor time", by_cpu, "x"))
        rows.append(row(f"{name}: sim time over wall time", by_wall, "x real time", target=f">= {LEAST}", ok=by_wall >= LEAST))
    return rows


def spent(b, seconds, rate_hz, options):
    """Processor time of the launcher and all that it started, and wall time."""
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as out:
        command = [str(b.build / "bin" / "ensonify-run"), str(ROOT / "bench/launch/navigation.yaml"), "--quiet",
                   "--out", out, "--arg", f"seconds={seconds}", "--arg", f"rate_hz={rate_hz}", *options]
        before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        done = subprocess.run(command, capture_output=True, text=True)
        wall_s, after = time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            raise RuntimeError(f"navigation: exit {done.returncode}: {done.stderr}")
        assert (pathlib.Path(out) / "run.json").exists()
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall_s
