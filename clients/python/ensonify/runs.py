"""Finding the clock of a run: by run directory, by $ENSONIFY_RUN, or the only live one of this user."""
import os
import pathlib
import socket
import stat

from ensonify.session import EXIT_BAD_INPUT, RunError

ENDPOINT_FILE = "clock.endpoint"


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


def find_clock(run: str | os.PathLike | None = None) -> str:
    """The clock's endpoint. `run` is a run directory, the id of one, or an endpoint."""
    return find_run(run)[0]


def find_run(run: str | os.PathLike | None = None) -> tuple:
    """The clock's endpoint and the run directory, None where an endpoint was given."""
    run = os.fspath(run) if run is not None else os.environ.get("ENSONIFY_RUN")
    if run:
        if run.startswith(("ipc://", "tcp://")):
            return run, None
        folder = pathlib.Path(run) if "/" in run else run_root() / run
        return _endpoint(folder), folder
    live = [folder for folder in _folders() if _is_live(_endpoint(folder))]
    if len(live) == 1:
        return _endpoint(live[0]), live[0]
    if not live:
        raise RunError(f"no run is live under {run_root()}", EXIT_BAD_INPUT)
    raise RunError("several runs are live, name one: " + ", ".join(folder.name for folder in live), EXIT_BAD_INPUT)


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
