"""An agent that turns the propeller and the rudder itself: what the vehicle then does, what it refuses, and who has it afterwards."""
import math
import unittest

import ensonify
import numpy as np
from support import SOURCE, SystemTest

AGENT = """
import math, ensonify, numpy as np
with ensonify.Participant("agent") as me:
    order = me.publish("actuators", ensonify.Actuators, rate=10)
    for step in me.steps(rate=10):
        rudder = math.radians(5) if step.t_s > 30 else 0.0
        wrong = {"no number": math.nan, "too far": 0.4}.get(me.config["does"] if 40 < step.t_s < 41 else "")
        if me.config["does"] == "ends" and step.t_s > 60.05:
            continue
        fins = [rudder if wrong is None else wrong, 0.0] + [0.0] * (me.config["does"] == "another vehicle's")
        order.send(ensonify.Actuators(stamp_ns=step.t_ns, propeller_rps=np.array([1525 / 60]), fin_rad=np.array(fins)))
"""

LAUNCH = """
ensonify: launch/1
scenario:
  ensonify: scenario/1
  site: {{ latitude_deg: 1, longitude_deg: 2 }}
  seabed: {{ kind: layers, size_m: [1000, 1000], post_spacing_m: 2, layers: {{ ground: {{ plane: {{ depth_m: 120 }} }} }} }}
  vehicles: {{ auv: {{ kind: hydrodynamic, dynamics: {source}/components/vehicle/hydrodynamic/remus_100.yaml, turning_radius_m: 30, start: {{ position_m: [0, 0, -50], heading_deg: 0, speed_mps: 2 }} }} }}
  mission: {{ speed_mps: 1.5, depth_m: 50, when_silent: hold, runlines: [{{ from_m: [0, 0], to_m: [0, 400] }}] }}
duration_s: {seconds}
processes:
  auv:   {{ run: vehicle, config: {{ steered_by: {{ agent: {{ by: actuators, timeout_s: 2 }}, pilot: {{}} }} }} }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
  agent: {{ run: [python3, {agent}], config: {{ does: "{does}" }} }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: [auv/pose, auv/helm, auv/health, agent/actuators] }} }}
"""


class Actuators(SystemTest):
    def run_with(self, does, seconds=100):
        agent = self.write("agent.py", AGENT)
        result = self.run_launch(LAUNCH.format(source=SOURCE, agent=agent, does=does, seconds=seconds), "--free", out=does.split()[0])
        self.assertEqual(result.code, 0, result.stderr)
        return result.out / "run.mcap"

    def messages(self, file, topic):
        with ensonify.Record(file) as record:
            return [message for _, _, message in record.messages(topic)]

    def counts(self, file):
        return {counter.name: counter.count for counter in self.messages(file, "auv/health")[-1].counters}

    def test_a_step_of_the_rudder_makes_the_published_turning_rate(self):
        file = self.run_with("steers")
        poses = self.messages(file, "auv/pose")
        t_s = np.array([pose.stamp_ns for pose in poses]) * 1e-9
        course_rad = np.unwrap([math.atan2(pose.velocity_enu_mps[0], pose.velocity_enu_mps[1]) for pose in poses])
        self.assertLess(abs(course_rad[np.searchsorted(t_s, 30.0)]), 0.01)  # straight until then
        first, last = np.searchsorted(t_s, (80.0, 99.0))
        rate_dps = math.degrees((course_rad[last] - course_rad[first]) / (t_s[last] - t_s[first]))
        self.assertLess(abs(rate_dps - 3.61), 0.01 * 3.61)  # of the published model of the REMUS 100, with 5 degrees at 1525 rev/min
        self.assertEqual({helm.steered_by for helm in self.messages(file, "auv/helm")}, {"", "agent", "pilot"} - {"pilot"})

    def test_what_cannot_be_ordered_is_refused_and_counted_and_is_silence(self):
        for does, counter, count in (("no number", "commands_not_finite", 9), ("too far", "commands_out_of_range", 9),
                                     ("another vehicle's", "commands_of_other_actuators", 400)):
            with self.subTest(does):
                file = self.run_with(does, seconds=45)
                self.assertAlmostEqual(self.counts(file)[counter], count, delta=50)
                last = self.messages(file, "auv/helm")[-1]
                self.assertEqual(last.steered_by, "pilot" if count > 9 else "agent")
                self.assertAlmostEqual(last.refused, self.counts(file)[counter], delta=10)  # each second
        agents = self.messages(file, "agent/actuators")
        self.assertEqual(len(agents[0].fin_rad), 3)

    def test_when_it_falls_silent_the_autopilot_has_the_vehicle(self):
        file = self.run_with("ends")
        helms = self.messages(file, "auv/helm")
        change = next(helm for helm in helms if helm.steered_by == "pilot")
        self.assertEqual(change.why, "silent")
        self.assertAlmostEqual(change.stamp_ns * 1e-9, 62.1, delta=0.05)  # the last order takes effect at 60.1 s
        poses = self.messages(file, "auv/pose")
        self.assertLess(abs(poses[-1].position_enu_m[2] + 50), 2.0)  # it is back at its depth

    def test_a_vehicle_without_forces_has_none_to_order(self):
        agent = self.write("agent.py", AGENT)
        text = LAUNCH.format(source=SOURCE, agent=agent, does="steers", seconds=5)
        result = self.run_launch(text.replace(f"kind: hydrodynamic, dynamics: {SOURCE}/components/vehicle/hydrodynamic/remus_100.yaml, ", ""))
        self.assertEqual(result.code, 2, result.stderr)
        self.assertIn("steered_by.agent.by: actuators are of a vehicle moved by forces; auv has no `dynamics` file", result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
