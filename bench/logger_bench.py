"""What the logger costs beside a survey: 512 beams at 10 Hz and a sidescan in all formats and streams, without and with the water column."""
import contextlib
import json
import pathlib
import re
import socket
import subprocess
import tempfile
import threading

from harness import ROOT, row

FORMATS, COLUMN = "[all, kmall, xtf]", "[all, kmall, wcd, kmwcd, xtf]"
STREAMS, COLUMN_STREAMS = (("all",), ("kmall",)), (("all", "wcd"), ("kmall", "kmwcd"))
# 2,000 samples a beam in 20 m of water.
WATER_COLUMN = ["--set", "bow.mode=water_column", "--set", "bow.amplitude_every=1", "--set", "bow.phase_every=0",
                "--set", "bow.auto_range=false", "--set", "bow.range_m=75", "--set", "bow.sample_rate_hz=20000"]
WRITER = "import os, sys\nblock = bytes(1 << 20)\nwith open(sys.argv[1], 'wb') as file:\n    for _ in range(int(sys.argv[2])): file.write(block)\nprint(sum(os.times()[:2]))"


class Reader:
    """Reads a UDP port of this machine and throws away what comes."""

    def __enter__(self):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(0.1)
        self.port, self.over = self.socket.getsockname()[1], False
        self.thread = threading.Thread(target=self.read)
        self.thread.start()
        return self

    def read(self):
        buffer = bytearray(65536)
        while not self.over:
            with contextlib.suppress(TimeoutError):
                self.socket.recv_into(buffer)

    def __exit__(self, *_):
        self.over = True
        self.thread.join()
        self.socket.close()


def bench_logger(b):
    """Processor time of the logger over sim time, in a free run; beside it, that of writing as many bytes and nothing else."""
    seconds = 8 if b.quick else 30
    return [measured(b, "logger, 512 beams at 10 Hz and a sidescan: .all, .kmall, XTF; two streams", FORMATS, STREAMS, [], seconds, 0.10),
            measured(b, "the same with the water column, 2,000 samples a beam", COLUMN, COLUMN_STREAMS, WATER_COLUMN, seconds, 0.35)]


def measured(b, what, formats, streams, options, seconds, most):
    with contextlib.ExitStack() as stack, tempfile.TemporaryDirectory(prefix="ensonify-bench-", dir="/dev/shm") as folder:
        out = pathlib.Path(folder) / "out"
        ports = [stack.enter_context(Reader()).port for _ in streams]
        send = ", ".join(f"{{to: '{port}', formats: [{', '.join(sent)}], rate_mb_s: 100}}" for port, sent in zip(ports, streams))
        words = ["run", ROOT / "launch" / "acquisition.yaml", "--free", "--quiet", "--arg", f"seconds={seconds}", "--out", out,
                 "--set", f"log.formats={formats}", "--set", f"log.send=[{send}]", *options]
        done = subprocess.run([b.build / "bin" / "ensonify", *words], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"acquisition: exit {done.returncode}: {done.stderr}")
        files = sorted(file for file in out.iterdir() if file.suffix in (".all", ".kmall", ".xtf", ".wcd", ".kmwcd"))
        said = json.loads(subprocess.run([b.build / "bin" / "ensonify", "info", "--json", *files], capture_output=True, text=True, check=True).stdout)
        for one in said:
            assert one["faults"]["count"] == 0, one["faults"]
        assert len(said) == formats.count(",") + 1, [file.name for file in files]
        lost = [int(count) for count in re.findall(r" streamed .* lost=(\d+) ", (out / "log" / "log.log").read_text())]
        assert lost == [0] * len(streams), f"streams lost {lost} datagrams"
        report = json.loads((out / "run.json").read_text())
        cost_s = next(process["cpu_s"] for process in report["processes"] if process["name"] == "log")
        megabytes = sum(file.stat().st_size for file in files) >> 20
        floor = subprocess.run(["python3", "-c", WRITER, pathlib.Path(folder) / "floor", str(megabytes)], capture_output=True, text=True, check=True)
        share, floor_share = cost_s / report["sim_s"], float(floor.stdout) / report["sim_s"]
        return row(f"{what}, {megabytes / report['sim_s']:.1f} MB/s", share, "of a core", floor_share, share / floor_share, f"<= {most}", share <= most)
