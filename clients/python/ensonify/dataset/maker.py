"""Pictures of one run after another, in one process."""
import json
import socket
from pathlib import Path

from ensonify.dataset import scene, store
from ensonify.dataset.plan import Plan
from ensonify.session import EXIT_DATA_LOST, RunError


def serve(folder: str | Path, descriptor: int, keep: bool) -> None:
    """Takes scenes as lines of JSON from a socket until it closes. For each goes back "ok", or a code and what is wrong."""
    plan = Plan(folder)
    with socket.socket(fileno=descriptor) as connection, connection.makefile("r", encoding="utf-8") as scenes:
        for line in scenes:
            connection.sendall((make(plan, json.loads(line), keep) + "\n").encode())


def make(plan: Plan, of: dict, keep: bool) -> str:
    """The pictures of a scene, beside its record, which goes unless it is kept."""
    file = plan.pictures_of(of)
    try:
        store.save(scene.pictures_of(plan.recipe, of, file.parent), file)
    except RunError as error:
        return f"{error.code} " + " ".join(str(error).split())
    except OSError as error:
        return f"{EXIT_DATA_LOST} {error.filename or file}: {error.strerror}"
    if not keep:
        for record in file.parent.glob("*.mcap"):
            record.unlink()
    return "ok"
