"""What a run survives, and what it says when it does not: exit code, culprit, nothing left behind."""
import collections
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree as xml

import ensonify
from support import BIN, Result, SystemTest, survey


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
    STALL_S = 10 * 0.2  # ten deadlines of the launch file
    START_S = 2  # to start, and to reach the fault

    def check(self, result, code, culprit, within_s):
        self.assertEqual(result.code, code, result.stderr)
        self.assertIn(f"ensonify run: {culprit}", result.stderr)
        self.assertEqual(result.report()["culprit"], culprit)
        self.assertLess(result.wall_s, self.START_S + within_s)

    def test_a_thrown_exception_is_3_and_names_the_process(self):
        result = self.run_launch(survey(head="throw_s: 1"))
        self.check(result, 3, "head", 1)
        self.assertIn("told to throw", result.stderr)
        self.assertIn("told to throw", result.log("head"))

    def test_sigkill_is_3_and_names_the_process(self):
        for process in ("vehicle", "consumer"):
            result = self.run_launch(survey(**{process: "die_s: 1"}), out=process)
            self.check(result, 3, process, 1)
            self.assertIn("was killed by signal 9 (Killed)", result.stderr)

    def test_a_busy_loop_is_a_stall_after_ten_deadlines(self):
        result = self.run_launch(survey(navigation="spin_s: 1"))
        self.check(result, 4, "navigation", self.STALL_S + 1)
        self.assertGreater(result.wall_s, self.STALL_S)

    def test_a_stopped_process_is_a_stall_even_when_another_blocks_on_its_queue(self):
        for size in (1000, 4_000_000):
            result = self.run_launch(survey(size=size, seconds=60, consumer="stop_s: 2"), out=f"out{size}")
            self.check(result, 4, "consumer", self.STALL_S + 1 + 2)  # 2 s of 4 MB messages until it stops
            self.assertGreater(result.wall_s, self.STALL_S)
            self.assertIn("system_state=T", result.log("clock"))

    def test_a_clock_that_is_stopped_is_4_and_one_that_is_killed_3(self):
        for number, code, words in ((signal.SIGSTOP, 4, "clock has not answered for 2.0 s"),
                                    (signal.SIGKILL, 3, "clock was killed by signal 9")):
            run = self.start_launch(survey(seconds=100000), out=number.name)
            self.wait_for_go(number.name)
            os.kill(self.wait_for_process("ensonify-conductor"), number)
            _, errors = run.communicate(timeout=30)
            self.assertEqual(run.returncode, code, errors)
            self.assertIn(f"ensonify run: {words}", errors)

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

    def test_ctrl_c_and_sigterm_are_130_and_an_orderly_end(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            run = self.start_launch(survey(seconds=100000, more="after: [[touch, $(out)/after]]"), out=number.name)
            self.wait_for_go(number.name)
            run.send_signal(number)
            _, errors = run.communicate(timeout=20)
            self.assertEqual(run.returncode, 130, errors)
            self.assertIn("stopping in order", errors)
            report = json.loads((self.folder / number.name / "run.json").read_text())
            self.assertEqual({process["state"] for process in report["processes"]}, {"DONE"})
            self.assertFalse((self.folder / number.name / "after").exists())

    def test_a_removed_socket_directory_does_not_end_a_run_but_no_tool_finds_it(self):
        run = self.start_launch(survey(seconds=8), "--rate", "4")
        self.wait_for_go()
        (directory,) = [path for path in (self.runs / "ensonify").iterdir() if path.is_dir()]
        shutil.rmtree(directory)
        self.assertEqual(self.tool("clock", "--run", directory, "status").returncode, 2)
        _, errors = run.communicate(timeout=30)
        self.assertEqual(run.returncode, 0, errors)


class Loaded(SystemTest):
    """With eight busy loops beside, who is to blame is still who is blamed."""

    def setUp(self):
        super().setUp()
        for _ in range(8):
            busy = subprocess.Popen(["sh", "-c", "while :; do :; done"])
            self.addCleanup(busy.wait)
            self.addCleanup(busy.kill)

    def test_a_participant_that_is_stopped_is_blamed(self):
        for process in ("vehicle", "navigation", "pilot", "head", "consumer"):
            run = self.start_launch(survey(seconds=100000), out=process)
            self.wait_for_go(process)
            programs = {pid: line for pid, line in self.processes() if "ensonify-stub" in line.split()[0]}
            (pid,) = [pid for pid, line in programs.items() if f"--name {process} " in line]
            os.kill(pid, signal.SIGSTOP)
            _, errors = run.communicate(timeout=60)
            self.assertEqual((run.returncode, json.loads((self.folder / process / "run.json").read_text())["culprit"]), (4, process), errors)

    def test_who_never_says_hello_is_blamed(self):
        mute = survey(seconds=1, more="  mute: { run: [sleep, '1000'] }\n" + Records.RECORDER.format(file="run.mcap"))
        result = self.run_launch(mute.replace("rate: free", "rate: free, connect_timeout_s: 10"))
        self.assertEqual((result.code, result.report()["culprit"]), (4, "mute"), result.stderr)
        self.assertIn("no hello from: mute", result.stderr)


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
            counted, read = self.read_officially(small / "full.mcap")
            self.assertEqual(counted, read)
        finally:
            subprocess.run(["umount", "-l", str(small)], check=True)

    def read_officially(self, file):
        """Messages by the summary and by following it, as the official reader finds them."""
        from mcap.reader import SeekingReader
        with open(file, "rb") as stream:
            reader = SeekingReader(stream, validate_crcs=True)
            return reader.get_summary().statistics.message_count, sum(1 for _ in reader.iter_messages())

    def test_a_run_that_dies_leaves_a_record_with_its_index(self):
        for out, faults in (("dies", {"head": "die_s: 20"}), ("spins", {"navigation": "spin_s: 20"}), ("tcp", {"head": "die_s: 20"})):
            launch = survey(seconds=60, more=self.RECORDER.format(file="run.mcap"), **faults)
            if out == "tcp":
                launch = launch.replace("rate: free", "rate: free, transport: tcp")
            result = self.run_launch(launch, out=out)
            self.assertNotEqual(result.code, 0)
            counted, read = self.read_officially(self.folder / out / "run.mcap")
            self.assertEqual(counted, read)
            self.assertGreater(counted, 1000)

    def test_a_killed_launcher_leaves_a_record_with_its_index(self):
        run = self.start_launch(survey(seconds=100000, more=self.RECORDER.format(file="run.mcap")))
        self.wait_for_go()
        record = self.folder / "out" / "run.mcap"
        while not record.exists() or record.stat().st_size < 100_000:
            time.sleep(0.01)
        os.kill(run.pid, signal.SIGKILL)
        run.communicate(timeout=10)
        while self.processes():
            time.sleep(0.01)
        counted, read = self.read_officially(record)
        self.assertEqual(counted, read)
        self.assertGreater(counted, 100)
        self.assertEqual(self.run_launch(survey(seconds=1), out="next").code, 0)  # clears what a dead launch left

    def test_a_killed_recorders_record_is_mended_by_repair(self):
        run = self.start_launch(survey(seconds=100000, more=self.RECORDER.format(file="run.mcap")))
        self.wait_for_go()
        record = self.folder / "out" / "run.mcap"
        while not record.exists() or record.stat().st_size < 100_000:
            time.sleep(0.01)
        busy = self.tool("record", "repair", record)
        self.assertEqual((busy.returncode, "another process is writing it" in busy.stderr), (2, True), busy.stderr)
        os.kill(self.wait_for_process("ensonify-recorder"), signal.SIGKILL)
        _, errors = run.communicate(timeout=30)
        self.assertEqual(run.returncode, 3, errors)
        self.assertIn("ensonify run: recorder was killed by signal 9", errors)
        self.assertEqual(self.tool("record", "repair", record).returncode, 0)
        counted, read = self.read_officially(record)
        self.assertEqual(counted, read)
        self.assertGreater(counted, 100)

    def test_a_second_run_with_the_same_output_folder_is_refused_and_spoils_nothing(self):
        run = self.start_launch(survey(seconds=100000, more=self.RECORDER.format(file="run.mcap")))
        self.wait_for_go()
        second = self.run_launch(survey(seconds=1, more=self.RECORDER.format(file="run.mcap")))
        self.assertEqual(second.code, 2, second.stderr)
        self.assertIn("another run puts its results there; choose another folder with --out", second.stderr)
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=20)
        self.assertEqual(run.returncode, 130, errors)
        counted, read = self.read_officially(self.folder / "out" / "run.mcap")
        self.assertEqual(counted, read)

    def test_a_full_runtime_directory_is_2_and_names_file_and_cause(self):
        small = self.folder / "runs" / "small"
        small.mkdir(mode=0o700)
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k,mode=700", "tmpfs", str(small)], capture_output=True).returncode:
            self.skipTest("cannot mount a small tmpfs here (needs root)")
        try:
            with open(small / "fill", "wb", buffering=0) as fill:
                try:
                    while fill.write(b" " * 1024):
                        pass
                except OSError:
                    pass
            self.environment["XDG_RUNTIME_DIR"] = str(small)
            result = self.run_launch(survey(seconds=1))
            self.assertEqual(result.code, 2, result.stderr)
            self.assertRegex(result.stderr, "about.json: cannot be written: No space left on device; allowed")
        finally:
            subprocess.run(["umount", "-l", str(small)], check=True)

    def test_a_slow_consumer_costs_lateness_not_data(self):
        result = self.run_launch(survey(seconds=2, consumer="jitter_ms: 300"), "--rate", "1")
        self.assertEqual(result.code, 0, result.stderr)
        late = result.late_events()
        self.assertGreater(late["consumer"], 0)
        self.assertEqual(late["vehicle"], 0)

    def test_a_slow_recorder_costs_lateness_not_data(self):
        """It is slowed from outside: stopped for 0.15 s out of 0.207 s, which is below the clock's deadline of 0.2 s and
        above the 0.1 s behind paced time from which a run counts as late. Its events come every 0.1 s; the pauses drift
        through that, or each could fall where it costs less."""
        run = self.start_launch(survey(seconds=4, more=self.RECORDER.format(file="slow.mcap")), "--rate", "1")
        self.wait_for_go()
        recorder = self.wait_for_process("ensonify-recorder")
        while run.poll() is None:
            for number, pause_s in ((signal.SIGSTOP, 0.15), (signal.SIGCONT, 0.057)):
                try:
                    os.kill(recorder, number)
                except ProcessLookupError:
                    break
                time.sleep(pause_s)
        _, errors = run.communicate(timeout=20)
        self.assertEqual(run.returncode, 0, errors)
        late = Result(run.returncode, "", errors, self.folder / "out").late_events()
        self.assertGreater(late["recorder"], 0)
        self.assertEqual(max(late, key=late.get), "recorder")
        with ensonify.Record(self.folder / "out" / "slow.mcap") as record:
            seen = collections.Counter(topic for topic, _, _ in record.messages())
        # From 0 to 4 s, and one second of margin behind what the pilot asks for.
        self.assertEqual((seen["vehicle/pose"], seen["head/ping"]), (501, 101))
        self.assertNotIn("clock/health", seen)  # wall-clock facts, for viewers only


class Files(SystemTest):
    def test_a_missing_program_of_after_is_refused_before_anything_runs(self):
        launch = self.write("after.yaml", survey(seconds=1, more="after:\n  - [no_such_program]\n  - [$(out)/made, by, it]"))
        for done in (self.tool("check", launch), self.run_launch(launch)):
            code = done.returncode if hasattr(done, "returncode") else done.code
            self.assertEqual((code, done.stderr.strip().splitlines()[-1].split("after.yaml:")[1]),
                             (2, "11:5: after: there is no program no_such_program"), done.stderr)

    def test_no_control_character_of_a_file_reaches_the_terminal(self):
        launch = self.write("red.yaml", 'ensonify: launch/1\nprocesses: { a: { run: "\\e[31mred" } }\n')
        done = self.tool("check", launch)
        self.assertEqual(done.returncode, 2)
        self.assertIn("\\x1b[31mred", done.stderr)
        self.assertNotIn("\x1b", done.stderr)

    def test_a_named_pipe_is_no_launch_file(self):
        os.mkfifo(self.folder / "pipe.yaml")
        done = self.tool("check", self.folder / "pipe.yaml", timeout=10)
        self.assertEqual(done.returncode, 2)
        self.assertIn("is a named pipe; a YAML file is expected", done.stderr)


class Exits(SystemTest):
    """`exit:` entries under `expect:`."""

    def expecting(self, exits, more="", **faults):
        entries = "".join(f"  - exit: {{ {exit} }}\n" for exit in exits)
        return survey(seconds=2, more=f"{more}\nexpect:\n{entries}", **faults)

    def verdicts(self, result):
        return {case["name"]: (case["ok"], case["message"]) for case in result.report()["expect"]}

    def test_an_end_that_comes_as_expected_is_0(self):
        for faults, end, name in (({"head": "throw_s: 1"}, "code: 3", "head ends with exit code 3"),
                                  ({"head": "die_s: 1"}, "signal: KILL", "head ends with signal KILL"),
                                  ({}, "code: 0", "head ends with exit code 0")):
            junit = self.folder / "junit.xml"
            result = self.run_launch(self.expecting([f"process: head, {end}"], **faults), "--junit", junit)
            self.assertEqual(result.code, 0, result.stderr)
            self.assertTrue(self.verdicts(result)[name][0])
            cases = xml.parse(junit).getroot()
            self.assertEqual([case.get("name") for case in cases.iter("testcase") if case.get("classname") == "expect"], [name])
            self.assertEqual(list(cases.iter("failure")), [])

    def test_another_end_is_1_unless_there_was_a_fault(self):
        survived = self.run_launch(self.expecting(["process: head, code: 3"]))
        self.assertEqual(survived.code, 1, survived.stderr)
        self.assertEqual(self.verdicts(survived), {"head ends with exit code 3": (False, "it ended with exit code 0")})
        self.assertIn("failed: head ends with exit code 3: it ended with exit code 0", survived.stderr)
        other = self.run_launch(self.expecting(["process: head, code: 3"], head="die_s: 1"), out="other")
        self.assertEqual((other.code, other.report()["culprit"]), (3, "head"), other.stderr)
        self.assertEqual(self.verdicts(other), {"head ends with exit code 3": (False, "it ended with signal 9 (Killed)")})
        elsewhere = self.run_launch(self.expecting(["process: head, signal: KILL"], consumer="die_s: 1"), out="elsewhere")
        self.assertEqual((elsewhere.code, elsewhere.report()["culprit"]), (3, "consumer"), elsewhere.stderr)

    def test_an_observers_exit_code_counts_without_ending_the_run(self):
        viewer = "  viewer: { run: [sh, -c, 'exit 9'], observer: true }"
        good = self.run_launch(self.expecting(["process: viewer, code: 9"], viewer))
        self.assertEqual((good.code, good.report()["sim_s"] > 2), (0, True), good.stderr)
        self.assertEqual(self.run_launch(self.expecting(["process: viewer, code: 0"], viewer), out="bad").code, 1)

    def test_leaving_early_with_0_stays_a_fault(self):
        leaver = "  leaver: { run: [sh, -c, 'exit 0'] }"
        result = self.run_launch(self.expecting(["process: leaver, code: 0"], leaver))
        self.assertEqual((result.code, result.report()["culprit"]), (3, "leaver"), result.stderr)

    def test_what_an_expected_death_leaves_unjudged_has_failed(self):
        launch = self.expecting(["process: head, code: 3"], head="throw_s: 1") + "  - no_gap: { topic: head/ping }\n"
        result = self.run_launch(launch)
        self.assertEqual(result.code, 1, result.stderr)
        self.assertFalse(self.verdicts(result)["other expectations"][0])

    def test_mistakes_are_2_with_their_place(self):
        for exit, text in (("process: haed, code: 0", "no process is named haed; did you mean head?"),
                           ("process: head", "needs one of code and signal"),
                           ("process: head, code: 0, signal: KILL", "needs one of code and signal"),
                           ("process: head, code: 256", "256 is outside [0, 255]"),
                           ("process: head, signal: KILLED", '"KILLED" is no signal; such as KILL, TERM or SEGV')):
            result = self.run_launch(self.expecting([exit]))
            self.assertEqual(result.code, 2, result.stderr)
            self.assertRegex(result.stderr, r"out.yaml:\d+:\d+: expect\[0\]")
            self.assertIn(text, result.stderr)
        alone = self.run_launch(self.expecting(["process: head, code: 0"]), "--in-process")
        self.assertEqual(alone.code, 2, alone.stderr)


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
        self.refused(survey(head="rate: 3", consumer="rats: 3"), "processes.head.config.rate: is not a known key",
                     "processes.consumer.config.rats: is not a known key")  # of both processes at once

    def test_a_wrong_override_names_its_target(self):
        self.refused(survey(), "--set haed.rate_hz: names no process, scenario section or clock; did you mean head?",
                     options=("--set", "haed.rate_hz=3"))
        self.refused(survey(), "--set head.rate_hz: is \"x\", not a whole number", options=("--set", "head.rate_hz=x"))

    def test_a_program_or_a_launch_file_that_is_not_there(self):
        self.refused("ensonify: launch/1\nprocesses: {a: {run: sutb}}\n", "there is no program ensonify-sutb")
        self.refused(self.folder / "missing.yaml", f"{self.folder}/missing.yaml: no such file")

    def test_output_folders_that_cannot_be_written(self):
        self.refused_out(self.write("file", "x") / "out")
        self.refused_out("/proc/ensonify/out")
        self.refused_out(f"/tmp/{'x' * 300}", "File name too long; choose another folder with --out")

    def refused_out(self, out, text="cannot be made: "):
        launch = self.write("l.yaml", survey(seconds=1))
        done = subprocess.run([str(BIN / "ensonify"), "run", str(launch), "--out", str(out)], capture_output=True, text=True,
                              env=self.environment, timeout=30)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(str(out), done.stderr)
        self.assertIn(text, done.stderr)

    def test_a_300_character_output_path_works_or_is_named(self):
        long = "/".join(["d" * 100] * 3)
        launch = self.write("l.yaml", survey(seconds=1))
        done = subprocess.run(self.command(launch, out=long), capture_output=True, text=True, env=self.environment, timeout=30)
        self.assertEqual(done.returncode, 0, done.stderr)  # sockets are never under the output folder
        self.assertTrue((self.folder / long / "run.json").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
