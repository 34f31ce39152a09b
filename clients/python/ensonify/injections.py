"""Faults that a launch file injects into this process (`inject:`; docs/manual/wire.md, the fact `inject`)."""
import collections
import json
import os
import random
import signal
import subprocess
import sys
from typing import Callable, Mapping

import numpy as np

from ensonify.session import EXIT_BAD_INPUT, RunError

FOR_EVER = 2**63 - 1


class InjectedKill(BaseException):
    """The launch kills this process now, by this signal. What it has published before is still to leave."""

    def __init__(self, number: int):
        super().__init__()
        self.signal = number


class Injector:
    """Does to a process's outputs, and to the process, what is to be injected, in sim time of an epoch."""

    def __init__(self, facts: Mapping[str, str], process: str):
        every = json.loads(facts.get("inject") or "[]")
        self._process = process
        self._seed = facts.get("seed", "0")
        self._all = [one for one in every if one["target"].split("/")[0] == process]
        self._said: set = set()
        self._late: dict = {}  # by output: (due ns, publish, content)
        self._numbers: collections.Counter = collections.Counter()

    def begin_step(self, t_ns: int) -> None:
        """Raises InjectedKill, or stops the process, if it is time; then publishes what has been delayed until now."""
        for number, one in enumerate(self._all):
            if one["kind"] not in ("kill", "pause") or t_ns < one["from_ns"] or number in self._said:
                continue
            self._say(number, t_ns, f"{one['kind']} target={one['target']}")
            if one["kind"] == "kill":
                raise InjectedKill(one.get("signal", signal.SIGKILL))
            else:
                subprocess.Popen(["sh", "-c", f"sleep {float(one['wall_s'])}; kill -CONT {os.getpid()}"])
                os.kill(os.getpid(), signal.SIGSTOP)
        for late in self._late.values():
            while late and late[0][0] <= t_ns:
                _, publish, content = late.popleft()
                publish(content)

    def send(self, port: str, t_ns: int, content: dict, publish: Callable[[dict], None]) -> None:
        """A message: published, changed, kept for later or lost."""
        due, drawn = t_ns, self._numbers[port]
        self._numbers[port] += 1
        for number, one in enumerate(self._all):
            if one["target"] not in (self._process, f"{self._process}/{port}") or not one["from_ns"] <= t_ns < one.get("to_ns", FOR_EVER):
                continue
            topic = f"{self._process}/{port}"
            if one["kind"] == "mute":
                return self._say(number, t_ns, f"mute topic={topic}")
            if one["kind"] == "drop" and random.Random(f"{self._seed} {topic} {drawn}").random() < one["share"]:
                return self._say(number, t_ns, f"drop topic={topic} share={one['share']:g}")
            if one["kind"] == "delay":
                due += one["by_ns"]
                self._say(number, t_ns, f"delay topic={topic} by_ms={one['by_ns'] * 1e-6:g}")
            if one["kind"] == "corrupt":
                put(content, one["field"], one["value"], topic)
                self._say(number, t_ns, f"corrupt topic={topic} field={one['field']} value={one['value']}")
        late = self._late.setdefault(port, collections.deque())
        if late:
            due = max(due, late[-1][0])  # none overtakes
        if due <= t_ns:
            return publish(content)
        late.append((due, publish, content))
        return None

    def _say(self, number: int, t_ns: int, what: str) -> None:
        if number not in self._said:
            self._said.add(number)
            print(f"t={t_ns * 1e-9:.3f} {self._process} inject {what}", file=sys.stderr)


def put(content: dict, path: str, text: str, topic: str) -> None:
    """A value in place of the one under a path such as "position_enu_m.2". What is changed is a copy: the sender holds the message too."""
    first, *rest = path.split(".")
    try:
        content[first] = with_value(content[first], rest, text)
    except (KeyError, IndexError, ValueError, TypeError):
        raise RunError(f"inject: corrupt: {topic} has no value {path} that is no array", EXIT_BAD_INPUT) from None


def with_value(old, path: list, text: str):
    """A copy of `old` with another value under the path."""
    if isinstance(old, np.ndarray):
        raise KeyError(path)
    if not path:
        return value_like(old, text)
    if isinstance(old, (list, tuple)):
        index = int(path[0])
        changed = list(old)
        changed[index] = with_value(changed[index], path[1:], text)
        return type(old)(changed)
    return {**old, path[0]: with_value(old[path[0]], path[1:], text)}


def value_like(old, text: str):
    """A number, true, false, or the text itself."""
    if isinstance(old, str):
        return text
    if text in ("true", "false"):
        return text == "true"
    try:
        number = float(text)
    except ValueError:
        return text
    return int(number) if isinstance(old, int) and number == number and number.is_integer() else number
