"""`ensonify plot navigation`: its numbers against closed forms, its picture from a record made here."""
import contextlib
import io
import os
import tempfile
import unittest

import numpy as np
from PIL import Image

import ensonify
from ensonify_plot import navigation
from ensonify_plot.main import main

try:
    from mcap.writer import CompressionType, Writer

    from ensonify import wire
except ImportError:
    Writer = None

STEP_S, OFF_M, SIGMA_M = 0.1, np.array([0.3, -0.2, 0.1]), 0.25


def pose_at(t_s):
    """North at 2 m/s, heaving 0.5 m in 8 s."""
    return np.array([0.0, 2.0 * t_s, 0.5 * np.sin(2 * np.pi * t_s / 8)])


def write(file, with_truth=True, seconds=60):
    """Truth, an estimate beside it, fixes to the other side of it, increments of white noise; two planned lines."""
    random = np.random.default_rng(1)
    north = (0.0, np.sqrt(0.5), np.sqrt(0.5), 0.0)
    covariance = tuple((SIGMA_M**2 * np.eye(3)).ravel())
    with open(file, "wb") as stream:
        writer = Writer(stream, compression=CompressionType.NONE)
        writer.start(profile="x-ensonify/1", library="test")
        channels = {}

        def put(topic, message):
            if topic not in channels:
                schema = writer.register_schema(message.TYPE, "jsonschema", b"{}")
                channels[topic] = writer.register_channel(topic, "msgpack", schema)
            t_ns = message.stamp_ns
            writer.add_message(channels[topic], t_ns, wire.encode_inline(message.to_map()), t_ns, 0)

        for n in range(round(seconds / STEP_S)):
            t_s = n * STEP_S
            stamp_ns = round(t_s * 1e9)
            if with_truth:
                put("boat/pose", ensonify.Pose(stamp_ns=stamp_ns, position_enu_m=tuple(pose_at(t_s)), enu_from_body=north))
            put("nav/estimate", ensonify.Estimate(stamp_ns=stamp_ns, position_enu_m=tuple(pose_at(t_s) + OFF_M),
                                                  enu_from_body=north, position_covariance_enu_m2=covariance,
                                                  rotation_covariance_enu_rad2=covariance))
            if n % 2 == 0:
                put("nav/position", ensonify.Position(stamp_ns=stamp_ns, position_enu_m=tuple(pose_at(t_s) - OFF_M)))
            if with_truth:
                put("nav/imu", ensonify.InertialIncrements(stamp_ns=stamp_ns, interval_s=STEP_S,
                                                           angle_rad=tuple(1e-4 * random.standard_normal(3)),
                                                           velocity_mps=tuple(1e-3 * random.standard_normal(3))))
        for number in range(3):  # the last says that nothing is left to run
            put("covered/next_line", ensonify.NextLine(stamp_ns=number, number=number, done=number == 2,
                                                     start_enu_m=(10.0 * number, 0.0), end_enu_m=(10.0 * number, 120.0)))
        writer.finish()


class Numbers(unittest.TestCase):
    def test_white_noise_falls_as_one_over_the_root_of_time(self):
        readings = np.random.default_rng(2).standard_normal(1 << 16)
        t_s, deviation = navigation.allan_deviation(readings, 0.01)
        near = t_s < 1.0  # 650 means and more: 3 %, four times that is allowed
        np.testing.assert_allclose(deviation[near], 0.1 / np.sqrt(t_s[near]), rtol=0.12)

    def test_a_spectrum_sums_to_the_variance_and_peaks_where_the_swell_is(self):
        t_s = np.arange(0, 800, 0.1)
        f_hz, density = navigation.spectrum(0.5 * np.sin(2 * np.pi * t_s / 8), 0.1)
        self.assertAlmostEqual(np.sum(density) * f_hz[0], 0.125, delta=0.002)
        self.assertAlmostEqual(f_hz[np.argmax(density)], 1 / 8, delta=f_hz[0])

    def test_angles_are_those_of_sailors(self):
        heading = np.radians(30)  # level: [w, x, y, z] of NED turned about down, in ENU
        q = np.array([[0.0, np.cos(np.pi / 4 - heading / 2), np.sin(np.pi / 4 - heading / 2), 0.0]])
        nan = np.full((1, 3), np.nan)
        track = navigation.Track(np.zeros(1), np.zeros((1, 3)), q, nan, nan[:, 0])
        np.testing.assert_allclose(track.angles_rad(), [[heading, 0, 0]], atol=1e-12)


@unittest.skipIf(Writer is None, "needs the package mcap")
class Picture(unittest.TestCase):
    def test_the_planted_error_is_found_and_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "nav.mcap")
            write(file)
            record = ensonify.Record(file)
            estimate = navigation.read_track(record, ensonify.Estimate)
            _, t_s, error_m, heading_rad = navigation.errors_of(estimate, navigation.read_track(record, ensonify.Pose))
            self.assertEqual(len(t_s), 600)
            np.testing.assert_allclose(error_m, np.tile(OFF_M, (600, 1)), atol=1e-9)
            np.testing.assert_allclose(heading_rad, 0, atol=1e-12)
            np.testing.assert_allclose(estimate.sigma_m, SIGMA_M)
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(main(["navigation", file, "--out", folder]), 0)
            with Image.open(os.path.join(folder, "navigation.png")) as picture:
                self.assertGreater(picture.size[0], 1000)

    def drawn(self, **how):
        """The panels by their titles."""
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "nav.mcap")
            write(file, **how)
            return {axes.get_title(): axes for axes in navigation.navigation_picture(ensonify.Record(file)).axes}

    def test_the_track_is_drawn_from_above_with_what_was_planned_believed_and_true(self):
        axes = self.drawn()["Track"]
        self.assertEqual(axes.get_aspect(), 1.0)  # a metre east is as long as a metre north
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()), ("east (m)", "north (m)"))
        drawn = {line.get_label(): line.get_xydata() for line in axes.get_lines()}
        true = np.array([pose_at(n * STEP_S)[:2] for n in range(600)])
        np.testing.assert_allclose(drawn["truth"], true, atol=1e-9)
        np.testing.assert_allclose(drawn["estimate"], true + OFF_M[:2], atol=1e-9)
        np.testing.assert_allclose(drawn["fixes"], true[::2] - OFF_M[:2], atol=1e-9)
        np.testing.assert_allclose(drawn["planned lines"], [[0, 0], [0, 120]])
        self.assertEqual(len(axes.get_lines()), 5)  # two planned lines, one name
        self.assertEqual({text.get_text() for text in axes.get_legend().get_texts()}, {"truth", "estimate", "fixes", "planned lines"})

    def test_without_truth_the_track_is_that_of_the_estimate(self):
        panels = self.drawn(with_truth=False)
        drawn = {line.get_label(): line.get_xydata() for line in panels["Track"].get_lines()}
        self.assertNotIn("truth", drawn)
        self.assertEqual(len(drawn["estimate"]), 600)
        self.assertIn("needs estimate/1 and pose/1", [text.get_text() for text in panels["Estimate less truth: position"].texts])

    def test_without_anything_of_navigation_there_is_nothing_to_draw(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "nav.mcap")
            write(file, seconds=0)
            printed = io.StringIO()
            with contextlib.redirect_stderr(printed):
                self.assertEqual(main(["navigation", file]), 2)
            self.assertIn("none of pose/1, estimate/1 and inertial_increments/1 was recorded", printed.getvalue())


if __name__ == "__main__":
    unittest.main()
