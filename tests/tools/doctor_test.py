"""ensonify doctor on this machine, which builds and tests the project and so must not be found ill."""
import json
import os
import pathlib
import tempfile
import unittest

from live_run import LiveRun, tool


class Doctor(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ens-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def findings(self, *words, **options):
        code, out, error = tool("doctor", "--json", *words, run_folder=self.folder, **options)
        self.assertEqual(error, "")
        answer = json.loads(out)
        self.assertEqual(code, 0 if answer["ok"] else 2)
        self.assertEqual(answer["ok"], all(f["level"] != "fail" for f in answer["findings"]))
        return {f["check"]: f for f in answer["findings"]}

    def test_every_check_is_there_and_bad_news_comes_with_advice(self):
        findings = self.findings()
        self.assertLessEqual({"cpu", "cores", "memory", "results", "/tmp", "/dev/shm", "open files", "clock", "zmq",
                              "tile cache", "socket paths", "run folder", "live runs", "dead runs", "programs", "data", "python"},
                             set(findings))
        for finding in findings.values():
            self.assertIn(finding["level"], ("ok", "warn", "fail"))
            self.assertEqual(finding["advice"] == "", finding["level"] == "ok", finding)
        self.assertEqual(findings["programs"]["level"], "ok")
        self.assertRegex(findings["zmq"]["text"], r"^4\.\d+\.\d+, ")
        code, text, _ = tool("doctor", run_folder=self.folder)
        self.assertRegex(text, r"(?m)^ok    zmq           4\.")

    def test_the_size_of_the_tile_cache_is_reported(self):
        cache = self.folder / "cache" / "ensonify" / "tiles"
        cache.mkdir(parents=True)
        (cache / "a").write_bytes(bytes(2_000_000))
        (cache / "b").write_bytes(bytes(1_000_000))
        reported = self.findings(env={"XDG_CACHE_HOME": str(self.folder / "cache")})["tile cache"]
        self.assertEqual((reported["level"], reported["text"]), ("ok", f"3 MB in {cache}"))

    def test_a_folder_that_cannot_be_used_is_exit_code_2(self):
        findings = self.findings("--out", self.folder / "none")
        self.assertEqual(findings["results"]["level"], "fail")
        self.assertEqual(tool("doctor", "--out", self.folder / "none")[0], 2)

    def test_a_client_that_cannot_be_imported_is_a_warning(self):
        broken = self.folder / "broken"
        broken.mkdir()
        (broken / "numpy.py").write_text("raise ImportError('planted')\n")
        python = self.findings(env={"PYTHONPATH": str(broken)})["python"]
        self.assertEqual(python["level"], "warn")
        self.assertIn("planted", python["text"])

    def test_dead_runs_and_open_folders_are_seen(self):
        run = self.folder / "ensonify" / "run-dead"
        run.mkdir(parents=True)
        os.chmod(run.parent, 0o755)
        (run / "clock.endpoint").write_text(f"ipc://{run}/clock")
        findings = self.findings()
        self.assertEqual(findings["dead runs"]["level"], "warn")
        self.assertIn(str(run), findings["dead runs"]["text"])
        self.assertIn("can be entered by others", findings["run folder"]["text"])

    def test_live_runs_are_named(self):
        with LiveRun() as run:
            code, text, _ = run.tool("doctor", "--json")
            live = next(f for f in json.loads(text)["findings"] if f["check"] == "live runs")
            self.assertIn(run.directory().name, live["text"])

    def test_a_long_runtime_folder_is_reported(self):
        deep = self.folder / ("x" * 60)
        deep.mkdir()
        code, text, _ = tool("doctor", "--json", run_folder=deep)
        paths = next(f for f in json.loads(text)["findings"] if f["check"] == "socket paths")
        self.assertEqual(paths["level"], "warn")


if __name__ == "__main__":
    unittest.main()
