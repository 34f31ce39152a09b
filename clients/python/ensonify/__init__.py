"""Watch an Ensonify sonar simulation, or take part in it."""
from ensonify.messages import *  # noqa: F401,F403  the message types, as ensonify.Ping
from ensonify.messages import TYPES
from ensonify.observer import Observer
from ensonify.participant import In, Out, Participant, Received, Step
from ensonify.record import Record
from ensonify.runs import LiveRun, find_clock, live_runs
from ensonify.session import RunError
from ensonify.wire import NEVER, DecodeError, Envelope

__version__ = "0.1.0"
