"""`ensonify dataset`: the same set however it is made, and refusals."""
import json
import os
import shutil
import signal
import subprocess
import time
import unittest

import numpy as np
import yaml

from ensonify import Record
from ensonify.dataset.check import leaks, rows_of
from ensonify.dataset.plan import Plan
from ensonify.labels.dataset import Dataset
from support import BIN, SOURCE, SystemTest

RECIPES = SOURCE / "launch/recipes"


def files_of(folder):
    """Bytes by name of all files of a set."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in sorted(folder.rglob("*")) if file.is_file()}


class DatasetTest(SystemTest):
    def dataset(self, *words, code=0, timeout=300):
        done = subprocess.run([BIN / "ensonify-dataset", *map(str, words)], capture_output=True, text=True, timeout=timeout,
                              env=os.environ | {"PATH": f"{BIN}:{os.environ['PATH']}"}, check=False)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def recipe(self, more="", of="forward_looking"):
        """A shipped recipe with other keys."""
        recipe = yaml.safe_load((RECIPES / f"{of}.yaml").read_text()) | yaml.safe_load(more or "{}")
        recipe["launch"] = str(RECIPES / recipe["launch"])
        return self.write("recipe.yaml", yaml.safe_dump(recipe))

    def test_a_set_is_the_same_however_it_is_made(self):
        recipe = self.recipe("formats: [coco, yolo, voc, masks, webdataset]\nsplits: { train: 0.5, val: 0.25, test: 0.25 }")
        one = self.folder / "one"
        self.dataset(recipe, "-n", 8, "-o", one, "--jobs", 2)
        whole = files_of(one / "set")
        self.check_content(one / "set", whole)
        self.assertIn("is whole already", self.dataset(recipe, "-n", 8, "-o", one))

        self.check_interrupted(recipe, whole)
        for part in (1, 2):
            self.dataset(recipe, "-n", 8, "-o", self.folder / f"part{part}", "--shard", f"{part}/2", "--jobs", 1)
        self.assertIn("4 scenes are missing, the first is 1", self.dataset(recipe, "-n", 8, "-o", self.folder / "merged", "--merge",
                                                                          self.folder / "part1", code=2))
        self.dataset(recipe, "-n", 8, "-o", self.folder / "merged", "--merge", self.folder / "part1", self.folder / "part2")
        self.assertEqual(files_of(self.folder / "merged/set"), whole)

        self.dataset(recipe, "-o", self.folder / "only", "--only", 5)
        alone = {name: content for name, content in files_of(self.folder / "only/set").items() if "00000005" in name}
        self.assertEqual(len(alone), 7, list(alone))
        self.assertEqual(alone, {name: content for name, content in whole.items() if "00000005" in name})

        self.check_leaks(one)
        self.assertIn("holds another plan", self.dataset(self.recipe("seed: 2"), "-n", 8, "-o", one, code=2))

    def check_content(self, folder, whole):
        rows = rows_of(folder)
        self.assertEqual([row["picture"] for row in rows], list(range(8)))
        self.assertEqual({row["split"] for row in rows}, {"train", "val", "test"})
        full = [row for row in rows if row["objects"]]
        self.assertGreater(len(full), 1)
        for row in full:
            self.assertTrue(row["kind"] and row["shows"], row)
        self.assertEqual(sum(name.startswith("train/images/") for name in whole), sum(row["split"] == "train" for row in rows))
        for split in ("train", "val", "test"):
            self.assertGreaterEqual(len(Dataset(folder / split)), 1)
            names = {one["id"]: one["name"] for one in json.loads(whole[f"{split}/annotations.json"])["categories"]}
            self.assertEqual(names, {1: "crate", 2: "mine-like", 3: "person", 4: "tyre", 5: "buoy"} | names)
        self.assertIn(b"No public labelled sonar set was used", whole["card.html"])
        self.check_by_pycocotools(folder)

    def check_by_pycocotools(self, folder):
        try:
            from pycocotools.coco import COCO
        except ModuleNotFoundError:
            return
        coco = COCO(folder / "train/annotations.json")
        for annotation in coco.loadAnns(coco.getAnnIds()):
            self.assertEqual(coco.annToMask(annotation).sum(), annotation["area"])

    def check_interrupted(self, recipe, whole):
        """Killed as soon as a scene is done, and again, and then left alone."""
        out = self.folder / "killed"
        for scenes in (1, 4):
            running = subprocess.Popen([BIN / "ensonify-dataset", str(recipe), "-n", "8", "-o", str(out), "--jobs", "1"],
                                       stderr=subprocess.DEVNULL, env=os.environ | {"PATH": f"{BIN}:{os.environ['PATH']}"})
            until = time.monotonic() + 120
            while len(list(out.glob("runs/*/result.json"))) < scenes:
                self.assertLess(time.monotonic(), until)
                self.assertIsNone(running.poll())
                time.sleep(0.02)
            running.send_signal(signal.SIGKILL)
            running.wait(30)
            self.assertFalse((out / "set").exists())
        self.dataset(recipe, "-n", 8, "-o", out, "--jobs", 2)
        self.assertEqual(files_of(out / "set"), whole)

    def check_leaks(self, one):
        self.assertIn("8 pictures, no leaks", self.dataset("--check", one))
        leaky = self.folder / "leaky"
        shutil.copytree(one / "set", leaky)
        rows = rows_of(leaky)
        for row in rows:
            row["split"] = "train"
        rows[3]["scene"], rows[3]["split"] = rows[4]["scene"], "test"
        (leaky / "manifest.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
        self.assertIn(f"scene: pictures 00000003 (test) and 00000004 (train) share {rows[4]['scene']}", self.dataset("--check", leaky, code=1))
        for row in rows:
            row["ground"] = 0
        self.assertTrue(any(leak.startswith("place: ") for leak in leaks(rows)))

    def test_pairs_are_the_same_scene_with_a_change(self):
        """Bit by bit the same ping before the nearest thing's echo, or before the first ground's."""
        out = self.folder / "pairs"
        pairs = "{ bare: { without: objects }, stony: { draw: { seabed.sediments.2: { lambert_mu_db: -6 } } } }"
        more = f"empty_share: 0\nsplits: {{ train: 1, val: 0, test: 0 }}\npairs: {pairs}"
        self.dataset(self.recipe(more), "-n", 3, "-o", out, "--jobs", 2, "--keep-runs")
        rows = {(row["picture"], row["pair"]): row for row in rows_of(out)}
        self.assertEqual(set(rows), {(k, pair) for k in range(3) for pair in ("", "bare", "stony")})
        self.assertEqual(rows[1, "stony"]["name"], "00000001_stony")
        scenes = {(scene["scene"], scene["pair"]): scene for scene in Plan(out).scenes()}
        bare = stony = 0
        for k in range(3):
            row = rows[k, ""]
            self.assertEqual(rows[k, "bare"]["objects"], [])
            ping, without, other = (self.first_ping(out, scenes[k, pair]) for pair in ("", "bare", "stony"))
            range_m = 0.5 * ping.sound_speed_mps * (ping.first_sample_s + ping.sample_period_s * np.arange(ping.amplitude_upa.shape[1]))
            if row["objects"]:
                nearest_m = min(thing["range_m"] for thing in row["objects"])
                before = range_m < nearest_m - 2  # its size, the bend of paths, and the pulse
                self.assertTrue(before.any())
                np.testing.assert_array_equal(ping.amplitude_upa[:, before], without.amplitude_upa[:, before])
                bare += int((ping.amplitude_upa != without.amplitude_upa).sum())
            water = range_m < 1.5  # the ground is 2.5 m below the head and more
            np.testing.assert_array_equal(ping.amplitude_upa[:, water], other.amplitude_upa[:, water])
            stony += int((ping.amplitude_upa != other.amplitude_upa).sum())
        self.assertGreater(bare, 0)
        self.assertGreater(stony, 0)

    @staticmethod
    def first_ping(out, scene):
        with Record(str(out / "runs" / scene["id"] / "scene.mcap")) as record:
            return next(message for _, _, message in record.messages("eye/ping"))

    def test_chips_hold_what_they_were_made_for(self):
        out = self.folder / "chips"
        self.dataset(self.recipe("empty_share: 0.2\nsplits: { train: 1, val: 0, test: 0 }", of="sidescan"), "-n", 4, "-o", out, "--jobs", 1)
        rows = [row for row in rows_of(out) if row["kind"]]
        self.assertGreaterEqual(len(rows), 2)
        for row in rows:
            self.assertTrue(row["shows"], row)
            thing = next(one for one in row["objects"] if one["name"].startswith(f"{row['kind']}_{row['picture']}_"))
            x, y, wide, high = thing["box"]
            self.assertLess(abs(x + wide / 2 - 128), 64 + 12, row["name"])
            self.assertTrue(row["settings"]["top"] == 0 or abs(y + high / 2 - 128) < 64 + 12, row["name"])

    def test_a_full_disk_ends_it_and_it_goes_on_with_room(self):
        recipe = self.recipe("splits: { train: 1, val: 0, test: 0 }")
        disk, words = self.folder / "disk", f"{BIN}/ensonify-dataset {recipe} -n 2 --jobs 1 -o"
        disk.mkdir()
        script = (f"mount -t tmpfs -o size=600k none {disk} || exit 77\n{words} {disk}/out; echo ended with $?\n"
                  f"mount -o remount,size=200m {disk}\n{words} {disk}/out && cp -r {disk}/out/set {self.folder}/copy")
        done = subprocess.run(["unshare", "--user", "--map-root-user", "--mount", "sh", "-c", script], capture_output=True, text=True, timeout=200,
                              env=os.environ | {"PATH": f"{BIN}:{os.environ['PATH']}"}, check=False)
        if done.returncode == 77 or "unshare" in done.stderr:
            self.skipTest("no mount of one's own: " + done.stderr)
        self.assertIn("ended with 5", done.stdout, done.stderr)
        self.assertIn("No space left", done.stderr)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.dataset(recipe, "-n", 2, "-o", self.folder / "other")
        self.assertEqual(files_of(self.folder / "copy"), files_of(self.folder / "other/set"))

    def test_what_is_wrong_is_said(self):
        out = self.folder / "out"
        refused = (("heed: eye", "heed: is not a known key; did you mean head?"),
                   ("head: bow", "head: " + str(RECIPES / "forward_looking_launch.yaml") + " has no process bow"),
                   ("draw: { eye.rnge_m: 3 }", "rnge_m"),
                   ("place: { east_m: 0, north_m: 6 }\nclutter: { ring: { count: 2, object: { tyre: {} } } }", "fail by apart_m"),
                   ("splits: { train: 0.99, val: 0.01, test: 0 }", "splits.val: has none of 8 scenes"))
        for more, said in refused:
            self.assertIn(said, self.dataset(self.recipe(more), "-n", 8, "-o", out, code=2))
        self.assertIn("--shard 3/2: allowed", self.dataset(self.recipe(), "-n", 8, "-o", out, "--shard", "3/2", code=2))
        self.assertIn("has no manifest.jsonl", self.dataset("--check", self.folder, code=2))


if __name__ == "__main__":
    unittest.main()
