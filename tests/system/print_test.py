"""`ensonify check --print`: what it writes of each shipped launch file, with its scenario, is a launch file that is valid, says the same when
it is printed again, has every value with a sentence, and runs to the same messages."""
import subprocess
import unittest

import yaml

from support import BIN, SOURCE, SystemTest, bay


def shipped():
    files = [*(SOURCE / "launch").glob("*.yaml"), *(SOURCE / "docs/physics/gallery").glob("*.yaml")]
    return sorted(file for file in files if "\nensonify: launch/1" in "\n" + file.read_text(encoding="utf-8"))


class Print(SystemTest):
    def printed(self, launch, *options):
        done = subprocess.run([BIN / "ensonify", "check", launch, "--print", *options], capture_output=True, text=True, cwd=SOURCE,
                              env=self.environment)
        self.assertEqual(done.returncode, 0, f"{launch}: {done.stderr}{done.stdout[-2000:]}")
        return done.stdout

    def test_each_shipped_launch_file_is_printed_and_reads_as_the_same(self):
        raster, record = self.folder / "ground.asc", self.folder / "run.mcap"
        raster.write_text("ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 100\n" + "-20 -20 -20\n" * 3)
        self.assertEqual(self.run_launch(bay(1), "--in-process", "--record", record).code, 0)
        arguments = {"survey.yaml": ["--arg", f"raster={raster}", "--arg", "crs=EPSG:32619"], "replay.yaml": ["--arg", f"record={record}"]}
        for file in shipped():
            with self.subTest(file=file.name):
                once = self.printed(file, *arguments.get(file.name, []))
                again = self.printed(self.write(file.name, once))
                self.assertEqual(once, again)

    def test_the_demo_with_files_has_the_head_of_the_preset(self):
        preset = "launch/presets/multibeam/em2040_class_300khz.yaml"
        demo = yaml.safe_load(self.printed("launch/demo.yaml", "--arg", "files=em2040"))["processes"]["bow"]["config"]
        wanted = bay(1).replace("run: multibeam", f"run: multibeam, config: {SOURCE / preset}").replace("set: { bow.quality: 0.25 }\n", "")
        head = yaml.safe_load(self.printed(self.write("preset.yaml", wanted)))["processes"]["bow"]["config"]
        changed = {key for key in {*demo, *head} if demo.get(key) != head.get(key)}
        self.assertEqual(changed, {"seabed_image", "ping_rate_hz", "amplitude_every"})

    def test_each_shipped_preset_is_printed_and_reads_as_the_same(self):
        presets = sorted((SOURCE / "launch/presets").glob("*/*.yaml"))
        self.assertGreater(len(presets), 5)
        for preset in presets:
            with self.subTest(preset=preset.name):
                launch = bay(1).replace("run: multibeam", f"run: {preset.parent.name}, config: {preset}")
                once = self.printed(self.write("preset.yaml", launch))
                self.assertEqual(once, self.printed(self.write("printed.yaml", once)))

    def test_what_no_launch_file_could_say_is_refused(self):
        demo = SOURCE / "launch/demo.yaml"
        for change, problem in (("site.name=b\udcff", "--set site.name=b?: is not UTF-8"),
                                ("site.name=cost $(x)", '--set site.name: "cost $(x)" cannot be printed')):
            done = self.tool("check", demo, "--print", "--set", change)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(problem, done.stderr)

    def test_every_value_has_a_sentence(self):
        text = self.printed(SOURCE / "launch/demo.yaml", "--set", "bow.swath_deg=100", "--set", "water.wind_speed_mps=7.5")
        self.assertRegex(text, r"\n  water:.*#.*(\n    .*)*\n    wind_speed_mps: 7.5 +# wind 10 m above the sea")
        self.assertRegex(text, r"\n      swath_deg: 100 +# \S.*\(deg\)")
        document = yaml.safe_load(text)
        self.assertEqual(list(document), ["ensonify", "scenario", "processes", "clock", "isa", "after", "expect"])
        without = [line for line in text.splitlines() if ": " in line and "  # " not in line and "run:" not in line]
        self.assertEqual(without, [])

    def test_a_printed_launch_runs_to_the_same_messages(self):
        given = self.write("given.yaml", bay(3))
        changes = ["--set", "seed=7", "--set", "bow.swath_deg=100"]
        printed = self.write("printed.yaml", self.printed(given, *changes))
        for out, launch, options in (("a", given, changes), ("b", printed, [])):
            run = self.run_launch(launch, *options, "--in-process", out=out, timeout=200)
            self.assertEqual(run.code, 0, run.stdout + run.stderr)
        same = self.tool("compare", self.folder / "a/run.mcap", self.folder / "b/run.mcap", timeout=100)
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)

    def test_what_is_wrong_is_said_and_nothing_is_printed(self):
        wrong = self.write("wrong.yaml", "ensonify: launch/1\nscenario: scenarios/bay/scenario.yaml\n"
                                         "set: {seabed.post_spacing_m: 1000}\nprocesses: {boat: {run: vehicle}}\n")
        done = self.tool("check", wrong, "--print")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("seabed.post_spacing_m: 1000 is outside [0.005, 100]", done.stderr)


if __name__ == "__main__":
    unittest.main()
