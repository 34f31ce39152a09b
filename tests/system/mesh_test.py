"""A quay wall that is no heightfield: a head hears it where it stands, and nothing there without it."""
import unittest

import ensonify
import numpy as np
from support import SystemTest

WORLD = """
ensonify: scenario/1
site: { latitude_deg: 54.3, longitude_deg: 10.1 }
seed: 1
water: { sound_speed_mps: 1480 }
seabed:
  kind: layers
  post_spacing_m: 0.5
  size_m: [300, 300]
  sediments: { 0: medium silt, 4: { lambert_mu_db: -12 } }
  layers: { ground: { plane: { depth_m: 12 } } }
  MESHES
vehicles:
  boat:
    start: { position_m: [0, -40, -5], heading_deg: 0, speed_mps: 2 }
    mountings: { ahead: { actual: { position_m: [0, 0, 0], pitch_deg: 90 } } }
mission: { depth_m: 5, speed_mps: 2, run_in_m: 0, runlines: [{ from_m: [0, -40], to_m: [0, 10] }] }
"""
WALL = "meshes: { quay: { sheet_pile_wall: { from_m: [-30, 20], to_m: [30, 20], foot_depth_m: 14 }, sediment: 4 } }"
# 8 degrees of beam, level, 7 m above the seabed; what it hears of that lies at its edges.
LAUNCH = """
ensonify: launch/1
scenario: world.yaml
duration_s: 12
clock: { rate: free }
processes:
  boat:  { run: vehicle }
  nav:   { run: navigation }
  pilot: { run: autopilot }
  pager: { run: terrain_pager, config: { feed_margin_m: 50, release_hysteresis_m: 10 } }
  ahead: { run: echosounder, config: { range_m: 70, ping_rate_hz: 2, sound_speed_mps: 1480, lod: { enabled: LOD } } }
  recorder: { run: recorder, config: { file: run.mcap, topics: [ahead/ping, boat/pose, pager/mesh] } }
"""
WALL_NORTH_M = 20.0
NEAREST_M = 12.0  # nearer echoes are the seabed's, below


class Mesh(SystemTest):
    def heard(self, meshes, lod="true"):
        """Of each ping: place of the head (north) when it pinged, range and level of its loudest sample beyond NEAREST_M."""
        self.write("world.yaml", WORLD.replace("MESHES", meshes))
        result = self.run_launch(LAUNCH.replace("LOD", lod), timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        heard = []
        with ensonify.Record(result.out / "run.mcap") as record:
            self.meshes = [mesh.name for _, _, mesh in record.messages("pager/mesh")]
            poses = [(pose.stamp_ns, pose.position_enu_m[1]) for _, _, pose in record.messages("boat/pose")]
            stamps, norths = np.array(poses).T
            for _, _, ping in record.messages("ahead/ping"):
                amplitude = np.asarray(ping.amplitude_upa)[0]
                ranges = 0.5 * 1480 * ping.sample_period_s * np.arange(amplitude.size)
                amplitude[ranges < NEAREST_M] = 0
                loudest = int(np.argmax(amplitude))
                heard.append((np.interp(ping.stamp_ns, stamps, norths), ranges[loudest], 20 * np.log10(amplitude[loudest])))
        self.assertGreater(len(heard), 15)
        return np.array(heard)

    def test_a_head_hears_the_wall_where_it_stands(self):
        north, range_m, level_db = self.heard(WALL).T
        self.assertEqual(self.meshes, ["quay"])
        near = WALL_NORTH_M - north < 49  # the pager has published it, half a second before at most
        self.assertGreater(near.sum(), 10)
        # The section is 0.215 m to either side of the line and piles are 0.015 m out of it; the pulse is 0.07 m long and
        # the vehicle moves 0.1 m while it listens. At the beam's edge, 4 degrees aside, the wall is 0.12 m farther at 50 m.
        self.assertLess(np.max(np.abs(range_m - (WALL_NORTH_M - north))[near]), 0.215 + 0.06 + 0.07 + 0.1 + 0.12)
        _, _, without_db = self.heard("").T
        self.assertEqual(self.meshes, [])
        self.assertGreater(np.median(level_db[near]) - np.median(without_db), 10)

    def test_with_and_without_level_of_detail_it_is_as_loud(self):
        some, everything = self.heard(WALL), self.heard(WALL, lod="false")
        near = WALL_NORTH_M - some[:, 0] < 49
        np.testing.assert_array_equal(some[:, 1][near], everything[:, 1][near])
        # The main lobe is the same to the bit; what side lobes add is more than 20 dB below it.
        np.testing.assert_allclose(some[:, 2][near], everything[:, 2][near], atol=0.1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
