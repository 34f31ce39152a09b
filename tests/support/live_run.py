"""A run of stubs for the tools to examine, in a run directory of its own. Nothing here sleeps: the tools are asked until
the run is there, and a run that never comes is ended by the test's time limit."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

BIN = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "bin"

# A pilot steers a vehicle over a delayed edge, a head pings, a viewer takes the pings.
LAUNCH = """\
ensonify: launch/1
processes:
  auv:
    run: stub
    config:
      rate_hz: 100
      out: [{port: pose, type: pose_blob/1, hz: 100}]
      in: [{port: command, type: command_blob/1, delay_ms: 100}]
  pilot:
    run: stub
    config:
      rate_hz: 10
      finish_s: FINISH
      out: [{port: command, type: command_blob/1, hz: 10}]
      in: [{port: pose, type: pose_blob/1}]
  bow:
    run: stub
    config:
      rate_hz: 20
      out: [{port: ping, type: ping_blob/1, hz: 20, bytes: 50000}]
      in: [{port: pose, type: pose_blob/1}]
  viewer:
    run: stub
    config: {rate_hz: 10, in: [{port: ping, type: ping_blob/1}]}
clock: {TRANSPORT}
"""


def tool(*words, env=None, run_folder=None):
    """Runs a tool to its end: (exit code, standard output, standard error)."""
    environment = {**os.environ, **(env or {})}
    if run_folder is not None:
        environment["XDG_RUNTIME_DIR"] = str(run_folder)
    if env is None or "ENSONIFY_RUN" not in env:
        environment.pop("ENSONIFY_RUN", None)
    done = subprocess.run([BIN / f"ensonify-{words[0]}", *words[1:]], env=environment, text=True, capture_output=True,
                          timeout=60)
    return done.returncode, done.stdout, done.stderr


class LiveRun:
    """`ensonify run` of the stubs, paced; use it as a context manager. Leaving asks the run to stop, unless it has ended."""

    def __init__(self, finish_s=1000.0, rate=1.0, tcp=False, name=None, beside=None):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="ens-"))
        self.runtime = beside.runtime if beside else self.folder  # runs of one runtime folder are seen together
        self.launch = self.folder / "stubs.yaml"
        text = LAUNCH.replace("FINISH", str(finish_s)).replace("TRANSPORT", "transport: tcp" if tcp else "transport: ipc")
        self.launch.write_text(text)
        environment = {**os.environ, "XDG_RUNTIME_DIR": str(self.runtime)}
        self.process = subprocess.Popen(
            [BIN / "ensonify-run", self.launch, "--rate", str(rate), "--quiet", "--out", self.folder / "out",
             *(["--name", name] if name else [])],
            env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def __enter__(self):
        while self.process.poll() is None:
            directory = self.directory()
            if directory is None or not (directory / "clock.endpoint").exists():
                continue
            code, out, _ = self.tool("clock", "status", "--json", "--run", str(directory))
            if code == 0 and json.loads(out)["state"] == "running":
                return self
        error = self.process.stderr.read()
        self._clear()
        raise AssertionError(f"the run of stubs did not start: {error}")

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.tool("clock", "stop", "--run", str(self.directory()))
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.terminate()
            self.process.wait(20)
        self._clear()

    def _clear(self):
        self.process.stderr.close()
        shutil.rmtree(self.folder)

    def tool(self, *words, env=None):
        """A tool that sees this run only."""
        return tool(*words, env=env, run_folder=self.runtime)

    def json(self, *words):
        """What a tool prints with --json; it must succeed."""
        code, out, error = self.tool(*words, "--json")
        assert code == 0, f"{words}: exit code {code}: {error}"
        return json.loads(out)

    def directory(self):
        """The run directory; None while there is none."""
        for about in (self.runtime / "ensonify").glob("run-*/about.json"):
            try:
                if str(self.launch) in about.read_text():
                    return about.parent
            except FileNotFoundError:  # another run has just ended
                continue
        return None
