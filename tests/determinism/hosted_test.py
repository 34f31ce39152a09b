"""`ensonify run --hosted`: our own processes live in the clock's program where they can. The same bytes as from processes of
their own, the same words about what goes wrong, and everybody outside sees no difference."""
import hashlib
import subprocess
import unittest

import ensonify
from support import SOURCE, SystemTest, bay

KILLED = SOURCE / "launch/tests/agent_killed.yaml"

# Steers from outside, by what hosted processes say. FAULT is what it does at 3 s.
AGENT = """
import os, ensonify
with ensonify.Participant("agent") as me:
    estimates = me.subscribe("estimate", ensonify.Estimate)
    command = me.publish("command", ensonify.Guidance, rate=10)
    for step in me.steps(rate=10):
        if step.t_s > 3:
            FAULT
        east_m = estimates.latest.position_enu_m[0] if estimates.latest else 0.0
        command.send(ensonify.Guidance(stamp_ns=step.t_ns, heading_grid_rad=0.2 - 0.01 * east_m, speed_mps=1.0))
"""
GARBAGE = """me._publish(b"agent/command\\0", command.topic_id, command._hash, [b"\\xc1"])"""


class Hosted(SystemTest):
    def with_agent(self, fault="pass", more=""):
        """agent_killed.yaml without its kill, with a program of our own for the agent."""
        agent = self.write("agent.py", AGENT.replace("FAULT", fault))
        text = KILLED.read_text().replace("duration_s: 60", "duration_s: 10").split("inject:")[0]
        return text.replace("agent: { run: autopilot, may_be_lost: true }", f"agent: {{ run: [python3, {agent}]{more} }}")

    def hosted(self, result):
        return {process["name"] for process in result.report()["processes"] if process.get("hosted")}

    def pair(self, launch, *options):
        """Digests of the record of a run with processes of their own, and of a hosted one."""
        found = []
        for name, words in (("apart", ()), ("hosted", ("--hosted",))):
            record = self.folder / f"{name}.mcap"
            result = self.run_launch(launch, *options, *words, "--record", record, out=name, timeout=120)
            self.assertEqual(result.code, 0, result.stderr)
            with ensonify.Record(record) as file:
                lines = [f"{topic} {t_ns} {content!r}" for topic, t_ns, content in file.messages("*")]
            self.assertGreater(len(lines), 100)
            found.append(hashlib.sha256("\n".join(lines).encode()).hexdigest())
        self.assertEqual(found[0], found[1])
        return result


class SameBytes(Hosted):
    def test_a_survey(self):
        launch = self.write("bay.yaml", bay(seconds=4))
        files = []
        for out, options in (("apart", ()), ("free", ("--hosted",)), ("paced", ("--hosted", "--rate", "3"))):
            result = self.run_launch(launch, *options, out=out)
            self.assertEqual(result.code, 0, result.stderr)
            files.append(hashlib.sha256((result.out / "run.mcap").read_bytes()).hexdigest())
            self.assertEqual(self.hosted(result), set() if out == "apart" else {"boat", "nav", "pilot", "pager", "bow"})
        self.assertEqual(len(set(files)), 1, files)
        entry = next(each for each in result.report()["processes"] if each["name"] == "bow")
        self.assertEqual((entry["state"], entry["exit_code"]), ("DONE", 0))
        self.assertFalse((result.out / "log/bow.log").exists())

    def test_an_agent_outside_by_files_and_by_tcp(self):
        launch = self.write("agent.yaml", self.with_agent())
        self.assertEqual(self.hosted(self.pair(launch, "--free")), {"boat", "nav", "pager", "pilot"})
        self.pair(launch, "--free", "--set", "clock.transport=tcp")

    def test_an_agent_that_is_killed_and_lost(self):
        self.assertEqual(self.hosted(self.pair(KILLED, "--free")), {"boat", "nav", "pager", "pilot"})


class FromOutside(Hosted):
    """Viewers and tools see what they see of processes of their own."""

    def test_watched_and_asked(self):
        run = self.start_launch(bay(seconds=600), "--hosted", "--rate", "5")
        self.addCleanup(lambda: run.poll() is None and run.kill())
        self.wait_for_go()
        with ensonify.Observer(next(self.runs.glob("ensonify/*/clock.endpoint")).parent) as observer:
            self.assertIn("bow", [each["name"] for each in observer.ask("status")["participants"]])
        heard = self.tool("topic", "hz", "boat/pose", "--count", 20)
        self.assertEqual(heard.returncode, 0, heard.stderr)
        run.send_signal(2)
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 130, errors)


class Wrong(Hosted):
    def test_parameters_of_two_processes_are_named_at_once(self):
        text = bay(seconds=4).replace("run: multibeam", "run: multibeam, config: { beams: -3 }")
        result = self.run_launch(text.replace("run: vehicle", "run: vehicle, config: { pose_rate: 3 }"), "--hosted")
        self.assertEqual(result.code, 2, result.stderr)
        for what in (r"out\.yaml:\d+:\d+: .*beams", r"out\.yaml:\d+:\d+: .*pose_rate"):
            self.assertRegex(result.stderr, what)
        self.assertNotIn(" go ", result.log("clock"))

    def test_parameters_of_a_later_epoch(self):
        run = self.start_launch(bay(seconds=600), "--hosted", "--free")
        self.addCleanup(lambda: run.poll() is None and run.kill())
        self.wait_for_go()
        with ensonify.Observer(next(self.runs.glob("ensonify/*/clock.endpoint")).parent) as observer:
            observer.reset({"bow.beams": -3})
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 2, errors)
        self.assertRegex(errors, r"beams")

    def test_a_message_of_an_agent_that_cannot_be_used(self):
        result = self.run_launch(self.with_agent(GARBAGE), "--hosted", "--free")
        self.assertEqual((result.code, result.report()["culprit"]), (3, "agent"), result.stderr)
        self.assertIn("agent/command", result.stderr)

    def test_an_agent_that_throws_dies_or_stands_still(self):
        for fault, code, words in (("raise ValueError('none')", 3, "ValueError: none"), ("os.kill(os.getpid(), 9)", 3, "signal 9"),
                                   ("os.kill(os.getpid(), 19)", 4, "no progress")):
            with self.subTest(fault):
                text = self.with_agent(fault).replace("duration_s: 10", "duration_s: 10\nclock: { progress_deadline_s: 0.2 }")
                result = self.run_launch(text, "--hosted", "--free")
                self.assertEqual((result.code, result.report()["culprit"]), (code, "agent"), result.stderr)
                self.assertIn(words, result.stderr)

    def test_an_agent_that_may_be_lost(self):
        text = self.with_agent("os.kill(os.getpid(), 9)", ", may_be_lost: true")
        result = self.run_launch(text, "--hosted", "--free")
        self.assertEqual(result.code, 0, result.stderr)
        self.assertIn("agent is lost at t=", result.stderr)

    def test_a_mission_that_is_given_up(self):
        text = bay(seconds=60).replace(str(SOURCE / "scenarios/bay/scenario.yaml"), str(self.write("world.yaml", WORLD)))
        result = self.run_launch(text, "--hosted")
        self.assertEqual((result.code, result.report()["culprit"]), (1, "pilot"), result.stderr)
        self.assertRegex(result.stderr, 'pilot did not reach its goal .*gave_up why="it took longer than abort.after_s"')
        self.assertEqual([each["exit_code"] for each in result.report()["processes"] if each["name"] in ("pilot", "boat")], [0, 1])

    def test_its_program_is_killed(self):
        run = self.start_launch(bay(seconds=600), "--hosted", "--free")
        self.wait_for_go()
        subprocess.run(["kill", "-9", str(self.wait_for_process("ensonify-host"))], check=True)
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 3, errors)
        self.assertIn("clock was killed by signal 9", errors)

    def test_options_that_exclude_one_another(self):
        for other in ("--in-process", "--profile"):
            result = self.run_launch(bay(seconds=1), "--hosted", other)
            self.assertEqual(result.code, 2)
            self.assertRegex(result.stderr, f"{other}.*--hosted|--hosted.*{other}")


WORLD = """
ensonify: scenario/1
site: { latitude_deg: 54.4, longitude_deg: 10.3 }
seabed: { kind: layers, size_m: [400, 400], layers: { ground: { plane: { depth_m: 10 } } } }
vehicles: { boat: { mountings: { bow: { actual: { position_m: [1.5, 0.2, 0.8] } } } } }
mission: { speed_mps: 1.5, abort: { after_s: 3 }, runlines: [{ from_m: [0, -60], to_m: [0, 100] }] }
"""


if __name__ == "__main__":
    unittest.main(verbosity=2)
