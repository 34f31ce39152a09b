"""A process that the run may lose: it is taken out of the lockstep, its topics fall silent, and the run goes on. Killed at a sim
time, or because a message of it cannot be used, the run has the same bytes each time; killed from outside it goes on all the same."""
import hashlib
import os
import signal
import unittest

import ensonify
from support import SOURCE, SystemTest, survey

KILLED = SOURCE / "launch/tests/agent_killed.yaml"

AGENT = """
import ensonify
with ensonify.Participant("agent") as me:
    estimates = me.subscribe("estimate", ensonify.Estimate)
    command = me.publish("command", ensonify.Guidance, rate=10)
    for step in me.steps(rate=10):
        if step.t_s > 5 and me.config.get("leaves"):
            {leave}
        command.send(ensonify.Guidance(stamp_ns=step.t_ns, heading_grid_rad=0.2, speed_mps=1.0))
"""


# With a second topic, of which nothing is wrong.
ERRS_AT_20 = """
import ensonify
with ensonify.Participant("agent") as me:
    estimates = me.subscribe("estimate", ensonify.Estimate)
    command = me.publish("command", ensonify.Guidance, rate=10)
    other = me.publish("other", ensonify.Ctd, rate=10)
    for step in me.steps(rate=10):
        order = ensonify.Guidance(stamp_ns=step.t_ns, heading_grid_rad=0.2, speed_mps=1.0)
        if step.t_ns == 20_000_000_000:
            {mistake}
        else:
            command.send(order)
        other.send(ensonify.Ctd(stamp_ns=step.t_ns))
"""
MISTAKES = {"message is not msgpack": """me._publish(b"agent/command\\0", command.topic_id, command._hash, [b"\\xc1"])""",
            "epoch: is 7": "me._session.epoch = 7; command.send(order); me._session.epoch = 1"}

READER = """
import pathlib, sys, ensonify
with ensonify.Participant("reader") as me, open(me.config["file"], "w") as file:
    commands = me.subscribe("command", ensonify.Guidance, topics=["agent/command"])
    others = me.subscribe("other", ensonify.Ctd, topics=["agent/other"])
    for step in me.steps(rate=4):
        for port in (commands, others):
            for received in port.received:
                print(received.topic, received.t_sim_ns, file=file)
"""


def losing(name, text):
    """A launch of stubs in which this process may be lost."""
    return text.replace(f"  {name}: {{ run: stub,", f"  {name}: {{ may_be_lost: true, run: stub,")


class Lost(SystemTest):
    def lost(self, result, name):
        """How a run without `name` says so."""
        report = result.report()
        entry = next(process for process in report["processes"] if process["name"] == name)
        self.assertEqual(entry["state"], "LOST", report)
        self.assertIn(f"ensonify run: {name} is lost at t=", result.stderr)
        self.assertIn(f"lost process={name}", result.log("clock"))
        self.assertEqual([process["name"] for process in report["processes"] if process["state"] == "FAILED" and process["name"] != "expect"], [])
        return entry


class Recorded(Lost):
    def run_recorded(self, launch, name, *options, prefix=()):
        file = self.folder / f"{name}.mcap"
        result = self.run_launch(launch, "--record", file, *options, out=name, prefix=prefix, timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        return result, file

    def digest(self, file):
        return hashlib.sha256(file.read_bytes()).hexdigest()

    def times_s(self, file, topic):
        with ensonify.Record(file) as record:
            return [round(t_ns * 1e-9, 6) for _, t_ns, _ in record.messages(topic)]


class SameBytes(Recorded):
    def check(self, launch):
        digests = []
        for name, options, prefix in (("free", ("--free",), ()), ("again", ("--free",), ()), ("paced", ("--rate", "20"), ()),
                                      ("core", ("--free",), ("taskset", "-c", "0"))):
            result, file = self.run_recorded(launch, name, *options, prefix=prefix)
            entry = self.lost(result, "agent")
            self.assertEqual((entry["signal"], entry["lost"]), (9, {"at_s": 20.0, "message": "was killed by signal 9 (Killed)"}))
            digests.append(self.digest(file))
        self.assertEqual(len(set(digests)), 1)
        whole, unharmed = self.run_recorded(self.without_kill(launch), "whole")
        self.assertEqual({process["state"] for process in whole.report()["processes"]}, {"DONE"})
        commands = self.times_s(file, "agent/command")
        self.assertEqual(commands, [t_s for t_s in self.times_s(unharmed, "agent/command") if t_s < 20], "all up to its death")
        self.assertGreater(len(commands), 100)
        self.assertGreater(self.times_s(file, "boat/pose")[-1], 29)

    def without_kill(self, launch):
        text = launch.read_text()
        return self.write("whole.yaml", text[:text.index("inject:")].replace("../schema", str(SOURCE / "launch/schema")))

    def test_a_node_that_is_killed_at_a_sim_time(self):
        self.check(self.write("node.yaml", KILLED.read_text().replace("duration_s: 60", "duration_s: 30").split("expect:")[0]))

    def test_a_python_agent_that_is_killed_at_a_sim_time(self):
        agent = self.write("agent.py", AGENT.format(leave="pass"))
        text = KILLED.read_text().replace("duration_s: 60", "duration_s: 30").split("expect:")[0]
        self.check(self.write("python.yaml", text.replace("agent: { run: autopilot,", f"agent: {{ run: [python3, {agent}],")))


class Unusable(Recorded):
    """A reader of Python, one of C++ and the recorder take nothing more of the topic; of the other topic all see the same."""

    def check(self, mistake, words):
        agent = self.write("errs.py", ERRS_AT_20.format(mistake=words))
        reader, heard = self.write("reader.py", READER), self.folder / "heard.txt"
        text = KILLED.read_text().replace("duration_s: 60", "duration_s: 30").split("inject:")[0]
        text = text.replace("agent: { run: autopilot,", f"agent: {{ run: [python3, {agent}],")
        text += f"  reader: {{ run: [python3, {reader}], config: {{ file: {heard} }} }}\n"
        launch = self.write("errs.yaml", text)
        seen = []
        for name, options, prefix in (("free", ("--free",), ()), ("again", ("--free",), ()), ("paced", ("--rate", "20"), ()),
                                      ("core", ("--free",), ("taskset", "-c", "0"))):
            result, file = self.run_recorded(launch, f"{name}_{len(words)}", *options, prefix=prefix)
            entry = self.lost(result, "agent")
            self.assertIn("agent sent a message that cannot be used: agent/command: seq 200: ", entry["lost"]["message"])
            self.assertIn(mistake, entry["lost"]["message"])
            seen.append((self.digest(file), heard.read_text(), entry["lost"]["at_s"], self.times_s(file, "agent/other")[-1]))
        self.assertEqual(len(set(seen)), 1, [one[2:] for one in seen])
        at_s, last_of_other_s = seen[0][2:]
        self.assertTrue(21 < at_s < 22, at_s)
        self.assertEqual(round(last_of_other_s, 6), round(at_s - 0.1, 6))
        lines = [line.split() for line in seen[0][1].splitlines()]
        self.assertEqual(max(int(t_ns) for topic, t_ns in lines if topic == "agent/command"), 19_900_000_000)
        self.assertEqual(max(int(t_ns) for topic, t_ns in lines if topic == "agent/other"), round(last_of_other_s * 1e9))
        self.assertGreater(self.times_s(file, "boat/pose")[-1], 29)

    def test_a_message_that_is_none(self):
        self.check("message is not msgpack", MISTAKES["message is not msgpack"])

    def test_a_message_of_another_epoch(self):
        self.check("epoch: is 7", MISTAKES["epoch: is 7"])


class Ends(Lost):
    """Each way to go; the exit code is that of what the launch expects."""

    def check(self, result, name, message, code=0):
        self.assertEqual(result.code, code, result.stderr)
        self.assertIn(message, self.lost(result, name)["lost"]["message"])
        self.assertEqual(result.clock()["end_ns"], 5_000_000_000)
        self.assertEqual(result.report()["culprit"], "expect" if code == 1 else None)

    def test_one_that_throws_dies_or_stands_still(self):
        for fault, message in (("throw_s: 1", "told to throw"), ("die_s: 1", "signal 9"), ("spin_s: 1", "no progress for 2."),
                               ("stop_s: 1", "no progress for 2.")):
            with self.subTest(fault):
                out = fault.split("_")[0]
                result = self.run_launch(losing("head", survey(seconds=4, head=fault)), out=out)
                self.check(result, "head", message)
                # The first event that it has not said to be done: it says so of several at once.
                self.assertLessEqual(self.lost(result, "head")["lost"]["at_s"], 1.0)

    def test_a_consumer_of_large_messages_that_is_stopped_blocks_nobody_for_ever(self):
        self.check(self.run_launch(losing("consumer", survey(seconds=4, size=4_000_000, consumer="stop_s: 1"))), "consumer", "no progress")

    def test_one_that_leaves_early_or_ends_with_a_code(self):
        for leave, code, message in (("raise SystemExit(0)", 0, "SystemExit: 0"), ("import os; os._exit(7)", 7, "exit code 7"),
                                     ("import os; os._exit(0)", 0, "left before the end")):
            with self.subTest(leave):
                agent = self.write("agent.py", AGENT.format(leave=leave))
                text = KILLED.read_text().replace("duration_s: 60", "duration_s: 10").split("inject:")[0]
                text = text.replace("agent: { run: autopilot,", f"agent: {{ run: [python3, {agent}], config: {{ leaves: true }},")
                result = self.run_launch(text, "--free", out=f"out{len(leave)}")
                self.assertEqual(result.code, 0, result.stderr)
                entry = self.lost(result, "agent")
                self.assertIn(message, entry["lost"]["message"])
                self.assertEqual(entry["exit_code"], code)

    def test_an_expectation_that_fails_is_1_all_the_same(self):
        text = losing("head", survey(seconds=4, head="die_s: 1", more="expect: [{count: {topic: head/ping, min: 40}}]"))
        self.check(self.run_launch(text), "head", "signal 9", code=1)

    def test_one_that_dies_before_time_starts_ends_the_run(self):
        text = losing("head", survey()).replace("head: { may_be_lost: true, run: stub,", "head: { may_be_lost: true, run: [sh, -c, 'exit 3'],")
        result = self.run_launch(text)
        self.assertEqual((result.code, result.report()["culprit"]), (3, "head"), result.stderr)

    def test_others_still_end_the_run(self):
        result = self.run_launch(losing("head", survey(head="die_s: 1", consumer="die_s: 2")))
        self.assertEqual((result.code, result.report()["culprit"]), (3, "consumer"), result.stderr)

    def test_an_observer_that_may_be_lost_is_refused(self):
        result = self.run_launch(survey().replace("consumer: { run", "consumer: { may_be_lost: true, observer: true, run"))
        self.assertEqual(result.code, 2)
        self.assertIn("processes.consumer.may_be_lost: is for participants; an observer may always be lost", result.stderr)


class FromOutside(Lost):
    """At no defined sim time, so no bytes are compared: nobody hangs, and nobody sees what was not counted."""

    def test_a_kill_by_hand_is_survived_each_time(self):
        for attempt in range(5):
            out = f"out{attempt}"
            run = self.start_launch(losing("head", survey(seconds=10, size=1_000_000)), "--rate", "5", out=out)
            self.wait_for_go(out)
            with self.observer() as observer:
                while (status := observer.ask("status"))["sim_ns"] < 1e9 * (1 + 0.1 * attempt):
                    pass
            os.kill(next(each["pid"] for each in status["participants"] if each["name"] == "head"), signal.SIGKILL)
            _, errors = run.communicate(timeout=60)
            self.assertEqual(run.returncode, 0, errors)
            self.assertIn("head is lost at t=", errors)

    def observer(self):
        return ensonify.Observer(next(self.runs.glob("ensonify/*/clock.endpoint")).parent)

    def test_a_reset_after_a_loss_is_refused_by_name(self):
        run = self.start_launch(losing("head", survey(seconds=30, head="die_s: 1")), "--rate", "10")
        self.wait_for_go()
        while "lost process=head" not in (self.folder / "out/log/clock.log").read_text():
            pass
        with self.observer() as observer:
            lost = next(each for each in observer.ask("status")["participants"] if each["name"] == "head")
            self.assertEqual((lost["lost"]["at_ns"], lost["next_ns"]), (1_000_000_000, None))
            with self.assertRaises(ensonify.RunError) as caught:
                observer.reset()
            self.assertEqual(str(caught.exception), "head: was lost at t=1.000 s; only a new launch resets it")
            observer.ask("stop")
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 0, errors)

    def test_who_may_not_be_lost_is_not_by_asking(self):
        run = self.start_launch(survey(seconds=6), "--rate", "2")
        self.wait_for_go()
        with self.observer() as observer:
            for asked, why in (({"process": "head", "why": "x"}, "head is not one that the run may lose"), ({"process": "nobody", "why": "x"}, "has not joined"),
                               ({"process": "head"}, "are not texts"), ({"process": 5, "why": "x"}, "are not texts")):
                self.assertIn(why, observer.ask("lose", **asked)["error"])
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 0, errors)


if __name__ == "__main__":
    unittest.main(verbosity=2)
