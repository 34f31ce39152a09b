"""`ensonify detectability`: intervals against published ones, the detector against its own closed form, matching, tables; a whole run of it."""
import contextlib
import csv
import io
import json
import os
import shlex
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from PIL import Image

from ensonify_detectability import cfar, intervals, limits, main, matching

BIN = Path(os.environ["ENSONIFY_BIN"])
SOURCE = Path(os.environ["ENSONIFY_SOURCE"])


class IntervalsTest(unittest.TestCase):
    def test_share_is_that_of_clopper_and_pearson(self):
        for hits, of, least, most in ((0, 10, 0.0, 0.30850), (5, 10, 0.18709, 0.81291), (10, 10, 0.69150, 1.0), (1, 20, 0.00127, 0.24873)):
            self.assertEqual(tuple(round(edge, 5) for edge in intervals.of_share(hits, of)), (least, most))
        self.assertEqual(intervals.of_share(0, 0), (0.0, 1.0))

    def test_count_is_that_of_garwood(self):
        for count, least, most in ((0, 0.0, 3.689), (1, 0.025, 5.572), (10, 4.795, 18.390)):
            self.assertEqual(tuple(round(edge, 3) for edge in intervals.of_count(count)), (least, most))


class Shown:
    """A picture of amplitudes alone."""

    def __init__(self, power):
        self.amplitude = np.sqrt(power).astype(np.float32)


class CfarTest(unittest.TestCase):
    def test_false_alarms_of_noise_are_those_of_the_closed_form(self):
        # Exponential power, one cell against the mean of N: P(ratio > T) = (1 + T / N) ** -N. 640,000 cells; those in one frame depend on
        # each other, so the tolerance is five standard deviations of as many independent ones.
        power = np.random.default_rng(1).exponential(3.0, (900, 900))
        ratio = 10 ** (cfar.ratio_db(power, 1)[50:-50, 50:-50] / 10)
        surrounding = cfar.FRAME ** 2 - cfar.GUARD ** 2
        for threshold in (2.0, 5.0, 8.0):
            expected = (1 + threshold / surrounding) ** -surrounding
            self.assertLess(abs((ratio > threshold).mean() - expected), 5 * np.sqrt(expected / ratio.size), threshold)

    def test_a_bright_thing_is_found_where_it_is(self):
        power = np.random.default_rng(2).exponential(1.0, (200, 160))
        power[90:102, 40:60] *= 100
        boxes, scores = cfar.find(Shown(power))
        best = boxes[scores.argmax()]
        self.assertGreater(matching.overlap(best, np.array([40, 90, 60, 102])), 0.7)
        self.assertAlmostEqual(scores.max(), 20, delta=6)  # the highest of some 25 means of 9 exponentials

    def test_what_was_not_received_is_no_alarm(self):
        power = np.random.default_rng(3).exponential(1.0, (200, 200))
        power[:100] = 0
        self.assertEqual(len(cfar.find(Shown(0 * power))[0]), 0)
        boxes, scores = cfar.find(Shown(power))
        self.assertTrue((scores < 9).all(), scores)
        self.assertTrue((boxes[:, 1] >= 99).all())


class MatchingTest(unittest.TestCase):
    def test_first_hit_counts_further_ones_do_not(self):
        things = np.array([[0, 0, 10, 10], [50, 50, 60, 60]], float)
        finds = np.array([[1, 1, 11, 11], [0, 0, 9, 9], [100, 100, 110, 110], [52, 52, 57, 57]], float)
        best, alarms = matching.matched(things, finds, np.array([0.5, 0.9, 0.7, 0.2]))
        self.assertEqual(best.tolist(), [0.9, 0.2])  # the last by its middle, a quarter as large
        self.assertEqual(alarms.tolist(), [0.7])

    def test_too_large_is_no_hit(self):
        self.assertFalse(matching.hits(np.array([0, 0, 10, 10.]), np.array([-20, -20, 30, 30.])))


class Known:
    def __init__(self, **known):
        self.known, self.name = known, "thing"


def outcome(hits, alarms, **known):
    return limits.Outcome(None, [Known(**{name: values[i] for name, values in known.items()}) for i in range(len(hits))],
                          np.array(hits, float), np.array(alarms, float), 0.001)


class LimitsTest(unittest.TestCase):
    def test_threshold_keeps_the_number_of_alarms(self):
        some = [outcome([], [5.0, 3.0]), outcome([], [4.0]), outcome([], []), outcome([], [])]
        for rate, alarms in ((0.0, 0), (0.25, 1), (0.5, 2), (0.75, 3), (9, 3)):
            self.assertEqual(limits.at(some, limits.threshold_for(some, rate))["false_alarms"], alarms, rate)

    def test_against_numbers_and_words(self):
        some = [outcome([9, 9, 1, 1], [], range_m=[1.0, 2.0, 3.0, 4.0], kind=["a", "b", "a", "b"])]
        rows = limits.against(some, 5, "range_m", [1, 2.5, 4])
        self.assertEqual([(row["found"], row["things"]) for row in rows], [(2, 2), (0, 2)])  # the last edge belongs to the last bin
        rows = limits.against(some, 5, "kind")
        self.assertEqual([(row["from"], row["found"], row["things"]) for row in rows], [("a", 1, 2), ("b", 1, 2)])
        rows = limits.against(some, 5, "range_m", bins=2)
        self.assertEqual([(row["found"], row["things"]) for row in rows], [(2, 2), (0, 2)])

    def test_curve_rises(self):
        random = np.random.default_rng(4)
        some = [outcome(random.normal(6, 2, 3), random.normal(3, 2, 5)) for _ in range(30)]
        curve = limits.curve(some)
        self.assertEqual(curve[0]["false_alarms"], 0)
        for name in ("probability", "false_alarms"):
            values = [of[name] for of in curve]
            self.assertEqual(values, sorted(values))
        self.assertEqual(curve[-1]["found"], 90)


def painted(folder: Path, count: int = 24) -> None:
    """A set as `ensonify dataset` writes it, with a square in two of three pictures, the weaker the farther it is."""
    random, rows = np.random.default_rng(5), []
    for number in range(count):
        split = "val" if number % 4 == 0 else "test"
        level, objects = random.rayleigh(100, (256, 128)), []
        if number % 3:
            row, gain = int(random.integers(20, 236)), 12
            gain = 12 if row > 128 else 1
            level[row - 6:row + 6, 50:70] *= gain
            objects = [{"name": "box_0_1", "class": "box", "instance": 1, "pixels": 240, "box": [50, row - 6, 20, 12], "range_m": 20 - row * 20 / 256,
                        "grazing_rad": 0.5, "aspect_rad": 0.1, "buried": 0.0}]
        for kind, pixels in (("amplitude", level.astype(np.uint16)), ("images", (level / 8).clip(0, 255).astype(np.uint8))):
            (folder / split / kind).mkdir(parents=True, exist_ok=True)
            Image.fromarray(pixels).save(folder / split / kind / f"{number:08d}.png")
        rows.append({"picture": number, "name": f"{number:08d}", "pair": "", "split": split, "scene": number, "seed": 100 + number, "objects": objects,
                     "drawn": {"draw.eye.tilt_deg": 10.0 + number, "box_0_1.box.size_m[0]": 0.5},
                     "settings": {"kind": "forward_looking", "view": "polar", "range_m": 20.0, "beam_from_rad": -0.5, "beam_to_rad": 0.5, "scale_upa": 1000.0,
                                  "sound_speed_mps": 1500.0, "sample_period_s": 20 / 256 / 750, "frequency_hz": 900e3}})
    (folder / "manifest.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))


class RunTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def measured(self, *words, code=0):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            self.assertEqual(main.main([str(word) for word in words]), code, err.getvalue())
        return out.getvalue() + err.getvalue()

    def test_near_things_are_found_and_weak_ones_missed(self):
        painted(self.folder / "set")
        self.measured(self.folder, "--threshold", 12, "--split", "test", "--by", "range_m:0,10,20", "--by", "eye.tilt_deg", "--by", "box.size_m[0]")
        report = json.loads((self.folder / "detectability/report.json").read_text())
        near, far = report["against"]["range_m"]
        self.assertGreater(near["things"], 2)
        self.assertEqual(near["found"], near["things"])
        self.assertEqual(far["found"], 0)
        self.assertEqual(report["whole"]["false_alarms"], 0)
        self.assertAlmostEqual(report["whole"]["km2"], 18 * 0.5 * 400 * 1e-6)  # a sector of 1 rad and 20 m, 18 times
        with open(self.folder / "detectability/missed.csv", encoding="utf-8") as file:
            self.assertEqual(len(list(csv.DictReader(file))), far["things"])
        with Image.open(self.folder / "detectability/limits.png") as drawn:
            self.assertGreater(min(drawn.size), 300)

    def test_a_detector_of_ones_own(self):
        painted(self.folder / "set")
        own = self.folder / "own.py"
        own.write_text("import numpy as np\n"
                       "def all_of_it(picture):\n"
                       "    rows, columns = picture.grey.shape\n"
                       "    return [[0, 0, columns, rows]], [float(picture.amplitude.max())]\n"
                       "def broken(picture):\n"
                       "    raise ValueError('nothing here')\n"
                       "def odd(picture):\n"
                       "    return np.zeros((2, 4)), np.zeros(3)\n"
                       "def nan(picture):\n"
                       "    return [[0, 0, 1, float('nan')]], [1.0]\n")
        said = self.measured(self.folder, "--detector", f"{own}:all_of_it", "--threshold", 0)
        self.assertIn("false alarms              24", said)
        self.assertIn("nothing here", self.measured(self.folder, "--detector", f"{own}:broken", code=3))
        self.assertIn("allowed are n x 4 and n", self.measured(self.folder, "--detector", f"{own}:odd", code=2))
        self.assertIn("no number", self.measured(self.folder, "--detector", f"{own}:nan", code=2))

    def test_refusals(self):
        painted(self.folder / "set")
        for words, said in (([self.folder / "nowhere"], "give -o DIR"), ([self.folder, "--detector", "none"], "allowed: cfar"),
                            ([self.folder, "--detector", "no.such:thing"], "no module no"), ([self.folder, "--by", "colour"], "allowed: aspect_deg"),
                            ([self.folder, "--by", "range_m:5,1"], "rising"), ([self.folder, "--by", "range_m:x,1"], "rising"),
                            ([self.folder, "--by", "class:1,2"], "is no number"), ([self.folder, "--bins", 0], "--bins 0"),
                            ([self.folder, "--alarms", "-1"], "--alarms"), ([self.folder, "--split", "train"], "another --split"),
                            ([self.folder, "--threshold", "nan"], "is a number"),
                            ([self.folder, "--only", 3], "needs a recipe"), ([self.folder / "set/test"], "manifest.jsonl")):
            self.assertIn(said, self.measured(*words, code=2), words)

    def test_a_damaged_set_or_detector_is_named(self):
        painted(self.folder / "set")
        broken = self.folder / "broken.py"
        broken.write_text("def find(picture:\n")
        self.assertIn("SyntaxError", self.measured(self.folder, "--detector", f"{broken}:find", code=2))
        manifest = self.folder / "set/manifest.jsonl"
        whole = manifest.read_text()
        for damaged in (whole[:-40], "{}\n", "[]\n"):
            manifest.write_text(damaged)
            self.assertIn("manifest.jsonl", self.measured(self.folder, code=2))
        manifest.write_text(whole)
        next((self.folder / "set/test/amplitude").glob("*.png")).write_bytes(b"no picture")
        self.assertIn("cannot identify", self.measured(self.folder, "--threshold", 12, code=2))

    def test_what_was_missed_is_seen_again(self):
        recipe = SOURCE / "launch/recipes/forward_looking.yaml"
        done = subprocess.run([BIN / "ensonify-detectability", recipe, "-n", "10", "-o", self.folder / "out", "--threshold", "60", "--jobs", "2"],
                              capture_output=True, text=True, timeout=110, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(self.folder / "out/detectability/missed.csv", encoding="utf-8") as file:
            missed = list(csv.DictReader(file))
        self.assertGreaterEqual(len(missed), 2)
        words = shlex.split(missed[0]["again"])
        again = subprocess.run([BIN / words[0], *words[1:]], capture_output=True, text=True, timeout=60, cwd=self.folder, check=False)
        self.assertEqual(again.returncode, 0, again.stdout + again.stderr)
        with open(self.folder / "out/detectability/things.csv", encoding="utf-8") as file:
            score = next(row["score"] for row in csv.DictReader(file) if (row["picture"], row["thing"]) == (missed[0]["picture"], missed[0]["thing"]))
        self.assertIn(f"{missed[0]['thing']}: missed" + (f", {float(score):.4f}" if score else ""), again.stdout)
        self.assertTrue(list(self.folder.glob("again_*/detectability/*.png")))


if __name__ == "__main__":
    unittest.main()
