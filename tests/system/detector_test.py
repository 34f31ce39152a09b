"""examples/train_detector: its scores against COCO's own, its readers against each other, and a shortened training."""
import contextlib
import importlib.util
import io
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from PIL import Image
from support import BIN, SHARED, SOURCE

HERE = SOURCE / "examples/train_detector"
NEEDED = importlib.util.find_spec("torch") is not None
sys.path.insert(0, str(HERE))


def run(*words: str) -> subprocess.CompletedProcess:
    environment = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"}
    return subprocess.run([sys.executable, str(HERE), *words], capture_output=True, text=True, timeout=500, env=environment)


def painted(split: Path, random: np.random.Generator) -> None:
    """Pictures as `ensonify dataset` writes them: discs and bars in Rayleigh noise."""
    for kind in ("facts", "amplitude", "masks"):
        (split / kind).mkdir(parents=True)
    y, x = np.mgrid[0:256, 0:128]
    for number in range(16):
        owner, objects = np.zeros(y.shape, np.uint16), []
        for instance in range(1, int(random.integers(0, 4)) + 1):
            name, row, column = str(random.choice(["bar", "disc"])), random.integers(30, 226), random.integers(20, 108)
            there = np.hypot(y - row, x - column) < 9 if name == "disc" else (abs(y - row) < 3) & (abs(x - column) < 14)
            owner[there] = instance
            objects.append({"instance": instance, "class": name})
        level = random.rayleigh(200, y.shape) * np.where(owner > 0, 10, 1)
        Image.fromarray(level.clip(1, 65535).astype(np.uint16)).save(split / "amplitude" / f"{number}.png")
        Image.fromarray(owner).save(split / "masks" / f"{number}.png")
        facts = {"kind": "forward_looking", "beam_from_rad": -0.5, "beam_to_rad": 0.5, "objects": objects}
        (split / "facts" / f"{number}.json").write_text(json.dumps(facts))


def classes_of_cut_outs(folder: Path, random: np.random.Generator, of_each: int) -> None:
    """A folder for each class: a thing, that fills most of a picture of 40 x 40."""
    y, x = np.mgrid[0:40, 0:40] - 19.5
    for name, there in (("disc", np.hypot(y, x) < 12), ("bar", (abs(y) < 4) & (abs(x) < 16))):
        (folder / name).mkdir(parents=True)
        for number in range(of_each):
            level = random.rayleigh(20, y.shape) * np.where(there, 6, 1)
            Image.fromarray(level.clip(0, 255).astype(np.uint8)).save(folder / name / f"{name}_{number}.png")


def random_picture(random: np.random.Generator, kinds: int):
    """Things, some that do not count, and finds near to them or anywhere."""
    import scores
    count = int(random.integers(0, 5))
    corner = random.uniform(0, 200, (count, 2))
    boxes = np.hstack([corner, corner + random.uniform(10, 60, (count, 2))])
    found = [box + random.normal(0, 4, 4) for box in boxes for _ in range(int(random.integers(0, 3)))]
    stray = random.uniform(0, 200, (int(random.integers(0, 4)), 2))
    found = np.array(found + [np.hstack([at, at + random.uniform(10, 60, 2)]) for at in stray]).reshape(-1, 4)
    found[:, 2:] = np.maximum(found[:, 2:], found[:, :2] + 1)
    score = np.sort(random.uniform(0, 1, len(found)))[::-1]
    shares = np.eye(kinds)[random.integers(kinds, size=len(found))]
    return scores.Judged(boxes, random.integers(kinds, size=count), random.random(count) < 0.15, found, score, shares, 256 * 256)


@unittest.skipUnless(NEEDED, "there is no PyTorch: apt-get install python3-torch")
class Scores(unittest.TestCase):
    def by_coco(self, pictures, blind: bool) -> np.ndarray:
        """Precision by threshold, recall and class, of the reference implementation."""
        from pycocotools.coco import COCO
        from pycocotools.cocoeval import COCOeval
        wide = lambda box: [box[0], box[1], box[2] - box[0], box[3] - box[1]]  # noqa: E731
        annotations, finds = [], []
        for number, picture in enumerate(pictures, 1):
            for box, kind, ignored in zip(picture.boxes, picture.kinds, picture.ignored):
                for of in ([1] if blind else ([1, 2, 3] if ignored else [int(kind) + 1])):
                    annotations.append({"id": len(annotations) + 1, "image_id": number, "category_id": of, "bbox": wide(box),
                                        "area": float((box[2] - box[0]) * (box[3] - box[1])), "iscrowd": int(ignored)})
            for box, score, share in zip(picture.found, picture.scores, picture.shares):
                finds.append({"image_id": number, "category_id": 1 if blind else int(share.argmax()) + 1, "bbox": wide(box), "score": float(score)})
        truth = COCO()
        truth.dataset = {"images": [{"id": i + 1, "width": 300, "height": 300} for i in range(len(pictures))], "annotations": annotations,
                         "categories": [{"id": i + 1} for i in range(1 if blind else 3)]}
        with contextlib.redirect_stdout(io.StringIO()):
            truth.createIndex()
            judge = COCOeval(truth, truth.loadRes(finds), "bbox")
            judge.evaluate()
            judge.accumulate()
        return judge.eval["precision"][:, :, :, 0, 2]

    def test_average_precision_is_coco_s(self):
        import scores
        random = np.random.default_rng(3)
        pictures = [random_picture(random, 3) for _ in range(60)]
        blind = self.by_coco(pictures, blind=True)
        for i, least in enumerate(scores.THRESHOLDS):
            self.assertAlmostEqual(scores.average_precision(pictures, least), blind[i].mean(), places=6)
        by_class = self.by_coco(pictures, blind=False)
        for picture in pictures:  # a find of another class is none of this class's
            picture.shares[picture.shares == 0] = 1e-9
        for kind in range(3):
            mine = [scores.Judged(of.boxes, of.kinds, of.ignored, of.found[of.shares.argmax(1) == kind], of.scores[of.shares.argmax(1) == kind],
                                  of.shares[of.shares.argmax(1) == kind], of.pixels) for of in pictures]
            self.assertAlmostEqual(scores.average_precision(mine, 0.5, kind), by_class[0, :, kind].mean(), places=6)

    def test_false_alarms_by_hand(self):
        import scores
        box = np.array([[10.0, 10, 30, 30]])
        found = np.array([[12.0, 12, 28, 28], [11, 11, 31, 31], [100, 100, 120, 120]])  # a hit, a second hit, a false alarm
        one = scores.Judged(box, np.array([0]), np.array([False]), found, np.array([0.9, 0.8, 0.7]), np.ones((3, 1)), 40000)
        other = scores.Judged(np.zeros((0, 4)), np.array([], int), np.array([], bool), found[2:], np.array([0.95]), np.ones((1, 1)), 60000)
        self.assertEqual(scores.alarms(one).tolist(), [1, -1, 0])
        self.assertEqual(scores.recall_at([one, other], 0.0), 0.0)  # the surest of all is a false alarm
        self.assertEqual(scores.recall_at([one, other], 0.5), 1.0)
        at = scores.at_threshold([one, other], 0.85)
        self.assertEqual((at["recall"], at["empty_with_alarm"]), (1.0, 1.0))
        self.assertAlmostEqual(at["alarms_per_megapixel"], 1 / 0.06)
        self.assertFalse(scores.near(np.array([0.0, 0, 100, 100]), np.array([45.0, 45, 55, 55])))  # areas differ by a hundred
        of = scores.of_classes(np.array([0, 0, 1, 1]), np.array([0, 1, 1, -1]), 2)
        self.assertEqual(of["balanced accuracy"], 0.5)
        self.assertAlmostEqual(of["macro F1"], (2 / 3 + 1 / 2) / 2)


class Readers(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))

    def picture(self, name: str, level: int = 90) -> None:
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        Image.fromarray(np.full((40, 50), level, np.uint8)).save(file)

    def boxes(self) -> list:
        import labelled
        return [(picture.file.name, thing.name, [round(float(x), 3) for x in thing.box], thing.ignored)
                for picture in labelled.read(self.folder) for thing in picture.things]

    def test_the_same_thing_in_four_forms(self):
        wanted = [("a.png", "ball", [10.0, 5.0, 20.0, 25.0], False)]
        self.picture("images/a.png")
        mask = np.zeros((40, 50), np.uint8)
        mask[5:25, 10:20] = 1
        (self.folder / "masks").mkdir()
        Image.fromarray(mask).save(self.folder / "masks/a.png")
        (self.folder / "classes.txt").write_text("ball\n")
        self.assertEqual(self.boxes(), wanted)
        (self.folder / "a.xml").write_text("<annotation><filename>a.png</filename><object><name>ball</name><bndbox><xmin>11</xmin><ymin>6</ymin>"
                                           "<xmax>20</xmax><ymax>25</ymax></bndbox></object></annotation>")
        self.assertEqual(self.boxes(), wanted)
        (self.folder / "labels").mkdir()
        (self.folder / "labels/a.txt").write_text("0 0.3 0.375 0.2 0.5\n")
        (self.folder / "data.yaml").write_text("names: [ball]\n")
        self.assertEqual(self.boxes(), wanted)
        from pycocotools import mask as coco_mask
        text = coco_mask.encode(np.asfortranarray(mask))
        annotation = {"id": 1, "image_id": 7, "category_id": 3, "bbox": [10, 5, 10, 20], "iscrowd": 0, "area": 200,
                      "segmentation": {"size": text["size"], "counts": text["counts"].decode()}}
        (self.folder / "all.json").write_text(json.dumps({"images": [{"id": 7, "file_name": "a.png", "width": 50, "height": 40, "group": "g"}],
                                                          "annotations": [annotation], "categories": [{"id": 3, "name": "ball"}]}))
        self.assertEqual(self.boxes(), wanted)
        import labelled
        self.assertTrue((labelled.read(self.folder)[0].things[0].mask((40, 50)) == mask).all())

    def test_two_parts_of_a_mask_are_two_things_and_folders_are_classes(self):
        self.picture("images/a.png")
        mask = np.zeros((40, 50, 3), np.uint8)
        mask[5:9, 10:20] = mask[20:30, 3:8] = 255
        mask[8:12, 19:22] = 255  # hangs together with the first
        (self.folder / "masks").mkdir()
        Image.fromarray(mask).save(self.folder / "masks/a.png")
        self.assertEqual([box for _, _, box, _ in self.boxes()], [[10, 5, 22, 12], [3, 20, 8, 30]])
        import labelled
        with tempfile.TemporaryDirectory() as other:
            self.folder = Path(other)
            for name in ("ball/1.png", "tyre/2.png", "empty/3.png"):
                self.picture(name)
            self.assertEqual([[thing.name for thing in picture.things] for picture in labelled.read(self.folder)], [["ball"], [], ["tyre"]])

    def test_names_are_changed_dropped_and_ignored(self):
        import labelled
        self.folder.joinpath("labels").mkdir()
        self.picture("images/a.png")
        self.folder.joinpath("labels/a.txt").write_text("0 0.5 0.5 0.2 0.2\n\n1 0.2 0.2 0.1 0.1\n2 0.8 0.8 0.1 0.1\n")
        read = labelled.chosen(labelled.read(self.folder), {"0": "ball"}, ["1"], [], ["2"])
        self.assertEqual([(thing.name, thing.ignored) for thing in read[0].things], [("ball", False), ("2", True)])

    def test_nearly_equal_pictures_are_one_group(self):
        from groups import groups_of
        import labelled
        random = np.random.default_rng(1)
        scene = random.uniform(0, 255, (2, 40, 50))
        for i, level in enumerate((scene[0], 0.8 * scene[0] + 10, scene[1])):
            self.picture(f"{i}.png")
            Image.fromarray(level.astype(np.uint8)).save(self.folder / f"{i}.png")
        pictures = [labelled.Labelled(self.folder / f"{i}.png", []) for i in range(3)]
        self.assertEqual(groups_of(pictures).tolist(), [0, 0, 1])
        for picture, group in zip(pictures, "xyx"):
            picture.group = group
        self.assertEqual(groups_of(pictures).tolist(), [0, 1, 0])

    def test_what_cannot_be_read_is_said(self):
        import labelled
        for name, text, cause in (("a.json", "{", "JSONDecodeError"), ("b.json", json.dumps(dict(
                images=[{"id": 1, "file_name": "no.png"}], annotations=[], categories=[])), "no.png: there is no such picture")):
            with tempfile.TemporaryDirectory() as folder:
                Path(folder, name).write_text(text)
                with self.assertRaisesRegex(labelled.Unreadable, cause):
                    labelled.read(Path(folder))
        with self.assertRaisesRegex(labelled.Unreadable, "allowed are COCO"):
            labelled.read(self.folder)
        with self.assertRaisesRegex(labelled.Unreadable, "is no folder"):
            labelled.read(self.folder / "none")


@unittest.skipUnless(NEEDED, "there is no PyTorch: apt-get install python3-torch")
class Realism(unittest.TestCase):
    """Statistics against their closed forms."""

    def k_distributed(self, shape: float) -> np.ndarray:
        random = np.random.default_rng(5)
        return random.gamma(shape, 1 / shape, 400_000) * random.exponential(1, 400_000)

    def test_shape_of_k_distributed_intensity_is_found(self):
        import realism
        for shape in (0.5, 2.0, 8.0):
            for found in (realism.inverse_shape_by_moments, realism.inverse_shape_by_logs):
                self.assertAlmostEqual(found(self.k_distributed(shape)) * shape, 1, delta=0.06)
        rayleigh = np.random.default_rng(6).exponential(1, 400_000)
        self.assertAlmostEqual(realism.inverse_shape_by_moments(rayleigh), 0, delta=0.01)
        self.assertLess(realism.inverse_shape_by_logs(rayleigh), 0.01)
        self.assertEqual(realism.inverse_shape_by_logs(rayleigh ** 0.5), 0)  # less varied than speckle
        self.assertAlmostEqual(realism.contrast(np.sqrt(rayleigh)), 0.5227, delta=0.002)

    def test_texture_of_a_checkerboard_stripes_and_noise(self):
        import realism
        board = np.indices((32, 32)).sum(0) % 2
        self.assertEqual(realism.texture(realism.cooccurrence(board, (0, 1), 2)), {"contrast": 1, "correlation": -1, "energy": 0.5, "entropy": 1})
        self.assertEqual(realism.texture(realism.cooccurrence(board, (1, 1), 2))["correlation"], 1)
        stripes = np.indices((32, 32))[0] % 2
        self.assertEqual([realism.texture(realism.cooccurrence(stripes, step, 2))["correlation"] for step in ((1, 0), (0, 1))], [-1, 1])
        noise = np.random.default_rng(7).normal(size=(700, 700))
        level = realism.by_rank(noise)
        self.assertTrue((np.bincount(level.ravel()) - 700 * 700 / 8 < 2).all())
        found = realism.texture(realism.cooccurrence(level, (0, 1)))
        for name, of in (("contrast", 2 * (8 ** 2 - 1) / 12), ("correlation", 0), ("energy", 1 / 64), ("entropy", 6)):
            self.assertAlmostEqual(found[name], of, delta=0.05)
        self.assertTrue((realism.by_rank(np.exp(3 * noise)) == level).all())  # a display's curve changes nothing

    @unittest.skipUnless((SHARED / "data/sonar/scotsman-iver2.xtf").is_file(), "there is no real sidescan")
    def test_windows_of_a_real_sidescan_lie_on_the_seabed(self):
        """Its water column has 500 counts, its seabed ten thousand; port runs the other way."""
        import realism
        of = realism.of_xtf(SHARED / "data/sonar/scotsman-iver2.xtf")
        self.assertEqual((len(of.groups), len(set(of.groups))), (142, 7))
        self.assertLess(np.mean([part.mean() < 1000 for part in of.parts]), 0.05)

    def test_two_folders_are_compared_and_interval_holds_the_value(self):
        with tempfile.TemporaryDirectory() as folder:
            painted(Path(folder, "a/set/train"), np.random.default_rng(1))
            painted(Path(folder, "b/set/train"), np.random.default_rng(2))
            classes_of_cut_outs(Path(folder, "grey"), np.random.default_rng(3), 5)
            done = run("realism", f"{folder}/a", f"{folder}/b", "--json", f"{folder}/of.json")
            self.assertEqual(done.returncode, 0, done.stderr)
            for of in json.loads(Path(folder, "of.json").read_text())["numbers"]:
                low, high = of["speckle contrast"]["interval"]
                self.assertTrue(low <= of["speckle contrast"]["value"] <= high)
                self.assertAlmostEqual(of["speckle contrast"]["value"], 0.5227, delta=0.1)  # Rayleigh, but for the things
            done = run("realism", f"{folder}/a", f"{folder}/grey")
            self.assertEqual((done.returncode, "neither speckle" in done.stdout, "speckle contrast" in done.stdout), (0, True, False), done.stderr)
            (Path(folder) / "x.xtf").write_bytes(b"no sonar")
            for wrong, said in (("none", "allowed is an XTF file"), ("x.xtf", "x.xtf")):
                done = run("realism", f"{folder}/{wrong}", f"{folder}/a")
                self.assertEqual((done.returncode, said in done.stderr), (2, True), done.stderr)


@unittest.skipUnless(NEEDED, "there is no PyTorch: apt-get install python3-torch")
class Worth(unittest.TestCase):
    def test_curve_is_linear_in_log_k(self):
        import worth
        curve = {10: 0.2, 30: 0.1, 100: 0.4, 300: 0.6}  # a fall counts as level
        self.assertAlmostEqual(worth.equal(curve, 0.5), np.sqrt(100 * 300))
        self.assertAlmostEqual(worth.equal(curve, 0.3), np.sqrt(30 * 100))
        self.assertEqual((worth.equal(curve, 0.15), worth.equal(curve, 0.61)), (0.0, float("inf")))
        self.assertEqual([worth.as_word(k, [10, 300]) for k in (0.0, 42.4, float("inf"))], ["< 10", "42", "> 300"])


@unittest.skipUnless(NEEDED, "there is no PyTorch: apt-get install python3-torch")
class Training(unittest.TestCase):
    def test_bright_things_are_learnt(self):
        """Sixty steps on discs and bars that stand out by 20 dB: another picture's are found, and by an untrained net are not."""
        import scenes
        import scores
        import training
        from detector import Detector
        from judging import judged
        with tempfile.TemporaryDirectory() as folder:
            for split, seed in (("train", 1), ("test", 2)):
                painted(Path(folder, "set", split), np.random.default_rng(seed))
            names = ["bar", "disc"]
            self.assertEqual(scenes.classes([Path(folder)]), names)
            found = {}
            for steps in (1, 60):
                examples = scenes.generated.Examples(scenes.generated.masters([Path(folder)], "train"), names, 256, np.random.default_rng(1))
                net = training.train(training.Batches(examples, 1), names, Path(folder, f"{steps}.pt"), steps, seed=1, say=lambda *_, **__: None)
                detector = Detector(net, names, 0.5, {})
                pictures = [judged(one, detector.find(one.grey()), names, one.grey().shape, [], 0.5)
                            for one in scenes.shown([Path(folder)], "test", names, 40)]
                found[steps] = scores.recall_at(pictures, 1.0)
            self.assertGreater(found[60], max(0.5, found[1] + 0.3), found)

    def test_worth_of_pictures_like_the_real_ones(self):
        """Real pictures are painted as the generated ones are. Short trainings of small pictures: numbers are bounds of sense, not of quality."""
        with tempfile.TemporaryDirectory() as folder:
            painted(Path(folder, "set/train"), np.random.default_rng(1))
            classes_of_cut_outs(Path(folder, "real"), np.random.default_rng(2), 12)
            done = run("worth", "--generated", folder, "--real", f"{folder}/real", "-o", f"{folder}/out", "--steps", "8", "--size", "64", "--jobs", "2")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            result = json.loads(Path(folder, "out/worth.json").read_text())
            self.assertEqual((result["score"], result["classes"], result["held_out"]), ("balanced accuracy", ["bar", "disc"], 10))
            self.assertEqual(result["left_out"], [30, 100, 300])
            self.assertEqual(set(result["scores"]), {"generated", "real 10", "generated and real 10"})
            for of in result["scores"].values():
                self.assertTrue(0 <= of["interval"][0] <= of["value"] <= of["interval"][1] <= 1, of)
            self.assertIn(result["worth"], ("< 10", "> 10", "10"))
            at = {file: file.stat().st_mtime_ns for file in Path(folder, "out").glob("*.pt")}
            self.assertEqual(len(at), 7)
            again = run("worth", "--generated", folder, "--real", f"{folder}/real", "-o", f"{folder}/out", "--steps", "8", "--size", "64")
            self.assertEqual((again.returncode, again.stdout), (0, done.stdout), again.stderr)
            self.assertEqual({file: file.stat().st_mtime_ns for file in at}, at)  # not trained again
            for wrong, said in ((("--real", f"{folder}/out"), "no labelled pictures"), (("--groups", f"{folder}/none.csv"), "none.csv"),
                                (("--generated", f"{folder}/real"), "no generated set"), (("--size", "64", "--steps", "9"), "nets of other")):
                done = run("worth", "--generated", folder, "--real", f"{folder}/real", "-o", f"{folder}/out", *wrong)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertIn(said, done.stderr)

    def test_cut_outs_teach_their_classes(self):
        """Discs and bars of another set, cut out and drawn by other displays, are told apart; a scene is a group."""
        import cut_outs
        import generated
        import labelled
        import whole
        with tempfile.TemporaryDirectory() as folder:
            for of, seed in (("a", 1), ("b", 2)):
                painted(Path(folder, of, "set/train"), np.random.default_rng(seed))
            done = run("cut", f"{folder}/b", "-o", f"{folder}/cut")
            self.assertEqual(done.returncode, 0, done.stderr)
            pictures = labelled.read(Path(folder, "cut"))
            self.assertTrue(all(picture.group.startswith("b_") for picture in pictures))
            mine = cut_outs.CutOuts(generated.masters([Path(folder, "a")], "train"))
            self.assertEqual(mine.limited(6).count(), 6)
            net = whole.train([mine], ["bar", "disc"], Path(folder, "net.pt"), 40, 64, seed=1)
            said = whole.said(net, pictures, 64, [0, 1])
            right = np.mean([["bar", "disc"][of] == picture.things[0].name for of, picture in zip(said, pictures)])
            self.assertGreater(right, 0.85)

    def test_curve_takes_so_many_cut_outs(self):
        with tempfile.TemporaryDirectory() as folder:
            painted(Path(folder, "set/train"), np.random.default_rng(1))
            classes_of_cut_outs(Path(folder, "real"), np.random.default_rng(2), 8)
            words = ("curve", "--generated", folder, "--real", f"{folder}/real", "-o", f"{folder}/out", "--counts", "4", "12", "999", "--seeds", "2", "--steps", "2")
            done = run(*words)
            self.assertEqual(done.returncode, 0, done.stderr)
            result = json.loads(Path(folder, "out/curve.json").read_text())
            self.assertEqual({name: of["cut_outs"] for name, of in result.items()}, {"4": 4, "12": 12})  # 999 there are not
            self.assertEqual(len(list(Path(folder, "out").glob("*.pt"))), 4)
            done = run(*words[:-1], "3")
            self.assertEqual((done.returncode, "nets of other" in done.stderr), (2, True), done.stderr)

    def test_each_effect_is_off_alone(self):
        """Variants are the same scenes. Too few steps to learn anything."""
        import curve
        import generated
        with tempfile.TemporaryDirectory() as folder:
            classes_of_cut_outs(Path(folder, "real"), np.random.default_rng(2), 8)
            done = run("effects", str(HERE / "recipes/hung_750khz.yaml"), "-n", "1", "--count", "10", "--seeds", "1", "--steps", "2", "--real", f"{folder}/real", "-o",
                       f"{folder}/out")
            self.assertEqual(done.returncode, 0, done.stderr)
            result = json.loads(Path(folder, "out/effects.json").read_text())
            self.assertEqual(set(result), set(curve.EFFECTS))
            self.assertEqual({name for name, of in result.items() if "difference" not in of}, {curve.AS_IT_IS})
            sets = {name: generated.masters([Path(folder, "out", name.replace(" ", "_"))], "train") for name in curve.EFFECTS}
            first, owner = sets[curve.AS_IT_IS][0].read()
            for name in curve.EFFECTS:
                amplitude, other = sets[name][0].read()
                self.assertTrue((other == owner).all(), name)
                self.assertEqual((amplitude == first).all(), name == curve.AS_IT_IS, name)
            plain = sets[curve.TEXTURE][0]
            textured = curve.Textured(plain.folder, plain.name, plain.facts).read()[0].astype(float)
            self.assertAlmostEqual((textured ** 2).sum() / (plain.read()[0].astype(float) ** 2).sum(), 1, delta=0.1)

    def test_one_command_makes_and_one_tests(self):
        """Too few steps to find anything; a training goes on where it was cut off."""
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder, "out")
            make = ("make", "imaging", "-o", str(out), "--pictures", "60", "--validate", "20")
            done = run(*make, "--steps", "4")
            self.assertEqual(done.returncode, 0, done.stderr)
            first = (out / "detector.pt").read_bytes()
            done = run(*make, "--steps", "8")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("step 8 of 8", done.stdout)
            self.assertNotEqual(first, (out / "detector.pt").read_bytes())
            import torch
            self.assertEqual(torch.load(out / "training.pt")["step"], 8)
            done = run("test", str(out), "--count", "30", "--json", str(out / "scores.json"), "--pictures", str(out / "drawn"))
            self.assertEqual(done.returncode, 0, done.stderr)
            result = json.loads((out / "scores.json").read_text())
            self.assertGreater(result["things"], 5)
            self.assertEqual(result["pictures"], 30)
            self.assertEqual(len(list((out / "drawn").iterdir())), 30)
            self.real_folders(out)

    def real_folders(self, out: Path):
        """A folder for each class, and one with nothing in it; a class that the detector has not."""
        random = np.random.default_rng(2)
        for of in ("kugel", "tyre", "empty"):
            (out / "real" / of).mkdir(parents=True)
            for i in range(3):
                Image.fromarray(random.integers(0, 255, (70, 61), np.uint8)).save(out / "real" / of / f"{i}.jpg")
        done = run("test", str(out), str(out / "real"), "--rename", "kugel=ball")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("balanced accuracy", done.stdout)
        done = run("test", str(out), str(out / "real"))
        self.assertIn("classes that the detector has not", done.stderr)
        (out / "wrong.pt").write_text("no detector")
        for words, cause in ((("test", str(out / "wrong.pt")), "wrong.pt: UnpicklingError"), (("test", str(out / "none")), "none: is not there"), (("test", str(out), str(out / "drawn")), "allowed are COCO"),
                             (("test", str(out), str(out / "real"), "--rename", "x"), "allowed is THEIRS=OURS")):
            done = run(*words)
            self.assertEqual((done.returncode, cause in done.stderr), (2, True), done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
