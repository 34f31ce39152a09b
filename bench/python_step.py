#!/usr/bin/env python3
"""The agent of bench/launch/python_step.yaml: takes a message, answers, and notes the wall time from each answer to its
next step, in which the clock, the world and the wire have had their turn. Writes <out>/python_step.json."""
import json
import os
import statistics
import time
from dataclasses import dataclass

import numpy as np

import ensonify
from ensonify.typed import Message, array


@dataclass(eq=False)
class Observation(Message):
    TYPE = "observation_stub/1"
    stamp_ns: int = 0
    data: np.ndarray = array("u1")


@dataclass(eq=False)
class Action(Message):
    TYPE = "action_stub/1"
    stamp_ns: int = 0


with ensonify.Participant() as me:
    observations = me.subscribe("observation", Observation)
    action = me.publish("action", Action, rate=20)
    began_ns, round_ns, sizes = 0, [], set()
    for n, step in enumerate(me.steps(rate=20)):
        (observation,) = observations  # exactly one is due at each step
        assert observation.stamp_ns == step.t_ns and observation.data[-1] == 0x5A
        sizes.add(observation.data.nbytes)
        now_ns = time.perf_counter_ns()
        round_ns.append(now_ns - began_ns)
        began_ns = now_ns
        action.send(Action(stamp_ns=step.t_ns))
settled = round_ns[len(round_ns) // 10:]
with open(os.path.join(os.environ["ENSONIFY_OUT"], "python_step.json"), "w", encoding="utf-8") as stream:
    json.dump({"rounds": len(round_ns), "bytes": sizes.pop(), "p50_us": statistics.median(settled) / 1e3,
               "p99_us": statistics.quantiles(settled, n=100)[98] / 1e3}, stream)
