"""What cannot be run, measured or assumed is refused before time starts: exit code 2, with the place, the cause and what is
allowed. One row a case."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ.get("ENSONIFY_BUILD", "build/dev")).resolve() / "bin"

# Ground falls to the east by 5 degrees from a shore at x = -114 m; 10 m deep at the origin.
WORLD = """
ensonify: scenario/1
site: { latitude_deg: 53, longitude_deg: -9 }
seed: 1
water: { sound_speed_mps: 1500 }
vertical: { tide: { constant_m: 0 } }
current: { profile: [{ depth_m: 0, speed_mps: 0.2, heading_deg: 90 }] }
seabed:
  kind: layers
  post_spacing_m: 1
  size_m: [600, 600]
  layers: { ground: { plane: { depth_m: 10, slope_deg: 5, downhill_heading_deg: 90 } } }
vehicles:
  boat: { VEHICLE }
mission: { MISSION }
"""
VEHICLE = "turning_radius_m: 10, fastest_mps: 8, mountings: { sounder: { actual: { position_m: [0, 0, 0.5] } } }"
LINE = "runlines: [{ from_m: [0, -50], to_m: [0, 50] }]"
LAUNCH = """
ensonify: launch/1
scenario: world.yaml
duration_s: 20
processes:
  boat:    { run: vehicle }
  nav:     { run: navigation, config: { NAVIGATION } }
  pilot:   { run: autopilot }
  pager:   { run: terrain_pager }
  sounder: { run: echosounder, config: { HEAD } }
"""

# What is wrong; where it is written; the file that is blamed; the cause and what is allowed, as they are reported.
MISSIONS = [
    ("a line through land", "runlines: [{ from_m: [-200, 0], to_m: [100, 0] }]", r"world.yaml:\d+:\d+: mission runline 1.*is land.*allowed is water"),
    ("a run-in over land", "run_in_m: 150, runlines: [{ from_m: [0, 0], to_m: [100, 0] }]", r"mission run-in: \(-150.0, 0.0\) m is land"),
    ("a line below the seabed", f"depth_m: 15, {LINE}", "the vehicle would reach 15.5 m deep and the seabed is 10.0 m below the lowest water; allowed"),
    ("an obstacle floor above the water", f"least_altitude_m: 200, {LINE}",
     "least_altitude_m 200.0 leaves no depth to dive to, the deepest place is at 10.0 m; allowed is less"),
    ("a depth above the water", f"depth_m: -2, {LINE}", r"mission.depth_m: -2 is outside \[0, 11000\]"),
    ("a step below the seabed", "steps: [{ depth_m: 30 }, { line: [[0, 0], [0, 50]] }]", "30.5 m deep.*allowed"),
    ("a wait below the seabed", "steps: [{ line: [[0, -5], [0, 5]] }, { depth_m: 30 }, { wait_s: 100 }]", "world.yaml:.* mission: at .*reach 30.5 m deep"),
    ("a next round below the seabed", "repeat: 2, steps: [{ line: [[0, 0], [0, 50]] }, { depth_m: 30 }, { line: [[300, 0], [300, 50]] }]",
     "mission runline 1: at .* reach 30.5 m deep"),
    ("a run-in from beyond land and terrain", "run_in_m: 250, runlines: [{ from_m: [-90, 0], to_m: [0, 0] }]",
     r"mission run-in: its end \(-340.0, 0.0\) m is outside the terrain; allowed is east"),
    ("a line that leaves the terrain", "runlines: [{ from_m: [0, 0], to_m: [0, 900] }]", "outside the terrain; allowed is east"),
    ("a station on land", "steps: [{ line: [[0, 0], [0, 50]] }, { keep: [-200, 0], for_s: 5 }]", "is land.*allowed is water"),
    ("an orbit over land", "steps: [{ line: [[0, 0], [0, 50]] }, { orbit: [-90, 0], radius_m: 50 }]", "mission orbit: at .* reach 0.5 m deep"),
    ("an adaptive survey beyond the terrain", "adaptive: { centre_m: [0, 0], length_m: 60, width_m: 3000, first_line_m: 10 }",
     "outside the terrain"),
    ("an altitude above the water", f"altitude_m: 50, {LINE}", "altitude_m 50.0 leaves no depth to dive to, the deepest place is at 10.0 m"),
    ("a time below no floor", f"abort: {{ too_low_s: 2 }}, {LINE}", "mission.abort: too_low_s needs an obstacle floor; allowed"),
    ("an adaptive survey half on land", "adaptive: { centre_m: [0, 0], length_m: 60, width_m: 500, first_line_m: 490 }",
     r"world.yaml:\d+:\d+: mission adaptive: .* is land"),
    ("a line of no length", "runlines: [{ from_m: [5, 5], to_m: [5, 5] }]", "to_m: is less than 1 m from from_m"),
    ("a step's line of no length", "steps: [{ line: [[5, 5], [5, 5]] }]", "line: place 2 is less than 1 m from the one before"),
    ("a lawnmower of no length", "lawnmower: { length_m: 0, spacing_m: 10, count: 2 }", r"length_m: 0 is outside \[1,"),
    ("no plan", "speed_mps: 2", "has no plan; give one of runlines"),
    ("a speed beyond the vehicle's", f"speed_mps: 9, {LINE}", "speed_mps is above what boat can do"),
    ("a speed below nothing", f"speed_mps: -1, {LINE}", r"speed_mps: -1 is outside \[0.01, 30\]"),
    ("an orbit tighter than the vehicle turns", "steps: [{ line: [[0, 0], [0, 50]] }, { orbit: [50, 0], radius_m: 4 }]",
     "step 2: radius_m 4 is less than boat can turn .* allowed: 10 m or more"),
    ("a line whose bend is tighter than the vehicle turns", "steps: [{ line: [[0, 0], [0, 50], [1, 49], [50, 50]] }]",
     "step 1: line: the 1 m from place 2 to 3 are too short for the bends of boat, which turns on a radius of 10 m at 2 m/s; allowed"),
    ("a line that turns back on itself", "steps: [{ line: [[0, 0], [0, 50], [0, 1]] }]", "step 1: line: the 50 m from place 1 to 2 are too short"),
    ("latitude and longitude swapped", "positions: geodetic, steps: [{ line: [[-9, 53], [-9, 53.001]] }]",
     "allowed: 100 km; are latitude and longitude swapped?"),
    ("another zone", "positions: geodetic, steps: [{ line: [[53, -3], [53.001, -3]] }]", "is 401 km from the site's origin; allowed: 100 km"),
    ("projected metres", "runlines: [{ from_m: [500000, 5900000], to_m: [500000, 5901000] }]", r"is outside \[-100000, 100000\]"),
    ("no number", "runlines: [{ from_m: [.nan, 0], to_m: [0, 50] }]", "from_m"),
    ("a sonar that nobody carries", "steps: [{ set_sonar: bow, range_m: 20 }, { line: [[0, 0], [0, 50]] }]",
     'no vehicle carries a head named "bow"; allowed: sounder'),
    ("no speed", f"speed_mps: .nan, {LINE}", "speed_mps: .nan"),
    ("no abort", f"abort: {{ after_s: .nan }}, {LINE}", "abort.after_s: .nan"),
    ("no width", "adaptive: { centre_m: [0, 0], length_m: 60, width_m: .nan, first_line_m: 10 }", "width_m: .nan"),
]
VEHICLES = [
    ("no turning", "turning_radius_m: -5", r"turning_radius_m: -5 is outside \[0.1, 1000\]"),
    ("no turning radius", "turning_radius_m: .nan", "turning_radius_m: .nan"),
    ("a turn of kilometres", "turn_rate_dps: 0.01", "boat: turn_rate_dps makes it turn on a radius of 11459 m at 2 m/s; allowed: 1000 m or less"),
    ("no brakes", "deceleration_mps2: 0", "deceleration_mps2: 0 is outside"),
    ("no sea", "disturbance: { heave: { oscillation_m: .nan } }", "oscillation_m: .nan"),
    ("no start", "start: { position_m: [0, .inf, 0] }", "position_m"),
    ("a start above the water", "start: { position_m: [0, 0, 5] }", "vehicles.boat.start.position_m: up 5 is above the water"),
    ("a start in the seabed", "start: { position_m: [0, 0, -30] }", "vehicles.boat.start: .* reach 30.0 m deep and the seabed is 10.0 m below"),
    ("a head in the seabed", "mountings: { sounder: { actual: { position_m: [0, 0, 50] } } }", "mission runline 1: .* reach 50.0 m deep and the seabed is 10.0 m below"),
    ("a start on land", "start: { position_m: [-200, 0, 0] }", "vehicles.boat.start: .* is land"),
    ("a start outside the terrain", "start: { position_m: [0, 4000, 0] }", "vehicles.boat.start: .* is outside the terrain"),
    ("a head above the water", "mountings: { sounder: { actual: { position_m: [0, 0, -30] } } }",
     "boat.mountings.sounder: the head is 25 m above the water where boat is deepest; allowed: a position_m farther down"),
    ("no mounting", "mountings: { sounder: { actual: { position_m: [0, 0, .nan] } } }", "position_m"),
    ("an altitude for what floats", "floats: {}", "altitude_m .*need a vehicle that dives; boat floats"),
]
WORLDS = [
    ("no current", "speed_mps: 0.2, heading", "speed_mps: .nan, heading", "speed_mps: .nan"),
    ("a current that sets the boat off its line", "speed_mps: 0.2, heading", "speed_mps: 2.1, heading",
     "step 1: line: boat makes no way from place 1 to 2 at 2 m/s through the water: the current there is 2.1 m/s; allowed"),
    ("a current against the boat", "speed_mps: 0.2, heading_deg: 90", "speed_mps: 2, heading_deg: 180", "boat makes no way from place 1 to 2"),
    ("no tide", "constant_m: 0", "constant_m: .nan", "constant_m: .nan"),
    ("a tide that ends before the survey", "constant_m: 0", "gauge: tide.csv", "the tide's last reading is 10 s after the start.*allowed: a file that covers"),
    ("a tide of one reading a month", "constant_m: 0", "gauge: month.csv", r"month.csv:2:1: is 1200.0 h after the reading before; allowed .*: 6 h"),
    ("a tide of the thirteenth month", "constant_m: 0", "gauge: thirteenth.csv", "thirteenth.csv:1:1: does not begin with a UTC time"),
    ("a tide of no number", "constant_m: 0", "gauge: nan.csv", r"nan.csv:1:1: has no height in \[-20, 20\] m"),
    ("a geoid that is not there", "constant_m: 0 }", "constant_m: 0 }, geoid_above_ellipsoid_grid: no.asc",
     r"world.yaml:6:\d+: vertical.geoid_above_ellipsoid_grid: .*no.asc.*no such file or folder"),
    ("a geoid of another place", "constant_m: 0 }", "constant_m: 0 }, geoid_above_ellipsoid_grid: small.asc",
     r"world.yaml:6:\d+: vertical.geoid_above_ellipsoid_grid: does not cover \(-300.0, 300.0\) m; allowed: a grid over the whole seabed"),
    ("a datum with a hole", "constant_m: 0 }", "constant_m: 0 }, datum_above_geoid_grid: holed.asc",
     r"holed.asc:8:1: lacks a value in \[-200, 200\] m"),
    ("no origin", "latitude_deg: 53", "latitude_deg: .nan", "latitude_deg: .nan"),
    ("no sound", "sound_speed_mps: 1500", "sound_speed_mps: .nan", "sound_speed_mps: .nan"),
    ("no ground", "depth_m: 10, slope", "depth_m: .nan, slope", "depth_m: .nan"),
]
GROUND = "layers: { ground"  # meshes stand before it
WALL = "sheet_pile_wall: { from_m: [50, 5], to_m: [90, 5] }"
# The water's constant level, what is run, and why not; a plain None is run. At x = -90 m the ground is 2.1 m below chart datum.
LEVELS = [
    ("a depth that low water does not leave", -5, f"depth_m: 8, {LINE}", "reach 8.5 m deep and the seabed is 5.0 m below the lowest water"),
    ("a bank that has dried", -6, "runlines: [{ from_m: [-90, 0], to_m: [-60, 0] }]", "is land, -2.1 m above chart datum with the lowest water at -6.0 m"),
    ("a bank under high water", 6, "runlines: [{ from_m: [-130, 0], to_m: [-60, 0] }]", None),
    ("a depth under high water", 6, f"depth_m: 12, {LINE}", None),
]
MESHES = [
    ("a mesh of nothing", "{}", "world.yaml:.* seabed.meshes.quay: needs one of file, bars, sheet_pile_wall"),
    ("a mesh that is not there", "{ file: no.obj }", "world.yaml:.* seabed.meshes.quay.file: .*no such file or folder"),
    ("a mesh of numbers that are none", "{ file: holed.obj }", "holed.obj:1:1: .*is no vertex; allowed: v and three numbers"),
    ("a mesh with a corner nowhere", "{ file: loose.obj }", 'loose.obj:4:1: .*"7" is no vertex; allowed'),
    ("a mesh of no triangles", "{ file: points.obj }", "points.obj:1:1: .*holds no triangle; allowed are meshes in OBJ, PLY, STL, OFF or glTF"),
    ("a mesh that ends early", "{ file: cut.ply }", "cut.ply:1:1: .*ends within its 3 elements vertex"),
    ("a mesh of another kind", "{ file: tide.csv }", "tide.csv:1:1: .*holds no triangle"),
    ("a mesh of a map's coordinates", "{ file: far.obj }",
     "world.yaml: seabed.meshes.quay: lies at east 500000 .*outside the terrain; allowed is east -300 to 300"),
    ("a mesh below infinity", "{ file: far.obj, position_m: [0, 0, .inf] }", "world.yaml:.* seabed.meshes.quay.position_m"),
    ("a mesh of no unit", "{ file: far.obj, unit_m: 0 }", r"world.yaml:.*unit_m: 0 is outside \[1e-06, 1000\]"),
    ("a mesh of no class", "{ file: far.obj, sediment: 5 }", "world.yaml:.* seabed.meshes.quay.sediment: is not a class of seabed.sediments"),
    ("a name twice", f"{{ {WALL} }}, quay: {{ {WALL} }}", "world.yaml:.* seabed.meshes.quay: is given twice"),
    ("a wall of no length", "{ sheet_pile_wall: { from_m: [5, 5], to_m: [5, 5] } }", "world.yaml:.*to_m: is less than a pile's width from from_m"),
    ("a wall of no height", "{ sheet_pile_wall: { from_m: [5, 5], to_m: [9, 5], foot_depth_m: 3, top_height_m: -3 } }",
     "world.yaml:.*top_height_m: is not above the foot"),
    ("a wall of no number", "{ sheet_pile_wall: { from_m: [.nan, 5], to_m: [9, 5] } }", "world.yaml:.*from_m.*: .nan is not finite"),
    ("a wall of too many piles", "{ sheet_pile_wall: { from_m: [-9000, 5], to_m: [9000, 5], row_m: 0.1 } }",
     "world.yaml:.*row_m: makes 9060302 vertices; allowed: 500000"),
    ("a wall across a line", "{ sheet_pile_wall: { from_m: [-9, 20], to_m: [9, 20] } }",
     r"world.yaml:\d+:\d+: mission runline 1: at \(0.0, (19.[789]|20.[0-3])\) m, 0.5 m deep, it runs into the mesh quay; allowed is a way beside it"),
]
SENSORS = [
    ("a rate below nothing", "NAVIGATION", "gnss: { rate_hz: -5 }", r"gnss.rate_hz: -5 is outside \[0.01, 1000\]"),
    ("a rate of no number", "NAVIGATION", "imu: { rate_hz: .nan }", "imu.rate_hz: .nan"),
    ("a grade that nobody makes", "NAVIGATION", "imu: { grade: quantum }", '"quantum" is no grade .* allowed: fog, mems'),
    ("an IMU quicker than the poses", "NAVIGATION", "imu: { rate_hz: 200 }", "nav.pose: needs at least 200 Hz, and boat/pose has 100 Hz"),
    ("an outage that ends before it begins", "NAVIGATION", "gnss: { outages_s: [10, 5] }", "outages_s: is not"),
    ("an error of no number", "NAVIGATION", "depth: { errors: { white_m: .nan } }", "white_m: .nan"),
    ("an attitude rate of nothing", "NAVIGATION", "attitude_rate_hz: 0", "attitude_rate_hz: 0 is outside"),
    ("an altimeter that hears nothing", "NAVIGATION", "altimeter: { shortest_m: 50, longest_m: 10 }", "altimeter.shortest_m: 50 is not below longest_m 10"),
    ("a velocity log that hears nothing", "NAVIGATION", "imu: { grade: fog }, velocity_log: { grade: standard, shortest_m: 90, longest_m: 10 }",
     "velocity_log.shortest_m: 90 is not below longest_m 10"),
    ("a head that pings backwards", "HEAD", "ping_rate_hz: -1", "ping_rate_hz: -1 is outside"),
    ("a head of no range", "HEAD", "range_m: .nan", "range_m: .nan"),
]


class Refused(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ensonify-refused-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "holed.obj").write_text("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        (self.folder / "far.obj").write_text("v 500000 5900000 -9\nv 500001 5900000 -9\nv 500000 5900001 -9\nf 1 2 3\n")
        (self.folder / "loose.obj").write_text("v 0 0 -9\nv 1 0 -9\nv 0 1 -9\nf 1 2 7\n")
        (self.folder / "points.obj").write_text("v 0 0 -9\nv 1 0 -9\nv 0 1 -9\nf 1 1 2\n")
        (self.folder / "cut.ply").write_text("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                                             "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                                             "end_header\n0 0 -9\n1 0")
        (self.folder / "nan.csv").write_text("2025-06-01T00:00:00Z,nan\n2025-06-02T00:00:00Z,1.1\n")
        (self.folder / "month.csv").write_text("2025-05-01T00:00:00Z,1\n2025-06-20T00:00:00Z,5\n")
        (self.folder / "thirteenth.csv").write_text("2025-13-01T00:00:00Z,1\n2026-06-20T00:00:00Z,5\n")
        head = "ncols 2\nnrows 2\nxllcorner -300\nyllcorner -300\ncellsize {}\nNODATA_value -9999\n"
        (self.folder / "small.asc").write_text(head.format(250) + "46 46\n46 46\n")  # 500 of 600 m
        (self.folder / "holed.asc").write_text(head.format(300) + "46 46\n46 -9999\n")
        (self.folder / "tide.csv").write_text("2025-06-01T00:00:00Z,1.0\n2025-06-01T00:00:10Z,1.1\n")  # 10 s of 25 and more

    def write(self, mission=LINE, vehicle=VEHICLE, world=("", ""), launch=LAUNCH):
        text = WORLD.replace("MISSION", mission).replace("VEHICLE", vehicle)
        self.assertIn(world[0], text)
        (self.folder / "world.yaml").write_text(text.replace(*world) if world[0] else text)
        (self.folder / "launch.yaml").write_text(launch.replace("NAVIGATION", "altimeter: {}").replace("HEAD", ""))
        return self.folder / "launch.yaml"

    def check(self, launch):
        done = subprocess.run([BIN / "ensonify", "check", launch], capture_output=True, text=True, timeout=60)
        return done.returncode, done.stdout + done.stderr

    def expect(self, launch, blamed, cause):
        code, reported = self.check(launch)
        self.assertEqual(code, 2, reported)
        lines = [line for line in reported.splitlines() if re.search(cause, line)]
        self.assertTrue(lines, reported)
        self.assertIn(blamed, lines[0])  # the file, and where it is known the line

    def test_without_a_fault_nothing_is_refused(self):
        self.assertEqual(self.check(self.write())[0], 0)

    def test_missions(self):
        for what, mission, cause in MISSIONS:
            with self.subTest(what):
                self.expect(self.write(mission=mission), "world.yaml", cause)

    def test_without_an_altimeter_no_line_is_run_above_the_bottom(self):
        launch = LAUNCH.replace("NAVIGATION", "")
        for mission in (f"altitude_m: 4, {LINE}", f"depth_m: 5, least_altitude_m: 2, abort: {{ too_low_s: 2 }}, {LINE}",
                        "steps: [{ altitude_m: 4 }, { line: [[0, 0], [0, 50]] }]"):
            with self.subTest(mission):
                self.expect(self.write(mission=mission, launch=launch), "launch.yaml:", "pilot.altitude: no publisher offers altitude/1; allowed")
                self.assertEqual(self.check(self.write(mission=mission))[0], 0)
        self.run_refused(self.write(mission=f"altitude_m: 4, {LINE}", launch=launch), "pilot.altitude: no publisher offers altitude/1")

    def test_vehicles(self):
        for what, vehicle, cause in VEHICLES:
            with self.subTest(what):
                mission = f"depth_m: 5, {LINE}" if "head above" in what else f"altitude_m: 4, {LINE}"
                self.expect(self.write(vehicle=vehicle, mission=mission), "world.yaml", cause)

    def test_a_step_at_a_speed_at_which_the_vehicle_hardly_turns(self):
        steps = "speed_mps: 0.5, steps: [{ speed_mps: 8 }, { line: [[0, -50], [0, 50]] }, { line: [[20, 50], [20, -50]] }]"
        self.expect(self.write(mission=steps, vehicle="turn_rate_dps: 0.2, fastest_mps: 8, mountings: { sounder: { actual: {} } }"), "world.yaml",
                    "step 1: at speed_mps 8 turn_rate_dps makes boat turn on a radius of 2292 m; allowed: 1000 m or less")

    def test_worlds(self):
        for what, good, wrong, cause in WORLDS:
            with self.subTest(what):
                self.expect(self.write(world=(good, wrong)), "" if re.match(r"\w+.(csv|asc):", cause) else "world.yaml", cause)

    def test_missions_at_other_levels_of_the_water(self):
        for what, level_m, mission, cause in LEVELS:
            with self.subTest(what):
                launch = self.write(mission=mission, world=("constant_m: 0", f"constant_m: {level_m}"))
                if cause:
                    self.expect(launch, "world.yaml", cause)
                else:
                    code, reported = self.check(launch)
                    self.assertEqual(code, 0, reported)

    def test_meshes(self):
        for what, mesh, cause in MESHES:
            with self.subTest(what):
                self.expect(self.write(world=(GROUND, f"meshes: {{ quay: {mesh} }}\n  {GROUND}")), "", cause)
        self.assertEqual(self.check(self.write(world=(GROUND, f"meshes: {{ quay: {{ {WALL} }} }}\n  {GROUND}")))[0], 0)

    def test_sensors(self):
        for what, place, config, cause in SENSORS:
            with self.subTest(what):
                self.expect(self.write(launch=LAUNCH.replace(place, config)), "launch.yaml:", cause)

    def run_refused(self, launch, cause):
        done = subprocess.run([BIN / "ensonify", "run", launch, "--out", self.folder / "out"], capture_output=True, text=True,
                              timeout=60, env=dict(os.environ, XDG_RUNTIME_DIR=str(self.folder)))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, cause)
        log = self.folder / "out/log/clock.log"
        self.assertNotIn(" go ", log.read_text() if log.exists() else "")

    def test_a_mission_that_is_given_up_fails_the_run_unless_that_is_asked_for(self):
        mission = f"abort: {{ after_s: 3 }}, {LINE}"
        for config, code in (("", 1), ("given_up: end", 0)):
            launch = self.write(mission=mission, launch=LAUNCH.replace("{ run: autopilot }", f"{{ run: autopilot, config: {{ {config} }} }}"))
            done = subprocess.run([BIN / "ensonify", "run", launch, "--free", "--out", self.folder / "out"], capture_output=True,
                                  text=True, timeout=60, env=dict(os.environ, XDG_RUNTIME_DIR=str(self.folder)))
            self.assertEqual(done.returncode, code, done.stderr)
            if code:
                self.assertRegex(done.stderr, 'ensonify run: pilot did not reach its goal .*gave_up why="it took longer than abort.after_s"')

    def test_a_run_is_refused_before_time_starts(self):
        self.run_refused(self.write(mission=MISSIONS[0][1]), MISSIONS[0][2])

    def test_a_mission_is_held_against_the_seabed_without_a_pager_too(self):
        launch = "".join(line for line in LAUNCH.replace("NAVIGATION", "").splitlines(True) if "terrain_pager" not in line and "echosounder" not in line)
        for what, mission, cause in MISSIONS[:3]:
            with self.subTest(what):
                self.expect(self.write(mission=mission, launch=launch), "world.yaml", cause)
        self.run_refused(self.write(mission=MISSIONS[0][1], launch=launch), MISSIONS[0][2])
        beyond = "runlines: [{ from_m: [0, 0], to_m: [0, 900] }]"  # where nobody needs tiles the terrain may end
        self.assertEqual(self.check(self.write(mission=beyond, launch=launch))[0], 0)


if __name__ == "__main__":
    unittest.main()
