"""Lines that were planned: what `ensonify plan` writes as JSON."""
import json
import pathlib

import numpy as np

from ensonify_plot import files
from ensonify_plot.errors import UserError


def add_plan(command) -> None:
    """The option `--plan` of a verb that draws a map."""
    command.add_argument("--plan", metavar="FILE", help="lines to draw over the map, as ensonify plan lines --json or ensonify plan import --json "
                         "prints them; default: none")


def read_plan(path: str | None, origin: tuple | None) -> list:
    """Places of each line in the world's metres, n x 2; none without a file. `origin`: the world's, latitude and longitude in degrees."""
    if path is None:
        return []
    try:
        plan = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        lines = [np.array(line["places"], float) for line in plan["lines"]]
        if any(line.ndim != 2 or line.shape[1] != 2 or not np.isfinite(line).all() for line in lines):
            raise ValueError("a line is not a list of places of two numbers")
        geodetic = plan.get("positions") == "geodetic"
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as fault:
        raise UserError(f"{path}: cannot be read as a plan ({fault}); allowed: what ensonify plan lines --json prints") from fault
    if not geodetic:
        return lines
    if origin is None:
        raise UserError(f"{path}: has latitudes and longitudes, and where the world is is not stated; allowed: a plan in metres of the world")
    world = files.world_crs(origin)
    return [np.column_stack(files.transformed(files.wgs84(), world, *line.T)) for line in lines]
