"""ensonify topic against live runs."""
import json
import os
import shutil
import signal
import subprocess
import unittest

from live_run import BIN, LiveRun, tool


class Topic(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = LiveRun()
        cls.run_.__enter__()
        cls.addClassCleanup(cls.run_.__exit__, None, None, None)

    def test_list_names_topics_types_rates_and_subscribers(self):
        topics = {entry["topic"]: entry for entry in self.run_.json("topic", "list")}
        self.assertEqual({name for name in topics if not name.endswith("/health")},
                         {"auv/pose", "pilot/command", "bow/ping"})
        self.assertEqual(topics["bow/ping"]["rate_hz"], 20)
        self.assertGreaterEqual(topics["bow/ping"]["max_bytes"], 50000)
        self.assertEqual(topics["pilot/command"]["subscribers"],
                         [{"process": "auv", "port": "command", "delay_ns": 100_000_000}])
        code, text, _ = self.run_.tool("topic", "list")
        self.assertEqual(code, 0)
        self.assertRegex(text, r"pilot/command +command_blob/1 +10 Hz .* auv.command \(delayed 100 ms\)")

    def test_info_shows_the_fields_with_their_units(self):
        code, text, _ = self.run_.tool("topic", "info", "bow/health")
        self.assertEqual(code, 0)
        self.assertRegex(text, r"stamp_ns +integer \[ns\]: time of the report")
        self.assertEqual(self.run_.json("topic", "info", "bow/health")[0]["schema"]["title"], "health/1")

    def test_echo_leaves_after_its_count(self):
        code, text, _ = self.run_.tool("topic", "echo", "bow/ping", "--count", "3", "--json")
        self.assertEqual(code, 0)
        messages = [json.loads(line) for line in text.splitlines()]
        self.assertEqual([m["t_sim_ns"] for m in messages], [m["seq"] * 50_000_000 for m in messages])
        self.assertEqual(messages[0]["content"]["data"]["shape"], [50000])
        self.assertEqual(len(messages), 3)

    def test_echo_of_one_field(self):
        code, text, _ = self.run_.tool("topic", "echo", "auv/pose", "-n", "1", "--field", "stamp_ns", "--json")
        self.assertEqual(code, 0)
        message = json.loads(text)
        self.assertEqual(message["value"], message["t_sim_ns"])
        code, text, _ = self.run_.tool("topic", "echo", "bow/ping", "-n", "1", "--field", "data")
        self.assertRegex(text, r"^t=\d+\.\d{3} s u1 \[50000\]: (\d+) \1 \1 \.\.\. \1 \1 \1 \(\1 to \1\)\n$")

    def test_echo_follows_patterns(self):
        code, text, _ = self.run_.tool("topic", "echo", "bow/*", "auv/pose", "-n", "30", "--json")
        self.assertEqual({json.loads(line)["topic"] for line in text.splitlines()}, {"bow/ping", "auv/pose"})

    def test_fewer_messages_than_asked_for_is_exit_code_1(self):
        code, text, error = self.run_.tool("topic", "echo", "bow/health", "-n", "1", "--timeout", "0.2")
        self.assertEqual((code, text), (1, ""))
        self.assertIn("0 of 1 messages came within 0.2 s", error)

    def test_the_clock_reports_how_the_run_keeps_its_pace(self):
        (entry,) = [topic for topic in self.run_.json("topic", "list") if topic["topic"] == "clock/health"]
        self.assertEqual((entry["type"], entry["publisher"], entry["subscribers"]), ("clock_health/1", "clock", []))
        code, text, _ = self.run_.tool("topic", "echo", "clock/health", "-n", "2", "--json")
        self.assertEqual(code, 0)
        messages = [json.loads(line) for line in text.splitlines()]
        first, second = (message["content"] for message in messages)
        self.assertEqual(messages[1]["seq"], messages[0]["seq"] + 1)
        self.assertEqual(messages[1]["t_sim_ns"], second["stamp_ns"])
        apart_s = second["wall_s"] - first["wall_s"]
        self.assertGreater(apart_s, 0.9)  # the period is one second of wall time
        self.assertEqual((second["state"], second["rate"], second["slips"]), ("running", 1, 0))
        advance_s = 1e-9 * (second["stamp_ns"] - first["stamp_ns"])
        self.assertAlmostEqual(second["rate_factor"], advance_s / apart_s, delta=0.01)  # taken some microseconds apart
        self.assertEqual([p["name"] for p in second["participants"]], ["auv", "pilot", "bow", "viewer"])
        for participant in second["participants"]:
            self.assertGreater(participant["grants"], 0)
            self.assertGreater(participant["cost_s"], 0)
        code, text, _ = self.run_.tool("topic", "echo", "clock/health", "-n", "1")
        self.assertRegex(text, "rate_factor")

    def test_hz_and_bw_print_the_rates_of_sim_time_exactly(self):
        (rate,) = self.run_.json("topic", "hz", "auv/pose", "--count", "40")
        self.assertAlmostEqual(rate["sim_hz"], 100.0, delta=1e-6)
        self.assertEqual(rate["received"], 40)
        self.assertGreater(rate["wall_hz"], 0)
        (size,) = self.run_.json("topic", "bw", "bow/ping", "--count", "5")
        self.assertGreater(size["min_bytes"], 50000)
        self.assertAlmostEqual(size["sim_bytes_per_s"], 20 * size["mean_bytes"], delta=1)

    def test_mistakes_are_exit_code_2_and_name_the_nearest(self):
        for words, hint in ((("echo", "bow/pign"), "did you mean bow/ping?"),
                            (("hz", "xxxxx"), "there are auv/pose"),
                            (("echo", "bow/health", "--field", "stat"), "did you mean state?"),
                            (("echo", "bow/ping", "-n", "1", "--field", "dat"), "did you mean data?"),
                            (("list", "--run", "run-nothere"), "there is no run of this name; live runs: run-")):
            code, text, error = self.run_.tool("topic", *words)
            self.assertEqual((code, text), (2, ""), error)
            self.assertIn(hint, error)
        self.assertEqual(self.run_.tool("topic", "echo")[0], 2)

    def test_ctrl_c_and_a_closed_pipe_end_it_quietly(self):
        env = {**os.environ, "XDG_RUNTIME_DIR": str(self.run_.folder)}
        words = [BIN / "ensonify-topic", "echo", "auv/pose"]
        with subprocess.Popen(words, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as echo:
            echo.stdout.readline()
            echo.send_signal(signal.SIGINT)
            _, error = echo.communicate(timeout=20)
            self.assertEqual((echo.returncode, error), (130, ""))
        with subprocess.Popen(words, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as echo:
            echo.stdout.readline()
            echo.stdout.close()
            self.assertEqual(echo.wait(20), -signal.SIGPIPE)
            self.assertEqual(echo.stderr.read(), "")

    def test_a_full_disk_is_exit_code_5(self):
        env = {**os.environ, "XDG_RUNTIME_DIR": str(self.run_.folder)}
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([BIN / "ensonify-topic", "echo", "auv/pose"], env=env, stdout=full,
                                  stderr=subprocess.PIPE, text=True, timeout=20)
        self.assertEqual((done.returncode, done.stderr), (5, "ensonify topic: standard output cannot be written\n"))

    def test_a_run_is_named_by_its_directory_its_id_its_endpoint_and_the_environment(self):
        directory = self.run_.directory()
        for run in (str(directory), directory.name, (directory / "clock.endpoint").read_text()):
            self.assertEqual(self.run_.tool("topic", "list", "--run", run)[0], 0)
            self.assertEqual(self.run_.tool("topic", "list", env={"ENSONIFY_RUN": run})[0], 0)



class Endings(unittest.TestCase):
    def test_tools_over_tcp(self):
        with LiveRun(tcp=True) as run:
            self.assertTrue((run.directory() / "clock.endpoint").read_text().startswith("tcp://127.0.0.1:"))
            self.assertEqual(run.tool("topic", "echo", "auv/pose", "-n", "2")[0], 0)

    def test_a_listener_ends_with_the_run(self):
        with LiveRun() as run:
            env = {**os.environ, "XDG_RUNTIME_DIR": str(run.folder)}
            words = [BIN / "ensonify-topic", "echo", "auv/pose", "--field", "stamp_ns", "--json"]
            with subprocess.Popen(words, env=env, stdout=subprocess.PIPE, text=True) as echo:
                echo.stdout.readline()
                self.assertEqual(run.tool("clock", "stop")[0], 0)
                self.assertEqual(run.process.wait(20), 0)
                echo.communicate(timeout=20)
                self.assertEqual(echo.returncode, 0)

    def test_a_run_whose_directory_was_removed_ends_well_but_takes_no_new_observers(self):
        with LiveRun(finish_s=2.0) as run:
            directory = run.directory()
            shutil.rmtree(directory)
            for words in (("list",), ("list", "--run", str(directory)), ("echo", "auv/pose", "--run", directory.name)):
                code, _, error = run.tool("topic", *words)
                self.assertEqual(code, 2, error)
            self.assertEqual(run.process.wait(20), 0)

    def test_without_a_run(self):
        code, _, error = tool("topic", "list", "--run", "/nowhere/at/all")
        self.assertEqual(code, 2)
        self.assertIn("/nowhere/at/all: is no run", error)


if __name__ == "__main__":
    unittest.main()
