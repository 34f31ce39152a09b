"""A reset begins another epoch in the same processes: its bytes are those of a fresh launch with the same seed and overrides.
All shipped launches that need nobody from outside with ENSONIFY_EPOCH_LAUNCHES=all, else three."""
import hashlib
import json
import os
import unittest

import ensonify
from support import SOURCE, SystemTest, bay, survey

UNTIL_S = 5.0
ENDS_S = {"quay": 2.9}  # before that
SHIPPED = ("acquisition", "adaptive", "agent", "demo", "forward_looking", "interference", "navigation", "patch_survey", "quay", "scanning",
           "sidescan", "survey_10km", "towed", "uncertainty", "underwater")
LAUNCHES = SHIPPED if os.environ.get("ENSONIFY_EPOCH_LAUNCHES") == "all" else ("agent", "navigation")


class Epochs(SystemTest):
    def start(self, launch, *options, out="out"):
        run = self.start_launch(launch, "--free", *options, out=out)
        self.addCleanup(lambda: run.poll() is None and run.kill())
        self.wait_for_go(out)
        return run

    def observer(self):
        endpoints = list(self.runs.glob("ensonify/*/clock.endpoint"))
        return ensonify.Observer(endpoints[0].parent)

    def wait_until(self, run, observer, t_s, epoch=1):
        """Until sim time has come so far in an epoch; None once the run has ended."""
        while run.poll() is None:
            try:
                status = observer.ask("status")
            except ensonify.RunError:
                continue
            if status["epoch"] == epoch and status["state"] == "running" and status["sim_ns"] > t_s * 1e9:
                return
            os.sched_yield()
        self.fail(f"the run ended with {run.returncode}: {run.stderr.read()}")

    def end(self, run):
        """As Ctrl-C does: files are completed, and nothing is done with them."""
        run.send_signal(2)
        _, errors = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 130, errors)


class SameBytes(Epochs):
    def messages(self, record, until_s):
        """Bytes of each topic's messages up to a time, and how many there are."""
        found, count = {}, 0
        with ensonify.Record(record) as file:
            for topic, t_ns, content in file.messages("*"):
                if topic == "log/health":  # counts what a network refuses: of this machine, not of the run
                    continue
                if t_ns <= until_s * 1e9:
                    found.setdefault(topic, hashlib.sha256()).update(f"{t_ns} {self.text(content)}".encode())
                    count += 1
        return {topic: digest.hexdigest() for topic, digest in found.items()}, count

    def text(self, value):
        if hasattr(value, "to_map"):
            value = value.to_map()
        if isinstance(value, dict):
            return "{" + ",".join(f"{key}:{self.text(each)}" for key, each in value.items()) + "}"
        if isinstance(value, (list, tuple)):
            return "[" + ",".join(map(self.text, value)) + "]"
        if hasattr(value, "tobytes"):
            return f"{value.dtype}{value.shape}{hashlib.sha256(value.tobytes()).hexdigest()}"
        return repr(value)

    def check(self, launch, name, *options):
        """First another scene, then one with another seed, then the one that is compared. `options` of the run with epochs."""
        until_s = ENDS_S.get(name, UNTIL_S)
        other_s = min(2.0, 0.5 * until_s)
        fresh = self.start(launch, "--set", "seed=7", "--record", self.folder / f"fresh_of_{name}.mcap", out=f"{name}_fresh")
        with self.observer() as observer:
            self.wait_until(fresh, observer, until_s)
        self.end(fresh)
        run = self.start(launch, *options, "--record", self.folder / f"epochs_of_{name}.mcap", out=name)
        with self.observer() as observer:
            self.wait_until(run, observer, 1.0)
            self.assertEqual(observer.reset({"seed": 3, "water.sound_speed_mps": 1520} if name == "bay" else {"seed": 3}), 2)
            self.wait_until(run, observer, other_s, epoch=2)
            self.assertEqual(observer.reset({"seed": 7}, out=self.folder / name / "third"), 3)
            self.wait_until(run, observer, until_s, epoch=3)
        self.end(run)
        wanted, count = self.messages(self.folder / f"fresh_of_{name}.mcap", until_s)
        self.assertGreater(count, 100)
        has, _ = self.messages(self.folder / name / "third" / f"epochs_of_{name}.mcap", until_s)
        self.assertEqual([topic for topic in wanted if has.get(topic) != wanted[topic]], [], name)
        self.assertEqual(has.keys(), wanted.keys())
        other, _ = self.messages(self.folder / name / "epochs" / "2" / f"epochs_of_{name}.mcap", other_s)
        self.assertNotEqual(other, self.messages(self.folder / f"fresh_of_{name}.mcap", other_s)[0], "another seed must differ")
        first, _ = self.messages(self.folder / f"epochs_of_{name}.mcap", 1.0)  # nothing of it is lost
        self.assertTrue(first)

    def bay(self):
        return self.write("bay.yaml", bay(600).replace("  recorder: { run: recorder, config: { file: run.mcap, topics: all } }\n", ""))

    def test_a_survey_with_a_multibeam(self):
        self.check(self.bay(), "bay")

    def test_the_same_in_the_clocks_program(self):
        self.check(self.bay(), "bay", "--hosted")

    def test_shipped_launches(self):
        for name in LAUNCHES:
            with self.subTest(name):
                self.check(SOURCE / "launch" / f"{name}.yaml", name)


class Files(Epochs):
    def test_each_epoch_has_a_folder_and_a_report(self):
        run = self.start(survey(seconds=3, more="  recorder: { run: recorder, config: { file: run.mcap } }"), "--set", "clock.rate=5")
        with self.observer() as observer:
            self.wait_until(run, observer, 0.5)
            observer.reset()
            self.wait_until(run, observer, 0.0, epoch=2)
            self.assertEqual([observer.ask("status")["epoch"], observer.ask("status")["end_ns"]], [2, None])
        _, errors = run.communicate(timeout=60)  # the pilot ends it after 3 s
        self.assertEqual(run.returncode, 0, errors)
        first, second = self.folder / "out", self.folder / "out" / "epochs" / "2"
        for folder, least, most in ((first, 0.5, 2.9), (second, 3.0, 4.1)):
            with ensonify.Record(folder / "run.mcap") as record:
                last_s = max(t_ns for _, t_ns, _ in record.messages("*")) * 1e-9
            self.assertTrue(least <= last_s <= most, (folder, last_s))
        report = json.loads((second / "clock.json").read_text())
        self.assertEqual((report["epoch"], report["state"]), (2, "done"))
        self.assertEqual(json.loads((first / "clock.json").read_text())["epoch"], 2)  # the run's own: its last
        self.assertEqual(json.loads((first / "run.json").read_text())["exit_code"], 0)

    def test_a_paused_run_waits_at_0(self):
        run = self.start(survey(seconds=3))
        with self.observer() as observer:
            observer.ask("pause")
            self.assertEqual(observer.reset(), 2)
            while (status := observer.ask("status"))["epoch"] == 1 or status["state"] == "connecting":
                pass
            self.assertEqual((status["state"], status["sim_ns"], status["epoch"]), ("paused", 0, 2))
            observer.ask("resume")
        self.assertEqual(run.wait(60), 0)
        self.assertEqual(run.stderr.read().count("failed"), 0)


class Refused(Epochs):
    """What is refused is said by name, and the epoch goes on."""

    def refusal(self, observer, *arguments, **named):
        with self.assertRaises(ensonify.RunError) as caught:
            observer.reset(*arguments, **named)
        self.assertEqual(caught.exception.code, 2)
        self.assertEqual(observer.ask("status")["epoch"], 1)
        return str(caught.exception)

    def test_what_a_launch_fixes(self):
        run = self.start(bay(600))
        with self.observer() as observer:
            self.assertIn("clock.rate=2: the clock's settings hold for the whole launch", self.refusal(observer, {"clock.rate": 2}))
            self.assertIn("did you mean bow", self.refusal(observer, {"bwo.beams": 64}))
            self.assertIn("seed", self.refusal(observer, {"seed": "many"}))
            blocked = self.write("file", "")
            self.assertIn(str(blocked), self.refusal(observer, out=blocked / "folder"))
            for wrong in ({"set": "seed=1"}, {"set": [1]}, {"out": 5}, {"set": ["seed"]}):
                self.assertFalse(observer.ask("reset", **wrong)["ok"], wrong)
            asked = self.tool("clock", "reset", "--run", observer.clock, "--set", "clock.rate=2")
            self.assertEqual((asked.returncode, asked.stdout), (2, ""))
            self.assertIn("clock.rate=2", asked.stderr)
            asked = self.tool("clock", "reset", "--run", observer.clock, "--seed", 4, "--out", self.folder / "four")
            self.assertEqual((asked.returncode, asked.stdout), (0, f"epoch 2 begins; results in {self.folder / 'four'}\n"))
            self.wait_until(run, observer, 0.1, epoch=2)
            self.assertEqual(observer.ask("get", what="seed")["text"], "4")
        self.end(run)

    def test_a_process_that_cannot(self):
        agent = self.write("agent.py", "import ensonify\nwith ensonify.Participant() as me:\n    for step in me.steps(rate=10): pass\n")
        run = self.start(survey(seconds=1000, more=f"  old: {{ run: [python3, {agent}] }}"))
        with self.observer() as observer:
            self.assertIn("old: cannot begin another epoch", self.refusal(observer))
        self.end(run)

    def ended(self, run):
        """The words of a run that a reset ended."""
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 2, errors)
        return errors

    def test_a_process_that_refuses_its_parameters_ends_the_run_in_its_name(self):
        run = self.start(bay(600))
        with self.observer() as observer:
            observer.reset({"bow.beams": -3})
        errors = self.ended(run)
        self.assertRegex(errors, r"bow\.beams|beams: ")

    def test_other_ports_end_the_run_by_name(self):
        run = self.start(survey(seconds=1000))
        with self.observer() as observer:
            observer.reset({"head.out": [{"port": "image", "type": "ping_stub/1", "hz": 20}]})
        self.assertIn("head/image of type ping_stub/1: is new; only a new launch can have it", self.ended(run))


class Agent(Epochs):
    AGENT = """
import json, sys
import ensonify

with ensonify.Participant("agent") as me:
    poses = me.subscribe("pose", topics=["vehicle/pose"])
    said = []
    for epoch in me.epochs():
        for n, step in enumerate(me.steps(rate=10)):
            if n == 0:
                said.append([epoch, step.t_ns, poses.latest is None, me.facts["seed"]])
            if n == 5 and epoch < 4:
                try:
                    me.reset({"clock.rate": 2})
                except ensonify.RunError as error:
                    said[-1].append(error.code)
                me.reset({"seed": 10 + epoch})
                if epoch == 2:
                    break  # what a step after it would do is no matter
    print(json.dumps(said), file=open(sys.argv[1], "w"))
"""

    def test_an_agent_resets_at_a_step_and_goes_on_in_the_next_epoch(self):
        agent = self.write("agent.py", self.AGENT)
        result = self.run_launch(survey(seconds=2, more=f"  agent: {{ run: [python3, {agent}, {self.folder / 'said.json'}] }}\n"
                                         f"scenario: {SOURCE}/scenarios/bay/scenario.yaml"))
        self.assertEqual(result.code, 0, result.stderr)
        said = json.loads((self.folder / "said.json").read_text())
        self.assertEqual(said, [[1, 0, False, "20250601", 2], [2, 0, False, "11", 2], [3, 0, False, "12", 2], [4, 0, False, "13"]])

    def test_an_agent_that_lets_an_epoch_pass_is_named(self):
        agent = self.write("agent.py", "import ensonify\nwith ensonify.Participant('agent') as me:\n    for epoch in me.epochs():\n"
                                       "        for step in me.steps(rate=10) if epoch == 1 else ():\n            me.reset()\n")
        result = self.run_launch(survey(seconds=2, more=f"  agent: {{ run: [python3, {agent}] }}"))
        self.assertEqual(result.code, 3, result.stderr)
        self.assertIn("RuntimeError: each epoch is to be gone through by steps()", result.stderr)


if __name__ == "__main__":
    unittest.main()
