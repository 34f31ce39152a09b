"""Labels of a run: where geometry says, in place of the levels, and written as files by the command."""
import json
import os
import subprocess
import sys
import unittest
from unittest import mock

import numpy as np
import yaml

import ensonify
from ensonify import labels
from ensonify.labels import energies
from ensonify.labels.dataset import Dataset
from ensonify.labels.live import Live
from support import BIN, SOURCE, SystemTest


def rotation(wxyz):
    w, x, y, z = wxyz
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def distance_m(place, start, end):
    """Of a place from a straight leg."""
    along = (end - start) / np.linalg.norm(end - start)
    off = place - start
    return np.linalg.norm(off - np.clip(off @ along, 0, np.linalg.norm(end - start)) * along)


class Labels(SystemTest):
    def test_labels_of_a_run_and_the_files_made_of_them(self):
        result = self.run_launch(SOURCE / "launch/targets.yaml", "--free", timeout=300)
        self.assertEqual(result.code, 0, result.stderr)
        with ensonify.Record(result.out / "targets.mcap") as record:
            self.assertEqual(labels.ping_topics(record), ["eye/ping"])
            pairs = list(labels.labelled(record, "eye/ping"))
            poses = {pose.stamp_ns: pose for _, _, pose in record.messages("auv/pose")}
            objects = {thing.instance: thing for _, _, thing in record.messages("pager/object")}
        self.assertGreater(len(pairs), 3)
        for ping, of, _ in pairs:
            self.assertEqual((of.beams, of.samples), ping.amplitude_upa.shape)
            self.check_places(ping, of, poses[ping.stamp_ns], objects)
        self.check_levels(pairs[0].ping, pairs[0].labels)
        self.check_files(result.out, len(pairs))

    def test_energies_of_a_run(self):
        """The mean of |p|^2 over pings that stand still but for speckle is what was expected; an object's response lies on its mask."""
        result = self.run_launch(SOURCE / "launch/targets.yaml", "--free", "--set", "eye.labels=energies",
                                 "--set", "recorder.topics=[eye/ping, eye/labels, eye/energies, auv/pose, nav/estimate, pager/object, pager/chart, pager/tile]", timeout=300)
        self.assertEqual(result.code, 0, result.stderr)
        with ensonify.Record(result.out / "targets.mcap") as record:
            pairs = list(labels.labelled(record, "eye/ping", energies=True))
        self.assertGreater(len(pairs), 3)
        ratios = []
        for ping, of, sent in pairs:
            expected = energies.total(sent)
            counts = expected > 0
            ratios.append((np.square(ping.amplitude_upa, dtype=float)[counts] / expected[counts]).mean())
            strongest = energies.strongest(sent)
            places = energies.object_places(sent)
            for place, thing in enumerate(of.objects):
                mask = labels.mask(of, place)
                if thing.visible < 0.5 or mask.sum() < 50:
                    continue
                response = energies.response(sent, places[thing.instance])
                self.assertGreater((response & mask).sum(), 0.4 * mask.sum(), thing.name)
                self.assertTrue((strongest[response] == places[thing.instance]).all())
        # Some 10^6 samples of unit exponentials, of which some hundred share a cell's draw.
        self.assertAlmostEqual(np.mean(ratios), 1.0, delta=0.05)
        command = [sys.executable, "-m", "ensonify.labels", str(result.out), "-o", str(result.out / "set"), "--mask", "response"]
        run = subprocess.run(command, capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(json.loads(run.stdout)["pictures"], len(pairs))

    def test_sections_of_a_laid_cable_are_labelled_where_its_route_goes(self):
        result = self.run_launch(SOURCE / "launch/cable.yaml", "--free", "--arg", "seconds=12", "--set", "side.quality=0.1", timeout=200)
        with ensonify.Record(result.out / "cable.mcap") as record:
            seen = [(of, place, thing) for _, _, of in record.messages("side/labels_main") for place, thing in enumerate(of.objects)
                    if thing.class_name == "cable" and thing.visible > 0]
        self.assertGreater(len({thing.instance for _, _, thing in seen}), 4)
        routes = {name: np.array(yaml.safe_load((SOURCE / "scenarios/cable_route/scenario.yaml").read_text())["objects"][name]["laid"]["through_m"])
                  for name in ("cable", "old_cable")}
        # A section that only enters the beam has no mask yet.
        self.assertGreater(np.mean([labels.mask(of, place).any() for of, place, _ in seen]), 0.5)
        for _, _, thing in seen:
            route = routes[thing.name.rsplit("_", 1)[0]]
            # On its surface: within its radius of 0.1 m of a leg, seen from above, and 1 cm for rounding.
            self.assertLess(min(distance_m(np.array(thing.hit_enu_m)[:2], *leg) for leg in zip(route, route[1:])), 0.11, thing.name)

    def test_a_live_data_set_repeats_no_scene(self):
        live = Live(SOURCE / "launch/object_training.yaml", "side/ping_main", ["clutter", "mine-like"], scenes=2, lines=64,
                    args={"seconds": 16}, set={"side.quality": 0.05})
        with mock.patch.dict(os.environ, {"ENSONIFY_BIN": str(BIN)}):
            first, second = list(live), list(live)
            again = list(Live(live.launch, live.topic, live.names, scenes=2, lines=64, args={"seconds": 16}, set={"side.quality": 0.05}))
        self.assertGreater(len(first), 2)
        self.assertGreater(sum(len(sample.boxes) for sample in first), 5)
        names = [sample.name for sample in first + second]
        self.assertEqual(len(set(names)), len(names))
        for one, other in zip(first, again):
            np.testing.assert_array_equal(one.image, other.image)
        with mock.patch.dict(os.environ, {"ENSONIFY_BIN": str(BIN)}), self.assertRaisesRegex(ensonify.RunError, "names has mine-like"):
            list(Live(live.launch, live.topic, ["mine-like"], scenes=1, args={"seconds": 16}))

    def check_places(self, ping, of, pose, objects):
        """The middle of what is visible lies in the mask at its range and azimuth, and near the object's own middle."""
        body = rotation(pose.enu_from_body)
        head = np.array(pose.position_enu_m) + body @ np.array([0.5, 0, 0])
        sines = np.sin(ping.beam_angle_rad)
        metre = 2 / 1490 / ping.sample_period_s  # in samples
        for place, thing in enumerate(of.objects):
            if thing.visible < 0.5 or thing.inside < 0.9:
                continue
            mask = labels.mask(of, place)
            hit = np.array(thing.hit_enu_m) - head
            self.assertLess(np.linalg.norm(hit + head - np.array(objects[thing.instance].position_enu_m)), 1.0, thing.name)
            range_m = np.linalg.norm(hit)
            self.assertAlmostEqual(range_m, thing.range_m, delta=0.05)
            beam = np.argmin(abs(sines - (body.T @ hit)[1] / range_m))
            near = mask[max(0, beam - 2):beam + 3, int((range_m - 0.15) * metre):int((range_m + 0.15) * metre)]
            self.assertTrue(near.any(), thing.name)

    def check_levels(self, ping, of):
        """Echoes of things are brighter than the seabed about them, shadows darker."""
        power = np.square(ping.amplitude_upa, dtype=float)
        things = {thing.name: place for place, thing in enumerate(of.objects)}
        for name in ("cylinder", "half_buried", "crate"):
            mask, dark = labels.mask(of, things[name]), labels.shadow(of, things[name])
            samples = np.flatnonzero(mask.any(0))
            about = power[:, samples][~labels.layer(of)[:, samples].astype(bool)]
            self.assertGreater(power[mask].mean(), 3 * np.median(about), name)
            self.assertTrue(dark.any(), name)
            around = np.flatnonzero(dark.any(0))
            lit = power[:, around][(labels.shadow_db(of)[:, around] == 0) & (labels.layer(of)[:, around] == 0)]
            self.assertLess(np.median(power[dark]), 0.25 * np.median(lit), name)

    def check_files(self, out, pings):
        folder = out / "set"
        command = [sys.executable, "-m", "ensonify.labels", str(out), "-o", str(folder), "--format", "coco", "webdataset", "masks",
                   "--view", "cartesian"]
        run = subprocess.run(command, capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(json.loads(run.stdout)["pictures"], pings)
        data = Dataset(folder)
        self.assertEqual(set(data.names), {"box", "mine-like", "reference"})
        self.assertGreater(len(data[0].boxes), 3)
        again = subprocess.run(command, capture_output=True, text=True, timeout=120)
        self.assertEqual(again.returncode, 2)
        self.assertIn("is not empty", again.stderr)


if __name__ == "__main__":
    unittest.main()
