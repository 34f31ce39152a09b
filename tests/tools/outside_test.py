"""What a user does to a live run from outside: publishes as its external participant, records it as an observer."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

import ensonify
from live_run import BIN, LiveRun

# A boat takes the commands of somebody else.
LAUNCH = """\
ensonify: launch/1
processes:
  boat: { run: stub, config: { rate_hz: 10, finish_s: 5, in: [{port: command, type: guidance/1}], out: [{port: pose, type: pose_blob/1}] } }
  helm: { run: [helm], external: true, join_s: 60 }
  fish: { run: stub, config: { rate_hz: 10 } }
"""


class Outside(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="ens-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.environment = {**os.environ, "XDG_RUNTIME_DIR": str(self.folder)}
        self.environment.pop("ENSONIFY_RUN", None)

    def launch(self, text, *words):
        """A run that awaits its external participant."""
        (self.folder / "x.yaml").write_text(text)
        words = [BIN / "ensonify-run", self.folder / "x.yaml", "--out", self.folder / "out", "--name", "x", *words]
        run = self.enterContext(subprocess.Popen(words, env=self.environment, stderr=subprocess.PIPE, text=True))
        while run.poll() is None and self.tool("clock", "status", "--run", "x")[0] != 0:
            pass
        return run

    def tool(self, *words):
        done = subprocess.run([BIN / f"ensonify-{words[0]}", *words[1:]], env=self.environment, capture_output=True, text=True,
                              timeout=60)
        return done.returncode, done.stdout, done.stderr

    def test_an_external_participant_publishes_and_others_are_refused(self):
        run = self.launch(LAUNCH, "--record", self.folder / "x.mcap")
        for words, said in ((("fish/command", "guidance/1"), "fish: is no external participant of this run; there are helm"),
                            (("nobody/command", "guidance/1"), "nobody: is no external participant of this run; there are helm"),
                            (("helm/command", "guidence/1"), "guidence/1: is no type of messages; did you mean guidance/1?"),
                            (("helm/command", "guidance/1", "speed_mp=1"), "guidance/1: has no field speed_mp; did you mean speed_mps?"),
                            (("helm", "guidance/1"), "helm: is no topic of a participant; allowed: PROCESS/PORT")):
            code, _, error = self.tool("topic", "pub", *words)
            self.assertEqual(code, 2, error)
            self.assertIn(said, error)
        code, _, error = self.tool("topic", "pub", "helm/command", "guidance/1", "--count", "0")
        self.assertEqual(code, 2, error)
        self.assertIn("--count", error)
        clock = json.loads(self.tool("clock", "list", "--json")[1])[0]["clock"]
        self.assertTrue(clock.startswith("ipc://"), clock)
        code, _, error = self.tool("topic", "pub", "--run", clock, "helm/command", "guidance/1", "speed_mps=1.5", "heading_grid_rad=0.25",
                                   "--rate", "2", "--count", "3")
        self.assertEqual(code, 0, error)
        self.assertEqual(run.wait(20), 0, run.stderr.read())
        with ensonify.Record(self.folder / "x.mcap") as record:
            sent = list(record.messages("helm/command"))
        self.assertEqual([(m.t_sim_ns, m.content.stamp_ns, m.content.speed_mps, m.content.heading_grid_rad) for m in sent],
                         [(t, t, 1.5, 0.25) for t in (0, 500_000_000, 1_000_000_000)])

    def test_a_run_without_externals_takes_nobody(self):
        with LiveRun() as run:
            code, _, error = run.tool("topic", "pub", "helm/command", "guidance/1")
            self.assertEqual(code, 2)
            self.assertIn("helm: is no external participant of this run; its launch file declares none (`external: true`)", error)

    def test_a_live_record_holds_what_the_run_published_and_counts_what_it_missed(self):
        run = self.launch(LAUNCH.replace("finish_s: 5", "finish_s: 3"), "--record", self.folder / "all.mcap", "--rate", "2")
        words = [BIN / "ensonify-record", "live", self.folder / "live.mcap", "--run", "x", "--json"]
        with subprocess.Popen(words, env=self.environment, stdout=subprocess.PIPE, text=True) as live:
            self.assertEqual(self.tool("topic", "pub", "helm/command", "guidance/1")[0], 0)
            text, _ = live.communicate(timeout=30)
        self.assertEqual(run.wait(20), 0, run.stderr.read())
        said = json.loads(text)
        with ensonify.Record(self.folder / "all.mcap") as everything, ensonify.Record(self.folder / "live.mcap") as seen:
            self.assertTrue(seen.whole)
            self.assertEqual(seen.info, everything.info)
            self.assertEqual(seen.attachments, everything.attachments)
            missed = seen.missed
            self.assertEqual(set(missed), {*everything.topics(), "recorder/health"})
            published = [(m.topic, m.t_sim_ns, str(m.content)) for m in everything.messages()]
            received = [(m.topic, m.t_sim_ns, str(m.content)) for m in seen.messages()]
        self.assertEqual(len(received), said["received"])
        # On a busy machine an observer misses some; then it says how many, of each topic.
        total = sum(missed.values())
        self.assertEqual((live.returncode, said["missed"], said["run_ended"]), (5 if total else 0, total, True))
        for topic in {m[0] for m in received} - {"recorder/health"}:
            got = [m[1] for m in received if m[0] == topic]
            between = [m[1] for m in published if m[0] == topic and got[0] <= m[1] <= got[-1]]
            lost = len(between) - sum(t_ns <= published[-1][1] for t_ns in got)
            self.assertEqual(max(lost, 0), missed[topic], topic)
        # From the first that it took to the recorder's last event it has them in the same order.
        first, last_ns = published.index(received[0]), published[-1][1]
        kept = [m for m in received if m[0] != "recorder/health" and m[1] <= last_ns]
        self.assertEqual(kept, [m for m in published[first:] if m in kept])
        self.assertGreater(len(kept), 20)  # of 2 * 30 and some
        self.assertEqual(self.tool("record", "repair", self.folder / "live.mcap")[0], 0)
        self.read_with_the_official_reader(said["received"], missed["boat/pose"])

    def read_with_the_official_reader(self, messages, missed):
        try:
            from mcap.reader import SeekingReader
        except ImportError:
            self.skipTest("PyPI's mcap is not installed (./dev test installs it into build/venv)")
        with open(self.folder / "live.mcap", "rb") as stream:
            reader = SeekingReader(stream, validate_crcs=True)
            self.assertEqual(sum(1 for _ in reader.iter_messages()), messages)
            kept = {metadata.name: metadata.metadata for metadata in reader.iter_metadata()}
        self.assertEqual(kept["ensonify_live"]["boat/pose/missed"], str(missed))

    def test_a_live_record_ends_with_the_epoch(self):
        with LiveRun(rate=2) as run:
            environment = {**self.environment, "XDG_RUNTIME_DIR": str(run.runtime)}
            words = [BIN / "ensonify-record", "live", self.folder / "live.mcap", "auv/*", "--json"]
            with subprocess.Popen(words, env=environment, stdout=subprocess.PIPE, text=True) as live:
                while not (self.folder / "live.mcap").exists():
                    self.assertIsNone(live.poll())
                run.tool("clock", "reset")
                while live.poll() is None and run.json("clock", "status")["epoch"] < 3:  # should the first have been over already
                    run.tool("clock", "reset")
                text, _ = live.communicate(timeout=20)
            self.assertIn(live.returncode, (0, 5))  # 5: a busy machine, and it says so
            self.assertEqual((json.loads(text)["reset"], json.loads(text)["run_ended"]), (True, False))
            with ensonify.Record(self.folder / "live.mcap") as record:
                times = [message.t_sim_ns for message in record.messages("auv/pose")]
            self.assertEqual(times, sorted(set(times)))  # of one epoch

    def test_a_live_record_that_is_interrupted_is_whole(self):
        with LiveRun() as run:
            environment = {**self.environment, "XDG_RUNTIME_DIR": str(run.runtime)}
            words = [BIN / "ensonify-record", "live", self.folder / "live.mcap", "auv/*"]
            with subprocess.Popen(words, env=environment, stdout=subprocess.PIPE, text=True) as live:
                while not (self.folder / "live.mcap").exists():
                    self.assertIsNone(live.poll())
                live.send_signal(signal.SIGINT)
                text, _ = live.communicate(timeout=20)
            self.assertEqual(live.returncode, 130)
            self.assertIn("none missed between a topic's first and last; the run goes on", text)
            with ensonify.Record(self.folder / "live.mcap") as record:
                self.assertTrue(record.whole)
                self.assertEqual(sorted(record.topics()), ["auv/health", "auv/pose"])
                for topic in record.topics():
                    self.assertEqual(f"{topic}: nothing came\n" in text, not list(record.messages(topic)))
            code, _, error = run.tool("record", "live", str(self.folder / "other.mcap"), "auv/pos")
            self.assertEqual((code, error), (2, "ensonify record: auv/pos: names no topic of this run; `ensonify topic list` shows them\n"))
            self.assertFalse((self.folder / "other.mcap").exists())


if __name__ == "__main__":
    unittest.main()
