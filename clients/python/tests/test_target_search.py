"""Ensonify/TargetSearch-v0: its waterfall, its baseline's eye and its rewards by themselves, then episodes."""
import unittest
from unittest import mock

import gymnasium
import numpy as np

import ensonify
from ensonify.tasks import target_search
from ensonify.tasks.target_search import CELLS, LINES, Baseline, line

NORTH = (0.0, 2 ** -0.5, 2 ** -0.5, 0.0)  # attitude of a body that heads north


def waterfall(*, shadow_cells, rows=(6, 16), start=30, side=1):
    """Sand, a water column of 13 cells to each side, and on one side an echo before a shadow."""
    half = np.full((LINES, CELLS), 130, np.uint8)
    half[:, :13] = 0
    other = half.copy()
    half[rows[0]:rows[1], start - 4:start] = 220
    half[rows[0]:rows[1], start:start + shadow_cells] = 20
    port, starboard = (half, other) if side < 0 else (other, half)
    return np.concatenate([port[:, ::-1], starboard], axis=1)


def seen(action, *, poses=((0.0, -60.0, -12.0),)):
    """A box at 0, 0, and where a vehicle that heads north has been since the last step."""
    newest = {"pager/object": ensonify.Object(position_enu_m=(0.0, 0.0, -17.0)),
            "auv/pose": ensonify.Pose(position_enu_m=poses[-1])}
    each = mock.MagicMock(action=np.float32(action))
    each.__getitem__.side_effect = newest.get
    each.new.return_value = [ensonify.Pose(position_enu_m=place, enu_from_body=NORTH) for place in poses]
    return each


class Parts(unittest.TestCase):
    def test_rows_make_a_picture_of_the_newest_messages(self):
        depths = [ensonify.Depth(depth_m=float(depth_m)) for depth_m in range(1, 6)]
        rows = ensonify.Rows(ensonify.Depth, lambda depth: [depth.depth_m, 7], gymnasium.spaces.Box(0, 255, (3, 2), np.uint8))
        self.assertEqual(rows.values("nav/depth", depths[:1])["nav/depth"].tolist(), [[1, 7], [0, 0], [0, 0]])
        self.assertEqual(rows.values("nav/depth", depths)["nav/depth"].tolist(), [[5, 7], [4, 7], [3, 7]])
        wide = ensonify.Rows(ensonify.Depth, lambda depth: [depth.depth_m], gymnasium.spaces.Box(0, 255, (3, 2), np.uint8))
        with self.assertRaisesRegex(ValueError, r"^nav/depth: the function's array has shape \(1,\), its space \(2,\)$"):
            wide.values("nav/depth", depths)
        with self.assertRaisesRegex(ValueError, r"^the space of Rows has shape \(4,\); it must be rows x columns$"):
            ensonify.Rows(ensonify.Depth, lambda depth: [1], gymnasium.spaces.Box(0, 255, (4,)))

    def test_a_line_has_port_left_far_outside_and_the_operators_gain(self):
        amplitude = np.zeros((2, 800), np.float32)
        amplitude[1, 400:412] = 1e6  # port, 15 m away: 120 dB and 40 dB of gain
        ping = ensonify.Ping(beam_angle_rad=np.float32([1, -1]), amplitude_upa=amplitude, sample_period_s=5e-5, sound_speed_mps=1500.0,
                             gain_offset_db=40.0)
        row = line(ping)
        self.assertEqual((row.shape, row.dtype), ((2 * CELLS,), np.uint8))
        self.assertEqual(np.flatnonzero(row).tolist(), [CELLS - 1 - 32])
        self.assertEqual(row.max(), round(255 * (160 - 125) / 50))

    def test_the_baseline_sees_a_tall_shadow_once_on_the_side_where_it_is(self):
        for side in (-1, 1):
            ahead_m, starboard_m = Baseline()._box(waterfall(shadow_cells=12, rows=(3, 13), side=side))
            self.assertAlmostEqual(ahead_m, -8.5 * 0.4)
            self.assertAlmostEqual(starboard_m, side * np.sqrt(13.5 ** 2 - (13 * 30 / 64 - 0.75) ** 2), delta=0.2)
        for at in (0, 6, 20):
            self.assertIsNone(Baseline()._box(waterfall(shadow_cells=12, rows=(at, at + 10))))

    def test_a_boulders_shadow_is_too_short_or_too_narrow(self):
        self.assertIsNone(Baseline()._box(waterfall(shadow_cells=3, rows=(3, 13))))
        self.assertIsNone(Baseline()._box(waterfall(shadow_cells=12, rows=(3, 6))))


class Rewards(unittest.TestCase):
    def setUp(self):
        self.env = target_search.TargetSearch()

    def earned(self, *arguments, **keywords):
        now = seen(*arguments, **keywords)
        reward, done = self.env._agent.judged(now)
        return round(reward, 3), done

    def test_a_right_announcement_ends_and_a_wrong_one_costs(self):
        self.assertEqual(self.earned([0, 0, 0, -1]), (-0.1, False))
        self.assertEqual(self.earned([0, 0.02, 0, 1]), (-0.1 + 80 * 0.8, True))  # 1 m beside it
        self.assertEqual(self.earned([0, 0.2, 0, 1]), (-2.1, False))
        self.assertEqual(self.earned([0, 0, 0, -1], poses=[(0, -101, -12)]), (-25.1, True))

    def test_the_first_pass_that_shows_the_box_earns_once(self):
        silent = [0, 0, 0, -1]
        self.assertEqual(self.earned(silent, poses=[(-3, 0, -12)]), (-0.1, False))  # it lies under the vehicle
        self.assertEqual(self.earned(silent, poses=[(30, 0, -12)]), (-0.1, False))  # beyond the swath
        self.assertEqual(self.earned(silent, poses=[(15, -2, -12), (15, 0, -12), (15, 2, -12)]), (19.9, False))
        self.assertEqual(self.earned(silent, poses=[(15, 0, -12)]), (-0.1, False))


class Episodes(unittest.TestCase):
    def test_the_box_is_in_the_waterfall_with_its_shadow_and_an_episode_repeats(self):
        env = target_search.TargetSearch()
        self.addCleanup(env.close)
        place = {"set": {"objects.target.on_seabed.at_m": [20, -60], "objects.target.heading_deg": 0,
                         "vehicles.auv.start.position_m": [0, -75, -12], "vehicles.auv.start.heading_deg": 0}}

        def episode():
            pictures = [env.reset(seed=3, options=place)[0]["side/ping_main"]]
            for _ in range(11):
                pictures.append(env.step(np.float32([0, 0, 0, -1]))[0]["side/ping_main"])
            return np.array(pictures)

        first = episode()
        self.assertEqual(first.tobytes(), episode().tobytes())
        starboard = first[-1][:, CELLS:].astype(int)
        usual = np.median(starboard, axis=0)
        box = slice(17, 27)  # rows: 4 m of it, abeam after 15 m of 22
        self.assertGreater((starboard - usual)[box, 40:45].max(), 40)
        self.assertGreater(((starboard - usual)[box, 47:62] < -30).mean(), 0.8)
        ahead_m, starboard_m = next(place for place in map(Baseline()._box, first) if place)
        self.assertAlmostEqual(starboard_m, 20, delta=1.5)


if __name__ == "__main__":
    unittest.main()
