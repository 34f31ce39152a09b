"""What we write, pynmea2 and gpsd's decoder read with the same values.   others_test.py WRITE_SENTENCES"""
import datetime
import json
import subprocess
import sys

import pynmea2

TIME = datetime.time(12, 34, 56, 789000)


def near(found, wanted, within):
    assert abs(float(found) - wanted) <= within, (found, wanted)


def check_sentences(lines):
    seen = {}
    for line in lines:
        if line.startswith("!"):
            continue
        m = pynmea2.parse(line, check=True)
        seen[line.split(",")[0][1:] + (line.split(",")[1] if "PSXN" in line else "")] = m
    assert set(seen) == {"GPGGA", "GPGST", "GPZDA", "GPVTG", "HEHDT", "TIROT", "SDDPT", "SDDBT", "PASHR", "PSXN20", "PSXN23"}, seen
    gga = seen["GPGGA"]
    assert gga.timestamp.replace(tzinfo=None) == TIME and gga.gps_qual == 4
    near(gga.latitude, 54.25, 1e-9)
    near(gga.longitude, -3.125, 1e-9)
    near(gga.altitude, 12.345, 1e-9)
    near(gga.geo_sep, 50.125, 1e-9)
    near(gga.horizontal_dil, 0.8, 1e-9)
    near(seen["GPGST"].std_dev_latitude, 0.012, 1e-9)
    near(seen["GPGST"].std_dev_altitude, 0.021, 1e-9)
    zda = seen["GPZDA"]
    assert (zda.day, zda.month, zda.year) == (1, 6, 2025) and zda.timestamp.replace(tzinfo=None) == TIME
    near(seen["GPVTG"].true_track, 217.3, 1e-9)
    near(seen["GPVTG"].spd_over_grnd_kts, 8.4, 1e-3)
    near(seen["HEHDT"].heading, 218.26, 1e-9)
    near(seen["TIROT"].rate_of_turn, -10.0, 1e-9)
    near(seen["SDDPT"].depth, 23.45, 1e-9)
    near(seen["SDDPT"].offset, 1.2, 1e-9)
    near(seen["SDDBT"].depth_meters, 23.45, 1e-9)
    near(seen["SDDBT"].depth_feet, 23.45 / 0.3048, 0.051)
    pashr = seen["PASHR"]
    assert isinstance(pashr, pynmea2.types.proprietary.ash.ASHRATT) and pashr.timestamp.replace(tzinfo=None) == TIME
    for found, wanted in ((pashr.true_heading, 218.26), (pashr.roll, -1.25), (pashr.pitch, 2.5), (pashr.heave, -0.58),
                          (pashr.roll_accuracy, 0.02), (pashr.heading_accuracy, 0.05)):
        near(found, wanted, 1e-9)
    psxn = seen["PSXN23"]
    for found, wanted in ((psxn.head, 218.26), (psxn.roll, -1.25), (psxn.pitch, 2.5), (psxn.heave, 0.58)):  # it counts down
        near(found, wanted, 1e-9)


def check_reports(lines):
    """Unscaled (-u): scaled, gpsd 3.22 loses the sign of the turn."""
    reports = [line for line in lines if line.startswith("!")]
    assert len(reports) == 2
    decoded = subprocess.run(["gpsdecode", "-u"], input="\n".join(reports) + "\n", capture_output=True, text=True, check=True, timeout=30).stdout
    found = [json.loads(line) for line in decoded.splitlines() if line.startswith("{")]
    assert len(found) == 2, decoded
    wanted = {"type": 1, "mmsi": 970000001, "status": 0, "turn": -15, "speed": 84, "accuracy": True, "lon": -3.125 * 600000, "lat": 54.25 * 600000,
              "course": 2173, "heading": 218, "second": 56}
    for report in found:
        assert {key: report[key] for key in wanted} == wanted, report


def main():
    written = subprocess.run([sys.argv[1]], capture_output=True, check=True).stdout.decode()
    lines = written.split("\r\n")
    assert lines.pop() == "" and all("\n" not in line for line in lines)
    check_sentences(lines)
    check_reports(lines)
    print("read by others:", len(lines))


main()
