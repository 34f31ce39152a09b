"""What the system tests share: running launches of stub processes, and examining what is left behind."""
import json
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

BUILD = pathlib.Path(os.environ.get("ENSONIFY_BUILD", "build/dev")).resolve()
SOURCE = pathlib.Path(os.environ.get("ENSONIFY_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
SHARED = pathlib.Path(os.environ.get("ENSONIFY_SHARED", SOURCE.parent / "shared"))
BIN = BUILD / "bin"

# A survey's traffic in small: a loop of vehicle, navigation and pilot, a head, a consumer.
SURVEY = """
ensonify: launch/1
clock: {{ rate: free, progress_deadline_s: 0.2 }}
processes:
  vehicle: {{ run: stub, config: {{ rate_hz: 100, out: [{{port: pose, type: pose_stub/1, hz: 100}}], in: [{{port: command, type: command_stub/1, delay_ms: 100}}] {vehicle} }} }}
  navigation: {{ run: stub, config: {{ rate_hz: 100, out: [{{port: estimate, type: estimate_stub/1, hz: 100}}], in: [{{port: pose, type: pose_stub/1}}] {navigation} }} }}
  pilot: {{ run: stub, config: {{ rate_hz: 10, finish_s: {seconds}, out: [{{port: command, type: command_stub/1, hz: 10}}], in: [{{port: estimate, type: estimate_stub/1}}] {pilot} }} }}
  head: {{ run: stub, config: {{ rate_hz: 20, out: [{{port: ping, type: ping_stub/1, hz: 20, bytes: {bytes}}}], in: [{{port: pose, type: pose_stub/1}}] {head} }} }}
  consumer: {{ run: stub, config: {{ rate_hz: 20, in: [{{port: ping, type: ping_stub/1}}] {consumer} }} }}
{more}
"""
FAULTY = ("vehicle", "navigation", "pilot", "head", "consumer")


def survey(seconds=5, size=1000, more="", **extra):
    """SURVEY as text; extra["head"] = "throw_s: 1" adds to that process's config."""
    filled = {name: ", " + extra[name] if name in extra else "" for name in FAULTY}
    return SURVEY.format(seconds=seconds, bytes=size, more=more, **filled)


# The demo's processes on its world, for a few seconds.
BAY = """
ensonify: launch/1
scenario: {source}/scenarios/bay/scenario.yaml
duration_s: {seconds}
clock: {{ rate: free }}
set: {{ bow.quality: 0.25 }}
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
  bow:   {{ run: multibeam }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: {topics} }} }}
"""


def bay(seconds, topics="all"):
    """BAY as text; its record is run.mcap in the output folder."""
    return BAY.format(source=SOURCE, seconds=seconds, topics=topics)


class Result:
    def __init__(self, code, stdout, stderr, out, wall_s=0.0):
        self.code, self.stdout, self.stderr, self.out, self.wall_s = code, stdout, stderr, out, wall_s

    def report(self):
        return json.loads((self.out / "run.json").read_text())

    def clock(self):
        return json.loads((self.out / "clock.json").read_text())

    def late_events(self):
        return {p["name"]: p["late_events"] for p in self.clock()["participants"]}

    def log(self, process):
        return (self.out / "log" / f"{process}.log").read_text()


class SystemTest(unittest.TestCase):
    """Each test has a folder of its own and must leave no process and no run directory behind."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="ensonify-test-")
        self.folder = pathlib.Path(self._folder.name)
        self.runs = self.folder / "runs"
        self.runs.mkdir(mode=0o700)
        self.environment = dict(os.environ, XDG_RUNTIME_DIR=str(self.runs))
        self.addCleanup(self._folder.cleanup)
        self.addCleanup(self.expect_nothing_left)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def kept(self, name, make):
        """A copy of the file that `make` returns the path of; made once for all tests of the class."""
        files = type(self).__dict__.get("kept_files")
        if files is None:
            files = type(self).kept_files = {}
        if name not in files:
            files[name] = make().read_bytes()
        path = self.folder / name
        path.write_bytes(files[name])
        return path

    def command(self, launch, *options, out="out"):
        return [str(BIN / "ensonify"), "run", str(launch), "--out", str(self.folder / out), *map(str, options)]

    def run_launch(self, launch, *options, out="out", timeout=60, prefix=()):
        """Runs a launch file (a path, or its text) to its end; `prefix` are words before the command."""
        if isinstance(launch, str) and "\n" in launch:
            launch = self.write(f"{out}.yaml", launch)
        began = time.monotonic()
        done = subprocess.run([*prefix, *self.command(launch, *options, out=out)], capture_output=True, text=True,
                              timeout=timeout, env=self.environment)
        return Result(done.returncode, done.stdout, done.stderr, self.folder / out, time.monotonic() - began)

    def start_launch(self, launch, *options, out="out"):
        if isinstance(launch, str) and "\n" in launch:
            launch = self.write(f"{out}.yaml", launch)
        return subprocess.Popen(self.command(launch, *options, out=out), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True, env=self.environment)

    def tool(self, *words, timeout=60):
        return subprocess.run([str(BIN / "ensonify"), *map(str, words)], capture_output=True, text=True, timeout=timeout,
                              env=self.environment)

    def wait_for_go(self, out="out"):
        """Until time runs; the test's time limit bounds it."""
        log = self.folder / out / "log" / "clock.log"
        while " go " not in (log.read_text() if log.exists() else ""):
            os.sched_yield()

    def wait_for_process(self, name):
        """The pid of a process of this test, by its program."""
        while True:
            for pid, line in self.processes():
                if pathlib.Path(line.split()[0]).name == name:
                    return pid

    def processes(self):
        """Command lines of living processes that name this test's folder."""
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and int(entry.name) != os.getpid():
                    line = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
                    if str(self.folder) in line:
                        found.append((int(entry.name), line))
            except OSError:
                continue  # it has just ended
        return found

    def expect_nothing_left(self):
        self.assertEqual(self.processes(), [])
        self.assertEqual([p for p in (self.runs / "ensonify").glob("*") if p.is_dir()], [])
