"""`ensonify test`: verdicts, exit codes, batches that are killed and go on; faults that launch files inject, the same at any speed."""
import json
import pathlib
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from support import BIN, SOURCE, SystemTest

SHIPPED = SOURCE / "launch/tests"

# A boat that goes north for some seconds of sim time.
BOAT = """
ensonify: launch/1
scenario:
  ensonify: scenario/1
  site: {{ latitude_deg: 1, longitude_deg: 2 }}
  seed: {seed}
  seabed: {{ kind: layers }}
  vehicles: {{ boat: {{ start: {{ position_m: [0, 0, 0], heading_deg: 0, speed_mps: 1 }} }} }}
  mission: {{ speed_mps: 1, runlines: [{{ from_m: [0, 0], to_m: [0, 90] }}] }}
duration_s: {seconds}
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
{more}
expect: [{{ name: it moves, eventually: {{ topic: boat/pose, where: {{ field: position_enu_m.1, above: 1 }}, within_s: 3 }} }}]
"""


def boat(seconds=4, seed=1, more=""):
    return BOAT.format(seconds=seconds, seed=seed, more=more)


class Batches(SystemTest):
    def ensonify_test(self, *words, timeout=120):
        return self.tool("test", *words, timeout=timeout)

    def batch(self, count, seconds=4):
        folder = self.folder / "launches"
        folder.mkdir()
        for number in range(count):
            (folder / f"l{number}.yaml").write_text(boat(seconds, seed=number + 1))
        return folder

    def results(self, out):
        return (self.folder / out / "results.csv").read_text()

    def test_shipped_launch_tests_hold(self):
        done = self.ensonify_test(SHIPPED, "--out", self.folder / "out", "--jobs", 2, timeout=400)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(f"{len(list(SHIPPED.glob('*.yaml')))} passed, 0 failed, 0 skipped", done.stdout)

    def test_shipped_launch_tests_fail_when_what_they_test_is_broken(self):
        changes = (("line_in_a_current", "speed_mps: 0.7", "speed_mps: 1.8"),
                   ("altitude_over_a_step", "vertical_speed_mps: 0.8", "vertical_speed_mps: 0.02"),
                   ("estimate_lost", "from_s: 30, to_s: 33", "from_s: 5, to_s: 75"),
                   ("wrong_commands", "value: nan", "value: 0.0"),
                   ("agent_silent", "timeout_s: 2", "timeout_s: 20"),
                   ("gnss_outage", "grade: tactical", "grade: mems"),
                   ("special_order", "0.8] }, measured", "0.8], roll_deg: 1 }, measured"),
                   ("wall_distance", "pilot: { run: autopilot }", "pilot: { run: autopilot, config: { drift_settle_s: 0 } }"),
                   ("target_passed", "speed_mps: 0.4", "speed_mps: 1.0"),
                   ("cross_talk", "mode: interleaved", "mode: free"),
                   ("coverage_complete", "ping_rate_hz: 3", "ping_rate_hz: 0.4"),
                   ("agent_killed", ", may_be_lost: true", ""),
                   ("killed", "at_s: 4", "at_s: 400"))
        self.assertEqual({name for name, *_ in changes}, {file.stem for file in SHIPPED.glob("*.yaml")})
        (self.folder / "broken").mkdir()
        for name, old, new in changes:
            text = (SHIPPED / f"{name}.yaml").read_text()
            self.assertIn(old, text)
            self.write(f"broken/{name}.yaml", text.replace(old, new))
        done = self.ensonify_test(self.folder / "broken", "--out", self.folder / "out", "--jobs", 2, timeout=400)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(f"0 passed, {len(changes)} failed, 0 skipped", done.stdout)

    def test_verdicts_exit_codes_and_junit(self):
        folder = self.batch(1)
        self.assertEqual(self.ensonify_test(folder, "--out", self.folder / "a").returncode, 0)
        (folder / "fails.yaml").write_text(boat().replace("above: 1 }", "above: 1000 }"))
        (folder / "waits.yaml").write_text(boat(more="  agent: { external: true }"))
        (folder / "dies.yaml").write_text(boat(more="  agent: { run: [python3, -c, 'raise SystemExit(7)'] }", seed=9))
        junit = self.folder / "junit.xml"
        done = self.ensonify_test(folder, "--out", self.folder / "b", "--junit", junit, "--jobs", 2)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        for line in ("passed  ", "failed: it moves:", "skipped ", "waits for agent, which somebody else starts", "alone: ensonify run",
                     "1 passed, 2 failed, 1 skipped"):
            self.assertIn(line, done.stdout)
        suites = {suite.get("name").rsplit("/", 1)[1]: suite for suite in xml.etree.ElementTree.parse(junit).getroot()}
        self.assertEqual(suites["l0.yaml"].get("failures"), "0")
        self.assertEqual(suites["fails.yaml"].get("failures"), "1")
        self.assertEqual([case.get("name") for case in suites["fails.yaml"]], ["it moves", "run"])
        self.assertIsNotNone(suites["waits.yaml"].find("testcase/skipped"))
        self.assertGreaterEqual(int(suites["dies.yaml"].get("failures")), 1)
        (folder / "unreadable.yaml").write_text(boat() + "speed: 3\n")
        done = self.ensonify_test(folder, "--out", self.folder / "c", "--filter", "l0.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = self.ensonify_test(folder, "--out", self.folder / "d", "--jobs", 2)
        self.assertEqual(done.returncode, 2)
        self.assertIn("unreadable.yaml:", done.stderr)
        self.assertIn("1 passed, 2 failed, 1 skipped, 1 unreadable", done.stdout)

    def test_a_run_that_takes_too_long_has_failed(self):
        folder = self.batch(1, seconds=600)
        done = self.ensonify_test(folder, "--out", self.folder / "out", "--rate", 1, "--timeout-s", 2)
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("it took longer than --timeout-s", done.stdout)

    def test_a_killed_batch_goes_on_and_gives_the_same_table(self):
        folder = self.batch(3)
        whole = self.ensonify_test(folder, "--out", self.folder / "whole", "--jobs", 3)
        self.assertEqual(whole.returncode, 0, whole.stderr)
        command = [str(BIN / "ensonify"), "test", str(folder), "--out", str(self.folder / "cut"), "--jobs", "1"]
        batch = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=self.environment)
        self.assertIn("passed", batch.stdout.readline())
        batch.kill()
        batch.communicate()
        until = time.monotonic() + 20
        while self.processes() and time.monotonic() < until:  # the run that was under way ends by itself
            time.sleep(0.05)
        done = self.ensonify_test(folder, "--out", self.folder / "cut", "--resume", "--jobs", 2)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("3 passed", done.stdout)
        self.assertEqual(self.results("cut"), self.results("whole"))
        before = {file: file.stat().st_mtime_ns for file in (self.folder / "cut/runs").glob("*/result.json")}
        self.ensonify_test(folder, "--out", self.folder / "cut", "--resume")
        self.assertEqual(before, {file: file.stat().st_mtime_ns for file in (self.folder / "cut/runs").glob("*/result.json")})

    def test_ctrl_c_ends_all_in_order(self):
        folder = self.batch(2, seconds=600)
        command = [str(BIN / "ensonify"), "test", str(folder), "--out", str(self.folder / "out"), "--jobs", "2", "--rate", "1"]
        batch = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=self.environment)
        while len(list((self.folder / "out/runs").glob("*/log/boat.log"))) < 2:
            time.sleep(0.05)
        batch.send_signal(signal.SIGINT)
        self.assertEqual(batch.wait(timeout=30), 130)
        batch.stdout.close()

    def test_shards_have_every_launch_once(self):
        folder = self.batch(3)
        names = []
        for part in (1, 2):
            done = self.ensonify_test(folder, "--list", "--json", "--shard", f"{part}/2")
            names += [pathlib.Path(one["launch"]).name for one in json.loads(done.stdout)["launches"]]
        self.assertEqual(sorted(names), ["l0.yaml", "l1.yaml", "l2.yaml"])
        self.assertEqual(self.ensonify_test(folder, "--shard", "3/2").returncode, 2)

    def test_shards_merge_to_the_table_of_one_batch(self):
        folder = self.batch(3, seconds=2)
        (folder / "fails.yaml").write_text(boat(2).replace("above: 1 }", "above: 1000 }"))
        out = self.folder / "parts"
        self.assertEqual(self.ensonify_test(folder, "--out", out / "whole", "--jobs", 2).returncode, 1)
        for part in (1, 2):
            self.ensonify_test(folder, "--out", out / str(part), "--shard", f"{part}/2")
        merged = self.ensonify_test("--merge", out / "1", out / "2", "--out", out / "merged", "--junit", out / "merged.xml")
        self.assertEqual(merged.returncode, 1, merged.stderr)
        self.assertIn("3 passed, 1 failed, 0 skipped", merged.stdout)
        for file in ("results.csv", "plan.json"):
            self.assertEqual((out / "merged" / file).read_bytes(), (out / "whole" / file).read_bytes())
        self.assertEqual(len(xml.etree.ElementTree.parse(out / "merged.xml").getroot()), 4)
        self.assertTrue(list((out / "merged/runs").glob("*/log/clock.log")))
        for words, message in ((("--merge", out / "1", "--out", out / "x"), "2 of 4 launches are done in none of the folders"),
                               (("--merge", out / "1", out / "whole", "--out", out / "x"), "2 of 4 launches are done more than once"),
                               (("--merge", out / "1", out / "2", "--out", out / "2"), "is one of the shards"),
                               (("--merge", out, "--out", out / "x"), "is no folder of `ensonify test`"), ((), "allowed: launch files and folders")):
            refused = self.ensonify_test(*words)
            self.assertEqual(refused.returncode, 2, refused.stdout)
            self.assertIn(message, refused.stderr)


INJECT = """
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: all }} }}
inject:
  - {{ mute: nav/estimate, from_s: 1, to_s: 1.5 }}
  - {{ drop: boat/pose, share: 0.25, from_s: 0.5 }}
  - {{ delay: pilot/command, by_ms: 300, from_s: 1 }}
  - {{ corrupt: nav/sound_speed, field: sound_speed_mps, value: 1234.5, from_s: 2 }}
  {more}
"""


class Faults(SystemTest):
    def test_faults_are_the_same_at_any_speed_and_in_one_process(self):
        runs = {"free": ["--free"], "paced": ["--rate", "3"], "one": ["--in-process"]}
        for out, options in runs.items():
            result = self.run_launch(boat(more=INJECT.format(more="")), *options, out=out)
            self.assertEqual(result.code, 0, result.stderr)
        for out in ("paced", "one"):
            same = self.tool("compare", self.folder / "free/run.mcap", self.folder / out / "run.mcap")
            self.assertEqual(same.returncode, 0, same.stdout + same.stderr)
        log = self.folder.joinpath("free/log/nav.log").read_text()
        self.assertIn("inject mute topic=nav/estimate", log)

    def test_a_pause_changes_no_byte(self):
        self.run_launch(boat(more=INJECT.format(more="")), "--free", out="whole")
        paused = self.run_launch(boat(more=INJECT.format(more="- { pause: boat, at_s: 2, for_wall_s: 1.5 }")), "--free", out="paused")
        self.assertEqual(paused.code, 0, paused.stderr)
        self.assertGreater(paused.wall_s, 1.5)
        same = self.tool("compare", self.folder / "whole/run.mcap", self.folder / "paused/run.mcap", "--topic", "boat/*")
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)

    def test_a_fault_that_does_nothing_fails_the_run(self):
        for more, idle in (("inject: [{ mute: boat/pose, from_s: 1, to_s: 2 }, { mute: boat/pose, from_s: 50 }]", "inject[1] acts"),
                           ("inject: [{ delay: boat/pose, by_ms: 20, from_s: 4.5 }]", "inject[0] acts"),
                           ("  idler: { run: [python3, -c, 'import time; time.sleep(60)'], observer: true }\n"
                            "inject: [{ pause: idler, at_s: 1, for_wall_s: 0.1 }]", "inject[0] acts")):
            result = self.run_launch(boat(more=more), "--free")
            self.assertEqual(result.code, 1, result.stderr)
            self.assertIn(f"failed: {idle}:", result.stderr)
            self.assertIn("did nothing", result.stderr)

    def test_a_kill_in_one_process_is_refused(self):
        result = self.run_launch(boat(more=INJECT.format(more="- { kill: pilot, at_s: 2 }")), "--in-process")
        self.assertEqual(result.code, 2, result.stderr)
        self.assertIn("inject[4]: kills pilot", result.stderr)

    def test_a_killed_process_ends_the_run_in_its_name(self):
        result = self.run_launch(boat(more=INJECT.format(more="- { kill: pilot, at_s: 2 }")), "--free")
        self.assertEqual(result.code, 3, result.stderr)
        self.assertIn("pilot", result.stderr)
        self.assertLess(result.report()["sim_s"], 3.5)

    def test_a_foreign_participant_does_it_too(self):
        agent = self.write("agent.py", """
            import ensonify
            with ensonify.Participant("agent") as me:
                mark = me.publish("mark", ensonify.Health, rate=10)
                for step in me.steps(rate=10):
                    mark.send(ensonify.Health(stamp_ns=step.t_ns, state="ok"))
            """.replace("\n            ", "\n"))
        more = (f"  agent: {{ run: [python3, {agent}] }}\n" + INJECT.format(more="""
  - { mute: agent/mark, from_s: 1, to_s: 2 }
  - { corrupt: agent/mark, field: state, value: wrong, from_s: 3 }"""))
        text = boat(more=more).replace("expect: [", "expect: [{ count: { topic: agent/mark, min: 30, max: 31 } }, "
                                       "{ count: { topic: agent/mark, where: { field: state, equals: wrong }, min: 10, max: 11 } }, ")
        result = self.run_launch(text, "--free")
        self.assertEqual(result.code, 0, result.stderr)

    def test_faults_of_what_is_not_there_are_refused(self):
        for entry, said in (("{ mute: nav/estimat }", "no process publishes nav/estimat (did you mean nav/estimate?)"),
                            ("{ mute: navi/estimate }", "no process is named navi; did you mean nav?"),
                            ("{ corrupt: nav/estimate, field: no_such, value: 1 }", "nav/estimate has no value no_such that is no array")):
            result = self.run_launch(boat(more=INJECT.format(more=f"- {entry}")), "--free")
            self.assertEqual(result.code, 2, result.stderr)
            self.assertIn(said, result.stderr)


if __name__ == "__main__":
    unittest.main()
