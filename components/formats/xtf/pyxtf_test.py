"""pyxtf reads what we write as it is meant, and of a genuine file what we read.   pyxtf_test.py BIN_FOLDER WRITE_SAMPLE_FORMATS"""
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import warnings

import numpy
import pyxtf

GENUINE = pathlib.Path(os.environ.get("ENSONIFY_SHARED", "")) / "data" / "sonar" / "scotsman-iver2.xtf"
HEADER_BYTES = 1024
RAW_SERIAL, MULTI_TRANSMIT = 6, 27  # pyxtf fails at the first and has no reader for the other


def without(data, types):
    """The file without packets of these types."""
    kept, offset = bytearray(data[:HEADER_BYTES]), HEADER_BYTES
    while offset < len(data):
        size = struct.unpack_from("<I", data, offset + 10)[0]
        if data[offset + 2] not in types:
            kept += data[offset:offset + size]
        offset += size
    return bytes(kept)


def info(file):
    done = subprocess.run([os.path.join(sys.argv[1], "ensonify-info"), "--json", file], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)[0]


warnings.simplefilter("error")  # what pyxtf finds odd is a fault
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[2], folder], check=True)
    sample = pathlib.Path(folder) / "sample.xtf"
    sample.write_bytes(without(sample.read_bytes(), (RAW_SERIAL, MULTI_TRANSMIT)))
    header, packets = pyxtf.xtf_read(str(sample))
    kinds = pyxtf.XTFHeaderType

    assert (header.SonarName.decode(), header.NumberOfSonarChannels, header.NumberOfBathymetryChannels) == ("Sample sidescan", 2, 1)
    assert [header.ChanInfo[i].Frequency for i in range(3)] == [600, 600, 300]
    assert {kind: len(found) for kind, found in packets.items()} == {
        kinds.notes: 1, kinds.pos_raw_navigation: 3, kinds.attitude: 3, kinds.sonar: 3, kinds.q_multibeam: 3}
    port, starboard = packets[kinds.sonar][1].data
    expected = numpy.array([3 if i < 20 else 2000 - 10 * i for i in range(50)])
    assert (starboard == expected).all() and (port == expected[::-1]).all()
    ping = packets[kinds.q_multibeam][2]
    assert (ping.PingNumber, ping.Year, ping.HSeconds, ping.SensorYcoordinate) == (2, 2026, 10, 54.000002)
    assert [(beam.Id, beam.BeamAngle, beam.TwoWayTravelTime) for beam in ping.data] == [(i, -40.0 + 20 * i, 0.02) for i in range(5)]
    attitude = packets[kinds.attitude][1]
    assert (attitude.Pitch, attitude.Roll, attitude.Millisecond) == (1, -2, 50)
    assert packets[kinds.pos_raw_navigation][1].Microsecond == 500  # tenths of a millisecond, whatever the name
    assert packets[kinds.notes][0].NotesText.decode() == "Made up for tests"

if not GENUINE.exists():
    print("skipped: no data/sonar/scotsman-iver2.xtf in the folder that ENSONIFY_SHARED names")
    sys.exit(77)
_, packets = pyxtf.xtf_read(str(GENUINE))
pings = packets[pyxtf.XTFHeaderType.sonar]
ours = info(GENUINE)
placed = [ping for ping in pings if ping.SensorXcoordinate != 0]
assert ours["pings"]["sidescan"]["count"] == len(pings) and ours["unusable_positions"] == len(pings) - len(placed)
assert abs(ours["extent_deg"]["north"] - max(ping.SensorYcoordinate for ping in placed)) < 1e-9
assert abs(ours["extent_deg"]["west"] - min(ping.SensorXcoordinate for ping in placed)) < 1e-9
assert abs(ours["depth_m"]["high"] - max(ping.SensorPrimaryAltitude for ping in pings)) < 1e-6
print("pyxtf reads the same")
