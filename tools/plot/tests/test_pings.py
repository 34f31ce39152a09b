"""Pictures of pings on echoes whose places are known: what stands where, in which level, and what is refused."""
import contextlib
import dataclasses
import importlib.util
import io
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import ensonify  # noqa: E402
from ensonify_plot import angular_response, geometry, scanning, stack, water_column, waterfall  # noqa: E402
from ensonify_plot.forward_looking import polar_panel, rectangular_panel  # noqa: E402
from ensonify_plot.received import Span, pings_in, received  # noqa: E402
from ensonify_plot.level import Gain, level_db, limits_of  # noqa: E402
from ensonify_plot.main import main  # noqa: E402
from ensonify_plot.ping import Show, fan_image  # noqa: E402

HAS_MCAP = importlib.util.find_spec("mcap") is not None
if HAS_MCAP:
    import synthetic_heads as made

ALL = Span()
PNG = b"\x89PNG\r\n"


def run(*arguments):
    """(exit code, stdout, stderr)."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            code = main([str(argument) for argument in arguments])
        except SystemExit as end:  # argparse
            code = end.code
    return code, out.getvalue(), err.getvalue()


def place_of_brightest(image, extent, from_top):
    """(x, y) of the middle of an image's brightest pixel."""
    row, col = np.unravel_index(np.nanargmax(image), image.shape)
    rows, cols = image.shape
    left, right, low, high = extent
    down = (row + 0.5) / rows
    return left + (col + 0.5) / cols * (right - left), (high + down * (low - high)) if from_top else low + down * (high - low)


class Geometry(unittest.TestCase):
    def test_a_beam_reaches_half_way_to_its_neighbours(self):
        angle = np.radians([10.0, -20.0, 0.0])  # in any order
        np.testing.assert_allclose(np.degrees(geometry.beam_edges_rad(angle)), [-30, -10, 5, 15])
        wanted = np.radians([-30.1, -29.9, -10.1, -9.9, 4.9, 5.1, 14.9, 15.1])
        np.testing.assert_array_equal(geometry.beam_at(angle, wanted), [-1, 1, 1, 2, 2, 0, 0, -1])

    def test_a_sample_stands_at_its_range_and_half_a_step_around(self):
        np.testing.assert_array_equal(geometry.sample_at(np.array([1.9, 2.3, 2.7, 3.3, 3.76]), 2.0, 0.5, 4), [0, 1, 1, 3, -1])
        self.assertEqual(geometry.sample_at(np.array([1.7]), 2.0, 0.5, 4)[0], -1)

    def test_polar_mapping(self):
        power = np.arange(12.0).reshape(3, 4)  # beams at -30, 0, 30 degrees; ranges 1, 2, 3, 4 m
        angle = np.radians([-30.0, 0.0, 30.0])
        across = np.array([0.0, 3 * np.sin(np.radians(30)), 2 * np.sin(np.radians(-30)), 0.0, 3.0])
        along = np.array([1.0, 3 * np.cos(np.radians(30)), 2 * np.cos(np.radians(-30)), 4.6, 0.0])
        image = geometry.polar_image(power, angle, 1.0, 1.0, across, along)
        np.testing.assert_array_equal(image, [4, 10, 1, np.nan, np.nan])

    def test_bounds_of_a_fan(self):
        bounds = geometry.polar_bounds_m(np.radians([-45.0, 45.0]), 0.0, 10.0)  # edges at -90 and 90 degrees
        np.testing.assert_allclose(bounds, (-10, 10, 0, 10), atol=1e-9)

    def test_thinning_keeps_mean_power_and_place(self):
        power = np.arange(10.0)[None, :]
        thin, first_m, step_m = geometry.thinned(power, 0.5, 0.1, 0.35)
        np.testing.assert_allclose(thin, [[1, 4, 7]])  # means of three; the tenth is dropped
        self.assertAlmostEqual(first_m, 0.6)
        self.assertAlmostEqual(step_m, 0.3)
        self.assertIs(geometry.thinned(power, 0.5, 0.1, 0.15)[0], power)

    def test_ground_range_is_pythagoras(self):
        self.assertEqual(geometry.ground_range_m(5.0, 3.0), 4.0)
        self.assertEqual(geometry.ground_range_m(2.0, 3.0), 0.0)
        self.assertEqual(geometry.slant_range_m(4.0, 3.0), 5.0)

    def test_a_line_over_ground(self):
        # Samples at 1, 2, ... 13 m; 12 m up: only 12 m (ground 0) and 13 m (ground 5) lie on the bottom.
        power = np.arange(1.0, 14.0)
        line = geometry.ground_line(power, 1.0, 1.0, 12.0, 2.0, 4)
        # Cell 0 and 2 hold a sample; cell 1 (centre 3 m, slant 12.37 m) takes the nearest; cell 3 (7 m, 13.89 m) has none.
        np.testing.assert_array_equal(line, [12, 12, 13, np.nan])
        # In slant range cell j holds what lies in it: [0,2) the 1 m, [2,4) the mean of 2 and 3 m.
        np.testing.assert_array_equal(geometry.ground_line(power, 1.0, 1.0, 0.0, 2.0, 2), [1, 2.5])

    @unittest.skipUnless(HAS_MCAP, "the package mcap is not installed (./dev test installs it)")
    def test_the_vertical_follows_the_roll(self):
        for roll in (-0.2, 0.0, 0.1):  # starboard down: the vertical lies on the starboard side of the head's axis
            self.assertAlmostEqual(geometry.vertical_rad(made.level_pose(roll)[0]), roll)

    def test_rows_of_time_leave_gaps(self):
        ping, begin, end = geometry.ping_of_rows(np.array([0.0, 1.0, 2.0, 6.0, 7.0]), 100)
        self.assertEqual((begin, end), (-0.5, 7.5))
        np.testing.assert_array_equal(ping, [0, 1, 2, 2, -1, 3, 3, 4])

    def test_groups_average_power_and_skip_gaps(self):
        values = np.array([[1.0, np.nan], [3.0, np.nan], [5.0, 7.0]])
        np.testing.assert_array_equal(geometry.grouped(values, 2), [[2, np.nan], [5, 7]])

    def test_a_second_axis_reads_both_ways(self):
        known, values = np.array([0.0, 1.0, 4.0]), np.array([10.0, 20.0, 26.0])
        t = np.array([-1.0, 0.5, 2.5, 6.0])
        np.testing.assert_allclose(stack.extended(t, known, values), [0, 15, 23, 30])
        np.testing.assert_allclose(stack.extended(stack.extended(t, known, values), values, known), t)


class Levels(unittest.TestCase):
    def test_gain(self):
        gain = Gain(30.0, 0.1)
        np.testing.assert_allclose(gain.db(np.array([10.0, 100.0])), [30 + 2, 60 + 20])
        self.assertEqual(gain.db(0.0), gain.db(1.0))
        self.assertEqual(gain.label(), "received level, rms + 30 log R + 2 R · 100 dB/km (dB re 1 µPa, R in m)")
        self.assertEqual(Gain().label(), "received level, rms (dB re 1 µPa)")

    def test_limits(self):
        level = level_db(np.append(10.0 ** np.arange(0, 10.1, 0.1), 0.0))  # 0, 1, ... 100 dB and silence
        self.assertEqual(limits_of(level, None, (10, 90)).low_db, 10.0)
        self.assertEqual(limits_of(level, None, (10, 90)).high_db, 90.0)
        self.assertEqual(limits_of(level, (3.0, 4.0), (10, 90)).origin, "as given")
        self.assertEqual(limits_of(np.full(3, 7.0), None, (10, 90)).high_db, 8.0)

    def test_counts_become_pressure(self):
        settings = {"sample_period_s": 2 / 1500.0, "first_sample_s": 2 * 10 / 1500.0, "sound_speed_mps": 1500.0,
                    "gain_spreading_db": 40.0, "gain_absorption_dbpm": 0.05, "gain_offset_db": 3.0, "count_upa": 0.5}
        ping = ensonify.Ping(beam_angle_rad=np.zeros(1, "f4"), amplitude_count=np.full((1, 91), 1000, "u2"), **settings)
        level = level_db(received("x/ping", ping).power_upa2)[0]
        # At 10 m the gain is 40 + 1 + 3 dB, at 100 m 80 + 10 + 3 dB; 1000 counts of 0.5 uPa are 53.979 dB.
        np.testing.assert_allclose(level[[0, 90]], 53.979 - np.array([44, 93]), atol=1e-3)


@unittest.skipUnless(HAS_MCAP, "the package mcap is not installed (./dev test installs it)")
class Places(unittest.TestCase):
    def test_a_target_in_the_fan(self):
        for roll in (None, 0.0, 0.15):
            topic, ping = made.multibeam([(np.radians(20.0), 20.0)], roll_rad=roll)
            fan = fan_image(received(topic, ping), Gain(), 30.0)
            self.assertEqual(fan.upright, roll is not None)
            x, y = place_of_brightest(fan.level_db, (*fan.extent_m[:2], fan.extent_m[2], fan.extent_m[3]), from_top=True)
            angle = np.radians(20.0) - (roll or 0.0)  # starboard down: the starboard beam points more steeply
            # A sample is 0.05 m long, a beam 1 degree (0.35 m at 20 m) wide, a pixel about 0.06 m.
            self.assertAlmostEqual(np.hypot(x, y), 20.0, delta=0.1)
            self.assertAlmostEqual(np.arctan2(x, y), angle, delta=np.radians(0.7))
            # 1e4 uPa are 80 dB; a pixel averages no other sample in.
            self.assertAlmostEqual(np.nanmax(fan.level_db), 80.0, delta=0.1)

    def test_targets_in_the_forward_looking_image(self):
        (topic, ping), = made.forward_looking(targets=((-0.4, 18.0),))
        one = received(topic, ping)
        power = np.where(np.hypot(*np.meshgrid(one.range_m - 18, 100 * (one.angle_rad + 0.4))) < 2, one.power_upa2, 1.0)
        x, y = place_of_brightest(*polar_panel(one, power), from_top=False)
        # Speckle moves the brightest pixel within the target: 0.25 m in range, 0.012 rad in azimuth.
        self.assertAlmostEqual(np.hypot(x, y), 18.0, delta=0.5)
        self.assertAlmostEqual(np.arctan2(x, y), -0.4, delta=0.03)
        azimuth_deg, range_m = place_of_brightest(*rectangular_panel(one, power), from_top=False)
        self.assertAlmostEqual(azimuth_deg, np.degrees(-0.4), delta=1.7)
        self.assertAlmostEqual(range_m, 18.0, delta=0.5)

    def test_a_target_in_the_turn_of_a_scanning_head(self):
        for angle_deg in (-180.0, -0.9, 90.0, 179.1):  # off the nearest step by 0.45 degrees at most; astern there is no seam
            with tempfile.TemporaryDirectory() as folder:
                messages = made.scanning(pings=500, first_deg=-120.0, target=(np.radians(angle_deg), 7.0))
                record = ensonify.Record(made.write(pathlib.Path(folder) / "turn.mcap", messages))
                turn = scanning.turn_of(record, "turner/ping", None, None)
            self.assertEqual([row.ping.ping for row in turn], list(range(100, 500)))  # the newest of each direction
            whole = scanning.assembled(turn)
            image, extent = polar_panel(whole, whole.power_upa2)
            x, y = place_of_brightest(image, extent, from_top=False)
            # A direction is 0.11 m wide at 7 m, and its middle up to half as far off; a sample is 0.025 m long.
            self.assertAlmostEqual(x, 7 * np.sin(np.radians(angle_deg)), delta=0.12)
            self.assertAlmostEqual(y, 7 * np.cos(np.radians(angle_deg)), delta=0.12)
            # The disc is filled: pi / 4 of its square but for the pixels at its rim.
            self.assertAlmostEqual(np.isfinite(image).mean(), np.pi / 4, delta=0.01)

    def test_a_scanned_sector_astern_is_drawn_astern(self):
        turn = [received(topic, ping) for topic, ping in made.scanning(pings=100, first_deg=135.0)]
        self.assertAlmostEqual(np.ptp(scanning.assembled(turn).angle_rad), np.radians(99 * 0.9))
        image, (left, right, low, high) = polar_panel(scanning.assembled(turn), scanning.assembled(turn).power_upa2)
        self.assertAlmostEqual(low, -10.0, delta=0.1)
        self.assertAlmostEqual(high, 0.0, delta=0.1)

    def test_a_waterfall_is_to_scale_where_the_track_is_known(self):
        pings = [received("fish/ping", m) for _, m in made.sidescan(pings=200) if isinstance(m, ensonify.Ping)]
        axes = waterfall.waterfall_picture(pings, {}, False, Show("auto")).axes[0]
        self.assertEqual((axes.get_aspect(), axes.get_ylabel()), (1.0, stack.ALONG))
        low, high = axes.get_ylim()
        self.assertAlmostEqual(high - low, 200 * 2.0 / 10.0, delta=0.01)  # at 2 m/s and ten pings a second
        for message in pings:  # a head that rests covers nothing
            message.ping.pose_position_enu_m = np.zeros((1, 3))
        axes = waterfall.waterfall_picture(pings, {}, False, Show("auto")).axes[0]
        self.assertEqual((axes.get_aspect(), axes.get_ylabel()), ("auto", "time of transmission (s)"))

    def test_a_head_that_hardly_moves_leaves_no_gaps_along_its_way(self):
        along = np.concatenate([np.arange(300) * 1e-3, 0.3 + np.arange(200) * 0.2])
        ping, _, _ = geometry.ping_of_rows(along, 800, np.arange(500) / 10)
        self.assertTrue((ping >= 0).all())
        ping, _, _ = geometry.ping_of_rows(np.arange(10.0), 100, np.array([0, 1, 2, 3, 4, 50, 51, 52, 53, 54.0]))
        self.assertTrue((ping >= 0).all())  # it stopped, and went on where it was

    def test_a_bottom_track_scales_the_water_column(self):
        with tempfile.TemporaryDirectory() as out:
            record = pathlib.Path(out) / "fish.mcap"
            made.write(record, made.sidescan(pings=20, altitude_m=12.0))
            record = ensonify.Record(record)
            pings = list(pings_in(record, "fish/ping", ALL, ALL))
            t_s, range_m = water_column.detections_of(record, pings, [0] * 20)
        np.testing.assert_allclose(t_s, np.arange(20) / 10, atol=1e-9)
        np.testing.assert_allclose(range_m, 12.0 + 1.5 * np.sin(np.arange(20) / 40))

    def test_a_target_in_the_waterfall(self):
        pings, altitudes = [], []
        for _, message in made.sidescan(pings=20, target=(10, 1, 30.0), range_m=50.0, samples=1000):
            if isinstance(message, ensonify.BottomTrack):
                altitudes.append(message.altitude_m)
            else:
                pings.append(received("fish/ping", message))
        level = level_db(waterfall.lines_of(pings, altitudes, Gain(30.0, 0.1), 0.25, 180))
        target = level[:, 180 + 121]  # 30.25 to 30.5 m to starboard: just behind it
        self.assertLess(target[7:14].max(), target[:7].min() - 5)  # shadow
        on_it = level[7:14, 180 + 119:180 + 121].mean(), level[:7, 180 + 119:180 + 121].mean()
        # 60 times the seabed's power is 17.8 dB; the mean dB of 14 speckled cells scatters by 5.6 / sqrt(14) = 1.5 dB each.
        self.assertAlmostEqual(on_it[0] - on_it[1], 17.8, delta=6)
        # The mirror place to port holds nothing of it.
        self.assertLess(level[7:14, 180 - 121:180 - 119].mean(), on_it[1] + 6)
        # Slant range: the same target at sqrt(30^2 + H^2), and the water column silent up to H.
        slant = level_db(waterfall.lines_of(pings, [0.0] * 20, Gain(30.0, 0.1), 0.25, 200))
        at = int(np.hypot(30.0, altitudes[10]) / 0.25)
        self.assertEqual(abs(int(np.argmax(slant[10, 200:])) - at) <= 1, True)
        seabed = np.nanmedian(slant[:, 200 + 60:])
        self.assertLess(np.nanmax(slant[:, 200 - 40:200 + 40]), seabed - 50)  # H is above 10 m: 40 cells to both sides

    def test_a_ping_without_bottom_stays_empty_over_ground(self):
        (_, message), = (pair for pair in made.sidescan(pings=1, bottom_track=False))
        lines = waterfall.lines_of([received("fish/ping", message)] * 2, [np.nan, 12.0], Gain(), 0.5, 100)
        self.assertTrue(np.isnan(lines[0]).all())
        self.assertTrue(np.isfinite(lines[1]).all())

    def test_the_beam_that_points_down(self):
        topic, ping = made.multibeam([(0.15, 12.0)], roll_rad=0.15)
        rolled = received(topic, ping)
        beam = water_column.beam_towards(rolled, 0.0)
        self.assertAlmostEqual(rolled.angle_rad[beam], 0.15, delta=np.radians(0.51))
        line = water_column.lines_of([rolled], [beam], Gain(), 0.1, 300)[0]
        self.assertEqual(int(np.argmax(line)), 120)
        self.assertAlmostEqual(np.degrees(rolled.angle_rad[water_column.beam_towards(rolled, np.radians(-30))] - 0.15), -30, delta=0.51)


@unittest.skipUnless(HAS_MCAP, "the package mcap is not installed (./dev test installs it)")
class AngularResponse(unittest.TestCase):
    def read(self, absorption_dbpm=None, **how):
        with tempfile.TemporaryDirectory() as folder:
            record = ensonify.Record(made.write(pathlib.Path(folder) / "a.mcap", made.soundings(**how)))
            return angular_response.read(record, None, ALL, ALL, absorption_dbpm)

    def test_lamberts_law_comes_back(self):
        for roll in (0.0, 0.1):
            curve = angular_response.curve(*self.parts(self.read(mu_db=-25.0, roll_rad=roll)), 2.0)
            known = np.isfinite(curve.mean_db)
            law = -25 + 20 * np.log10(np.sin(np.radians(curve.grazing_deg)))
            # Gaussian dB of 1 dB raise the mean power by ln(10) / 20 = 0.115 dB. The standard error with at least 100 soundings is 0.1 dB.
            self.assertGreater(np.count_nonzero(known), 25)
            np.testing.assert_allclose(curve.mean_db[known], law[known] + 0.115, atol=0.4)
            # 16 % and 84 % lie one standard deviation to both sides, within three standard errors of a percentile of 100.
            np.testing.assert_allclose((curve.high_db - curve.low_db)[curve.count > 100], 2.0, atol=0.6)

    @staticmethod
    def parts(response):
        return response.grazing_rad, response.strength_db

    def test_a_wrong_absorption_leaves_its_trend(self):
        right, wrong = self.read(), self.read(absorption_dbpm=0.1)
        slant_m = 20 / np.sin(right.grazing_rad)
        np.testing.assert_allclose(wrong.strength_db - right.strength_db, 2 * 0.03 * slant_m, atol=1e-3)
        self.assertIn("2 R · 100 dB/km", wrong.corrections)

    def test_the_heads_own_strengths_come_first(self):
        reported = np.full(256, -30.0, "f4")
        response = self.read(backscatter_strength_db=reported, pings=2)
        np.testing.assert_array_equal(response.strength_db, -30.0)
        self.assertIn("as the head computed it", response.corrections)

    def test_what_is_not_corrected_is_said(self):
        response = self.read(pings=2, transmit_beamwidth_rad=0.0, gain_absorption_dbpm=0.0)
        self.assertIn("no absorption (none is stated)", response.corrections)
        self.assertIn("not for area (beam widths are not recorded)", response.corrections)

    def test_means_are_of_power(self):
        curve = angular_response.curve(np.full(20, 0.8), np.repeat([0.0, 10.0], 10), 1.0)
        self.assertAlmostEqual(np.nanmax(curve.mean_db), 10 * np.log10(5.5))
        self.assertTrue(np.isnan(angular_response.curve(np.full(9, 0.8), np.zeros(9), 1.0).mean_db).all())


@unittest.skipUnless(HAS_MCAP, "the package mcap is not installed (./dev test installs it)")
class Commands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.root = pathlib.Path(folder.name)
        fan = [made.multibeam([(0.0, 10.0)], ping=ping) for ping in range(3)]
        silent = ensonify.Ping(stamp_ns=4 * 10**8, ping=4, sample_period_s=1e-4, sound_speed_mps=1500.0,
                               beam_angle_rad=np.linspace(-1, 1, 128, dtype="f4"), amplitude_upa=np.zeros((128, 50), "f4"))
        soundings = list(made.soundings(pings=3, beams=128))
        cls.mute = cls.record("mute", [*made.soundings(pings=3, beams=128), ("bow/ping", silent)])
        cls.heads = cls.record("heads", fan + [("bow/ping", silent)] + soundings + list(made.forward_looking()))
        cls.turner = cls.record("turner", made.scanning(pings=20))
        cls.fish = cls.record("fish", made.sidescan(pings=12, target=(5, 1, 30.0), samples=300))
        lost = ensonify.BottomTrack(ping=0, valid=False, altitude_m=9.0)
        cls.lost = cls.record("lost", [*made.sidescan(pings=2, samples=300, bottom_track=False), ("fish/bottom_track", lost)])
        cls.untracked = cls.record("untracked", made.sidescan(pings=4, samples=300, bottom_track=False))

    @classmethod
    def record(cls, name, messages):
        return made.write(cls.root / f"{name}.mcap", messages)

    def test_each_verb_draws_its_picture(self):
        for verb, record, arguments, name in (
                ("fan", self.heads, ("--ping", 1), "fan_1.png"), ("fan", self.heads, ("--t", 0.15), "fan_2.png"),
                ("ping", self.heads, ("--ping", 1), "ping_1.png"), ("fls", self.heads, (), "fls_25.png"),
                ("scan", self.turner, (), "scan_19.png"), ("scan", self.turner, ("--t", 0.1), "scan_10.png"),
                ("waterfall", self.fish, (), "waterfall.png"), ("waterfall", self.fish, ("--ground", "--t", "0.2:"), "waterfall_ground.png"),
                ("water-column", self.heads, ("--ping", 1), "water_column_1.png"),
                ("water-column", self.heads, ("--ping", ":2", "--angle", -20), "water_column.png"),
                ("angular-response", self.heads, ("--class", 5), "angular_response.png")):
            with self.subTest(verb=verb, arguments=arguments), tempfile.TemporaryDirectory() as out:
                code, printed, errors = run(verb, record, *arguments, "--out", out)
                self.assertEqual((code, errors), (0, ""))
                self.assertEqual(printed, f"{out}/{name}\n")
                self.assertTrue((pathlib.Path(out) / name).read_bytes().startswith(PNG))
                file = pathlib.Path(out) / "new" / "mine.png"
                self.assertEqual(run(verb, record, *arguments, "--out", file)[0], 0)
                self.assertTrue(file.exists())

    def test_the_users_mistakes_name_their_cause(self):
        for arguments, why in {
            ("fan", self.heads, "--topic", "stern/ping"): "stern/ping is no recorded ping topic; there are bow/ping (beams: 128), eye/ping (beams: 512)",
            ("fan", self.heads, "--ping", "7"): "ping 7 of bow/ping was not recorded; the nearest is 4, and there are 4 from 0 to 4",
            ("fan", self.heads, "--t", "9"): "no ping of bow/ping at or after t = 9 s; there are 4, from 0 (t = 0.000 s) to 4 (t = 0.400 s)",
            ("fan", self.heads, "--ping", "4"): "ping 4 of bow/ping: all amplitudes are zero, there is nothing to draw",
            ("fan", self.heads, "--out", "x.jpg"): "--out x.jpg: allowed are a file that ends in .png, or a folder",
            ("fan", self.heads, "--ping", "1", "--db", "5", "4"): "--db 5 4: LOW must be below HIGH",
            ("fan", self.heads, "--gain", "30"): "30: allowed: none, head, auto, or S,A with S in [0, 100] dB and A in [0, 2000] dB/km",
            ("fan", self.fish): "no topic is known to hold pings of a multibeam; name one with --topic: fish/ping (beams: 2)",
            ("scan", self.turner, "--ping", "40"): "ping 40 of turner/ping was not recorded; the nearest is 19",
            ("scan", self.heads, "--topic", "bow/ping"): "ping 0 of bow/ping has 128 beams; a scanning head has one",
            ("fls", self.turner): "no topic is known to hold forward-looking pings",
            ("waterfall", self.heads): "no topic is known to hold sidescan pings",
            ("waterfall", self.heads, "--topic", "bow/ping"): "has 128 beams; a waterfall needs one to port (beam_angle_rad below 0) and one to starboard",
            ("waterfall", self.fish, "--t", "5:"): "no ping of fish/ping lies in what was asked for; there are 12, from 0 (t = 0.000 s) to 11 (t = 1.100 s)",
            ("waterfall", self.fish, "--ping", "5:3"): "5:3: allowed: a number, or A:B with A <= B",
            ("waterfall", self.untracked, "--ground"): "no bottom_track/1 of fish was recorded; without the instrument's own bottom track there is no ground range",
            ("waterfall", self.lost, "--ground"): "fish/bottom_track has no bottom for these pings; without",
            ("water-column", self.heads, "--ping", "4"): "all amplitudes are zero",
            ("water-column", self.heads, "--angle", "100"): "100: allowed: a number in [-90, 90]",
            ("water-column", self.heads, "--angle", "85", "--ping", ":2"):
                "ping 0 of bow/ping has no beam near +85° from straight down; its beams run from -64° to +63°",
            ("angular-response", self.fish): "holds no soundings",
            ("angular-response", self.heads, "--t", "7:"): "no soundings of bow/soundings lie in what was asked for; there are pings 0 (t = 0.000 s)",
            ("angular-response", self.heads, "--class", "0.1", "--ping", "0"): "no class of 0.1° holds 10 soundings",
        }.items():
            with self.subTest(arguments=arguments):
                code, _, errors = run(*arguments)
                self.assertEqual(code, 2)
                self.assertIn(why, " ".join(errors.split()))

    def test_a_head_is_found_by_what_it_declares_whatever_its_kind(self):
        pings = [(topic, dataclasses.replace(ping, kind="a new head")) for topic, ping in made.forward_looking()]
        new = made.write(self.root / "new.mcap", pings, {"eye": ensonify.HeadDeclaration(beam_axis="forward")})
        down = made.write(self.root / "down.mcap", pings, {"eye": ensonify.HeadDeclaration(beam_axis="down")})
        with tempfile.TemporaryDirectory() as out:
            self.assertEqual(run("fls", new, "--out", out)[0], 0)
            self.assertEqual(run("fan", down, "--out", out)[0], 0)
            self.assertIn("no topic is known to hold forward-looking pings", run("fls", down, "--out", out)[2])

    def test_a_survey_survives_a_silent_ping(self):
        with tempfile.TemporaryDirectory() as out:
            code, _, errors = run("survey", self.mute, "--out", out)
            self.assertEqual(code, 0)
            self.assertIn("no ping.png: ", errors)
            self.assertTrue((pathlib.Path(out) / "summary.json").exists())

    def test_several_topics_that_fit_are_not_guessed_between(self):
        both = [("fish/ping_" + band, message) for band in ("low", "high") for topic, message in made.sidescan(pings=2, samples=300)
                if topic == "fish/ping"]
        record = self.record("both", both)
        code, _, errors = run("waterfall", record)
        self.assertEqual(code, 2)
        self.assertIn("several topics hold sidescan pings", errors)
        self.assertIn("name one with --topic: fish/ping_low, fish/ping_high", errors)
        with tempfile.TemporaryDirectory() as out:
            self.assertEqual(run("waterfall", record, "--topic", "fish/ping_high", "--out", out)[0], 0)

    def test_each_channel_has_its_own_bottom(self):
        messages = []
        for band, altitude_m in (("low", 12.0), ("high", 9.0)):
            for topic, message in made.sidescan(pings=2, samples=300, altitude_m=altitude_m):
                messages.append((f"{topic.replace('bottom_track', 'bottom')}_{band}", message))
        record = ensonify.Record(self.record("channels", messages))
        for band, altitude_m in (("low", 12.0), ("high", 9.0)):
            _, tracks = waterfall.read(record, f"fish/ping_{band}", ALL, ALL, True)
            self.assertEqual(tracks[0].altitude_m, altitude_m)

    def test_one_dead_side_is_named(self):
        def half(message):
            message.amplitude_upa[0] = 0
            return message

        record = self.record("half", [("fish/ping", half(m)) for topic, m in made.sidescan(pings=3, samples=300) if topic == "fish/ping"])
        code, _, errors = run("waterfall", record)
        self.assertEqual(code, 2)
        self.assertIn("fish/ping, port, pings 0 to 2: all amplitudes are zero", errors)

    def test_what_is_no_ping_is_refused(self):
        good = {"stamp_ns": 0, "ping": 3, "sample_period_s": 1e-4, "sound_speed_mps": 1500.0,
                "beam_angle_rad": np.linspace(-1, 1, 8, dtype="f4"), "amplitude_upa": np.ones((8, 9), "f4")}
        for changed, why in (({"amplitude_upa": np.empty(0, "f4")}, "holds no samples: neither amplitude_upa nor amplitude_count"),
                             ({"amplitude_upa": np.ones((9, 8), "f4")}, "amplitudes of shape (9, 8) do not fit 8 beam angles"),
                             ({"amplitude_upa": np.full((8, 9), np.nan, "f4")}, "72 of 72 amplitudes are not finite"),
                             ({"sound_speed_mps": 0.0}, "must be above 0: without them samples have no range")):
            with self.subTest(why=why):
                record = self.record("odd", [("bow/ping", ensonify.Ping(**(good | changed)))])
                code, _, errors = run("fan", record)
                self.assertEqual(code, 2)
                self.assertIn(why, errors)

    def test_help_names_units_and_defaults(self):
        for verb in ("fan", "fls", "scan", "waterfall", "water-column", "angular-response"):
            code, printed, _ = run(verb, "--help")
            self.assertEqual(code, 0)
            self.assertGreaterEqual(printed.count("default:"), 4, verb)
            self.assertIn("in s", " ".join(printed.split()))


if __name__ == "__main__":
    unittest.main()
