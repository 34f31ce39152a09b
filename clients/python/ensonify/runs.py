"""Finding the clock of a run: by name, by run directory, by $ENSONIFY_RUN, or the only live one of this user."""
import json
import os
import pathlib
import socket
import stat
import time
from typing import NamedTuple

from ensonify.session import EXIT_BAD_INPUT, RunError

ENDPOINT_FILE = "clock.endpoint"
ABOUT_FILE = "about.json"


# A socket path has at most 107 bytes, and "/run-XXXXXX/" and the longest process name with its ending follow.
LONGEST_RUN_ROOT = 107 - 60


def run_root() -> pathlib.Path:
    """Where this user's run directories are, as the launcher chooses it: `$XDG_RUNTIME_DIR/ensonify`, or
    `/tmp/ensonify-<uid>` when that variable is unset, or names a folder that is too long or not ours to use."""
    runtime = os.environ.get("XDG_RUNTIME_DIR", "")
    if runtime.startswith("/") and _can_be_used(f"{runtime}/ensonify"):
        return pathlib.Path(runtime) / "ensonify"
    return pathlib.Path(f"/tmp/ensonify-{os.geteuid()}")


def _can_be_used(folder: str) -> bool:
    if len(os.fsencode(folder)) > LONGEST_RUN_ROOT:
        return False
    try:
        facts = os.lstat(folder)
    except OSError:
        return os.access(os.path.dirname(folder), os.W_OK | os.X_OK)
    return stat.S_ISDIR(facts.st_mode) and facts.st_uid == os.geteuid()


class LiveRun(NamedTuple):
    """A run with somebody at its clock's endpoint."""

    name: str  # as `ensonify run --name` gave it, else the id of its directory
    launch: str  # its file; "" where that is not known
    age_s: float  # wall seconds since its start
    folder: pathlib.Path
    clock: str  # endpoint


def live_runs() -> list:
    """The live runs of this user."""
    return [_live_run(folder) for folder in _folders() if _is_live(_endpoint(folder))]


def _live_run(folder: pathlib.Path) -> LiveRun:
    about = _about(folder)
    age_s = time.time() - about["began_unix_s"] if "began_unix_s" in about else 0.0
    return LiveRun(about.get("name") or folder.name, about.get("launch", ""), age_s, folder, _endpoint(folder))


def find_clock(run: str | os.PathLike | None = None) -> str:
    """The clock's endpoint. `run` is a run's name, its directory, the id of that, or an endpoint."""
    return find_run(run)[0]


def find_run(run: str | os.PathLike | None = None) -> tuple:
    """The clock's endpoint and the run directory, None where an endpoint was given."""
    run = os.fspath(run) if run is not None else os.environ.get("ENSONIFY_RUN")
    if run:
        if run.startswith(("ipc://", "tcp://")):
            return run, None
        named = [folder for folder in _folders() if _about(folder).get("name") == run]
        folder = pathlib.Path(run) if "/" in run else named[0] if named else run_root() / run
        return _endpoint(folder), folder
    live = live_runs()
    if len(live) == 1:
        return live[0].clock, live[0].folder
    if not live:
        raise RunError(f"no run is live under {run_root()}", EXIT_BAD_INPUT)
    names = ", ".join(f"{each.name} ({each.launch or 'of unknown launch'}, {each.age_s:.0f} s old)" for each in live)
    raise RunError(f"several runs are live, name one: {names}", EXIT_BAD_INPUT)


def _about(folder: pathlib.Path) -> dict:
    """What the launcher wrote of a run; empty where it is not known."""
    try:
        about = json.loads((folder / ABOUT_FILE).read_text())
    except (OSError, ValueError):
        return {}
    return about if isinstance(about, dict) else {}


def _folders() -> list:
    root = run_root()
    return sorted(file.parent for file in root.glob(f"*/{ENDPOINT_FILE}")) if root.is_dir() else []


def _endpoint(folder: pathlib.Path) -> str:
    try:
        return (folder / ENDPOINT_FILE).read_text().strip()
    except OSError as error:
        raise RunError(f"{folder} is no run directory: {error.strerror}", EXIT_BAD_INPUT) from None


def _is_live(endpoint: str) -> bool:
    """Somebody listens there. A connection that says nothing does a ROUTER no harm."""
    if endpoint.startswith("ipc://"):
        probe, address = socket.socket(socket.AF_UNIX), endpoint[len("ipc://"):]
    else:
        host, _, port = endpoint[len("tcp://"):].rpartition(":")
        probe, address = socket.socket(), (host, int(port))
    with probe:
        return probe.connect_ex(address) == 0
