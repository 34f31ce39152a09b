"""Lines that survey software wrote become a mission that a scenario runs: each format through `ensonify plan import` and
`ensonify check`. The same lines on land are refused there, so that the check did examine them."""
import pathlib
import subprocess
import tempfile
import unittest

from guidance_refused_test import BIN, LAUNCH, VEHICLE, WORLD

# The line runs from 50 m south to 50 m north of the site's origin (53 N, 9 W, the central meridian of UTM zone 29); the
# land begins 114 m west of it.
SOUTH, NORTH = 52.99955, 53.00045
UTM_NORTHING_M = 5872269.5  # of 53 N
FORMATS = {
    "lnw": lambda west_m, lon: f"LNS 1\nLIN 2\nPTS {500000 - west_m} {UTM_NORTHING_M - 50}\n"
                               f"PTS {500000 - west_m} {UTM_NORTHING_M + 50}\nLNN 1 main\nEOL\n",
    "csv": lambda west_m, lon: f'"line","name","east_m","north_m"\n1,"A, ""main""",{-west_m},-50\n1,A,{-west_m},50\n',
    "geojson": lambda west_m, lon: '{"type": "Feature", "properties": {"name": "A\\nrepeat: 5"}, "geometry": {"type": "LineString", '
                                   f'"coordinates": [[{lon}, {SOUTH}], [{lon}, {NORTH}]]}}}}',
    "kml": lambda west_m, lon: "<kml><Placemark><name>A\nrepeat: 7</name><LineString><coordinates>"
                               f"{lon},{SOUTH} {lon},{NORTH},0</coordinates></LineString></Placemark></kml>",
    "gpx": lambda west_m, lon: f'<gpx version="1.1"><rte><name>A # B: [</name><rtept lat="{SOUTH}" lon="{lon}"/>'
                               f'<rtept lat="{NORTH}" lon="{lon}"/></rte></gpx>',
}
CRS = {"lnw": ["--crs", "EPSG:32629"]}


class Imported(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ensonify-imported-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "world.yaml").write_text(WORLD.replace("MISSION", "file: mission.yaml").replace("VEHICLE", VEHICLE))
        (self.folder / "launch.yaml").write_text(LAUNCH.replace("NAVIGATION", "").replace("HEAD", ""))

    def checked(self, ending, west_m):
        lines = self.folder / f"lines.{ending}"
        lines.write_text(FORMATS[ending](west_m, -9 - west_m / 67100))  # metres in a degree of longitude, within 1 %
        done = subprocess.run([BIN / "ensonify", "plan", "import", lines, "--speed", "2", *CRS.get(ending, [])],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        (self.folder / "mission.yaml").write_text(done.stdout)
        done = subprocess.run([BIN / "ensonify", "check", self.folder / "launch.yaml"], capture_output=True, text=True,
                              timeout=60)
        return done.returncode, done.stdout + done.stderr

    def test_each_format_makes_a_mission_that_a_scenario_takes(self):
        for ending in FORMATS:
            with self.subTest(ending):
                self.assertEqual(self.checked(ending, 0)[0], 0, self.checked(ending, 0)[1])

    def test_each_formats_lines_are_held_against_the_seabed(self):
        for ending in FORMATS:
            with self.subTest(ending):
                code, reported = self.checked(ending, 200)
                self.assertEqual(code, 2, reported)
                self.assertRegex(reported, r"mission.yaml:\d+.*-(199|200)\.\d.*is land")


if __name__ == "__main__":
    unittest.main()
