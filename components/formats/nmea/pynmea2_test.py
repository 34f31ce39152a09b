"""pynmea2 reads in a sentence what we read, in genuine logs and in examples of every kind.   pynmea2_test.py PRINT_NAVIGATION"""
import datetime
import os
import pathlib
import subprocess
import sys

import pynmea2

DATA = pathlib.Path(os.environ.get("ENSONIFY_SHARED", "")) / "data"
LOGS = [DATA / "nav" / f"nbp1406_{name}.nmea" for name in ("seapath330", "gyro", "multibeam_centre_depth")] + [DATA / "records/hemisphere.nmea"]
EXAMPLES = [
    "GPGGA,172814.0,3723.46587704,N,12202.26957864,W,2,6,1.2,18.893,M,-25.669,M,2.0,0031",
    "GPRMC,225446,A,4916.45,N,12311.12,W,000.5,054.7,191194,020.3,E", "GPVTG,054.7,T,034.4,M,005.5,N,010.2,K",
    "HEHDT,274.07,T", "TIROT,-35.6,A", "GPZDA,201530.00,04,07,2002,00,00",
    "GPGST,172814.0,0.006,0.023,0.020,273.6,0.023,0.020,0.031", "SDDPT,2.4,-0.5,", "SDDBT,7.8,f,2.4,M,1.3,F",
    "VDVBW,12.3,0.05,A,12.4,-0.1,A", "GPDTM,W72,,0.0,N,0.0,E,0.0,W84",
    "PASHR,163029.000,158.09,T,-0.30,+0.31,+0.01,0.029,0.029,0.059,1,1",
]


def sentence(body):
    total = 0
    for byte in body.encode():
        total ^= byte
    return f"${body}*{total:02X}"


def seconds(time):
    return time.hour * 3600 + time.minute * 60 + time.second + time.microsecond * 1e-6


def days(date):
    return (date - datetime.date(1970, 1, 1)).days


def number(text):
    return None if text in (None, "") else float(text)


def by_pynmea2(line):
    """The kind and the values of a line as our program prints them; None for what it does not print."""
    m = pynmea2.parse(line, check=True)
    kind = getattr(m, "sentence_type", "")
    if kind == "GGA":
        return ("GGA", [0]) if m.gps_qual == 0 else (
            "GGA", [m.gps_qual, seconds(m.timestamp), m.latitude, m.longitude, number(m.altitude), number(m.geo_sep)])
    if kind == "RMC":
        return "RMC", [seconds(m.timestamp), m.latitude, m.longitude, number(m.spd_over_grnd), number(m.true_course), days(m.datestamp)]
    if kind == "VTG":
        return None if m.spd_over_grnd_kts is None else ("VTG", [number(m.true_track), number(m.spd_over_grnd_kts)])
    if kind == "HDT":
        return None if number(m.heading) is None else ("HDT", [number(m.heading)])
    if kind == "ROT":
        return "ROT", [number(m.rate_of_turn)]
    if kind == "ZDA":
        return "ZDA", [seconds(m.timestamp), days(datetime.date(m.year, m.month, m.day))]
    if kind == "GST":
        return "GST", [seconds(m.timestamp), *map(number, (m.std_dev_latitude, m.std_dev_longitude, m.std_dev_altitude))]
    if kind == "DPT":
        return "DPT", [number(m.depth), number(m.offset)]
    if kind == "DBT":
        return "DPT", [number(m.depth_meters), None]
    if kind == "VBW":
        return "VBW", [number(m.lon_water_spd), number(m.trans_water_spd), number(m.lon_grnd_spd), number(m.trans_grnd_spd)]
    if kind == "DTM":
        return "DTM", m.datum
    if isinstance(m, pynmea2.types.proprietary.ash.ASHRATT):
        return "motion", [seconds(m.timestamp), *map(number, (m.true_heading, m.roll, m.pitch, m.heave))]
    if isinstance(m, pynmea2.types.proprietary.sxn.SXN23):
        heave = number(m.heave)  # which it counts down
        return "motion", [None, *map(number, (m.head, m.roll, m.pitch)), None if heave is None else -heave]
    return None


def main():
    lines = [sentence(body) for body in EXAMPLES]
    for log in LOGS:
        if log.exists():
            lines += [text[text.index("$"):] for text in log.read_text().splitlines() if "$" in text]
        else:
            print(f"skipped: {log} is not there")
    ours = subprocess.run([sys.argv[1]], input="\n".join(lines), capture_output=True, text=True, check=True).stdout.splitlines()
    compared, at = {}, 0
    for line in lines:
        theirs = by_pynmea2(line)
        if theirs is None:
            continue
        kind, values = theirs
        got, at = ours[at].split(), at + 1
        assert got[0] == kind, (line, got)
        if kind == "DTM":
            assert got[1] == values, (line, got)
        else:
            assert len(got) - 1 == len(values), (line, got, values)
            for text, value in zip(got[1:], values):
                assert (text == "-") == (value is None), (line, got, values)
                assert value is None or abs(float(text) - value) < 2e-6, (line, got, values)
        compared[kind] = compared.get(kind, 0) + 1
    assert at == len(ours), ours[at:at + 3]
    assert set(compared) == {"GGA", "RMC", "VTG", "HDT", "ROT", "ZDA", "GST", "DPT", "VBW", "DTM", "motion"}, compared
    print("the same values:", compared)


main()
