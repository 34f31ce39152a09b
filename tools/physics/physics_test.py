"""`ensonify physics` as scripts see it: published values, sweeps, JSON, wrong input.   physics_test.py PROGRAM"""
import csv
import io
import json
import math
import subprocess
import sys
import tempfile


def physics(*words):
    done = subprocess.run([sys.argv[1], *words], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def rows(*words):
    code, out, error = physics(*words)
    assert code == 0, (words, error)
    return list(csv.DictReader(io.StringIO(out)))


def value(column, *words):
    found = rows(*words)
    assert len(found) == 1, (words, found)
    return float(found[0][column])


def near(found, wanted, margin):
    assert abs(found - wanted) <= margin, (found, wanted, margin)


def refused(cause, *words):
    code, out, error = physics(*words)
    assert code == 2 and out == "" and cause in error, (words, code, out, error)


# The frame: header, order of sweeps, JSON.
speed = ["sound-speed", "--law", "mackenzie"]
table = rows(*speed, "--temperature-degc", "2:10:4", "--depth-m", "100:0:-100")
assert list(table[0]) == ["law", "temperature_degc", "salinity_psu", "depth_m", "latitude_deg", "pressure_bar",
                          "in_range", "sound_speed_mps"], list(table[0])
assert [(row["temperature_degc"], row["depth_m"]) for row in table] == [
    ("2", "100"), ("2", "0"), ("6", "100"), ("6", "0"), ("10", "100"), ("10", "0")], table
code, out, _ = physics(*speed, "--depth-m", "0:1000:1000", "--json")
objects = json.loads(out)
assert code == 0 and [row["depth_m"] for row in objects] == [0, 1000] and objects[0]["law"] == "mackenzie", out

refused("--depth-m: 13000 is outside [0, 12000]", "sound-speed", "--depth-m", "13000")
refused("--depth-m: 'deep' is neither a number nor a sweep from:to:step", "sound-speed", "--depth-m", "deep")
refused("--law: 'wilson' is none of mackenzie, unesco, del-grosso", "sound-speed", "--law", "wilson")
refused("the sweeps make 1.002e+06 rows; at most 1000000 are allowed",
        "sound-speed", "--depth-m", "0:1000:1", "--salinity-psu", "0:50:0.05")
refused("--speed", "sound-speed", "--speed", "3")
refused("", "sound")
assert physics("sound-speed", "--help")[0] == 0 and "--latitude-deg" in physics("sound-speed", "--help")[1]

# Published values.
near(value("sound_speed_mps", *speed, "--temperature-degc", "25", "--depth-m", "1000"), 1550.744, 5e-4)
near(value("sound_speed_mps", "sound-speed", "--law", "unesco", "--temperature-degc", "0"), 1449.139, 5e-4)
near(value("sound_speed_mps", "sound-speed", "--law", "del-grosso", "--temperature-degc", "0"), 1449.083, 5e-4)
near(value("pressure_bar", "sound-speed", "--depth-m", "7321.45", "--latitude-deg", "30"), 750.0004, 5e-4)
for law, wanted, margin in (("francois-garrison", 73.1, 0.05), ("ainslie-mccolm", 73.1, 7.3)):
    near(value("absorption_db_per_km", "absorption", "--law", law, "--frequency-hz", "300e3"), wanted, margin)
near(value("absorption_db_per_km", "absorption", "--frequency-hz", "200e3", "--temperature-degc", "0"), 40.6, 0.05)
near(value("level_m", "tide", "--t-h", "0"), 4.0, 1e-9)
near(value("level_m", "tide", "--t-h", "6.2103", "--s2-m", "0"), 0.5, 1e-6)   # half a period of M2
near(value("heave_m", "disturbance", "--preset", "auv", "--t-s", "5"),
     value("heave_m", "disturbance", "--preset", "auv", "--t-s", "5", "--seed", "1"), 1e-12)
near(value("thermal_db", "noise", "--frequency-hz", "100e3"), 25, 1e-9)
near(value("wind_db", "noise", "--frequency-hz", "1e3", "--wind-speed-mps", "2.5722"), 51.0, 1e-3)
near(value("received_db", "noise", "--wind-speed-mps", "0", "--bandwidth-hz", "1e4", "--directivity-index-db", "30"),
     44.54, 0.01)
code, out, _ = physics("noise", "--wind-speed-mps", "0", "--json")
assert json.loads(out)[0]["wind_db"] is None, out

# Image sources: R1 = 20 m straight down, R2 = 68 m by way of bottom and surface; the two orders add as pressures.
below = ["multipath", "--ground-range-m", "0", "--head-depth-m", "4", "--altitude-m", "20", "--source-level-db", "200",
         "--bottom-loss-db", "12"]
near(value("direct_db", *below), 200 - 40 - 40 * math.log10(20) - 0.05 * 40, 1e-3)
near(value("second_bottom_s", *below), 88 / 1500, 1e-7)
near(value("second_bottom_db", *below), 200 - 40 - 20 * math.log10(20 * 68) - 0.05 * 88 - 12 + 6.0206, 0.01)
near(value("surface_s", *below), 8 / 1500, 1e-9)
code, out, _ = physics(*below, "--surface-rms-m", "1", "--json")   # waves leave nothing
assert json.loads(out)[0]["second_bottom_db"] is None and json.loads(out)[0]["second_bottom_s"] is None, out

sidescan = [float(row["level_db"]) for row in rows(
    "level", "sidescan", "--range-m", "50:100:50", "--altitude-m", "10", "--absorption-db-per-km", "100")]
near(sidescan[0], 77.06, 0.01)
near(sidescan[1], 51.95, 0.01)
near(value("level_db", "level", "multibeam", "--source-level-db", "220", "--beam-angle-deg", "60"), 107.68, 0.1)
near(value("gain_db", "gain", "--range-m", "10", "--absorption-dbpm", "0.05"), 30 + 2 * 0.05 * 10, 1e-5)
near(value("envelope", "pulse", "--time-s", "50e-6"), 1, 1e-9)
near(value("angular_db", "flattening", "--range-m", "40"), 20 * math.log10(20 / 40), 1e-6)  # Lambert's law at 60 degrees
near(value("level_db", "level", "target", "--range-m", "100", "--absorption-db-per-km", "0", "--bubble-loss-db", "2",
           "--patterns-db", "-3"), 210 - 80 - 4 - 20 - 3, 1e-9)
near(value("level_db", "level", "volume", "--range-m", "100", "--absorption-db-per-km", "0", "--solid-angle-sr", "1"),
     210 - 40 - 70 - 11.249, 1e-3)
refused("A subcommand is required", "level")
refused("--beam-angle-deg: 90 is outside [-85, 85]", "level", "multibeam", "--beam-angle-deg", "45:90:5")

# Patterns: 128 elements half a wavelength apart are 64 wavelengths long, near-field range 20.48 m.
widths = rows("pattern", "--angle-deg", "0")[0]
near(float(widths["upper_edge_deg"]) - float(widths["lower_edge_deg"]), 50.76 / 64, 2e-4)
near(value("pattern_db", "pattern"), 0.0, 1e-9)
near(value("pattern_db", "pattern", "--range-m", "20.48"), -0.239, 1e-3)
near(value("pattern_db", "pattern", "--range-m", "20.48", "--focus-m", "20.48"), 0.0, 1e-9)
lobes = rows("pattern", "--shading", "dolph-chebyshev", "--side-lobe-db", "40", "--angle-deg", "2:80:0.01")
near(max(float(row["pattern_db"]) for row in lobes), -40.0, 0.02)
near(value("upper_edge_deg", "pattern", "--aperture", "piston"), 0.5 * 58.96 * 0.005 / 0.1, 1e-3)
near(value("pattern_db", "pattern", "--aperture", "sector", "--angle-deg", "20"), -6.02, 0.05)
code, _, error = physics("pattern", "--shading", "taylor", "--side-lobe-db", "60")
assert code == 2 and "nbar 4 of a Taylor shading" in error, error

# Stabilisation: the edge of a rolling head stays within its bound, and follows the roll when not stabilised.
held = rows("stabilisation", "--sensor-error-deg", "0.1", "--time-s", "0:6:0.01")
assert all(abs(float(row["error_deg"])) <= float(row["bound_deg"]) + 1e-9 for row in held), held
assert max(abs(float(row["error_deg"])) for row in held) > 0.99 * float(held[0]["bound_deg"])
near(value("error_deg", "stabilisation", "--roll-stabilised", "no", "--time-s", "1.45"), -10.0, 1e-9)

sand = ["backscatter", "--sediment", "medium-sand", "--sound-speed-mps", "1528"]
for degrees, at_100_khz in ((10, -29.8), (20, -24.2), (40, -21.7), (60, -19.5), (80, -12.2), (90, -9.7)):  # TR 9407, table 3
    row = rows(*sand, "--frequency-hz", "100e3", "--grazing-deg", str(degrees))[0]
    near(float(row["total_db"]), at_100_khz, 0.1)
    near(float(row["table_db"]), float(row["total_db"]), 0.1)
mud = ["backscatter", "--sediment", "grain-size", "--grain-size-phi", "6"]
near(value("total_db", *mud, "--grazing-deg", "45"), -28.3, 0.1)
near(value("w2_cm4", *mud), 0.0005175, 1e-7)
near(value("rho", "backscatter", "--sediment", "parameters", "--density-ratio", "2"), 2, 0)
assert rows(*sand, "--frequency-hz", "200e3")[0]["in_range"] == "0"
code, out, _ = physics(*sand, "--grazing-deg", "30", "--json")
assert code == 0 and json.loads(out)[0]["kirchhoff_db"] is None, out  # no Kirchhoff part below 40 degrees
refused("--grain-size-phi: 10 is outside [-1, 9]", "backscatter", "--grain-size-phi", "10")

near(value("sphere_target_strength_db", "material", "--sphere-radius-m", "2"), 0, 1e-9)
near(value("reflection", "material", "--material", "metal"), 0.935, 1e-3)
near(value("total_db", "surface", "--wind-speed-mps", "8", "--frequency-hz", "70e3", "--grazing-deg", "30"), -24.5, 0.1)
near(value("rms_height_m", "surface", "--wind-speed-mps", "10"), 2.13 / 4, 2e-3)

# Refracted paths: straight in uniform water, a closed form in a gradient, a path that never arrives, a file that is none.
uniform = ["ray", "--water", "linear", "--gradient-per-s", "0", "--target-depth-m", "50"]
near(value("path_length_m", *uniform), 100, 1e-6)
near(value("tube_m2", *uniform), 1e4, 1e-3)
near(value("turning_depth_m", "ray", "--water", "linear", "--gradient-per-s", "0.1", "--depression-deg", "10",
           "--target-depth-m", "0"), 15000 * (1 / 0.984807753 - 1), 1e-3)
near(value("horizontal_m", "ray", "--until", "point", "--distance-m", "150"), 150, 1e-5)
assert rows("ray", "--depression-deg", "-30")[0]["horizontal_m"] == "nan"  # it goes up for good
assert physics("ray", "--profile", "/none")[0] == 2, "a profile that is not there"
with tempfile.NamedTemporaryFile("w", suffix=".csv") as cast:
    cast.write("depth_m,speed\n0,1500\n100,1500\n")
    cast.flush()
    row = rows("ray", "--profile", cast.name, "--speed-column", "speed", "--target-depth-m", "50")[0]
    assert row["water"] == "profile", row
    near(float(row["path_length_m"]), 100, 1e-6)
    refused(f"{cast.name}:1:1: needs columns for depth_m and sound_speed_mps", "ray", "--profile", cast.name)
    cast.write("end of cast\n")
    cast.flush()
    refused(f"{cast.name}:4:1: depth_m: is \"end of cast\"", "ray", "--profile", cast.name, "--speed-column", "speed")
row = rows("ray", "--profile", "scenarios/casts/mixed.csv", "--target-depth-m", "10")[0]  # by name, from anywhere
assert float(row["path_length_m"]) > 10, row
refused("--water profile: needs --profile and a file", "ray", "--water", "profile")

# Generated seabed: one post alone is the same as in a sweep; a layer's own mistakes are the user's.
relief = ["relief", "--layer", "outcrops", "--north-m", "12.8"]
row_of_posts = [row["elevation_m"] for row in rows(*relief, "--east-m", "-30:30:0.5")]
assert len(set(row_of_posts)) > 60 and row_of_posts[37] == rows(*relief, "--east-m", "-11.5")[0]["elevation_m"], row_of_posts
near(value("elevation_m", "relief", "--rms-m", "0"), 0, 0)
code, _, error = physics("relief", "--inner-scale-m", "60")
assert code == 2 and "relief spectrum: inner_scale_m is 60.000000, allowed: 0 or more, below outer_scale_m" in error, error

print("ensonify physics answers as documented")
