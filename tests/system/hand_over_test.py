"""Several pilots of one vehicle: a survey package by NMEA sentences, an agent that hands the vehicle back, and an autopilot."""
import math
import socket
import threading
import unittest

import ensonify
import numpy as np
from nmea import free_port, sentence
from support import SOURCE, SystemTest

LEG_EAST_M = -105.0  # the package's leg goes north along it; the boat begins 15 m west of it
SILENT_S = 85  # from then on the package says nothing

AGENT = """
import ensonify
with ensonify.Participant("agent") as me:
    command = me.publish("command", ensonify.Guidance, rate=10)
    for step in me.steps(rate=10):
        t_s = step.t_ns * 1e-9
        if t_s > 3:
            command.send(ensonify.Guidance(stamp_ns=step.t_ns, heading_grid_rad=1.5, speed_mps=1.0, hand_back=t_s > 6, vehicle="boat"))
"""

SHARED_BOAT = """
ensonify: launch/1
scenario:
  ensonify: scenario/1
  site: {{ latitude_deg: 1, longitude_deg: 2 }}
  seabed: {{ kind: layers }}
  vehicles: {{ boat: {{ start: {{ position_m: [0, 0, 0], heading_deg: 0, speed_mps: 1 }} }} }}
  mission: {{ speed_mps: 1, runlines: [{{ from_m: [0, 0], to_m: [0, 90] }}] }}
duration_s: 12
processes:
  boat:  {{ run: vehicle, config: {{ steered_by: {{ agent: {{ timeout_s: 1 }}, pilot: {{}} }} }} }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
  agent: {{ run: [python3, {agent}] }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: [boat/helm, boat/health, pilot/mission] }} }}
{more}
"""


def in_a_row(values):
    """Each value once, however often it comes in a row."""
    values = list(values)
    return [value for i, value in enumerate(values) if i == 0 or value != values[i - 1]]


class HandOver(SystemTest):
    def helms(self, file):
        with ensonify.Record(file) as record:
            return [message for _, _, message in record.messages("boat/helm")]

    def test_a_survey_package_steers_its_leg_and_the_autopilot_takes_over(self):
        port = free_port()
        run = self.start_launch(SOURCE / "launch/steering_feed.yaml", "--rate", "8", "--arg", f"port={port}", "--arg", "seconds=100")
        self.wait_for_go()
        run_directory = next(self.runs.glob("ensonify/*/clock.endpoint")).parent
        stop = threading.Event()

        def send():
            """As a package does: once a second of the run how far the boat is off the leg."""
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out, ensonify.Observer(run_directory) as watch:
                sent_s = -1
                for pose in watch.messages("boat/pose"):
                    t_s = math.floor(pose.t_sim_ns * 1e-9)
                    if stop.is_set() or t_s >= SILENT_S:
                        return
                    if t_s == sent_s:
                        continue
                    sent_s = t_s
                    off_m = pose.content.position_enu_m[0] - LEG_EAST_M
                    body = f"GPAPB,A,A,{abs(off_m) / 1852:.5f},{'L' if off_m > 0 else 'R'},N,V,V,000.0,T,END,000.0,T,000.0,T"
                    out.sendto((sentence(body) + sentence("GPVTG,0,T,,M,4,N,7,K") + "$GPXTE,A,A,0.5,L,N*00\r\n").encode(), ("127.0.0.1", port))

        sender = threading.Thread(target=send)
        sender.start()
        _, error = run.communicate(timeout=120)
        stop.set()
        sender.join()
        self.assertEqual(run.returncode, 0, error)

        helms = self.helms(self.folder / "out/steering.mcap")
        self.assertEqual(in_a_row(helm.steered_by for helm in helms), ["", "pilot", "package", "pilot"])
        self.assertEqual(helms[-1].why, "silent")
        taken_back_s = next(helm.stamp_ns for helm in helms if helm.why == "silent") * 1e-9
        self.assertGreater(taken_back_s, SILENT_S + 5)  # valid_s of the feed and timeout_s of the vehicle, 3 s and 5 s
        self.assertLess(taken_back_s, SILENT_S + 10)
        with ensonify.Record(self.folder / "out/steering.mcap") as record:
            way = np.array([(message.stamp_ns * 1e-9, *message.position_enu_m[:2]) for _, _, message in record.messages("boat/pose")])
            health = [message for _, _, message in record.messages("package/health")][-1]
        on_leg = way[(way[:, 0] > SILENT_S - 5) & (way[:, 0] < SILENT_S)]
        self.assertLess(np.abs(on_leg[:, 1] - LEG_EAST_M).max(), 3.0)  # in a stream of 0.5 m/s across it
        counts = {counter.name: counter.count for counter in health.counters}
        self.assertGreater(counts["legs_taken"], 30)
        self.assertGreater(counts["sentences_of_other_kinds"], 30)
        self.assertGreater(counts["sentences_with_bad_checksum"], 30)

    def test_an_agent_takes_the_helm_and_hands_it_back(self):
        agent = self.write("agent.py", AGENT)
        for out, more in (("out", ""), ("wrong", "inject: [{ corrupt: agent/command, field: vehicle, value: ship }]"),
                          ("silent", "inject: [{ mute: agent, from_s: 5 }]")):
            result = self.run_launch(SHARED_BOAT.format(agent=agent, more=more), "--free", out=out)
            self.assertEqual(result.code, 0, result.stderr)
        helms = self.helms(self.folder / "out/run.mcap")
        self.assertEqual(in_a_row((helm.steered_by, helm.why) for helm in helms),
                         [("", ""), ("pilot", "commands"), ("agent", "commands"), ("pilot", "hand_back")])
        with ensonify.Record(self.folder / "out/run.mcap") as record:
            states = in_a_row(message.state for _, _, message in record.messages("pilot/mission"))
        self.assertEqual(states[:3], ["on_line", "stand_by", "turn"])

        helms = self.helms(self.folder / "wrong/run.mcap")
        self.assertEqual({helm.steered_by for helm in helms}, {"", "pilot"})
        self.assertGreater(helms[-1].refused, 70)
        with ensonify.Record(self.folder / "wrong/run.mcap") as record:
            health = [message for _, _, message in record.messages("boat/health")][-1]
        self.assertEqual((health.state, health.message), ("degraded", "a command of agent was refused: for_another_vehicle"))

        silent = self.helms(self.folder / "silent/run.mcap")[-1]
        self.assertEqual((silent.steered_by, silent.why), ("pilot", "silent"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
