"""Labelled pictures as files, read back by readers of others: pycocotools, webdataset, and a YOLO reader of its own here."""
import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from PIL import Image

from ensonify import Labels, Ping, RunError, labels
from ensonify.labels import __main__ as command
from ensonify.labels import energies, formats, outlines, pictures
from ensonify.labels.dataset import Dataset
from ensonify.messages import Energies, EnergySource, LabelledObject, Soundings, TransmitSector


def disc(height, width, x, y, radius):
    rows, columns = np.mgrid[0:height, 0:width] + 0.5
    return np.hypot(rows - y, columns - x) < radius


def thing(instance, name, mask, shadow=None):
    return pictures.Thing(instance, f"{name}_{instance}", name, {"mine": 7, "tyre": 4}[name], mask,
                          np.zeros_like(mask) if shadow is None else shadow, {"visible": 1.0, "hit_enu_m": [1.0, 2.0, -3.0]})


def scene(name="eye_ping_000003"):
    """Two things: a whole disc with a shadow, and a ring, which has a hole."""
    height, width = 60, 90
    mine, tyre = disc(height, width, 20, 30, 6), disc(height, width, 60, 20, 9) & ~disc(height, width, 60, 20, 4)
    shadow = np.zeros((height, width), bool)
    shadow[10:24, 16:25] = True
    things = [thing(1, "mine", mine, shadow), thing(2, "tyre", tyre)]
    layer = np.where(mine, 1, np.where(tyre, 2, 0)).astype(np.int32)
    grey = np.where(layer > 0, 200, 30).astype(np.uint8)
    return pictures.Picture(name, grey, (grey * 100).astype(np.uint16), 0.5, things, layer, np.zeros_like(mine), {"topic": "eye/ping"})


class Outlines(unittest.TestCase):
    def test_a_rectangle_is_its_four_corners(self):
        mask = np.zeros((5, 8), bool)
        mask[1:3, 2:7] = True
        self.assertEqual(outlines.box(mask), (2, 1, 5, 2))
        (ring,) = outlines.rings(mask)
        self.assertEqual({tuple(corner) for corner in ring}, {(2, 1), (7, 1), (7, 3), (2, 3)})
        self.assertEqual(outlines.area(ring), 10)

    def test_rings_of_parts_and_holes_add_up_to_the_area(self):
        rng = np.random.default_rng(3)
        for share in (0.3, 0.5, 0.7):
            mask = rng.random((40, 50)) < share
            rings = outlines.rings(mask)
            self.assertEqual(sum(outlines.area(ring) for ring in rings), mask.sum())

    def test_parts_that_touch_at_a_corner_are_two(self):
        self.assertEqual([outlines.area(ring) for ring in outlines.rings(np.eye(2, dtype=bool))], [1, 1])

    def test_an_oriented_box_fits_a_turned_rectangle(self):
        rows, columns = np.mgrid[0:200, 0:200] + 0.5
        turn = np.deg2rad(30)
        along = (columns - 100) * np.cos(turn) + (rows - 100) * np.sin(turn)
        across = -(columns - 100) * np.sin(turn) + (rows - 100) * np.cos(turn)
        corners = outlines.oriented_box((abs(along) < 60) & (abs(across) < 20))
        sides = sorted(np.hypot(*(np.roll(corners, -1, 0) - corners).T))
        np.testing.assert_allclose(sides, [40, 40, 120, 120], atol=3)
        self.assertIsNone(outlines.oriented_box(np.zeros((3, 3), bool)))


class Formats(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.picture = scene()
        formats.Images(self.folder).add(self.picture)

    def write(self, writer):
        empty = pictures.Picture("eye_ping_000004", self.picture.grey, self.picture.linear, 0.5, [], np.zeros_like(self.picture.layer),
                                 self.picture.seabed_shadow, {})
        for picture in (self.picture, empty):
            writer.add(picture)
            if not isinstance(writer, formats.WebDataset):
                formats.Images(self.folder).add(picture)
        writer.close()

    def test_pycocotools_reads_the_masks_back(self):
        from pycocotools.coco import COCO
        self.write(formats.Coco(self.folder))
        with contextlib.redirect_stdout(io.StringIO()):
            coco = COCO(str(self.folder / "annotations.json"))
        self.assertEqual([coco.cats[i]["name"] for i in (1, 2)], ["mine", "tyre"])
        self.assertEqual(len(coco.imgs), 2)
        for annotation, thing in zip(coco.loadAnns(coco.getAnnIds(imgIds=1)), self.picture.things):
            read = coco.annToMask(annotation).astype(bool)
            np.testing.assert_array_equal(read, thing.mask)
            self.assertEqual(tuple(annotation["bbox"]), outlines.box(thing.mask))
            self.assertEqual(annotation["area"], thing.mask.sum())
        self.assertEqual(coco.getAnnIds(imgIds=2), [])

    def test_pycocotools_reads_masks_of_any_form_back(self):
        from pycocotools import mask as coco_mask
        rng = np.random.default_rng(5)
        for share in (0.02, 0.5, 0.98):
            pixels = rng.random((17, 23)) < share
            pixels[0, 0] = pixels[-1, -1] = share > 0.5
            form = formats.segmentation(pixels)
            if isinstance(form, dict):
                np.testing.assert_array_equal(coco_mask.decode(coco_mask.frPyObjects(form, *pixels.shape)).astype(bool), pixels)

    def test_an_instance_that_16_bits_do_not_hold_is_refused(self):
        self.picture.things[0].instance = 65535
        with self.assertRaisesRegex(RunError, "instance 65535; masks of 16 bits hold up to 65534"):
            self.write(formats.Masks(self.folder))

    def test_webdataset_reads_the_shards(self):
        import webdataset
        self.write(formats.WebDataset(self.folder, pictures_per_shard=1))
        shards = sorted(str(shard) for shard in self.folder.glob("*.tar"))
        self.assertEqual(len(shards), 2)
        samples = list(webdataset.WebDataset(shards, shardshuffle=False).decode())
        self.assertEqual([sample["__key__"] for sample in samples], ["eye_ping_000003", "eye_ping_000004"])
        self.assertEqual(samples[0]["json"]["objects"][0]["box"], list(outlines.box(self.picture.things[0].mask)))
        np.testing.assert_array_equal(np.array(Image.open(io.BytesIO(samples[0]["mask.png"])))
                                      if isinstance(samples[0]["mask.png"], bytes) else samples[0]["mask.png"], self.picture.layer)

    def read_yolo(self, name):
        """An independent reader: class and numbers of each line, in pixels."""
        height, width = self.picture.grey.shape
        rows = (self.folder / "labels" / f"{name}.txt").read_text().split("\n")[:-1]
        return [(int(row.split()[0]), np.array(row.split()[1:], float).reshape(-1, 2) * (width, height)) for row in rows]

    def test_yolo_boxes_outlines_and_corners(self):
        self.write(formats.Yolo(self.folder))
        (mine, (middle, size)), _ = self.read_yolo("eye_ping_000003")
        x, y, wide, high = outlines.box(self.picture.things[0].mask)
        self.assertEqual(mine, 0)
        np.testing.assert_allclose([*middle, *size], [x + wide / 2, y + high / 2, wide, high], atol=1e-3)
        self.assertEqual(self.read_yolo("eye_ping_000004"), [])
        self.assertIn('  0: "mine"\n  1: "tyre"\n', (self.folder / "data.yaml").read_text())
        self.write(formats.Yolo(self.folder, form="oriented"))
        self.assertEqual(self.read_yolo("eye_ping_000003")[0][1].shape, (4, 2))
        self.write(formats.Yolo(self.folder, form="segment"))
        self.assertAlmostEqual(outlines.area(self.read_yolo("eye_ping_000003")[0][1]), self.picture.things[0].mask.sum(), delta=0.1)

    def test_a_box_goes_round_what_was_asked_for(self):
        boxes = {}
        for around in formats.AROUND:
            self.write(formats.Coco(self.folder, around))
            annotations = json.loads((self.folder / "annotations.json").read_text())["annotations"]
            boxes[around] = tuple(annotations[0]["bbox"])
        mine = self.picture.things[0]
        self.assertEqual(boxes["object"], outlines.box(mine.mask))
        self.assertEqual(boxes["shadow"], (16, 10, 9, 14))
        self.assertEqual(boxes["object+shadow"], outlines.box(mine.mask | mine.shadow))

    def test_masks_are_instances(self):
        self.write(formats.Masks(self.folder))
        np.testing.assert_array_equal(np.array(Image.open(self.folder / "masks/eye_ping_000003.png")), self.picture.layer)
        shadow = np.array(Image.open(self.folder / "shadows/eye_ping_000003.png"))
        np.testing.assert_array_equal(shadow == 1, self.picture.things[0].shadow)

    def test_every_form_is_read_to_the_same_boxes(self):
        expected = [[x, y, x + wide, y + high] for x, y, wide, high in (outlines.box(one.mask) for one in self.picture.things)]
        for writer in (formats.Coco, formats.Yolo, formats.Voc, formats.WebDataset):
            with self.subTest(writer.__name__), tempfile.TemporaryDirectory() as folder:
                self.folder = Path(folder)
                self.write(writer(self.folder))
                data = Dataset(folder)
                self.assertEqual(data.names, ["mine", "tyre"])
                self.assertEqual(len(data), 2)
                np.testing.assert_allclose(data[0].boxes, expected, atol=1e-3)
                np.testing.assert_array_equal(data[0].classes, [0, 1])
                np.testing.assert_array_equal(data[0].image, self.picture.grey)
                self.assertEqual(len(data[1].boxes), 0)

    def test_a_folder_that_cannot_be_read_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(RunError, "has no labelled pictures; allowed are"):
                Dataset(folder)
            Path(folder, "annotations.json").write_text('{"images": [{"id": 1}], "annotations": [], "categories": []}')
            with self.assertRaisesRegex(RunError, "annotations.json: KeyError: 'file_name'"):
                Dataset(folder)


def ping(number, kind, samples, beams):
    amplitude = np.full((beams, samples), 1e6, np.float32)
    return Ping(ping=number, kind=kind, sample_period_s=1e-3 / 7.5, amplitude_upa=amplitude,
                beam_angle_rad=np.linspace(-0.5, 0.5, beams).astype(np.float32), sound_speed_mps=1500.0, source_level_db=200.0)


def label(number, samples, beams, runs, shadows=((0, 1, 5, 7),)):
    seen = LabelledObject(instance=9, name="a", class_name="mine", class_id=1, visible=0.5 + 0.01 * number)
    return Labels(ping=number, beams=beams, samples=samples, objects=[seen], mask_run=np.array(runs, np.int32),
                  layer_run=np.array(runs, np.int32), shadow_run=np.array(shadows, np.int32), shadow_db=np.array([60, 7], np.uint8))


class Record:
    """As much of a record as pictures need."""

    file, info = "out/some.mcap", {"seed": "1"}

    def __init__(self, topic, pairs):
        self.topic, self.pairs = topic, pairs

    def topics(self):
        return {self.topic: ("ping/1", 1), labels.labels_topic(self.topic): ("labels/1", 1)}

    def messages(self, *_):
        for pair in self.pairs:
            for message in pair:
                yield mock.Mock(content=message)


class Pictures(unittest.TestCase):
    def test_arrays_of_a_message(self):
        of = label(0, 8, 2, [(0, 1, 2, 4)])
        self.assertEqual(labels.mask(of, 0).sum(), 2)
        self.assertEqual(labels.layer(of)[1].tolist(), [0, 0, 9, 9, 0, 0, 0, 0])
        self.assertEqual(labels.shadow_db(of)[1].tolist(), [0, 0, 0, 0, 0, 60, 7, 0])
        self.assertEqual(labels.labels_topic("side/ping_main"), "side/labels_main")

    def test_labels_that_do_not_fit_their_image_are_refused(self):
        for runs in ([(0, 4, 0, 1)], [(0, 0, 0, 9)], [(1, 0, 0, 1)], [(0, 0, 3, 3)], [(0, 0, 3)]):
            record = Record("eye/ping", [(ping(0, "forward_looking", 8, 4), label(0, 8, 4, runs))])
            with self.subTest(runs), self.assertRaisesRegex(RunError, "eye/labels: ping 0: runs"):
                list(pictures.pictures(record, "eye/ping"))

    def test_a_ping_without_labels_is_left_out(self):
        pairs = [(ping(n, "forward_looking", 8, 4), label(n, 8, 4, [(0, 3, 6, 8)])) for n in range(4)]
        record = Record("eye/ping", [pairs[0], pairs[1][:1], pairs[2][1:], pairs[3]])
        self.assertEqual([pair.ping.ping for pair in labels.labelled(record, "eye/ping")], [0, 3])

    def test_an_imaging_head_stands_upright_port_left(self):
        record = Record("eye/ping", [(ping(0, "forward_looking", 8, 4), label(0, 8, 4, [(0, 3, 6, 8)]))])
        (picture,) = pictures.pictures(record, "eye/ping")
        self.assertEqual(picture.grey.shape, (8, 4))
        rows, columns = np.nonzero(picture.layer == 9)
        self.assertEqual((set(rows), set(columns)), ({0, 1}, {3}))  # far: on top; starboard: right

    def test_a_fan_has_the_mask_where_the_levels_are(self):
        amplitude = ping(0, "forward_looking", 64, 16)
        amplitude.amplitude_upa[12, 40:50] = 1e9
        record = Record("eye/ping", [(amplitude, label(0, 64, 16, [(0, 12, 40, 50)]))])
        (picture,) = pictures.pictures(record, "eye/ping", view="cartesian")
        bright = picture.linear > picture.linear[picture.linear > 0].min() * 50
        np.testing.assert_array_equal(bright, picture.layer == 9)
        self.assertAlmostEqual(picture.facts["beam_to_rad"], float(amplitude.beam_angle_rad.max()))
        self.assertGreater(bright.sum(), 100)
        self.assertGreater(np.nonzero(bright)[1].mean(), picture.grey.shape[1] / 2)

    def test_lines_of_a_sidescan_are_one_waterfall(self):
        pairs = [(ping(n, "sidescan", 10, 2), label(n, 10, 2, [(0, 1, 3, 5)])) for n in range(5)]
        for n in (1, 2, 4):  # before its first estimate a head does not know where it is
            pairs[n][0].pose_position_enu_m = np.array([[3.0, 0.2 * n, -5.0]])
        whole, rest = pictures.pictures(Record("side/ping_main", pairs), "side/ping_main", lines=3)
        self.assertEqual(whole.grey.shape, (3, 20))
        self.assertEqual(rest.grey.shape, (2, 20))
        self.assertEqual(outlines.box(whole.things[0].mask), (13, 0, 2, 3))  # starboard, behind the 10 of port
        self.assertAlmostEqual(whole.facts["line_spacing_m"], 0.2)
        self.assertEqual(rest.facts["line_spacing_m"], 0.0)  # one place alone
        self.assertAlmostEqual(whole.things[0].facts["visible"], 0.52)  # of the line that has most of it

    def test_levels_are_the_same_in_all_pictures(self):
        dark, bright = ping(0, "forward_looking", 8, 4), ping(1, "forward_looking", 8, 4)
        bright.amplitude_upa[0, 0] = 1e9
        record = Record("eye/ping", [(dark, label(0, 8, 4, [(0, 1, 0, 1)])), (bright, label(1, 8, 4, [(0, 1, 0, 1)]))])
        first, second = pictures.pictures(record, "eye/ping")
        self.assertEqual(first.grey[0, 0], second.grey[0, 0])
        self.assertEqual(first.scale_upa, second.scale_upa)

    def test_the_command_refuses_what_it_cannot_do(self):
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()) as said:
            Path(folder, "something").write_text("")
            self.assertEqual(command.main(["nowhere.mcap", "-o", folder]), 2)
            self.assertEqual(command.main(["nowhere.mcap", "-o", folder + "/new"]), 2)
            self.assertEqual(command.main(["nowhere.mcap", "-o", folder + "/new", "--lines", "0"]), 2)
        self.assertRegex(said.getvalue(), "is not empty; allowed is")
        self.assertRegex(said.getvalue(), "nowhere.mcap: No such file")
        self.assertRegex(said.getvalue(), "--lines: 0; allowed is 1 or more")


def energies_of_two():
    """Noise everywhere, an object in one beam, another by way of the surface over it: 2 beams x 6 samples."""
    sources = [EnergySource(kind="noise", path="direct"), EnergySource(kind="object", path="direct", instance=4),
               EnergySource(kind="object", path="surface", instance=4)]
    runs = [[0, 0, 0, 6], [0, 1, 0, 6], [1, 0, 1, 4], [2, 0, 3, 5]]
    energy = [1.0] * 12 + [1.0, 3.0, 0.5] + [1.0, 9.0]
    return Energies(ping=5, beams=2, samples=6, sources=sources, run=np.array(runs, np.int32), energy_upa2=np.array(energy, np.float32))


class EnergiesOfSources(unittest.TestCase):
    def test_arrays_of_sources(self):
        of = energies_of_two()
        np.testing.assert_array_equal(energies.energy(of, 1), [[0, 1, 3, 0.5, 0, 0], [0] * 6])
        np.testing.assert_array_equal(energies.total(of), [[1, 2, 4, 2.5, 10, 1], [1] * 6])
        np.testing.assert_array_equal(energies.response(of, 1), [[False, True, True, False, False, False], [False] * 6])
        # Of equals the earlier: noise before the object, and before its echo by way of the surface.
        np.testing.assert_array_equal(energies.strongest(of), [[0, 0, 1, 0, 2, 0], [0] * 6])
        self.assertEqual(energies.object_places(of), {4: 1})
        self.assertEqual(energies.topic_of("side/ping_main"), "side/energies_main")

    def test_soundings_have_sources(self):
        of = energies_of_two()
        of.first_sample_s, of.sample_period_s = 0.01, 0.001
        soundings = Soundings(beam=np.array([0, 0, 1, 0]), travel_time_s=np.array([0.0121, 0.0139, 0.012, 0.0170], np.float32))
        np.testing.assert_array_equal(energies.of_soundings(soundings, of), [1, 2, 0, -1])
        # One for each beam, the second of a sector that sends 2 ms later; NaN: none.
        sectors = [TransmitSector(), TransmitSector(delay_s=0.002)]
        soundings = Soundings(travel_time_s=np.array([0.0121, np.nan], np.float32), sector=np.array([1, 1], np.uint8), sectors=sectors)
        np.testing.assert_array_equal(energies.of_soundings(soundings, of), [2, -1])

    def test_what_does_not_fit_is_refused(self):
        for change in ({"beams": 1}, {"samples": 5}, {"sources": energies_of_two().sources[:2]},
                       {"energy_upa2": np.ones(3, np.float32)}, {"run": np.ones((2, 3), np.int32)}):
            of = energies_of_two()
            for key, value in change.items():
                setattr(of, key, value)
            with self.subTest(change), self.assertRaises(RunError):
                energies.check(of, "eye/energies")


if __name__ == "__main__":
    unittest.main()
