"""A survey whose seabed is paged in and given up again receives what one receives with the whole seabed in memory."""
import contextlib
import csv
import io
import os
import signal
import time
import unittest

import ensonify
from support import SOURCE, SystemTest

# 700 m of rock and sand at 0.1 m, 21 tiles; the boat crosses it lengthwise.
WORLD = """
ensonify: scenario/1
site: { name: Strip, latitude_deg: 57.5, longitude_deg: -1.5 }
seed: 10
seabed:
  kind: layers
  post_spacing_m: 0.1
  size_m: [700, 200]
  layers:
    slope: { plane: { depth_m: 12, slope_deg: 0.2, downhill_heading_deg: 90 } }
    rock: { spectral: { rms_m: 0.3, outer_scale_m: 50 } }
vehicles:
  boat:
    acceleration_mps2: 0.3
    turning_radius_m: 30
    fastest_mps: 8
    mountings: { bow: { actual: { position_m: [1.5, 0.2, 0.8] } } }
mission:
  speed_mps: 6
  runlines: [{ from_m: [-300, 0], to_m: [300, 0] }]
"""

LAUNCH = """
ensonify: launch/1
scenario: world.yaml
duration_s: 60
clock: {{ rate: free }}
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager, config: {{ {pager} }} }}
  bow:   {{ run: multibeam, config: {{ ping_rate_hz: 1, amplitude_every: 10, quality: 0.25 }} }}
  heard: {{ run: recorder, config: {{ file: heard.mcap, topics: [bow/soundings, bow/ping] }} }}
  paged: {{ run: recorder, config: {{ file: paged.mcap, topics: [pager/release, pager/health] }} }}
"""

# A part of survey_10km that fits into memory: 48 tiles, 450 m of its line.
SURVEY = (SOURCE / "scenarios/survey_10km/scenario.yaml").read_text()
PART = {"size_m: [10000, 10000]": "size_m: [800, 420]\n  centre_m: [0, 100]",
        "from_m: [-4900, 100], to_m: [4900, 100]": "from_m: [-200, 100], to_m: [200, 100]", "speed_mps: 4": "speed_mps: 6"}


def releases(record):
    with ensonify.Record(record) as messages:
        return sum(1 for _ in messages.messages("pager/release"))


# The least that is allowed: 6 tiles at once within 62 m and one being made; every tile is a surprise to the disk.
LEAST = "budget_mb: 53, threads: 1, load_ahead_s: 1, wide_margin_m: 0"


class Paged(SystemTest):
    def survey(self, name, pager, world=WORLD):
        self.write("world.yaml", world)
        result = self.run_launch(LAUNCH.format(pager=pager), out=name, timeout=300)
        self.assertEqual(result.code, 0, result.stderr)
        return result.out

    def hindered_survey(self, name, pager):
        """The same; its pager stands still for most of the time, as behind a disk that hangs."""
        self.write("world.yaml", WORLD)
        run = self.start_launch(LAUNCH.format(pager=pager), out=name)
        pid, stops = self.wait_for_process("ensonify-terrain_pager"), 0
        with contextlib.suppress(ProcessLookupError):  # it has ended
            while run.poll() is None:
                os.kill(pid, signal.SIGSTOP)
                time.sleep(0.2)
                os.kill(pid, signal.SIGCONT)
                time.sleep(0.1)
                stops += 1
        _, errors = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 0, errors)
        self.assertGreater(stops, 5)
        return self.folder / name

    def expect_same(self, whole, paged):
        same = self.tool("compare", whole / "heard.mcap", paged / "heard.mcap")
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)

    def test_pings_depend_neither_on_resident_tiles_nor_on_loading_time(self):
        whole = self.survey("whole", "feed_margin_m: 1000")
        self.assertEqual(releases(whole / "paged.mcap"), 0)
        paged = self.survey("paged", LEAST)
        self.assertGreaterEqual(releases(paged / "paged.mcap"), 6)
        self.expect_same(whole, paged)
        self.expect_same(whole, self.hindered_survey("hindered", LEAST))
        with ensonify.Record(paged / "heard.mcap") as record:
            received = [soundings.valid.any() for _, _, soundings in record.messages("bow/soundings")]
        self.assertGreater(len(received), 50)
        self.assertTrue(all(received), "a ping came back empty")

    def heights(self, world):
        """At places of the part, as the seabed of a world has them."""
        points = self.write("points.csv", "".join(f"{x},{y}\n" for x in range(-390, 391, 60) for y in (-100, 7, 103.37, 300)))
        done = self.tool("terrain", "sample", self.write("sampled.yaml", world), "--points", points)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [(line["elevation_m"], line["sediment"]) for line in csv.DictReader(io.StringIO(done.stdout))]

    def test_a_part_of_ten_kilometres_gives_the_pings_of_all_resident_and_of_a_cache(self):
        part = SURVEY
        for there, here in PART.items():
            self.assertEqual(part.count(there), 1, there)
            part = part.replace(there, here)
        heights = self.heights(part)
        self.assertGreater(len(set(heights)), 50)
        self.assertEqual(heights, self.heights(SURVEY))

        whole = self.survey("whole", "feed_margin_m: 1000", part)
        self.assertEqual(releases(whole / "paged.mcap"), 0)
        cache = self.folder / "cache"
        cached = f"budget_mb: 160, threads: 1, load_ahead_s: 1, wide_margin_m: 0, cache_mb: 500, cache_folder: {cache}"  # 30 tiles of 48
        cold = self.survey("cold", cached, part)
        self.assertGreaterEqual(releases(cold / "paged.mcap"), 6)
        self.expect_same(whole, cold)
        kept = {file.name: file.stat() for file in cache.iterdir()}
        self.assertGreaterEqual(len(kept), 20)
        self.expect_same(whole, self.survey("warm", cached, part))
        now = {file.name: file.stat() for file in cache.iterdir()}
        self.assertEqual({name: facts.st_ino for name, facts in kept.items()}, {name: facts.st_ino for name, facts in now.items()})
        self.assertGreaterEqual(sum(now[name].st_mtime_ns > facts.st_mtime_ns for name, facts in kept.items()), 20)  # were read


if __name__ == "__main__":
    unittest.main(verbosity=2)
