"""What the logger costs beside a survey: 512 beams at 10 Hz and a sidescan in all formats, without and with the water column."""
import json
import pathlib
import subprocess
import tempfile

from harness import ROOT, row

FORMATS, COLUMN = "[all, kmall, xtf]", "[all, kmall, wcd, kmwcd, xtf]"
# 2,000 samples a beam in 20 m of water.
WATER_COLUMN = ["--set", "bow.mode=water_column", "--set", "bow.amplitude_every=1", "--set", "bow.phase_every=0",
                "--set", "bow.auto_range=false", "--set", "bow.range_m=75", "--set", "bow.sample_rate_hz=20000"]
WRITER = "import os, sys\nblock = bytes(1 << 20)\nwith open(sys.argv[1], 'wb') as file:\n    for _ in range(int(sys.argv[2])): file.write(block)\nprint(sum(os.times()[:2]))"


def bench_logger(b):
    """Processor time of the logger over sim time, in a free run; beside it, that of writing as many bytes and nothing else."""
    seconds = 8 if b.quick else 30
    return [measured(b, "logger, 512 beams at 10 Hz and a sidescan: .all, .kmall, XTF", FORMATS, [], seconds, 0.10),
            measured(b, "the same with the water column, 2,000 samples a beam", COLUMN, WATER_COLUMN, seconds, 0.35)]


def measured(b, what, formats, options, seconds, most):
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-", dir="/dev/shm") as folder:
        out = pathlib.Path(folder) / "out"
        words = ["run", ROOT / "launch" / "acquisition.yaml", "--free", "--quiet", "--arg", f"seconds={seconds}", "--out", out,
                 "--set", f"log.formats={formats}", *options]
        done = subprocess.run([b.build / "bin" / "ensonify", *words], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"acquisition: exit {done.returncode}: {done.stderr}")
        files = sorted(file for file in out.iterdir() if file.suffix in (".all", ".kmall", ".xtf", ".wcd", ".kmwcd"))
        said = json.loads(subprocess.run([b.build / "bin" / "ensonify", "info", "--json", *files], capture_output=True, text=True, check=True).stdout)
        for one in said:
            assert one["faults"]["count"] == 0, one["faults"]
        assert len(said) == formats.count(",") + 1, [file.name for file in files]
        report = json.loads((out / "run.json").read_text())
        cost_s = next(process["cpu_s"] for process in report["processes"] if process["name"] == "log")
        megabytes = sum(file.stat().st_size for file in files) >> 20
        floor = subprocess.run(["python3", "-c", WRITER, pathlib.Path(folder) / "floor", str(megabytes)], capture_output=True, text=True, check=True)
        share, floor_share = cost_s / report["sim_s"], float(floor.stdout) / report["sim_s"]
        return row(f"{what}, {megabytes / report['sim_s']:.1f} MB/s", share, "of a core", floor_share, share / floor_share, f"<= {most}", share <= most)
