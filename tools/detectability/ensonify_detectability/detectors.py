"""Detectors by name: the one that is shipped, or a function of somebody's own."""
import importlib
import importlib.util
import sys
from pathlib import Path

from . import cfar
from .pictures import Unreadable


def named(name: str):
    """`cfar`, MODULE:FUNCTION or FILE.py:FUNCTION. Raises Unreadable when there is none."""
    if name == "cfar":
        return cfar.find
    module, _, function = name.rpartition(":")
    if not module or not function:
        raise Unreadable(f"--detector {name}: allowed: cfar, MODULE:FUNCTION or FILE.py:FUNCTION")
    try:
        of = _from_file(name, Path(module)) if module.endswith(".py") else _from_module(name, module)
    except Unreadable:
        raise
    except Exception as error:  # somebody's code, as it is loaded
        raise Unreadable(f"--detector {name}: {type(error).__name__}: {error}") from None
    if not callable(getattr(of, function, None)):
        raise Unreadable(f"--detector {name}: {module} has no function {function}")
    return getattr(of, function)


def _from_file(name: str, file: Path):
    if not file.is_file():
        raise Unreadable(f"--detector {name}: {file} is not there")
    sys.path.insert(0, str(file.resolve().parent))
    spec = importlib.util.spec_from_file_location(file.stem, file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _from_module(name: str, module: str):
    sys.path.insert(0, ".")
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name is not None and module.split(".")[0] == error.name.split(".")[0]:
            raise Unreadable(f"--detector {name}: there is no module {error.name}") from None
        raise
