"""What a run survives, and what it says when it does not: exit code, culprit, nothing left behind."""
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

import ensonify
from support import BIN, SystemTest, survey


class Healthy(SystemTest):
    def test_a_run_ends_with_0_at_the_same_sim_time_each_time(self):
        ends = set()
        for attempt in range(3):
            result = self.run_launch(survey(seconds=3), out=f"out{attempt}")
            self.assertEqual(result.code, 0, result.stderr)
            ends.add(result.clock()["end_ns"])
        self.assertEqual(ends, {4_000_000_000})  # asked for at 3 s, one second of margin

    def test_two_launches_at_once_do_not_see_each_other(self):
        first = self.start_launch(survey(seconds=20), out="a")
        second = self.start_launch(survey(seconds=20), out="b")
        for run in (first, second):
            _, errors = run.communicate(timeout=60)
            self.assertEqual(run.returncode, 0, errors)


class Deaths(SystemTest):
    def check(self, result, code, culprit):
        self.assertEqual(result.code, code, result.stderr)
        self.assertIn(culprit, result.stderr)
        self.assertEqual(result.report()["culprit"], culprit)

    def test_a_thrown_exception_is_3_and_names_the_process(self):
        result = self.run_launch(survey(head="throw_s: 1"))
        self.check(result, 3, "head")
        self.assertIn("told to throw", result.log("head"))

    def test_sigkill_is_3_and_names_the_process(self):
        for process in ("vehicle", "consumer"):
            self.check(self.run_launch(survey(**{process: "die_s: 1"}), out=process), 3, process)

    def test_a_busy_loop_is_a_stall_within_ten_deadlines(self):
        began = time.monotonic()
        result = self.run_launch(survey(navigation="spin_s: 1"))
        self.check(result, 4, "navigation")
        self.assertLess(time.monotonic() - began, 10 * 0.2 + 1 + 2)  # 2 s to start and to reach the fault

    def test_a_stopped_process_is_a_stall_even_when_another_blocks_on_its_queue(self):
        for size in (1000, 4_000_000):
            result = self.run_launch(survey(size=size, seconds=60, consumer="stop_s: 2"), out=f"out{size}")
            self.check(result, 4, "consumer")
            self.assertIn("system_state=T", result.log("clock"))

    def test_a_stopped_clock_is_a_stall_that_names_the_clock(self):
        run = self.start_launch(survey(seconds=100000))
        self.wait_for_go()
        os.kill(self.wait_for_process("ensonify-conductor"), signal.SIGSTOP)
        _, errors = run.communicate(timeout=30)
        self.assertEqual(run.returncode, 4, errors)
        self.assertIn("clock", errors)

    def wait_for_go(self):
        log = self.folder / "out" / "log" / "clock.log"
        while " go " not in (log.read_text() if log.exists() else ""):
            os.sched_yield()

    def wait_for_process(self, name):
        while True:
            for pid, line in self.processes():
                if pathlib.Path(line.split()[0]).name == name:
                    return pid

    def test_a_killed_launcher_leaves_nothing(self):
        run = self.start_launch(survey(seconds=100000))
        self.wait_for_process("ensonify-stub")
        os.kill(run.pid, signal.SIGKILL)
        run.communicate(timeout=10)
        deadline = time.monotonic() + 10
        while self.processes() and time.monotonic() < deadline:
            os.sched_yield()
        self.assertEqual(self.processes(), [])
        self.assertEqual(self.run_launch(survey(seconds=1), out="next").code, 0)  # clears what a dead launch left

    def test_ctrl_c_is_130_and_clean(self):
        run = self.start_launch(survey(seconds=100000))
        self.wait_for_process("ensonify-stub")
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=20)
        self.assertEqual(run.returncode, 130, errors)

    def test_a_removed_socket_directory_does_not_end_a_run_but_no_tool_finds_it(self):
        run = self.start_launch(survey(seconds=8), "--rate", "4")
        self.wait_for_go()
        (directory,) = [path for path in (self.runs / "ensonify").iterdir() if path.is_dir()]
        shutil.rmtree(directory)
        self.assertEqual(self.tool("clock", "--run", directory, "status").returncode, 2)
        _, errors = run.communicate(timeout=30)
        self.assertEqual(run.returncode, 0, errors)


class Records(SystemTest):
    RECORDER = "  recorder: {{ run: recorder, config: {{ file: {file} }} }}"

    def test_a_full_disk_is_5_names_the_recorder_and_leaves_a_readable_record(self):
        small = self.folder / "small"
        small.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", str(small)], capture_output=True).returncode:
            self.skipTest("cannot mount a small tmpfs here (needs root)")
        try:
            result = self.run_launch(survey(seconds=60, size=100_000, more=self.RECORDER.format(file=small / "full.mcap")))
            self.assertEqual(result.code, 5, result.stderr)
            self.assertEqual(result.report()["culprit"], "recorder")
            self.assertIn("full.mcap", result.stderr)
            with ensonify.Record(small / "full.mcap") as record:
                self.assertGreater(sum(1 for _ in record.messages("head/ping")), 10)
        finally:
            subprocess.run(["umount", "-l", str(small)], check=True)

    def test_a_slow_consumer_costs_lateness_not_data(self):
        result = self.run_launch(survey(seconds=2, consumer="jitter_ms: 300"), "--rate", "1")
        self.assertEqual(result.code, 0, result.stderr)
        late = {p["name"]: p["late_events"] for p in result.clock()["participants"]}
        self.assertGreater(late["consumer"], 0)
        self.assertEqual(late["vehicle"], 0)


class Mistakes(SystemTest):
    def refused(self, launch, *texts, options=()):
        result = self.run_launch(launch, *options)
        self.assertEqual(result.code, 2, result.stderr)
        for text in texts:
            self.assertIn(text, result.stderr)

    def test_wiring_mistakes_are_2_with_place_and_cause(self):
        self.refused(survey(more="wiring: { consumer.ping: { topic: head/pong } }"), "wiring.consumer.ping",
                     "did you mean head/ping?")
        self.refused(survey(more="wiring: { consumer.ping: { topic: vehicle/pose } }"), "vehicle/pose is pose_stub/1")
        self.refused(survey().replace("delay_ms: 100", "delay_ms: 0"), "a cycle without a delayed edge")
        self.refused(survey(more="  second: { run: stub, config: { out: [{port: ping, type: ping_stub/1}] } }"),
                     "several publishers offer ping_stub/1 (head/ping, second/ping)")

    def test_a_wrong_parameter_is_2_with_its_line(self):
        self.refused(survey(head="thrwo_s: 1"), "out.yaml:", "is not a known key")

    def test_output_folders_that_cannot_be_written(self):
        self.refused_out(self.write("file", "x") / "out")
        self.refused_out("/proc/ensonify/out")

    def refused_out(self, out):
        launch = self.write("l.yaml", survey(seconds=1))
        done = subprocess.run([str(BIN / "ensonify"), "run", str(launch), "--out", str(out)], capture_output=True, text=True,
                              env=self.environment, timeout=30)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(str(out), done.stderr)

    def test_a_300_character_output_path_works_or_is_named(self):
        long = "/".join(["d" * 100] * 3)
        launch = self.write("l.yaml", survey(seconds=1))
        done = subprocess.run(self.command(launch, out=long), capture_output=True, text=True, env=self.environment, timeout=30)
        self.assertEqual(done.returncode, 0, done.stderr)  # sockets are never under the output folder
        self.assertTrue((self.folder / long / "run.json").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
