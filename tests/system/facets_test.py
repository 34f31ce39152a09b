"""Relief that the mesh has is counted once in the strength of its facets, also where a layer's mask examines the shape of a guide,
which the pager alone reads: heads take from its tiles what it counted."""
import unittest

import ensonify
import numpy as np
from support import SystemTest

# Mud with posts of 0.1 m, level but for 1 m in a kilometre to the north: an echosounder at 300 kHz receives it at right angles, where
# slopes that count twice are received most.
WORLD = """
ensonify: scenario/1
site: {{ latitude_deg: 54.0, longitude_deg: -10.0 }}
seed: 3
water: {{ sound_speed_mps: 1500 }}
seabed:
  kind: layers
  post_spacing_m: 0.1
  size_m: [160, 80]
  sediments: {{ 0: {sediment} }}
  layers:
    ground: {{ guide: {{ raster: guide.asc, values: elevation, cell_m: 10 }} }}
    mud: {mud}
vehicles:
  boat: {{ start: {{ position_m: [-40, 0, 0], heading_deg: 90, speed_mps: 4 }}, mountings: {{ sounder: {{ actual: {{ position_m: [0, 0, 0.8] }} }} }} }}
mission: {{ speed_mps: 4, run_in_m: 0, runlines: [{{ from_m: [-40, 0], to_m: [60, 0] }}] }}
"""
LAUNCH = """
ensonify: launch/1
scenario: {world}.scenario.yaml
duration_s: 8
clock: {{ rate: free }}
processes:
  boat: {{ run: vehicle }}
  nav: {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
  sounder:
    run: echosounder
    config: {{ frequency_hz: 3.0e+5, range_m: 30, ping_rate_hz: 10, effects: {{ speckle: false, noise: false, multipath: false }} }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: [sounder/ping, pager/tile] }} }}
"""
COLUMNS, ROWS, CELL_DEG = 40, 40, 1e-4  # 6.6 m x 11.1 m
SILT = "{ spectral: { as_sediment: medium silt, outer_scale_m: 8 } }"
MASKED = SILT[:-1] + ", mask: { depth_m: { to: 30 }, of: ground } }"  # it holds everywhere


def guide():
    """An ESRI ASCII grid around the origin."""
    north_deg = CELL_DEG * (ROWS / 2 - 0.5 - np.arange(ROWS))  # first row: the northernmost
    rows = "\n".join(" ".join([f"{-20 - 0.001 * 111_000 * north:.4f}"] * COLUMNS) for north in north_deg)
    return (f"ncols {COLUMNS}\nnrows {ROWS}\nxllcorner {-10 - CELL_DEG * COLUMNS / 2}\nyllcorner {54 - CELL_DEG * ROWS / 2}\n"
            f"cellsize {CELL_DEG}\n{rows}\n")


class Facets(SystemTest):
    def written(self, name, mud, sediment="medium silt"):
        """A launch file on its world."""
        self.write("guide.asc", guide())
        self.write("guide.prj", 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],'
                                'UNIT["degree",0.0174532925199433]]')
        self.write(f"{name}.scenario.yaml", WORLD.format(mud=mud, sediment=sediment))
        return self.write(f"{name}.yaml", LAUNCH.format(world=name))

    def received(self, name, *world):
        """Amplitudes of all pings, and what the tiles reported."""
        result = self.run_launch(self.written(name, *world), out=name, timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        with ensonify.Record(result.out / "run.mcap") as record:
            reported = {tuple(tile.facet_mean_square_slope) for _, _, tile in record.messages("pager/tile")}
            pings = [np.array(ping.amplitude_upa[0], dtype=float) for _, _, ping in record.messages("sounder/ping")]
        self.assertEqual(len(reported), 1)
        self.assertGreater(len(pings), 50)
        return pings, reported.pop()

    def test_a_layer_masked_by_a_guides_depth_counts_as_one_without_a_mask(self):
        masked, reported = self.received("masked", MASKED)
        plain, reported_of_plain = self.received("plain", SILT)
        self.assertEqual(reported, reported_of_plain)
        self.assertGreater(reported[0], 0)
        for a, b in zip(masked, plain, strict=True):
            np.testing.assert_array_equal(a, b)
        level, _ = self.received("level", "{ use: false, plane: {} }")
        twice, reported = self.received("twice", MASKED, "{ name: medium silt, facet_slope_deg: 0 }")
        self.assertEqual(reported, ())

        def over_level_db(pings):
            energy = np.mean([np.sum(ping**2) for ping in pings]) / np.mean([np.sum(ping**2) for ping in level])
            return 10 * np.log10(energy)

        # The plane's law is what facets return on average (docs/physics/seabed/backscatter.md): 0.1 dB of that and 0.1 dB for 10,000
        # facets. What counts twice is 1.0 dB at right angles; over a beam 8 degrees wide 0.6 are left.
        self.assertAlmostEqual(over_level_db(masked), 0.0, delta=0.2)
        self.assertLess(over_level_db(twice), -0.5)

    def test_check_reads_from_the_guide_what_part_of_a_class_is_rough(self):
        everywhere, half = self.written("masked", MASKED), self.written("half", MASKED.replace("to: 30", "to: 20"))
        self.assertNotIn("mud", self.tool("check", everywhere).stderr)
        reported = self.tool("check", half)
        self.assertEqual(reported.returncode, 0, reported.stderr)
        self.assertRegex(reported.stderr, r"(?m)^warning: layer mud holds at 0\.[45]\d of class 0,")

    def test_check_reads_no_guide_for_a_launch_without_a_pager(self):
        self.written("unread", MASKED)
        self.write("guide.asc", "no raster")
        launch = self.write("unread.yaml", "ensonify: launch/1\nscenario: unread.scenario.yaml\nduration_s: 1\n"
                                           "processes: { boat: { run: vehicle } }\n")
        reported = self.tool("check", launch)
        self.assertEqual(reported.returncode, 0, reported.stderr)


if __name__ == "__main__":
    unittest.main()
