"""Watch an Ensonify sonar simulation, or take part in it."""
import importlib
import importlib.util

from ensonify.messages import *  # noqa: F401,F403  the message types, as ensonify.Ping
from ensonify.messages import TYPES
from ensonify.observer import Observer
from ensonify.participant import In, Out, Participant, Received, Step
from ensonify.record import Record
from ensonify.runs import LiveRun, find_clock, live_runs
from ensonify.session import RunError
from ensonify.wire import NEVER, DecodeError, Envelope

__version__ = "0.1.0"

# What needs Gymnasium or PettingZoo, and where it is.
_GYM = {"Env": "environment", "ParallelEnv": "parallel", "Agent": "agent", "TruthError": "agent", "Seen": "episode",
        "Fields": "spaces", "Array": "spaces", "Rows": "spaces", "Act": "acts", "steer": "acts", "goto": "acts"}
_EXTRAS = {"gymnasium": "Gymnasium: pip install 'ensonify[gym]'", "pettingzoo": "PettingZoo: pip install 'ensonify[pettingzoo]'"}


def __getattr__(name: str):
    if name not in _GYM:
        raise AttributeError(f"module 'ensonify' has no attribute {name!r}")
    try:
        return getattr(importlib.import_module(f"ensonify.{_GYM[name]}"), name)
    except ModuleNotFoundError as error:
        if error.name not in _EXTRAS:
            raise
        raise ImportError(f"ensonify.{name} needs {_EXTRAS[error.name]}") from None


if importlib.util.find_spec("gymnasium") is not None:
    from ensonify import tasks
    tasks.register()
