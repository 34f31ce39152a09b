#!/usr/bin/python3
"""Writes harbour_round.csv: two minutes of a launch on a curved way in a small sea, as a logger would keep them.

    scenarios/tracks/make.py [FOLDER]

By formulas, so that a test knows what is true. Places are near the origin of launch/follow.yaml.
"""
import math
import pathlib
import sys

SECONDS, EVERY_S = 120, 0.5
LATITUDE_DEG, LONGITUDE_DEG = 54.4, 10.3
METRES_PER_DEGREE = 111_320.0  # of latitude, roughly: the file's own degrees are the truth


def place_m(t):
    """East and north: a bend to port, then to starboard, at about 2.5 m/s."""
    return 60 * math.sin(2 * math.pi * t / 120), -150 + 2.5 * t


def row(t):
    east, north = place_m(t)
    before, after = place_m(t - 0.01), place_m(t + 0.01)
    heading = math.degrees(math.atan2(after[0] - before[0], after[1] - before[1])) % 360
    roll, pitch, heave = 3.0 * math.sin(2 * math.pi * t / 6.5), 1.2 * math.sin(2 * math.pi * t / 5.2 + 1), 0.25 * math.sin(2 * math.pi * t / 5.8)
    latitude = LATITUDE_DEG + north / METRES_PER_DEGREE
    longitude = LONGITUDE_DEG + east / (METRES_PER_DEGREE * math.cos(math.radians(LATITUDE_DEG)))
    return f"{t:.1f},{latitude:.8f},{longitude:.8f},{heading:.2f},{roll:.3f},{pitch:.3f},{heave:.3f}"


def text():
    lines = ["# a launch in a small sea; made by make.py", "time_s,latitude_deg,longitude_deg,heading_deg,roll_deg,pitch_deg,heave_m"]
    return "\n".join(lines + [row(i * EVERY_S) for i in range(int(SECONDS / EVERY_S) + 1)]) + "\n"


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    (folder / "harbour_round.csv").write_text(text())
