"""What is no heightfield, received. A quay's wall, driven towards, along and away from: a head receives it where it stands as long as
it is near, however the run is run. A scanned coral on sand: an echo where it stands, and a shadow behind."""
import re
import shutil
import unittest

import ensonify
import numpy as np
from support import SHARED, SOURCE, SystemTest

# The harbour and its quay, posts farther apart, in a swell; the boat drives at the quay, turns beside it at once, and leaves.
HARBOUR = (SOURCE / "scenarios/harbour/scenario.yaml").read_text()
WALL_NORTH_M = -126.0
OF_HARBOUR = {"post_spacing_m: 0.05": "post_spacing_m: 0.5",
              "    disturbance: { preset: survey_launch }\n":
                  "    roll: { amplitude_deg: 1.7, period_s: 5 }\n    heave: { amplitude_m: 0.1, period_s: 6 }\n",
              "  boat:\n": "  boat:\n    turn_acceleration_dps2: 10000\n    start: { position_m: [20, -66, 0], heading_deg: 180, speed_mps: 5 }\n",
              "    mountings:\n": "    mountings:\n      eye: { actual: { position_m: [1.5, 0, 0.8] } }\n"}
MISSION = """mission:
  speed_mps: 5
  run_in_m: 0
  runlines: [{ from_m: [20, -66], to_m: [20, -105] }, { from_m: [40, -105], to_m: [40, -50] }]
"""
REACH_M = 40.0
EYE = ("{ run: forward_looking, config: { ping_rate_hz: 1, beams: 64, most_samples: 500, tilt_deg: 8, lod: { enabled: true }, "
       f"range_m: {REACH_M}, longest_range_m: {REACH_M} }} }}")
LAUNCH = f"""
ensonify: launch/1
scenario: world.yaml
duration_s: 22
clock: {{ rate: free }}
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager, config: {{ release_hysteresis_m: 5 }} }}
  eye:   {EYE}
  recorder:
    run: recorder
    config:
      file: run.mcap
      topics: [eye/ping, boat/pose, nav/estimate, nav/sound_speed, pager/tile, pager/release, pager/mesh, pager/mesh_release]
"""
# The same head on the same world, which comes from a record.
REPLAYED = f"""
ensonify: launch/1
scenario: world.yaml
duration_s: 22
clock: {{ rate: free }}
processes:
  boat:  {{ run: replay, config: {{ file: RECORD, topics: [boat/pose] }} }}
  nav:   {{ run: replay, config: {{ file: RECORD, topics: [nav/estimate, nav/sound_speed] }} }}
  pager: {{ run: replay, config: {{ file: RECORD, topics: [pager/tile, pager/release, pager/mesh, pager/mesh_release] }} }}
  eye:   {EYE}
  recorder: {{ run: recorder, config: {{ file: again.mcap, topics: [eye/ping] }} }}
"""


def heading_of(pose):
    w, x, y, z = pose.enu_from_body
    return np.arctan2(1 - 2 * (y * y + z * z), 2 * (x * y + z * w))  # forward, from north


class Seen:
    """One ping: where the head truly was, and what stands out in its beams, at the first sample of half a beam's greatest amplitude."""
    STANDS_OUT_UPA = 10 ** (110 / 20)  # mud and its drags stay below 107 dB re 1 uPa beyond 12 m

    def __init__(self, ping, pose):
        self.t_s = 1e-9 * ping.stamp_ns
        heading_rad = heading_of(pose)
        self.power_upa2 = np.sum(np.square(np.asarray(ping.amplitude_upa), dtype=float))
        self.south, self.north = np.cos(heading_rad) < -0.9998, np.cos(heading_rad) > 0.9998  # within a degree: not turning
        place = np.array(pose.position_enu_m[:2]) + 1.5 * np.array([np.sin(heading_rad), np.cos(heading_rad)])
        self.from_wall_m = place[1] - WALL_NORTH_M
        amplitude = np.asarray(ping.amplitude_upa)
        self.out = amplitude.max(axis=1) > self.STANDS_OUT_UPA
        first = np.argmax(amplitude > 0.5 * amplitude.max(axis=1, keepdims=True), axis=1)
        range_m = (ping.first_sample_s + first * ping.sample_period_s) * ping.sound_speed_mps / 2
        bearing = heading_rad + np.asarray(ping.beam_angle_rad)
        moved = np.outer(range_m / ping.sound_speed_mps, pose.velocity_enu_mps[:2])  # half-way between transmission and echo
        self.places = place + moved + range_m[:, None] * np.stack([np.sin(bearing), np.cos(bearing)], axis=1)
        # Beams within 30 degrees of upright to the wall that hit it well within their range.
        towards = -np.cos(bearing)
        self.at_wall = (towards > np.cos(np.radians(30))) & (self.from_wall_m < (REACH_M - 1.5) * towards)


class Mesh(SystemTest):
    @classmethod
    def setUpClass(cls):
        cls.world = HARBOUR[:HARBOUR.index("mission:")] + MISSION
        for there, here in OF_HARBOUR.items():
            assert cls.world.count(there) == 1, there
            cls.world = cls.world.replace(there, here)

    def run_world(self, launch, name, *options, prefix=()):
        self.write("world.yaml", self.world)
        result = self.run_launch(launch, *options, out=name, timeout=200, prefix=prefix)
        self.assertEqual(result.code, 0, result.stderr)
        return result.out

    def expect_wall_where_it_stands(self, pings):
        looking = [ping for ping in pings if ping.south and ping.at_wall.any()]
        self.assertGreaterEqual(len(looking), 3)
        for ping in looking:
            self.assertTrue(ping.out[ping.at_wall].all(), ping.t_s)
        places = np.concatenate([ping.places[ping.at_wall] for ping in looking])
        self.assertGreater(len(places), 80)
        north_m = places[:, 1] - WALL_NORTH_M
        # Pans stand 0.215 m to either side and 0.06 m out of line; a cell of range is 0.16 m; 30 degrees aside and 38 m
        # off a beam 1.2 degrees wide receives the wall 0.2 m nearer by its inner edge.
        self.assertLess(np.abs(north_m).max(), 0.215 + 0.06 + 0.16 + 0.2)
        # A beam covers a pile of 0.6 m: what it receives first is a pan that stands out, or, where speckle takes it, one that
        # stands back. So the line through all lies between the middle of the section and its front; 0.05 m for the mean
        # of 80 places 0.2 m off. These deviate its direction by 0.1 degrees.
        slope, middle_m = np.polyfit(places[:, 0] - places[:, 0].mean(), north_m, 1)
        self.assertTrue(-0.05 < middle_m < 0.215 + 0.05, middle_m)
        self.assertLess(abs(np.degrees(np.arctan(slope))), 0.4)

    def test_a_head_receives_the_quay_in_place_while_it_is_near(self):
        out = self.run_world(LAUNCH, "first")
        with ensonify.Record(out / "run.mcap") as record:
            poses = {pose.stamp_ns: pose for _, _, pose in record.messages("boat/pose")}
            pings = [Seen(ping, poses[ping.stamp_ns]) for _, _, ping in record.messages("eye/ping")]
            came = [(1e-9 * t, mesh.name) for _, t, mesh in record.messages("pager/mesh")]
            went = [1e-9 * t for _, t, _ in record.messages("pager/mesh_release")]
        self.assertEqual(len(pings), 22)
        self.expect_wall_where_it_stands(pings)
        self.assertEqual([name for _, name in came], ["quay"])
        self.assertEqual(len(went), 1)
        for ping in pings:
            if ping.from_wall_m < REACH_M:
                self.assertTrue(came[0][0] <= ping.t_s < went[0], ping.t_s)
            if ping.from_wall_m > REACH_M + 10:  # and what the boat goes between two updates of the pager
                self.assertFalse(came[0][0] <= ping.t_s - 0.5 and ping.t_s < went[0], ping.t_s)
        away = [ping for ping in pings if ping.from_wall_m < REACH_M and ping.north]
        self.assertGreater(len(away), 3)
        self.assertFalse(any(ping.out.any() for ping in away))  # nothing else stands out

        one_core = self.run_world(LAUNCH, "one_core", prefix=("taskset", "-c", "0"))
        one_process = self.run_world(LAUNCH, "one_process", "--in-process")
        for other in (one_core, one_process):
            self.assertEqual((out / "run.mcap").read_bytes(), (other / "run.mcap").read_bytes(), other.name)
        again = self.run_world(REPLAYED.replace("RECORD", str(out / "run.mcap")), "again")
        same = self.tool("compare", "--topic", "eye/ping", out / "run.mcap", again / "again.mcap")
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)
        self.assertRegex(same.stdout, "^same: 22 messages on 1 topics")

    def test_the_first_ping_has_the_level_of_the_whole_mesh_and_none_without_it(self):
        start = "position_m: [20, -66, 0]"
        self.assertIn(start, self.world)
        near = self.world.replace(start, "position_m: [20, -100, 0]").replace("[20, -66]", "[20, -100]")
        short = LAUNCH.replace("duration_s: 22", "duration_s: 1.5")
        received = {}
        self.world = near
        for name, launch, options in (("refined", short, ()), ("whole", short.replace("enabled: true", "enabled: false"), ()),
                                      ("without", short, ("--set", "seabed.meshes={}"))):
            with ensonify.Record(self.run_world(launch, name, *options) / "run.mcap") as record:
                poses = {pose.stamp_ns: pose for _, _, pose in record.messages("boat/pose")}
                received[name] = [Seen(ping, poses[ping.stamp_ns]) for _, _, ping in record.messages("eye/ping")]
        first = received["refined"][0]
        self.assertEqual(first.t_s, 0)
        self.assertGreater(first.at_wall.sum(), 20)
        self.assertTrue(first.out[first.at_wall].all())
        for refined, whole in zip(received["refined"], received["whole"], strict=True):
            self.assertLess(abs(10 * np.log10(refined.power_upa2 / whole.power_upa2)), 0.1)
        self.assertEqual(len(received["without"]), len(received["refined"]))
        self.assertFalse(any(ping.out.any() for ping in received["without"]))

    def test_an_imaging_head_beside_the_pier_images_each_pile_in_place(self):
        """Its front row stands along north at -106 m, every 5 m from -122 m on, 0.6 m thick. The bottom is 12 m deep: before 11 m
        the piles are all there is."""
        there, bow_east_m, north_m = "position_m: [20, -66, 0], heading_deg: 180", -94.5 - 1.5, -104.5
        self.assertIn(there, self.world)
        self.world = self.world.replace(there, "position_m: [-94.5, -104.5, 0], heading_deg: 270").replace(
            "from_m: [20, -66], to_m: [20, -105]", "from_m: [-94.5, -104.5], to_m: [-100, -104.5]").replace(
            "from_m: [40, -105], to_m: [40, -50]", "from_m: [-60, -60], to_m: [-50, -60]")
        launch = LAUNCH.replace("duration_s: 22", "duration_s: 0.5").replace("range_m: 40.0", "range_m: 20")
        power = {}
        for name, options in (("piles", ()), ("without", ("--set", "seabed.meshes={}"))):
            with ensonify.Record(self.run_world(launch, name, *options) / "run.mcap") as record:
                _, _, ping = next(iter(record.messages("eye/ping")))
            power[name] = np.square(np.asarray(ping.amplitude_upa, dtype=float))
        range_m = (ping.first_sample_s + np.arange(power["piles"].shape[1]) * ping.sample_period_s) * ping.sound_speed_mps / 2
        bearing_deg = np.degrees(np.asarray(ping.beam_angle_rad))
        for pile_north_m in (-112, -107, -102, -97):
            starboard_m, ahead_m = pile_north_m - north_m, bow_east_m + 106  # heading west
            towards_deg, away_m = np.degrees(np.arctan2(starboard_m, ahead_m)), np.hypot(starboard_m, ahead_m) - 0.3
            near = np.ix_(abs(bearing_deg - towards_deg) < 8, abs(range_m - away_m) < 1)
            beam, sample = np.unravel_index(np.argmax(power["piles"][near]), power["piles"][near].shape)
            found_deg, found_m = bearing_deg[near[0][beam, 0]], range_m[near[1][0, sample]]
            with self.subTest(north_m=pile_north_m):
                # Beams are 2 degrees apart, a pile 3 degrees wide and strongest at its middle. Its first echo is the nearest place; the
                # vertical beams, tilted by 8 degrees, are strongest 0.1 m farther; a cell is 0.05 m.
                self.assertLess(abs(found_deg - towards_deg), 2.5)
                self.assertTrue(-0.1 < found_m - away_m < 0.3, found_m - away_m)
                self.assertGreater(10 * np.log10(power["piles"][near].max() / power["without"][near].max()), 15)

    def test_the_shipped_launch_holds_what_it_expects_and_draws_its_image(self):
        result = self.run_launch(SOURCE / "launch/quay.yaml", "--free", "--arg", "quality=0.1", timeout=200)
        self.assertEqual(result.code, 0, result.stderr)
        self.assertGreater(next(result.out.glob("fls_*.png")).stat().st_size, 100_000)


# The walk-through of scenarios/meshes.md: a coral of 0.37 m on sand, 6 m ahead of a small AUV that is 2 m above the sand.
_, REEF, REEF_LAUNCH = re.findall(r"^```yaml\n(.*?)^```", (SOURCE / "scenarios/meshes.md").read_text(), re.M | re.S)
OF_REEF_LAUNCH = {"duration_s: 2": "duration_s: 0.5", "after: [[ensonify, plot, fls]]\n": "",
                  "ping_rate_hz: 1 }": "ping_rate_hz: 1, beams: 128, most_samples: 500 }"}


class Coral(SystemTest):
    def first_image(self, name, *options):
        """Power by beam and sample, and what the pager's log says."""
        launch = REEF_LAUNCH
        for there, here in OF_REEF_LAUNCH.items():
            self.assertEqual(launch.count(there), 1, there)
            launch = launch.replace(there, here)
        result = self.run_launch(launch, "--free", *options, out=name, timeout=100)
        self.assertEqual(result.code, 0, result.stderr)
        with ensonify.Record(result.out / "reef.mcap") as record:
            _, _, ping = next(iter(record.messages("eye/ping")))
        self.range_m = (ping.first_sample_s + np.arange(500) * ping.sample_period_s) * ping.sound_speed_mps / 2
        self.azimuth_deg = np.degrees(ping.beam_angle_rad)
        return np.square(np.asarray(ping.amplitude_upa, dtype=float)), result.log("pager")

    def test_a_scanned_coral_is_an_echo_and_a_shadow_and_is_prepared_once(self):
        scan = SHARED / "data/objects/mcap_coral.obj"
        if not scan.exists():
            self.skipTest(f"{scan} is not there")
        shutil.copy(scan, self.folder / "coral.obj")
        self.write("reef.yaml", REEF)
        unprepared, log = self.first_image("unprepared")
        self.assertIn("mesh_unprepared mesh=coral", log)
        prepared = self.tool("terrain", "lod", self.folder / "coral.obj")
        self.assertEqual(prepared.returncode, 0, prepared.stderr)
        received, log = self.first_image("prepared")
        self.assertNotIn("mesh_unprepared", log)
        np.testing.assert_array_equal(received, unprepared)
        bare, _ = self.first_image("bare", "--set", "seabed.meshes={}")

        # Its middle is 0.1 m above the sand, 0.3 m east and 6 m north of the head and 1.9 m below it; it is 0.37 m wide, 3.4
        # degrees from there. The head is so high above the sand that the shadow of its top, 0.22 m up, ends 0.7 m behind it.
        away_m, towards_deg = np.linalg.norm([0.3, 6.0, 1.9]), np.degrees(np.arctan2(0.3, 6.0))
        beam, sample = np.unravel_index(np.argmax(received), received.shape)
        self.assertLess(abs(self.range_m[sample] - away_m), 0.25)
        self.assertLess(abs(self.azimuth_deg[beam] - towards_deg), 1.7 + 0.5)

        def stronger_db(from_m, to_m, half_deg):
            there = np.ix_(abs(self.azimuth_deg - towards_deg) < half_deg, (self.range_m > away_m + from_m) & (self.range_m < away_m + to_m))
            return 10 * np.log10(received[there].mean() / bare[there].mean())

        self.assertGreater(stronger_db(-0.25, 0.25, 2.0), 12)  # 17 dB of Lambert's law, and a face that is upright
        self.assertLess(stronger_db(0.15, 0.45, 1.4), -5)      # there all of its width shades; what is left are side lobes


if __name__ == "__main__":
    unittest.main(verbosity=2)
