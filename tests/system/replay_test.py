"""A record fed back through whole runs: nothing skipped, nothing changed."""
import json
import subprocess
import unittest

from support import BIN, SystemTest, survey

RECORDER = "  recorder: {{ run: recorder, config: {{ file: {file} }} }}"

# `head` takes the place of the recorded head; a new recorder listens to it.
TAKE_OVER = """
ensonify: launch/1
clock: {{ rate: free }}
processes:
  head: {{ run: replay, config: {{ file: {record}, topics: [head/ping], finish: true }} }}
  slow: {{ run: stub, config: {{ rate_hz: 20, in: [{{port: ping, type: ping_stub/1}}] }} }}
  recorder: {{ run: recorder, config: {{ file: again.mcap, topics: [head/ping] }} }}
"""


class Replay(SystemTest):
    def compare(self, *words):
        done = subprocess.run([BIN / "ensonify-compare", *map(str, words)], capture_output=True, text=True)
        return done.returncode, done.stdout

    def record(self):
        result = self.run_launch(survey(seconds=3, more=RECORDER.format(file="a.mcap")))
        self.assertEqual(result.code, 0, result.stderr)
        return result.out / "a.mcap"

    def recorded(self):
        return self.kept("a.mcap", self.record)

    def test_a_replay_in_the_place_of_a_head_gives_the_same_messages(self):
        record = self.recorded()
        result = self.run_launch(TAKE_OVER.format(record=record), out="again")
        self.assertEqual(result.code, 0, result.stderr)
        code, text = self.compare("--topic", "head/ping", record, result.out / "again.mcap")
        self.assertEqual(code, 0, text)
        self.assertRegex(text, r"^same: [1-9]\d+ messages on 1 topics")

    def test_the_verb_replays_everything_and_ends(self):
        record = self.recorded()
        done = subprocess.run([BIN / "ensonify", "replay", record, "--free", "--out", self.folder / "played"],
                              capture_output=True, text=True, timeout=60, env=self.environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads((self.folder / "played/run.json").read_text())
        self.assertEqual(report["exit_code"], 0)

    def test_a_record_that_is_none_or_lacks_the_topic_is_2(self):
        record = self.recorded()
        wrong = self.run_launch(TAKE_OVER.format(record=record).replace("topics: [head/ping], finish", "topics: [head/pong], finish"),
                                out="wrong")
        self.assertEqual(wrong.code, 2, wrong.stderr)
        self.assertIn("holds no head/pong (did you mean head/ping?)", wrong.stderr)
        text = self.write("text.mcap", "no record")
        none = self.run_launch(TAKE_OVER.format(record=text), out="none")
        self.assertEqual(none.code, 2, none.stderr)
        self.assertIn("is no record", none.stderr)


if __name__ == "__main__":
    unittest.main()
