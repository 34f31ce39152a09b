"""Where beams truly hit the seabed: planes, against closed forms."""
import unittest

import numpy as np

import ensonify
from ensonify_plot.true_places import Head, Mounting, Poses, axis_on_seabed
from ensonify_plot.truth import Seabed


def plane(slope: float) -> Seabed:
    """20 m deep below the origin, rising to the east."""
    posts = np.arange(-60, 60.5, 0.5)
    height = np.broadcast_to(-20.0 + slope * posts, (len(posts), len(posts)))
    return Seabed([ensonify.Tile(col=0, row=0, origin_east_m=posts[0], origin_north_m=posts[0], spacing_m=0.5, height_m=height)])


def head(attitude_deg=(0.0, 0.0, 0.0), position_m=(0.0, 0.0, 0.0), n=1) -> Head:
    """Roll, pitch, heading, as of a body at the origin that lies level with its bow to the north."""
    ned = np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1.0]])
    turned = Mounting(np.zeros(3), *attitude_deg).body_from_head()
    return Head(np.tile(np.array(position_m), (n, 1)), np.tile(ned @ turned, (n, 1, 1)))


class AxisOnSeabed(unittest.TestCase):
    def test_a_rolled_head_over_a_slope(self):
        angle = np.radians(np.linspace(-60, 60, 25))
        for roll_deg, slope in ((0, 0), (5, 0), (-3, 0.1)):
            at = head((roll_deg, 0, 0), n=25)
            place = axis_on_seabed(plane(slope), at, at, np.zeros(25), np.sin(angle), np.full(25, 25.0))
            # Starboard down, a beam to starboard points nearer to the vertical.
            tangent = np.tan(angle - np.radians(roll_deg))
            depth = 20.0 / (1 + slope * tangent)
            np.testing.assert_allclose(place, np.column_stack([depth * tangent, np.zeros(25), -depth]), atol=2e-3)

    def test_a_fan_tilted_forward_and_a_head_turned_by_its_mounting(self):
        at = head((0, 4, 90))  # bow to the east and up
        place = axis_on_seabed(plane(0), at, at, np.array([np.sin(np.radians(4))]), np.zeros(1), np.array([19.0]))
        np.testing.assert_allclose(place, [[20 * np.tan(np.radians(8)), 0, -20]], atol=2e-3)

    def test_each_array_is_placed_where_it_was(self):
        transmit, receive = head(), head(position_m=(0.1, 0.3, 0.0))
        place = axis_on_seabed(plane(0), transmit, receive, np.zeros(1), np.zeros(1), np.array([20.0]))
        # In the plane across the bow where it transmitted and in that along the bow where it received.
        np.testing.assert_allclose(place, [[0.1, 0.0, -20]], atol=2e-3)

    def test_beyond_the_tiles_there_is_no_truth(self):
        at = head()
        place = axis_on_seabed(plane(0), at, at, np.zeros(1), np.array([np.sin(np.radians(80))]), np.array([115.0]))
        self.assertTrue(np.isnan(place).all())


class PosesBetween(unittest.TestCase):
    def test_a_quaternion_of_the_other_sign_is_the_same_attitude(self):
        half = np.radians(45)
        poses = Poses([ensonify.Pose(stamp_ns=0, position_enu_m=(0, 0, 0), enu_from_body=(1, 0, 0, 0)),
                       ensonify.Pose(stamp_ns=10**9, position_enu_m=(2, 4, 6), enu_from_body=(-np.cos(half), 0, 0, -np.sin(half)))])
        middle = poses.head_at(np.array([0.5]), Mounting(np.array([1.0, 0.0, 0.0])))
        np.testing.assert_allclose(middle.enu_from_head[0][:, 0], [np.sqrt(0.5), np.sqrt(0.5), 0])
        np.testing.assert_allclose(middle.position_enu_m[0], [1 + np.sqrt(0.5), 2 + np.sqrt(0.5), 3])


if __name__ == "__main__":
    unittest.main(verbosity=2)
