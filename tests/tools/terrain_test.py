"""`ensonify terrain`: what it builds is what the scenario generates, GDAL reads it, and damage is found."""
import csv
import io
import json
import re
import signal
import subprocess
import time
import unittest

import ensonify
import numpy as np
from support import BIN, SOURCE, SystemTest, bay

SCENARIO = SOURCE / "scenarios" / "bay" / "scenario.yaml"
LSB_M = 2e-4


def terrain(*words, text=None):
    return subprocess.run([BIN / "ensonify-terrain", *map(str, words)], capture_output=True, text=True, input=text, timeout=120)


class Terrain(SystemTest):
    def build(self, name="tiles", *options):
        folder = self.folder / name
        done = terrain("build", SCENARIO, folder, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return folder

    def plain(self):
        """The bay by Lambert's law: tiles do not know what of a rough sediment's slopes their heights have already."""
        text, changed = re.subn(r"sediments: .*", "sediments: { 0: { lambert_mu_db: -25 } }", SCENARIO.read_text(encoding="utf-8"))
        self.assertEqual(changed, 1)
        path = self.folder / "plain.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    def on_tiles(self, scenario, folder):
        """A scenario with its generator replaced by a tile set."""
        text = scenario.read_text(encoding="utf-8")
        text = re.sub(r"^  kind: layers\n", f"  kind: tiles\n  tiles: {{ folder: {folder} }}\n", text, flags=re.M)
        text = re.sub(r"^  (size_m: .*\n|layers:\n(    .*\n)+)", "", text, flags=re.M)
        path = self.folder / "on_tiles.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    def test_a_seabed_above_the_water_is_refused_with_the_scenarios_name(self):
        land = self.folder / "land.yaml"
        land.write_text("ensonify: scenario/1\nsite: {latitude_deg: 50, longitude_deg: -4}\nvehicles: {boat: {}}\n"
                        "seabed: {kind: layers, size_m: [40, 40], layers: {hill: {plane: {depth_m: -10}}}}\n"
                        "mission: {speed_mps: 2, runlines: [{from_m: [0, -10], to_m: [0, 10]}]}\n")
        done = terrain("sample", land, "--points", "-", text="0,0\n")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(f"{land}: seabed.layers: make a seabed that is nowhere under water", done.stderr)

    def test_a_survey_of_the_tiles_gives_the_pings_of_the_generator(self):
        launch = bay(3, topics="[bow/soundings]")
        plain = self.plain()
        generated = self.run_launch(launch.replace(str(SCENARIO), str(plain)), out="generated", timeout=120)
        self.assertEqual(generated.code, 0, generated.stderr)
        on_tiles = launch.replace(str(SCENARIO), str(self.on_tiles(plain, self.build())))
        stored = self.run_launch(on_tiles, out="stored", timeout=120)
        self.assertEqual(stored.code, 0, stored.stderr)
        depths = []
        for result in (generated, stored):
            with ensonify.Record(result.out / "run.mcap") as record:
                depths.append([np.asarray(s.position_enu_m) for _, _, s in record.messages("bow/soundings")])
        self.assertGreater(len(depths[0]), 10)
        self.assertEqual(len(depths[0]), len(depths[1]))
        for a, b in zip(*depths):  # beyond the generator's end, tiles are holes in both
            np.testing.assert_array_equal(a, b)

    def test_gdal_reads_the_set_as_one_raster(self):
        try:
            from osgeo import gdal
        except ImportError:
            self.skipTest("GDAL's Python module is absent")
        folder = self.build()
        raster = gdal.Open(str(folder / "seabed.vrt"))
        self.assertEqual((raster.RasterXSize, raster.RasterYSize), (2049, 4097))
        heights = raster.ReadAsArray()
        west, step, _, north, _, _ = raster.GetGeoTransform()
        rng = np.random.default_rng(1)
        column, row = rng.integers(100, 1900, 200), rng.integers(1000, 3000, 200)
        places = [(west + (c + 0.5) * step, north - (r + 0.5) * step) for c, r in zip(column, row)]
        points = self.folder / "points.csv"
        points.write_text("east_m,north_m\n" + "".join(f"{x},{y}\n" for x, y in places))
        done = terrain("sample", folder, "--points", points)
        self.assertEqual(done.returncode, 0, done.stderr)
        sampled = [float(line["elevation_m"]) for line in csv.DictReader(io.StringIO(done.stdout))]
        np.testing.assert_allclose(sampled, heights[row, column], atol=LSB_M / 2)

    def test_sample_prints_class_and_slope_and_leaves_the_unknown_empty(self):
        folder = self.build()
        done = terrain("sample", folder, "--points", "-", text="-60, -40\n\n5000,0\n")
        lines = list(csv.DictReader(io.StringIO(done.stdout)))
        self.assertEqual(lines[0]["sediment"], "1")  # the ridge
        self.assertEqual(lines[1]["elevation_m"], "")
        self.assertLess(float(lines[0]["slope_deg"]), 60)
        bad = terrain("sample", folder, "--points", "-", text="1,2\nhere\n")
        self.assertEqual(bad.returncode, 2)

    def test_a_mesh_covers_the_seabed_once_finely_below_the_fan_and_coarsely_elsewhere(self):
        done = terrain("mesh", SCENARIO, "--at", 10, 20, "--altitude", 20)
        self.assertEqual(done.returncode, 0, done.stderr)
        mesh = json.loads(done.stdout)
        west, south, east, north, level = np.array(mesh["blocks"]).T

        def level_at(x, y):
            over = (west <= x) & (x < east) & (south <= y) & (y < north)
            self.assertEqual(np.count_nonzero(over), 1)
            return level[over][0]

        self.assertEqual({level_at(x, 20) for x in range(-30, 50, 5)}, {0})  # 43 m to either side, across the heading
        self.assertEqual(level_at(10, 150), 5)
        self.assertEqual(level_at(-150, 20), 5)
        self.assertLess(10 * mesh["triangles"], mesh["triangles_of_all_posts"])
        picture = self.folder / "lod.png"
        plot = [BIN / "ensonify-plot", "lod", SCENARIO, "--at", "10", "20", "--altitude", "20", "--out", picture]
        subprocess.run(plot, check=True, capture_output=True, timeout=120)
        self.assertGreater(picture.stat().st_size, 10_000)
        beside = terrain("mesh", SCENARIO, "--at", 5000, 0)
        self.assertEqual(beside.returncode, 2)
        self.assertIn("has no height at 5000, 0", beside.stderr)

    def test_an_irregular_mesh_is_fine_in_the_fan_and_left_out_beyond_reach(self):
        harbour = SOURCE / "scenarios/harbour/scenario.yaml"
        words = ["--at", 20, -112, "--altitude", 9, "--heading", 80]
        (quay,) = json.loads(terrain("mesh", harbour, *words).stdout)["meshes"]
        self.assertEqual(quay["name"], "quay")
        self.assertLess(20 * len(quay["triangles"]), quay["triangles_of_all"])
        places, own = np.array(quay["places_enu_m"]), np.array(quay["triangles"])[:quay["of_the_source"]]
        self.assertGreater(len(own), 20)
        # The fan stands across the heading: 14 m off it intersects the wall 14 tan(10 deg) = 2.5 m farther east, 0.8 m wide.
        # Piles are 0.6 m wide.
        east, north, up = places[np.unique(own)].T
        self.assertLess(np.abs(east - 22.5).max(), 0.8 + 4 * 0.6)
        self.assertLess(np.abs(north + 126).max(), 0.215 + 0.06)
        self.assertEqual(up.min(), -15)
        self.assertEqual(json.loads(terrain("mesh", harbour, "--at", 20, 0, "--altitude", 9).stdout)["meshes"], [])
        picture = self.folder / "lod.png"
        subprocess.run([BIN / "ensonify-plot", "lod", harbour, *map(str, words), "--out", picture], check=True, capture_output=True, timeout=120)
        self.assertGreater(picture.stat().st_size, 50_000)

    def test_marks_are_where_the_seabed_is_furrowed(self):
        scars = SOURCE / "scenarios/trawl_scars/scenario.yaml"
        rows = list(csv.DictReader(io.StringIO(terrain("marks", scars, "--points", 201).stdout)))
        marks = {}
        for row in rows:
            self.assertEqual(row["layer"], "scars")
            marks.setdefault(int(row["mark"]), []).append([float(row[key]) for key in ("east_m", "north_m", "half_width_m", "depth_m")])
        self.assertGreater(len(marks), 20)
        deep, points = 0, []
        for line in map(np.array, marks.values()):
            self.assertEqual(len(line), 201)
            # Furrows of 1500 m have a place every 7.5 m: the nearest is at most half of that farther off than the furrow.
            outside = np.maximum(abs(line[:, :2]) - [1000, 500], 0)
            self.assertLess(np.hypot(*outside.T).min(), line[0, 2] + 4)
            inner = line[40:160:12]  # a tenth of its length at each end it fades
            ahead = line[42:162:12, :2] - line[38:158:12, :2]
            across = np.column_stack([ahead[:, 1], -ahead[:, 0]]) / np.linalg.norm(ahead, axis=1)[:, None]
            inside = (abs(inner[:, 0]) < 980) & (abs(inner[:, 1]) < 480)
            depth_m, away_m = line[0, 3], 4 * line[0, 2]
            if depth_m < 0.15 or inside.sum() < 4:
                continue
            deep += 1
            on, aside = inner[inside, :2], away_m * across[inside]
            points.append((depth_m, np.concatenate([on, on + aside, on - aside])))
        self.assertGreater(deep, 8)
        text = "".join(f"{x},{y}\n" for _, places in points for x, y in places)
        heights = [float(row["elevation_m"]) for row in csv.DictReader(io.StringIO(terrain("sample", scars, "--points", "-", text=text).stdout))]
        for depth_m, places in points:
            (middle, port, starboard), heights = np.reshape(heights[:len(places)], (3, -1)), heights[len(places):]
            # Mud and swell differ by 2 cm over some metres; a line between posts 0.2 m apart is not the deepest: up to a tenth of depth.
            self.assertAlmostEqual(np.median(0.5 * (port + starboard) - middle), depth_m, delta=0.02 + 0.1 * depth_m)

        collection = json.loads(terrain("marks", scars, "--points", 201, "--geojson").stdout)
        self.assertEqual(len(collection["features"]), len(marks))
        for feature, line in zip(collection["features"], marks.values()):
            self.assertEqual(feature["geometry"]["type"], "LineString")
            longitude, latitude = np.array(feature["geometry"]["coordinates"]).T
            line = np.array(line)
            # The ellipsoid's radii at 61 N: 111,429 m to a degree of latitude, 54,108 m to one of longitude; 0.1 % for grid north.
            np.testing.assert_allclose((latitude - 61.0) * 111_429, line[:, 1], atol=3)
            np.testing.assert_allclose((longitude - 3.5) * 54_108, line[:, 0], atol=3)
        refused = terrain("marks", self.build())
        self.assertEqual(refused.returncode, 2)
        self.assertIn("is no seabed of layers; only those have marks", refused.stderr)

    def test_facets_of_a_scenario_are_reported_with_the_uneven_classes(self):
        def facets_of(layer):
            path = self.folder / "scenario.yaml"
            text = re.sub(r"^    relief: .*$", f"    relief: {{ spectral: {{ as_sediment: medium sand, outer_scale_m: 40 }}{layer} }}",
                          SCENARIO.read_text(encoding="utf-8"), flags=re.M)
            text = re.sub(r"^  sediments: .*$", "  sediments: { 0: medium sand }", text, flags=re.M)
            path.write_text(text, encoding="utf-8")
            reported = terrain("facets", path)
            self.assertEqual(reported.returncode, 0, reported.stderr)
            return reported.stdout

        even = facets_of("")
        self.assertRegex(even, r"(?m)^class 0: .* facet_slope_deg: \d\.\d{4} ")
        self.assertNotIn("warning", even)
        # The slope of 2 degrees is 22 m deep 57 m east of its middle; it is 480 m wide.
        uneven = facets_of(", mask: { depth_m: { to: 22 }, of: slope }")
        self.assertEqual(re.search("class 0: .*", uneven)[0], re.search("class 0: .*", even)[0])
        self.assertRegex(uneven, r"(?m)^warning: layer relief holds at 0\.6\d of class 0,")
        refused = terrain("facets", SOURCE / "scenarios" / "raster" / "scenario.yaml")
        self.assertEqual(refused.returncode, 2)

    def test_info_and_verify(self):
        folder = self.build()
        facts = json.loads(terrain("info", folder, "--json").stdout)
        self.assertEqual((facts["tiles"], facts["spacing_m"], facts["lsb_m"]), (8, 0.25, LSB_M))
        self.assertEqual(facts["overview"], "overview.npy")
        self.assertEqual(terrain("verify", folder).returncode, 0)
        manifest = (folder / "tileset.yaml").read_text()
        (folder / "tileset.yaml").write_text("".join(line for line in manifest.splitlines(True) if "overview" not in line))
        self.assertEqual(json.loads(terrain("info", folder, "--json").stdout)["overview"], "none")
        self.assertEqual(terrain("verify", folder).returncode, 0)
        self.assertEqual(terrain("build", SCENARIO, folder).returncode, 0)  # made anew, no tile is
        self.assertEqual((folder / "tileset.yaml").read_text(), manifest)
        tile = sorted((folder / "tiles").glob("*+0000.png"))[0]
        data = bytearray(tile.read_bytes())
        data[len(data) // 2] ^= 4
        tile.write_bytes(data)
        done = terrain("verify", folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn(tile.name, done.stdout)

    def test_an_overview_is_read_by_numpy_and_a_damaged_one_is_found_and_made_anew(self):
        folder = self.build()
        overview = folder / "overview.npy"
        heights, whole = np.load(overview), overview.read_bytes()
        self.assertEqual(heights.shape, (255, 127))  # every 4.02 m over the 1024 m of four tiles, counted from the origin
        step = 1024 / 255
        posts = [(row, column) for row in range(70, 190, 17) for column in range(10, 120, 13)]
        points = "east_m,north_m\n" + "".join(f"{(column - 63) * step!r},{(row - 127) * step!r}\n" for row, column in posts)
        lines = list(csv.DictReader(io.StringIO(terrain("sample", folder, "--points", "-", text=points).stdout)))
        np.testing.assert_allclose([heights[post] for post in posts], [float(line["elevation_m"]) for line in lines], atol=1e-4)
        overview.write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]))
        done = terrain("verify", folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("overview.npy: is not that of the manifest's tiles (SHA-256)", done.stdout)
        self.assertEqual(terrain("build", SCENARIO, folder).returncode, 0)
        self.assertEqual(overview.read_bytes(), whole)

    def test_the_same_tiles_by_one_thread_and_by_three(self):
        one, three = self.build("one", "--threads", 1), self.build("three", "--threads", 3)
        names = sorted(path.relative_to(one) for path in one.rglob("*") if path.is_file())
        self.assertEqual(names, sorted(path.relative_to(three) for path in three.rglob("*") if path.is_file()))
        for name in names:
            self.assertEqual((one / name).read_bytes(), (three / name).read_bytes(), name)

    def test_a_killed_build_goes_on_and_ends_as_if_it_had_not_been(self):
        whole, broken = self.build("whole"), self.folder / "broken"
        build = subprocess.Popen([BIN / "ensonify-terrain", "build", SCENARIO, broken, "--threads", "1"],
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while not list(broken.glob("tiles/*.yaml")) and time.monotonic() < deadline:
            time.sleep(0.01)
        build.send_signal(signal.SIGKILL)
        build.wait()
        self.assertFalse((broken / "tileset.yaml").exists(), "the build was over before it was killed")
        self.assertEqual(terrain("info", broken).returncode, 2)  # no half set passes for a whole one
        kept = {path: path.stat().st_mtime_ns for path in broken.glob("tiles/*.yaml")}
        done = terrain("build", SCENARIO, broken)
        self.assertEqual(done.returncode, 0, done.stderr)
        for path, time_ns in kept.items():
            self.assertEqual(path.stat().st_mtime_ns, time_ns, "a finished tile was made again")
        for path in whole.rglob("*.png"):
            self.assertEqual(path.read_bytes(), (broken / path.relative_to(whole)).read_bytes())

    def test_a_folder_with_another_seabed_is_left_alone(self):
        folder = self.build()
        done = terrain("build", SCENARIO, folder, "--lsb-m", 0.001)
        self.assertEqual(done.returncode, 2)
        self.assertIn("another seabed", done.stderr)

    def test_a_step_too_fine_for_the_relief_is_refused_with_the_remedy(self):
        done = terrain("build", SCENARIO, self.folder / "fine", "--lsb-m", 1e-5)
        self.assertEqual(done.returncode, 2)
        self.assertIn("use a larger lsb_m", done.stderr)

    def test_a_full_disk_is_said_and_the_build_can_go_on(self):
        mount = self.folder / "small"
        mount.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1500k", "none", mount], capture_output=True).returncode != 0:
            self.skipTest("no right to mount a small tmpfs")
        try:
            done = terrain("build", SCENARIO, mount / "tiles")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("cannot be written", done.stderr)
            self.assertFalse(list(mount.rglob("*.part")))
            subprocess.run(["mount", "-o", "remount,size=50m", mount], check=True)
            self.assertEqual(terrain("build", SCENARIO, mount / "tiles").returncode, 0)
            self.assertEqual(terrain("verify", mount / "tiles").returncode, 0)
        finally:
            subprocess.run(["umount", mount], check=True)

    def test_tiles_of_another_place_are_refused(self):
        scenario = self.on_tiles(SCENARIO, self.build())
        scenario.write_text(scenario.read_text().replace("latitude_deg: 42.25", "latitude_deg: 43.25"))
        launch = bay(1).replace(str(SCENARIO), str(scenario))
        result = self.run_launch(launch, out="elsewhere", timeout=60)
        self.assertEqual(result.code, 2)
        self.assertIn("origin: is 42.25", result.stderr)


    def test_a_scenario_is_sampled_as_the_tiles_made_of_it_are(self):
        text = "".join(f"{x},{y}\n" for x, y in np.random.default_rng(2).uniform(-200, 200, (50, 2)))
        reported = [terrain("sample", seabed, "--points", "-", text=text) for seabed in (SCENARIO, self.build())]
        self.assertEqual(reported[0].returncode, 0, reported[0].stderr)
        self.assertEqual(reported[0].stdout, reported[1].stdout)
        coarse = terrain("sample", SCENARIO, "--points", "-", "--spacing", 8, text=text)
        heights = [[float(line["elevation_m"]) for line in csv.DictReader(io.StringIO(done.stdout))] for done in (reported[0], coarse)]
        difference = np.abs(np.subtract(*heights))
        self.assertGreater(difference.max(), 0.01)  # a mesh of 8 m has not all of it ...
        self.assertLess(np.median(difference), 0.2)  # ... and is the same seabed


class LevelOfDetail(SystemTest):
    def lod(self, *words):
        done = terrain("lod", self.mesh, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_a_mesh_is_prepared_once_and_again_when_it_changes(self):
        side = 60
        lines = [f"v {i} {j} {3 * np.sin(0.3 * i) * np.cos(0.2 * j) - 20:.3f}" for j in range(side) for i in range(side)]
        lines += [f"f {v} {v + 1} {v + side + 1} {v + side}" for j in range(side - 1) for v in range(side * j + 1, side * (j + 1))]
        self.mesh = self.folder / "waves.obj"
        self.mesh.write_text("\n".join(lines))
        first = self.lod("--at", 30, 30, 0, "--range", 40)
        self.assertEqual((first["cached"], first["triangles"]), (False, 2 * (side - 1) ** 2))
        self.assertLess(first["coarsest_triangles"], 10)
        self.assertLess(first["ping"]["triangles"], first["triangles"] / 4)
        again = self.lod("--at", 30, 30, 0, "--range", 40, "--ping-out", self.folder / "ping.obj")
        self.assertEqual(again, {**first, "cached": True})
        source, moved = (self.folder / "ping.obj").read_text().split("g source\n")[1].split("g moved\n")
        self.assertEqual(source.count("f "), first["ping"]["of_the_source"])
        self.assertEqual(moved.count("f "), first["ping"]["triangles"] - first["ping"]["of_the_source"])
        file = self.folder / "waves.obj.lod"
        file.write_bytes(file.read_bytes()[:-100])  # damaged
        self.assertFalse(self.lod()["cached"])
        self.assertFalse(self.lod("--unit-m", 0.001)["cached"])
        self.mesh.write_text("\n".join(lines[:-1]))
        self.assertEqual(self.lod()["triangles"], first["triangles"] - 2)
        self.mesh.write_text("f 1 2 3\n")
        done = terrain("lod", self.mesh)
        self.assertEqual(done.returncode, 2)
        self.assertIn("waves.obj:1", done.stderr)


if __name__ == "__main__":
    unittest.main()
