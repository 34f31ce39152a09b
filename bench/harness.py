"""What all benchmarks share: running programs and launches, pairing with a floor, a row of the table."""
import contextlib
import json
import os
import pathlib
import re
import statistics
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Bench:
    """What all benchmarks share: where the programs are and how often to repeat."""

    def __init__(self, build: pathlib.Path, repeat: int, quick: bool):
        self.build, self.repeat, self.quick = build, repeat, quick

    def program(self, *words) -> dict:
        """Runs a bench program that prints one line of JSON."""
        done = subprocess.run([str(self.build / "bench" / words[0]), *map(str, words[1:])], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{words}: exit {done.returncode}: {done.stderr or done.stdout}")
        return json.loads(done.stdout)

    def launch(self, name: str, *options, environment=None, cpu=None) -> dict:
        """Runs bench/launch/NAME.yaml, all its processes on one CPU if `cpu` is given; the clock's report, with the
        connect time from its log."""
        with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as out:
            place = ["taskset", "-c", str(cpu)] if cpu is not None else []
            command = [*place, str(self.build / "bin" / "ensonify-run"), str(ROOT / "bench" / "launch" / f"{name}.yaml"),
                       "--out", out, *map(str, options)]
            environment = dict(environment or os.environ)
            # A launch file's `python3` is the Python that runs this: it has what the client needs.
            environment["PATH"] = f"{pathlib.Path(sys.executable).parent}:{environment['PATH']}"
            done = subprocess.run(command, capture_output=True, text=True, env=environment)
            if done.returncode != 0:
                raise RuntimeError(f"{name}: exit {done.returncode}: {done.stderr}")
            report = json.loads((pathlib.Path(out) / "clock.json").read_text())
            log = (pathlib.Path(out) / "log" / "clock.log").read_text()
            report["connect_s"] = float(re.search(r"connect_s=([0-9.]+)", log).group(1))
            run = json.loads((pathlib.Path(out) / "run.json").read_text())
            report["processes"], report["profile"], judged = run["processes"], run.get("profile"), run["expect"]
            report["messages"] = {e["name"]: int(e["message"].split()[0]) for e in judged if e["message"].endswith(" messages")}
            for notes in pathlib.Path(out).glob("python_step.json"):
                report["python_step"] = json.loads(notes.read_text())
            return report


@contextlib.contextmanager
def awake_cores():
    """Keeps idle cores from sleeping while inside, as latency tests do (Linux PM QoS); yields whether that is allowed."""
    try:
        device = os.open("/dev/cpu_dma_latency", os.O_WRONLY)
    except OSError:
        yield False
        return
    try:
        os.write(device, struct.pack("i", 0))  # in force until it is closed
        yield True
    finally:
        os.close(device)


def interleaved(repeat, ours, floor):
    """ours(), floor(), ours(), ... and the median of each."""
    pairs = [(ours(), floor()) for _ in range(repeat)]
    return statistics.median(a for a, _ in pairs), statistics.median(b for _, b in pairs), [a / b for a, b in pairs]


def row(name, value, unit, floor=None, ratio=None, target="", ok=True):
    return {"name": name, "value": value, "unit": unit, "floor": floor, "ratio": ratio, "target": target, "ok": ok}
