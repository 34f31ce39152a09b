"""Starting `ensonify run` as a child that waits for us to take part, and ending it in order."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import time
from typing import Any, Mapping

from ensonify.session import EXIT_BAD_INPUT, EXIT_DIED, RunError

START_S = 60.0  # wall time until the clock has an endpoint
SILENCE_S = 2.0  # wall time in which the launcher then names it, if anybody is awaited
END_S = 20.0  # wall time until everything is gone, once it has been asked to end
LOG = "launcher.log"
WHERE = re.compile(r"ensonify run: (?:tools reach this run|external processes take part)")
CLOCK = re.compile(r"external processes take part at (\S+)\s")

# The launcher, and beside it a shell that waits at our end of a pipe: should we be killed, it ends the run as Ctrl-C does.
GUARDED = 'exec 3<&0; (read line <&3 || kill -INT $$ 2>/dev/null) & exec "$@" 3<&- </dev/null'


def program() -> str:
    """`ensonify`: in the folder that ENSONIFY_BIN names, else on PATH. A RunError where there is none."""
    folder = os.environ.get("ENSONIFY_BIN")
    found = shutil.which("ensonify", path=folder or os.environ.get("PATH", os.defpath))
    if found is None:
        where = f"in {folder} (ENSONIFY_BIN)" if folder else "on PATH; ENSONIFY_BIN can name the folder of Ensonify's programs"
        raise RunError(f"the program `ensonify` is not {where}", EXIT_BAD_INPUT)
    return found


def assignments(settings: Mapping[str, Any]) -> list:
    """Parameters and their values as --set takes them."""
    return [f"{key}={value if isinstance(value, str) else json.dumps(value, default=plain)}" for key, value in settings.items()]


def plain(value: Any) -> Any:
    """A numpy number or array as JSON has it."""
    return value.tolist()


class Launch:
    """A launch file that runs as fast as it can, with its results in `out`. `clock` is where to take part.
    hosted: our own processes run in the clock's program where they can"""

    def __init__(self, file: str | os.PathLike, out: pathlib.Path, settings: Mapping[str, Any], *, hosted: bool = False):
        self._out = out
        out.mkdir(parents=True, exist_ok=True)
        words = [program(), "run", os.fspath(file), "--free", "--out", os.fspath(out)]
        words += ["--hosted"] if hosted else []
        for assignment in assignments(settings):
            words += ["--set", assignment]
        with open(out / LOG, "wb") as log:
            self._child = subprocess.Popen(["/bin/sh", "-c", GUARDED, "ensonify", *words], stdin=subprocess.PIPE,
                                           stdout=subprocess.DEVNULL, stderr=log)
        try:
            self.clock = self._await_clock(os.fspath(file))
        except BaseException:
            self.end()
            raise

    def _await_clock(self, file: str) -> str:
        until = time.monotonic() + START_S
        while time.monotonic() < until:
            ended = self._child.poll() is not None
            said = self._said()
            if found := CLOCK.search(said):
                return found[1]
            if ended:
                raise RunError(self._complaints() or f"{file} ended with exit code {self._child.returncode}", self._child.returncode)
            if WHERE.search(said):  # then the endpoint comes at once, if at all
                until = min(until, time.monotonic() + SILENCE_S)
            time.sleep(0.002)
        if WHERE.search(self._said()):
            raise RunError(f"{file}: awaits nobody: it needs a process with `external: true`", EXIT_BAD_INPUT)
        raise RunError(f"{file} did not start within {START_S:g} s", EXIT_DIED)

    def _said(self) -> str:
        return (self._out / LOG).read_text(errors="replace")

    def _complaints(self) -> str:
        """What it has said, without how it is reached."""
        return "\n".join(line for line in self._said().splitlines() if line and not WHERE.match(line))

    def interrupt(self) -> None:
        """Asks it to end in order; whoever takes part is to answer the end, then wait()."""
        if self._child.poll() is None:
            self._child.send_signal(subprocess.signal.SIGINT)

    def wait(self) -> int:
        """Waits for its end, and forces it if it does not come. The exit code."""
        try:
            code = self._child.wait(END_S)
        except subprocess.TimeoutExpired:
            self._child.terminate()
            code = self._child.wait(END_S)
        self._dismiss_guard()
        return code

    def end(self) -> int:
        """Ends it, whatever it does. The exit code."""
        self.interrupt()
        return self.wait()

    def fault(self) -> RunError:
        """Why it ended, or is about to: the process, its exit code or signal, and what was said."""
        code = self.wait()
        try:
            result = json.loads((self._out / "run.json").read_text())
        except (OSError, ValueError):
            return RunError(self._complaints() or f"the run ended with exit code {code}", code)
        culprit = result.get("culprit", "")
        if code == EXIT_BAD_INPUT:
            return RunError(self._complaints(), code, culprit)
        own = next((process for process in result.get("processes", ()) if process["name"] == culprit), {})
        how = f" with exit code {own['exit_code']}" if own.get("exit_code") is not None else ""
        said = result.get("message") or "it came to its end"
        who = f"process {culprit}{how}: " if culprit else ""
        return RunError(f"the run ended at t = {result.get('sim_s', 0):.3f} s with exit code {code}: {who}{said}", code, culprit)

    def _dismiss_guard(self) -> None:
        if self._child.stdin.closed:
            return
        try:
            self._child.stdin.write(b"\n")
            self._child.stdin.close()
        except OSError:  # the guard is gone already
            pass
