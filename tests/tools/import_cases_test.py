"""`ensonify terrain import` on small files made for it: everything strange that survey files are, imported right or refused
with place, cause and remedy; and imports that are stopped."""
import json
import math
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

import numpy as np
from importing import Import, gdal, osr, terrain
from support import BIN, SOURCE

try:
    import h5py
except ImportError:
    h5py = None

UTM = 32619
CORNER = (360000.0, 4680000.0)


def sea(x, y):
    """A gentle bottom, 18 to 23 m deep over the rasters below."""
    return -20.0 + 0.004 * (x - CORNER[0]) + 2.0 * np.sin((y - CORNER[1]) / 90.0)


@unittest.skipUnless(gdal, "GDAL's Python module is absent")
class Cases(Import):
    def made(self, name="sea.tif", geotransform=(CORNER[0], 4.0, 0, CORNER[1], 0, -4.0), shape=(120, 150), epsg=UTM, values=sea,
             kind=None, nodata=None, unit=None, description=None):
        """A raster of values at the centres of its cells, on its map."""
        g = geotransform
        column, row = np.meshgrid(np.arange(shape[1]) + 0.5, np.arange(shape[0]) + 0.5)
        array = values(g[0] + column * g[1] + row * g[2], g[3] + column * g[4] + row * g[5])
        path = self.folder / name
        raster = gdal.GetDriverByName("GTiff").Create(str(path), shape[1], shape[0], 1, kind or gdal.GDT_Float32)
        raster.SetGeoTransform(g)
        if epsg:
            reference = osr.SpatialReference()
            reference.ImportFromEPSG(epsg)
            raster.SetProjection(reference.ExportToWkt())
        band = raster.GetRasterBand(1)
        if nodata is not None:
            band.SetNoDataValue(nodata)
        if unit:
            band.SetUnitType(unit)
        if description:
            band.SetDescription(description)
        band.WriteArray(array)
        raster = None
        return path

    def compare(self, path, *words, name="tiles", expected=None, **options):
        """Imports a file and compares it with gdalwarp's bilinear on the same posts, away from its rim: half a step, and
        1e-3 m for slopes of up to 0.03 times the lattice on which places are carried from map to map."""
        folder, report = self.run_import(path, *words, name=name)
        ours, gdals = self.warped(expected or path, folder, report, **options)
        both = np.isfinite(ours) & np.isfinite(gdals)
        self.assertGreater(np.count_nonzero(both), 0.9 * np.count_nonzero(np.isfinite(gdals)))
        for axis in (0, 1):
            for shift in (1, -1):
                both &= np.roll(np.isfinite(ours), shift, axis)
        self.assertLess(np.abs(ours - gdals)[both].max(), report["steps"]["lsb_m"] / 2 + 1e-3)
        return report

    # What is imported right

    def test_rotated_and_sheared_cells(self):
        self.compare(self.made(geotransform=(CORNER[0], 3.8, 0.9, CORNER[1], 1.3, -3.5)))

    def test_south_up_and_oblong_cells(self):
        report = self.compare(self.made(geotransform=(CORNER[0], 4.0, 0, CORNER[1], 0, 2.5)))
        self.assertAlmostEqual(report["spacing_m"], 2.5, delta=0.01)

    def test_web_mercator_metres_are_not_metres(self):
        path = self.made(geotransform=(-13580000.0, 5.0, 0, 4400000.0, 0, -5.0), epsg=3857,
                         values=lambda x, y: -20 + 0.004 * (x + 13580000))
        report = self.compare(path)
        latitude = 2 * math.atan(math.exp(4399700 / 6378137)) - math.pi / 2
        # The projection takes the ellipsoid for a sphere: 0.3 % at most.
        self.assertAlmostEqual(report["sources"][0]["cell_m"], 5 * math.cos(latitude), delta=0.02)

    def test_two_files_join_at_the_antimeridian(self):
        def dip(x, y):
            return -20 - 300.0 * np.abs(np.where(x > 0, x - 180, x + 180))
        west = self.made("west.tif", (179.99, 1e-4, 0, -16.0, 0, -1e-4), (60, 101), 4326, dip)
        east = self.made("east.tif", (-180.0001, 1e-4, 0, -16.0, 0, -1e-4), (60, 101), 4326, dip)
        folder, report = self.run_import(west, east)
        heights, _, _, step = self.heights(folder)
        middle = np.flatnonzero(np.isfinite(heights).any(axis=0))
        row = heights[np.flatnonzero(np.isfinite(heights[:, middle].mean(axis=1)))[0], middle]
        self.assertTrue(np.isfinite(row).all())  # one seabed, no seam
        # 0.02 degrees of 107,034 m [the ellipsoid's at 16 degrees]
        self.assertAlmostEqual(len(middle) * step, 0.02 * 107034, delta=4 * step)
        self.assertAlmostEqual(np.nanmax(heights), -20, delta=0.03)

    def test_feet_and_fathoms_and_depths_become_metres_up(self):
        feet = self.made("feet.tif", values=lambda x, y: -sea(x, y) / 0.3048, unit="ft", description="depth")
        report = self.compare(feet, expected=self.made("metres.tif"))
        self.assertEqual((report["sources"][0]["values"], report["sources"][0]["unit"]), ("depths", "ft"))
        fathoms = self.made("fathoms.tif", values=lambda x, y: sea(x, y) / 1.8288)
        self.compare(fathoms, "--units", "fathom", name="fathoms", expected=self.folder / "metres.tif")

    def test_datums_are_shifted_by_a_number_or_by_a_raster(self):
        path = self.made()
        shifted = self.made("shifted.tif", values=lambda x, y: sea(x, y) - 1.25)
        self.compare(path, "--datum-shift", -1.25, expected=shifted)
        self.made("separation.tif", (CORNER[0] - 100, 50, 0, CORNER[1] + 100, 0, -50), (20, 12),
                  values=lambda x, y: 0.001 * (x - CORNER[0]) - 1.0)
        tilted = self.made("tilted.tif", values=lambda x, y: sea(x, y) + 0.001 * (x - CORNER[0]) - 1.0)
        folder, report = self.run_import(path, "--vertical", self.folder / "separation.tif", name="separated")
        self.assertGreater(report["sources"][0]["posts_without_separation"], 0)  # it ends before the survey does
        ours, gdals = self.warped(tilted, folder, report)
        both = np.isfinite(ours) & np.isfinite(gdals)
        self.assertGreater(np.count_nonzero(both), 0.7 * np.count_nonzero(np.isfinite(gdals)))
        self.assertLess(np.abs(ours - gdals)[both][1000:-1000].max(), 2e-3)

    def test_marks_of_missing_values_of_several_kinds(self):
        def holed(x, y):
            z = sea(x, y)
            z[10:20, 10:20] = -9999
            z[40:50, 10:20] = np.nan
            z[70:80, 10:20] = 1e6
            return z
        path = self.made(values=holed, nodata=-9999)
        self.refused(path, causes=["holds 1e+06", "--nodata 1e+06"])
        _, report = self.run_import(path, "--nodata", "1e6")
        self.assertEqual(report["holes"]["count"], 3)
        self.assertEqual(report["sources"][0]["marked_cells"], 100)

    def test_a_lonely_zero_is_a_mark_and_a_beach_is_none(self):
        def holed(mark):
            return lambda x, y: np.where((x > CORNER[0] + 240) & (x < CORNER[0] + 320), mark, sea(x, y))
        for mark in (0, -10):
            self.refused(self.made("holed.tif", values=holed(mark)), causes=[f"holds {mark} in", f"--nodata {mark}"])
        _, report = self.run_import(self.folder / "holed.tif", "--nodata", "-10")
        self.assertGreater(report["sources"][0]["marked_cells"], 2000)
        # Land that is drawn at 0, but rises out of shallows.
        beach = self.made("beach.tif", values=lambda x, y: np.minimum(0, -12 + 0.03 * (x - CORNER[0])))
        _, report = self.run_import(beach, name="beach")
        self.assertEqual(report["highest_m"], 0)

    def test_classes_from_a_raster_by_nearest_cell_and_from_rules(self):
        path = self.made()
        classes = self.made("classes.tif", (CORNER[0], 20.0, 0, CORNER[1], 0, -20.0), (24, 15), kind=gdal.GDT_Byte, nodata=255,
                            values=lambda x, y: np.where(x > CORNER[0] + 150, 7, np.where(y > CORNER[1] - 200, 3, 255)))
        folder, report = self.run_import(path, "--sediment-class", classes, "--class-map", "7=2,3=1", "--sediment-rule",
                                         "5:depth>20.5", "--sediment-rule", "6:slope>90", "--sediment", 4)
        _, by_gdal = self.warped(classes, folder, report, resampleAlg=gdal.GRA_NearestNeighbour)
        heights, west, north, step = self.heights(folder)
        rows, columns = np.nonzero(np.isfinite(heights))
        picked = np.random.default_rng(2).integers(0, len(rows), 400)
        text = "".join(f"{west + (columns[i] + 0.5) * step},{north - (rows[i] + 0.5) * step}\n" for i in picked)
        reported = terrain("sample", folder, "--points", "-", text=text).stdout.splitlines()[1:]
        wrong, seen = 0, set()
        for i, line in zip(picked, reported):
            value, depth = by_gdal[rows[i], columns[i]], -heights[rows[i], columns[i]]
            expected = 2 if value == 7 else 1 if value == 3 else 5 if depth > 20.5 else 4
            seen.add(expected)
            reported_class = line.split(",")[3]
            wrong += reported_class not in ("", str(expected))  # empty: the place of a post on the rim, rounded, lies beyond
        self.assertEqual(seen, {1, 2, 4, 5})
        self.assertLessEqual(wrong, 4)  # places on the border of two cells to the last digit

    def test_spikes_are_reported_and_removed(self):
        def spiky(x, y):
            z = sea(x, y)
            z[30, 40] += 5
            z[90, 100] -= 3
            return z
        path = self.made(values=spiky)
        _, reported = self.run_import(path)
        spikes = reported["sources"][0]["spikes"]
        self.assertEqual([(s["column"], s["row"]) for s in spikes["largest"]], [(40, 30), (100, 90)])
        _, taken = self.run_import(path, "--despike", "--fill", "idw/20", name="taken")
        self.assertEqual((taken["holes"]["count"], taken["holes"]["filled"]), (0, 2))
        self.assertLess(taken["highest_m"], -15.4)

    def test_posts_farther_apart_than_cells_see_no_shorter_waves(self):
        path = self.made(values=lambda x, y: -20 + np.cos(np.pi * (x - CORNER[0]) / 8))  # 16 m waves, 4 m cells
        folder, report = self.run_import(path, "--spacing", 20)
        heights = self.heights(folder)[0]
        # Waves of 40 m lose half their power, those of 16 m all but 2^-(40/16)^2: 0.081 m are left of 0.707 m.
        self.assertLess(np.nanstd(heights), 0.09)
        self.assertAlmostEqual(report["sources"][0]["band"]["removed_below_cells"], 10, delta=0.1)
        against = report["sources"][0]["posts_against_cells"]
        self.assertAlmostEqual(against["rms_m"], math.sqrt(0.5) * (1 - 2 ** -6.25), delta=0.06)  # what was taken out
        self.assertEqual(report["steps"]["rms_error_m"] < 1e-3, True)

    def test_how_far_the_stored_seabed_lies_from_the_cells_is_told(self):
        gentle = self.run_import(self.made(), name="gentle")[1]["sources"][0]["posts_against_cells"]
        self.assertGreater(gentle["cells"], 0.95 * 120 * 150)
        self.assertLess(gentle["largest_m"], 0.01)  # slopes of 0.03 over cells of 4 m bend by 2 m (4 m / 90 m)^2 / 8 at most
        # A checkerboard of 1 m up and down: posts half a cell off all cells' middles are 0 everywhere.
        board = self.made("board.tif", geotransform=(CORNER[0], 1.0, 0, CORNER[1], 0, -1.0),
                          values=lambda x, y: -20 + np.where((np.floor(x) + np.floor(y)) % 2 == 0, 1.0, -1.0))
        rough = self.run_import(board, name="board")[1]["sources"][0]["posts_against_cells"]
        self.assertGreater(rough["largest_m"], 0.5)
        self.assertLess(rough["rms_m"], 1.0)
        self.assertGreater(rough["rms_m"], 0.2)
        fine = self.run_import(board, "--spacing", 0.1, name="fine")[1]["sources"][0]["posts_against_cells"]
        self.assertLess(fine["rms_m"], 0.3 * rough["rms_m"])

    @unittest.skipUnless(h5py, "h5py is absent")
    def test_a_bag_of_variable_resolution_whose_overview_is_two_by_two(self):
        cell, posts = 64.0, {(0, 0): 32, (0, 1): 16, (1, 0): 8, (1, 1): 32}  # row from the south, column: nodes a side
        overview = self.made("overview.tif", (CORNER[0], cell, 0, CORNER[1], 0, -cell), (2, 2))
        path = self.folder / "variable.bag"
        gdal.Translate(str(path), str(overview), format="BAG")
        nodes, index = [], np.zeros((2, 2), dtype=[("index", "<u4"), ("dimensions_x", "<u4"), ("dimensions_y", "<u4"),
                                                   ("resolution_x", "<f4"), ("resolution_y", "<f4"), ("sw_corner_x", "<f4"),
                                                   ("sw_corner_y", "<f4")])
        for (row, column), n in posts.items():
            step = cell / n
            x = CORNER[0] + column * cell + (np.arange(n) + 0.5) * step
            y = CORNER[1] - 2 * cell + row * cell + (np.arange(n) + 0.5) * step
            index[row, column] = (len(nodes), n, n, step, step, step / 2, step / 2)
            nodes += [(z, 0.1) for z in sea(*np.meshgrid(x, y)).ravel()]
        with h5py.File(path, "a") as bag:
            root = bag["BAG_root"]
            root.create_dataset("varres_metadata", data=index)
            for name, value in (("resolution", (2.0, 8.0)), ("dimensions", (8, 32))):
                for axis in "xy":
                    root["varres_metadata"].attrs[f"min_{name}_{axis}"] = np.dtype("f4" if name == "resolution" else "u4").type(value[0])
                    root["varres_metadata"].attrs[f"max_{name}_{axis}"] = np.dtype("f4" if name == "resolution" else "u4").type(value[1])
            root.create_dataset("varres_refinements", data=np.array([nodes], dtype=[("depth", "<f4"), ("depth_uncrt", "<f4")]))
        folder, report = self.run_import(path)
        self.assertAlmostEqual(report["spacing_m"], 2.0, delta=0.01)
        whole = self.made("whole.tif", (CORNER[0], 2.0, 0, CORNER[1], 0, -2.0), (64, 64))
        ours, gdals = self.warped(whole, folder, report)
        both = np.isfinite(ours) & np.isfinite(gdals)
        self.assertGreater(np.count_nonzero(both), 60 * 60)
        # a node of 8 m stands for 4 m to each side; the slope is 2 / 90 at most along north
        self.assertLess(np.abs(ours - gdals)[both].max(), 4 * 2 / 90 + 4 * 0.004 + 0.01)

    def test_an_overview_whose_refinements_cannot_be_read_is_no_seabed(self):
        overview = self.made("overview.tif", (CORNER[0], 50.0, 0, CORNER[1], 0, -50.0), (20, 20))
        file = gdal.Open(str(overview), gdal.GA_Update)
        file.SetMetadataItem("MIN_RESOLUTION_X", "0.5")  # as a BAG's, of a GDAL that says nothing of supergrids
        file.FlushCache()
        del file
        self.refused(overview, causes=["overview.tif: is of variable resolution", "only its overview of 50 m cells",
                                       "refinements of 0.5 m and more"])

    def test_a_mesh_in_millimetres_becomes_its_highest_surface(self):
        lines = [f"v {500 * i} {500 * j} {-20000 + 50 * i}" for j in range(21) for i in range(21)]
        lines += [f"f {v} {v + 1} {v + 22} {v + 21}" for j in range(20) for v in range(21 * j + 1, 21 * j + 21)]
        # A table 2 m above, on one upright side.
        lines += [f"v {x} {y} {z}" for x, y, z in ((3000, 3000, -17700), (5000, 3000, -17700), (5000, 5000, -17700), (3000, 5000, -17700),
                                                   (3000, 3000, -19700), (5000, 3000, -19500))]
        lines += ["f 442 443 444 445", "f 442 446 447 443"]
        mesh = self.folder / "table.obj"
        mesh.write_text("\n".join(lines))
        folder, report = self.run_import(mesh, "--crs", "plane", "--origin", "50,-5", "--units", "mm", "--positive", "up",
                                         "--points-cell", 0.25, "--spacing", 0.25)
        # The plane's middle, 5.125 m of the 41 cells, is at the origin: these are (2, 2), (4, 4) and (8, 1.5).
        reported = terrain("sample", folder, "--points", "-", text="-3.125,-3.125\n-1.125,-1.125\n2.875,-3.625\n").stdout.splitlines()[1:]
        heights = [float(line.split(",")[2]) for line in reported]
        for height, known in zip(heights, (-19.8, -17.7, -19.2)):
            self.assertAlmostEqual(height, known, delta=2e-3)
        # What lies under the table is lost: 2 m at its west, where its middle of cells begins, 0.125 m from the edge.
        self.assertAlmostEqual(report["sources"][0]["points"]["widest_spread_m"], 2.0 - 0.0125, delta=1e-3)
        self.assertEqual(report["sources"][0]["unit"], "mm")
        (self.folder / "none.obj").write_text("v 0 0 -3\n")
        self.refused(self.folder / "none.obj", "--crs", "plane", "--origin", "50,-5", causes=["none.obj", "holds no triangle"])

    # What is refused

    def test_rasters_without_a_seabed_are_refused(self):
        self.refused(self.made("one.tif", shape=(1, 1)), causes=["one.tif: is only 1 x 1 cells", "at least 2 x 2"])
        self.refused(self.made("empty.tif", values=lambda x, y: np.full_like(x, -9999), nodata=-9999),
                     causes=["empty.tif: holds no valid cell"])
        self.refused(self.made("nan.tif", values=lambda x, y: np.full_like(x, np.nan)), causes=["holds no valid cell"])
        self.refused(self.folder / "missing.tif", causes=["missing.tif", "cannot be read as a raster"])
        self.refused(self.made("land.tif", values=lambda x, y: 30 - sea(x, y)), "--positive", "up",
                     causes=["mostly above the water", "--datum-shift"])

    def test_maps_that_lead_nowhere_are_refused(self):
        self.refused(self.made("none.tif", epsg=None), causes=["no coordinate reference system", "--crs EPSG:"])
        self.refused(self.made("some.tif"), "--crs", "EPSG:99999999", causes=["EPSG:99999999 is unknown"])
        self.refused(self.made("half.tif", (-40.0, 0.1, 0, 40.0, 0, -0.1), epsg=4326, values=lambda x, y: 0 * x - 20),
                     causes=["at most 200 km x 200 km are allowed", "--bounds"])
        self.refused(self.made("some.tif"), "--bounds=0,0,1,1", causes=["no cells in the bounds"])
        self.refused(self.made("some.tif"), "--spacing", 0.01, causes=["at most 1e+08 are allowed", "--spacing"])
        self.refused(self.made("some.tif"), "--origin", "42.25,-7", causes=["from the scenario's origin"])

    def test_values_that_are_no_heights_are_refused(self):
        self.refused(self.made("both.tif", values=lambda x, y: -sea(x, y)), causes=["--positive down for depths, up for"])
        self.refused(self.made("mm.tif", values=lambda x, y: 1000 * sea(x, y), kind=gdal.GDT_Int32),
                     causes=["holds heights from -2", "--units cm", "between -11500 and 9000 m"])
        self.refused(self.made("cm.tif", values=lambda x, y: 100 * (0.03 * (x - CORNER[0]) - 40)),
                     causes=["steeper than 60 deg", "--units cm"])
        self.refused(self.made("lost.tif", (math.nan, 4.0, 0, CORNER[1], 0, -4.0)), causes=["geotransform", "number which is none"])

        def ran_over(x, y):  # 32 m and deeper in mm, past -32,768, which it steps over
            return (-32000 - 7 * np.floor((x - CORNER[0]) / 4).astype(np.int64) + 2**15) % 2**16 - 2**15
        self.refused(self.made("ran_over.tif", kind=gdal.GDT_Int16, values=ran_over), "--units", "mm",
                     causes=["jumps from", "16 bits that ran over"])
        self.refused(self.made("some.tif"), "--units", "ells", causes=["unit ells is unknown", "fathom"])

    def test_wrong_words_are_refused(self):
        some = self.made("some.tif")
        for words, cause in ((["--fill", "magic/3"], "idw/METRES"), (["--sediment-rule", "3:mud"], "CLASS:CONDITION"),
                             (["--band-start", "1"], "none, auto"), (["--origin", "91,0"], "LATITUDE,LONGITUDE"),
                             (["--sediment-backscatter", some], "--thresholds"), (["--class-map", "7"], "VALUE=CLASS")):
            self.refused(some, *words, causes=[cause])
        self.refused(f"{some}?colour=red", causes=["colour=red is not known", "datum-shift"])
        points = self.folder / "points.xyz"
        points.write_text("1 2 -3\n2 4 -3\n4 1 deep\n5 5 -3\n")
        self.refused(points, "--crs", "EPSG:32619", causes=["points.xyz:3: is no point"])

    # Folders

    def test_a_set_of_another_version_is_left_alone(self):
        folder, _ = self.run_import(self.made())
        manifest = folder / "tileset.yaml"
        manifest.write_text(manifest.read_text().replace("tiles/1", "tiles/9"))
        self.assertIn("is tiles/9; this program reads tiles/1", terrain("info", folder).stderr)
        (folder / "source.yaml").unlink()
        self.refused_in(folder, "was not built here")

    def refused_in(self, folder, cause, *words):
        before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
        done = terrain("import", self.folder / "sea.tif", "--out", folder, *words)
        self.assertEqual(done.returncode, 2)
        self.assertIn(cause, done.stderr)
        self.assertEqual(before, {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()})

    def test_another_import_is_left_alone_even_if_only_the_bytes_of_the_file_changed(self):
        folder, _ = self.run_import(self.made())
        self.refused_in(folder, "another seabed or other options", "--datum-shift", "1")
        self.made(values=lambda x, y: sea(x, y) - 0.5)
        self.refused_in(folder, "another seabed or other options")

    def test_a_killed_import_goes_on_and_ends_as_if_it_had_not_been(self):
        path = self.made()
        words = ["import", path, "--spacing", 0.5, "--cells", 64]
        whole, broken = self.folder / "whole", self.folder / "broken"
        self.assertEqual(terrain(*words, "--out", whole).returncode, 0)
        process = subprocess.Popen([BIN / "ensonify-terrain", *map(str, words), "--out", broken, "--threads", "1"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while not list(broken.glob("tiles/*.yaml")) and time.monotonic() < deadline:
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.assertFalse((broken / "tileset.yaml").exists(), "the import was over before it was killed")
        self.assertEqual(terrain("info", broken).returncode, 2)  # no half set passes for a whole one
        kept = {tile: tile.stat().st_mtime_ns for tile in broken.glob("tiles/*.yaml")}
        self.assertEqual(terrain(*words, "--out", broken).returncode, 0)
        for tile, time_ns in kept.items():
            self.assertEqual(tile.stat().st_mtime_ns, time_ns, "a finished tile was made again")
        self.assertFalse(list(broken.rglob("*.part")))
        for file in whole.rglob("*.*"):
            self.assertEqual(file.read_bytes(), (broken / file.relative_to(whole)).read_bytes(), file)

    def test_a_full_disk_is_said_and_the_import_goes_on(self):
        mount = self.folder / "small"
        mount.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=200k", "none", mount], capture_output=True).returncode != 0:
            self.skipTest("no right to mount a small tmpfs")
        try:
            words = ["import", self.made(), "--spacing", 1, "--cells", 128, "--out", mount / "tiles"]
            done = terrain(*words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("cannot be written", done.stderr)
            self.assertFalse((mount / "tiles/tileset.yaml").exists())
            subprocess.run(["mount", "-o", "remount,size=50m", mount], check=True)
            self.assertEqual(terrain(*words).returncode, 0)
            self.assertEqual(terrain("verify", mount / "tiles").returncode, 0)
        finally:
            subprocess.run(["umount", mount], check=True)

    @unittest.skipUnless(shutil.which("gdal_create"), "gdal_create is absent")
    def test_the_example_of_the_page(self):
        page = (SOURCE / "docs/manual/import.md").read_text(encoding="utf-8")
        (box,) = re.findall(r"^```sh\n(.*?)^```", page, re.M | re.S)
        done = subprocess.run(["bash", "-e", "-c", box], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(json.loads((self.folder / "bay/import.json").read_text())["lowest_m"], -80 * 0.3048, places=3)

    def test_gdal_and_qgis_open_the_set(self):
        folder, report = self.run_import(self.made())
        if shutil.which("gdalinfo") is None:
            self.skipTest("gdalinfo is absent")
        reported = json.loads(subprocess.run(["gdalinfo", "-json", folder / "seabed.vrt"], capture_output=True, check=True).stdout)
        self.assertIn("Transverse Mercator", reported["coordinateSystem"]["wkt"].replace("_", " "))
        self.assertEqual(reported["bands"][0]["unit"], "m")
        place = terrain("sample", folder, "--points", "-", text="10,20\n").stdout.splitlines()[1].split(",")
        value = subprocess.run(["gdallocationinfo", "-valonly", "-geoloc", folder / "seabed.vrt", "10", "20"],
                               capture_output=True, text=True, check=True).stdout
        # the nearest post, within half a cell of a bottom that slopes by 0.03
        self.assertAlmostEqual(float(value), float(place[2]), delta=0.03 * report["spacing_m"])


if __name__ == "__main__":
    unittest.main()
