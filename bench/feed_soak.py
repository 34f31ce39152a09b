"""What nav_feed bears, outside CI's time: a day of a log at full speed, and a flood of sentences in real time.

  feed_soak.py --build build/dev [day] [flood] [pace]      all, where none is named; exit code 1 when something does not hold

day: 24 h of GGA, HDT and PASHR at 1 Hz from a file, across midnight and a leap second: each fix once, a second after the one
before. The file is played by its own times, so it covers decoding and time bases, not sockets. --hours makes it shorter about midnight.
pace: 10 minutes (--minutes) of 10 fixes and 100 motion sentences a second in real time: no late event, no sample lost.
flood: 100,000 sentences a second in datagrams of 60 kB beside fixes at 1 Hz, for 15 s: no late event, bounded memory.
"""
import argparse
import json
import math
import pathlib
import socket
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "clients/python"), str(ROOT / "tests/support")]
import ensonify  # noqa: E402
from feed_bench import measure  # noqa: E402
from nmea import free_port, sentence  # noqa: E402

DAY_S = 86_400
LAUNCH = """
ensonify: launch/1
scenario: {root}/scenarios/tideway/scenario.yaml
clock: {{ rate: {rate} }}
duration_s: {seconds}
processes:
  boat: {{ run: nav_feed, config: {{ pose_rate_hz: {hz}, sources: {{ ship: {{ {way} }} }} }} }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: [boat/fix, boat/health] }} }}
"""


def time_of(second):
    """hhmmss.sss of a second from 23:59:60 on, which is 0."""
    if second == 0:
        return "235960.000"
    of_day = (second - (1 if second > 0 else 0)) % DAY_S
    return f"{of_day // 3600:02}{of_day // 60 % 60:02}{of_day % 60:02}.000"


def block(second):
    """A boat in a circle of 200 m at 2 m/s."""
    turn = second / 100.0
    north, east = 200 * math.sin(turn), 200 * math.cos(turn)
    latitude, longitude = 48.6 + north / 111_200, 3.9 - east / 73_700
    gga = f"GPGGA,{time_of(second)},{int(latitude)}{latitude % 1 * 60:010.7f},N,{int(longitude):03}{longitude % 1 * 60:010.7f},W,4,12,0.8,1.0,M,50.1,M,,"
    heading = math.degrees(-turn) % 360
    pashr = f"PASHR,{time_of(second)},{heading:.2f},T,{5 * math.sin(turn * 60):+.2f},+0.50,+0.10,0.02,0.02,0.05,2,1"
    return sentence(gga) + sentence(f"HEHDT,{heading:.2f},T") + sentence(pashr)


def start(build, folder, **values):
    launch = folder / "launch.yaml"
    launch.write_text(LAUNCH.format(root=ROOT, **values))
    return subprocess.Popen([str(build / "bin/ensonify"), "run", str(launch), "--out", str(folder / "out")], stdout=subprocess.DEVNULL)


def results(folder):
    with ensonify.Record(folder / "out/run.mcap") as record:
        stamps = [fix.stamp_ns for _, _, fix in record.messages("boat/fix")]
        health = [message for _, _, message in record.messages("boat/health")]
    return stamps, {counter.name: counter.count for counter in health[-1].counters}


def day(build, folder, hours):
    seconds = round(3600 * hours)
    log = folder / "day.nmea"
    with open(log, "w", encoding="ascii", newline="") as file:
        for second in range(seconds + 20):
            file.write(block(second - seconds // 2))
    began = time.monotonic()
    code = start(build, folder, rate="free", seconds=seconds, hz=10, way=f"file: {log}").wait(timeout=1800)
    wall_s = time.monotonic() - began
    stamps, counts = results(folder)
    steps = {b - a for a, b in zip(stamps, stamps[1:])}
    print(f"day: exit {code}, {seconds / wall_s:.0f} x real time, {len(stamps)} fixes, steps of {sorted(steps)} ns, {json.dumps(counts)}")
    wrong = [name for name in ("fixes_double", "fixes_at_another_time", "fixes_beyond_the_fastest_speed", "sentences_late", "time_jumps",
                               "place_jumps", "motions_at_another_time") if name in counts]
    return code == 0 and steps == {10**9} and len(stamps) >= seconds - 3 and seconds / wall_s >= 100 and not wrong


def memory_mb(program):
    """The most that a program of this machine holds, resident."""
    for entry in pathlib.Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and program in (entry / "cmdline").read_text():
                status = (entry / "status").read_text()
                return int(status.split("VmHWM:")[1].split()[0]) / 1024
        except (OSError, IndexError):
            continue
    return 0.0


def flood(build, folder):
    seconds, port = 15, free_port()
    run = start(build, folder, rate=1, seconds=seconds, hz=100, way=f"udp: {port}")
    line = sentence("HEHDT,90.00,T").encode()
    datagram = line * (60_000 // len(line))
    sent, most_mb, second, began = 0, 0.0, 0, time.monotonic()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
        while run.poll() is None:
            at_s = time.monotonic() - began
            if at_s >= second:
                out.sendto(block(second).encode(), ("127.0.0.1", port))
                most_mb = max(most_mb, memory_mb("ensonify-nav_feed"))
                second += 1
            if sent < 100_000 * at_s:
                out.sendto(datagram, ("127.0.0.1", port))
                sent += len(datagram) // len(line)
            else:
                time.sleep(0.001)
    stamps, counts = results(folder)
    clock = json.loads((folder / "out/clock.json").read_text())
    late = {one["name"]: one["late_events"] for one in clock["participants"]}
    print(f"flood: exit {run.returncode}, {sent / second:.0f} sentences/s sent, {most_mb:.0f} MB at most, late events {late}, {len(stamps)} fixes, {json.dumps(counts)}")
    return run.returncode == 0 and sent / second > 90_000 and most_mb < 100 and late["boat"] == 0 and len(stamps) >= seconds - 6


def pace(build, minutes):
    found = measure(build, round(60 * minutes), timed=True)
    most_ms = 1e3 * abs(found["place_s"]).max()
    print(f"pace: {minutes:g} min, {found['late']} late events, places off their time by {most_ms:.3f} ms at most, {json.dumps(found['counts'])}")
    wrong = [name for name in found["counts"] if name not in ("fixes_taken", "motions_taken", "sentences_before_the_first_fix", "poses_guessed")]
    return found["late"] == 0 and most_ms <= 1 and not wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/dev")
    parser.add_argument("--hours", type=float, default=24, help="length of the day, half of it before midnight (default 24)")
    parser.add_argument("--minutes", type=float, default=10, help="length of the pace (default 10)")
    parser.add_argument("what", nargs="*", choices=["day", "flood", "pace", []], help="day, flood, pace")
    options = parser.parse_args()
    build, good = options.build.resolve(), True
    checks = {"day": lambda folder: day(build, folder, options.hours), "flood": lambda folder: flood(build, folder),
              "pace": lambda folder: pace(build, options.minutes)}
    for name, check in checks.items():
        if options.what and name not in options.what:
            continue
        with tempfile.TemporaryDirectory() as folder:
            good = check(pathlib.Path(folder)) and good
    sys.exit(0 if good else 1)


main()
