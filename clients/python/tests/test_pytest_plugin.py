"""Launch files as tests of pytest, by pytest itself in a process of its own."""
import os
import pathlib
import subprocess
import sys
import tempfile
import textwrap
import unittest

CLIENT = pathlib.Path(__file__).resolve().parents[1]

LAUNCH = """
    ensonify: launch/1
    scenario:
      ensonify: scenario/1
      site: { latitude_deg: 1, longitude_deg: 2 }
      seabed: { kind: layers }
      vehicles: { auv: {} }
      mission: { speed_mps: 1, runlines: [{ from_m: [0, 0], to_m: [0, 50] }] }
    duration_s: 2
    processes: { auv: { run: vehicle } }
"""


class Pytest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = pathlib.Path(self.folder.name, name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))

    def pytest(self, *words):
        env = dict(os.environ, PYTHONPATH=str(CLIENT), PYTEST_DISABLE_PLUGIN_AUTOLOAD="1")
        return subprocess.run([sys.executable, "-m", "pytest", "-p", "ensonify.pytest_plugin", "-p", "no:cacheprovider", "-rs", *words],
                              cwd=self.folder.name, env=env, capture_output=True, text=True, timeout=120, check=False)

    def test_launch_files_pass_fail_and_are_skipped(self):
        moves = "    expect: [{ name: it moves, eventually: { topic: auv/pose, where: { field: position_enu_m.1, above: %s }, within_s: 2 } }]\n"
        self.write("launch/good.yaml", LAUNCH + moves % "-1e9")
        self.write("launch/bad.yaml", LAUNCH + moves % "1e9")
        self.write("launch/waits.yaml", LAUNCH.replace("run: vehicle }", "run: vehicle }, agent: { external: true }") + moves % "0")
        self.write("launch/part.yaml", LAUNCH)
        self.write("launch/other.yaml", "hello: [world\n")
        done = self.pytest("launch", "--ensonify-set", "seed=4")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("1 failed, 1 passed, 1 skipped", done.stdout)
        self.assertIn("failed: it moves:", done.stdout)
        self.assertIn("waits for agent, which somebody else starts", done.stdout)
        self.assertNotIn("Traceback", done.stdout)
        self.assertTrue(list(pathlib.Path(self.folder.name, "out/pytest/launch_bad/runs").glob("*/log")))

    def test_arguments_go_to_the_files_that_have_them(self):
        bound = "    args: { least: }\n    expect: [{ bounds: { topic: auv/pose, field: position_enu_m.1, min: $(least) } }]\n"
        self.write("asks.yaml", LAUNCH + bound)
        self.write("plain.yaml", LAUNCH + "    expect: [{ no_gap: { topic: auv/pose } }]\n")
        self.assertIn("needs --arg least=VALUE", self.pytest().stdout)
        done = self.pytest("--ensonify-arg", "least=-1e6")
        self.assertIn("2 passed", done.stdout, done.stdout + done.stderr)
        done = self.pytest("--ensonify-arg", "least=1e6")
        self.assertIn("1 failed, 1 passed", done.stdout)

    def test_a_launch_that_cannot_be_read_fails_with_its_place(self):
        self.write("wrong.yaml", LAUNCH + "    speed: 1\n    expect: [{ no_gap: { topic: auv/pose } }]\n")
        done = self.pytest()
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("wrong.yaml:11:", done.stdout)


if __name__ == "__main__":
    unittest.main()
