"""A participant's mistake ends the run with its name, the right exit code and what was wrong; nobody else is blamed."""
import json
import pathlib
import sys
import unittest

import ensonify
from support import SOURCE, SystemTest, survey

CLIENT = pathlib.Path(__file__).resolve().parent / "rude_client.py"
LAUNCH = """\
ensonify: launch/1
scenario: {source}/scenarios/slope/scenario.yaml
duration_s: 3
clock: {{ rate: free, progress_deadline_s: 0.4 }}
processes:
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: [auv/pose] }} }}
  auv: {{ run: vehicle }}
  foreign: {{ run: [{python}, {client}], config: {{ mistake: "{mistake}" }} }}
{more}
"""
BROKEN, STALL, LOST = 3, 4, 5
# On the data edge: code, then what the verdict says behind "foreign/command: seq 10: ".
MESSAGES = {
    "another magic": (BROKEN, "envelope: magic is not ENS1"),
    "another wire version": (BROKEN, "envelope: wire version 2"),
    "an envelope of 60 bytes": (BROKEN, "envelope: has 60 bytes"),
    "a message of two frames": (BROKEN, "message: fewer than 3 frames"),
    "another number of frames": (BROKEN, "envelope: frame count does not match"),
    "another epoch": (BROKEN, "epoch: is 2"),
    "another publisher": (BROKEN, "publisher: is 77"),
    "another topic id": (BROKEN, "envelope: topic id is 77"),
    "another type": (BROKEN, "type hash: is not that of guidance/1"),
    "no msgpack": (BROKEN, "message is not msgpack at byte 0"),
    "a body cut short": (BROKEN, "message ends early"),
    "a list for a map": (BROKEN, "message is not a map"),
    "text for a number": (BROKEN, "speed_mps: is not a number"),
    "a fraction for an integer": (BROKEN, "stamp_ns: is not an integer in range"),
    "more bytes than declared": (BROKEN, "bytes, declared at most 4096"),
    "a time that is over": (BROKEN, "t_sim: 700000000 ns is before"),
    "a time that never comes": (BROKEN, "t_sim: 9223372036854775807 ns"),
    "a message on a token": (BROKEN, "message: fewer than 3 frames"),
}
OTHERS = {
    "skips a seq": (LOST, "foreign lost messages: foreign/command: seq 10 is missing, 11 came"),
    "counts too many": (LOST, "foreign lost messages: foreign/command: its DONE counted"),
    "a frame of 64 MB": (LOST, "foreign lost messages: foreign/command: "),
    "a flood": (BROKEN, "more than 10 Hz with 12 at once"),
    "next taken back": (BROKEN, "foreign broke the protocol: DONE: next: 899999999 ns is before its promise"),
    "flag 1 without leave": (BROKEN, "DONE: flags: 1 ends the run"),
    "flag 1 in the future": (BROKEN, "DONE: next: with flag 1"),
    "DONE of another epoch": (BROKEN, "DONE: epoch: is 2"),
    "DONE of 9 bytes": (BROKEN, "done: 9 bytes are none"),
    "DONE twice": (BROKEN, "done: answers no GRANT"),
    "DONE for another's topic": (BROKEN, "is not its own"),
    "counts fewer than before": (BROKEN, "foreign/command: count 6 is less than 10 before"),
    "tokens are numbers": (BROKEN, "foreign broke the protocol: proven: tokens: is not a list of texts"),
    "failed with code 0": (BROKEN, "foreign broke the protocol: failed: code: 0 is not an exit code of a failure"),
    "failed": (LOST, "my disk is full"),
    "blames a bystander": (BROKEN, "it was x"),
    "bye early": (BROKEN, "foreign left before the end of the run"),
    "creeps": (STALL, "foreign stands still: 1001 grants"),
    "repeats flag 1": (STALL, "foreign stands still: 1001 grants"),
}
REFUSED = {
    "unknown type version": "foreign/mark: type mark/9 is of an unknown version; known: mark/1",
    "rate is text": "out[0].rate: is not two integers",
    "no sync": "sync: is missing",
    "sync is no endpoint": 'sync: "nonsense" is no endpoint',
}


class Rude(SystemTest):
    def run_with(self, mistake, more="", may_be_lost=False):
        launch = LAUNCH.format(source=SOURCE, python=sys.executable, client=CLIENT, mistake=mistake, more=more)
        if may_be_lost:
            launch = launch.replace("foreign: { run:", "foreign: { may_be_lost: true, run:")
        return self.run_launch(launch, "--quiet", out=mistake.replace(" ", "_").replace("'", ""))

    def check(self, mistake, code, *texts, culprit="foreign"):
        with self.subTest(mistake):
            result = self.run_with(mistake)
            self.assertEqual(result.code, code, result.stderr)
            report = result.report()
            self.assertEqual(report["culprit"], culprit, report["message"])
            for text in texts:
                self.assertIn(text, report["message"])

    def test_without_a_mistake_the_run_is_well(self):
        self.assertEqual(self.run_with("").code, 0)

    def test_a_message_that_cannot_be_used(self):
        for mistake, (code, text) in MESSAGES.items():
            self.check(mistake, code, "foreign sent a message that cannot be used: foreign/command: seq 10: ", text)

    def test_what_breaks_the_protocol_stalls_or_loses(self):
        for mistake, (code, text) in OTHERS.items():
            self.check(mistake, code, text)

    def test_one_that_may_be_lost_is_lost_by_its_message_and_the_run_goes_on(self):
        texts = {mistake: text for mistake, (_, text) in MESSAGES.items()}
        texts |= {mistake: OTHERS[mistake][1] for mistake in ("skips a seq", "counts too many", "a frame of 64 MB", "a flood")}
        for mistake, text in texts.items():
            with self.subTest(mistake):
                result = self.run_with(mistake, may_be_lost=True)
                self.assertEqual(result.code, 0, result.stderr)
                states = {process["name"]: process for process in result.report()["processes"]}
                self.assertEqual(states["foreign"]["state"], "LOST")
                self.assertIn(text, states["foreign"]["lost"]["message"])
                self.assertIn("lost process=foreign", result.log("clock"))
                self.assertEqual(result.clock()["end_ns"], 3_000_000_000)

    def test_a_process_that_outgrows_its_memory_is_named_and_an_observer_is_lost_alone(self):
        grow = f"run: [{sys.executable}, -c, 'import time; x = b\"x\" * 300_000_000; time.sleep(60)'], memory_mb: 200"
        result = self.run_launch(survey(seconds=100000, more=f"  hog: {{ {grow} }}"), "--quiet")
        self.assertEqual((result.code, result.report()["culprit"]), (3, "hog"), result.stderr)
        self.assertRegex(result.report()["message"], r"holds [23]\d\d MB of memory, its memory_mb is 200")
        self.assertLess(result.wall_s, 10)  # to start, to be looked at twice a second, and to end
        watched = survey(seconds=300, more=f"  hog: {{ {grow}, observer: true }}").replace("rate: free", "rate: 100")
        result = self.run_launch(watched, "--quiet", out="observer")
        self.assertEqual(result.code, 0, result.stderr)
        (hog,) = [process for process in result.report()["processes"] if process["name"] == "hog"]
        self.assertEqual(hog["signal"], 9)

    def test_whom_a_participant_blames_must_be_one_that_it_listens_to(self):
        self.check("blames its input", BROKEN, "auv: bad pose", culprit="auv")

    def test_a_wrong_hello_is_2_and_says_what_is_wrong(self):
        for mistake, text in REFUSED.items():
            with self.subTest(mistake):
                result = self.run_with(mistake)
                self.assertEqual(result.code, 2, result.stderr)
                self.assertIn(text, result.stderr)

    def test_a_number_that_is_none_is_refused_counted_and_its_sender_named(self):
        health = "  watcher: { run: recorder, config: { file: health.mcap, topics: [auv/health] } }"
        result = self.run_with("NaN", health)
        self.assertEqual(result.code, 0, result.stderr)
        self.assertIn("auv refused foreign/command: seq 10: speed_mps: is not a finite number", result.log("auv"))
        self.assertEqual(result.log("auv").count(" refused "), 1)
        with ensonify.Record(result.out / "health.mcap") as record:
            counters = {c.name: c.count for _, _, health in record.messages("auv/health") for c in health.counters}
        self.assertEqual(counters, {"refused_foreign/command.speed_mps": 3})


if __name__ == "__main__":
    unittest.main(verbosity=2)
