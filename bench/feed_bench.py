"""When the poses of a fed vehicle are: 10 fixes and 100 headings a second by UDP over the loopback interface, at rate 1."""
import json
import math
import pathlib
import random
import socket
import subprocess
import sys
import tempfile
import threading
import time

import numpy as np
from harness import ROOT, row

sys.path[:0] = [str(ROOT / "clients/python"), str(ROOT / "tests/support")]
import ensonify  # noqa: E402
from nmea import free_port, sentence  # noqa: E402

SITE_DEG = (48.6, -3.9)  # of scenarios/tideway
SPEED_MPS, TURN_DEGPS = 10.0, 30.0
LATENCY_S = 0.2  # stated of fixes without a time
PAUSE_S = 0.01  # between headings; ten to a fix
MOST_JITTER_S = 0.008  # of what has its own time: it is sent that much late
SETTLED_S = 8.0  # from the run's start: three fixes and the vehicle's delay


def metres_a_degree(latitude_deg):
    """North, on the ellipsoid."""
    w2 = 1 - 0.00669437999014 * math.sin(math.radians(latitude_deg)) ** 2
    return math.radians(1) * 6378137.0 * (1 - 0.00669437999014) / w2 ** 1.5


def place(t_s):
    """The fields of a place that goes north from the site."""
    north_m = SPEED_MPS * t_s
    middle_deg = SITE_DEG[0] + 0.5 * north_m / metres_a_degree(SITE_DEG[0])
    latitude, longitude = SITE_DEG[0] + north_m / metres_a_degree(middle_deg), -SITE_DEG[1]
    return f"{int(latitude)}{latitude % 1 * 60:010.7f},N,{int(longitude):03}{longitude % 1 * 60:010.7f},W,4,12,0.8,1.0,M,50.1,M,,"


def clock(t_s):
    ms = round(1000 * (t_s + 43_200))
    return f"{ms // 3_600_000:02}{ms // 60_000 % 60:02}{ms // 1000 % 60:02}.{ms % 1000:03}"


def send(ports, timed, stop):
    """What has a time of its own is of that time, and comes late by chance; what has none is of the moment when it is sent."""
    gnss, motion = ports
    chance, began, count = random.Random(23), time.monotonic(), 0
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as out:
        while not stop.is_set():
            late_s = MOST_JITTER_S * chance.random() if timed else 0.0
            time.sleep(max(0.0, began + PAUSE_S * count + late_s - time.monotonic()))
            t_s = PAUSE_S * count if timed else time.monotonic() - began
            if count % 10 == 0:
                out.sendto(sentence(f"GPGGA,{clock(t_s)},{place(t_s if timed else t_s - LATENCY_S)}").encode(), ("127.0.0.1", gnss))
            t_s = PAUSE_S * count if timed else time.monotonic() - began
            heading = f"{TURN_DEGPS * t_s % 360:.3f}"
            body = f"PASHR,{clock(t_s)},{heading},T,+1.00,+0.50,+0.10,0.02,0.02,0.05,2,1" if timed else f"HEHDT,{heading},T"
            out.sendto(sentence(body).encode(), ("127.0.0.1", motion))
            count += 1


def heading_deg(pose):
    w, x, y, z = pose.enu_from_body
    return math.degrees(math.atan2(1 - 2 * (y * y + z * z), 2 * (x * y + w * z)))


def off_turn_s(pose, t_s):
    """By how much a heading is behind the turn of that time."""
    return ((TURN_DEGPS * t_s - heading_deg(pose) + 180) % 360 - 180) / TURN_DEGPS


def measure(build, seconds, timed):
    """Seconds by which poses, or fixes, are off the times that they are of, and the counts of what went wrong."""
    ports, stop = (free_port(), free_port()), threading.Event()
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as out:
        arguments = {"seconds": seconds, "place_port": ports[0], "motion_port": ports[1], "time_scale": "utc" if timed else "none",
                     "latency_s": 0 if timed else LATENCY_S}
        words = [word for name, value in arguments.items() for word in ("--arg", f"{name}={value}")]
        sender = threading.Thread(target=send, args=(ports, timed, stop))
        sender.start()
        try:
            done = subprocess.run([str(build / "bin/ensonify-run"), str(ROOT / "bench/launch/feed.yaml"), "--quiet", "--out", out, *words],
                                  capture_output=True, text=True)
        finally:
            stop.set()
            sender.join()
        if done.returncode != 0:
            raise RuntimeError(f"feed: exit {done.returncode}: {done.stderr}")
        folder = pathlib.Path(out)
        with ensonify.Record(folder / "feed.mcap") as record:
            poses = [m for _, _, m in record.messages("boat/pose") if m.stamp_ns * 1e-9 > SETTLED_S]
            fixes = [m for _, _, m in record.messages("boat/fix") if m.stamp_ns * 1e-9 > SETTLED_S]
            health = [m for _, _, m in record.messages("boat/health")]
        late = {one["name"]: one["late_events"] for one in json.loads((folder / "clock.json").read_text())["participants"]}
    counts = {counter.name: counter.count for counter in health[-1].counters}
    if len(fixes) < 0.9 * 10 * (seconds - SETTLED_S) or len(poses) < 0.9 * 100 * (seconds - SETTLED_S):
        raise RuntimeError(f"feed: {len(fixes)} fixes and {len(poses)} poses in {seconds} s, {counts}")
    placed = poses if timed else fixes
    place_s = np.array([one.stamp_ns * 1e-9 - one.position_enu_m[1] / SPEED_MPS for one in placed])
    middle_s = np.median(place_s)  # the run's time less the sender's, unknown from outside
    turn_s = np.array([off_turn_s(pose, pose.stamp_ns * 1e-9 - middle_s) for pose in poses])
    # Without a time the place is LATENCY_S older, and the feed says so: the same middle holds for the headings.
    return {"place_s": place_s - middle_s, "turn_s": turn_s, "late": late["boat"], "counts": counts}


def bench_feed(b):
    seconds = 20 if b.quick else 60
    own, none = measure(b.build, seconds, True), measure(b.build, seconds, False)

    def most_ms(values):
        return 1e3 * np.abs(values).max()

    def p99_ms(values):
        return 1e3 * np.quantile(np.abs(values), 0.99)

    rows = []
    for what, values in (("place", own["place_s"]), ("heading", own["turn_s"])):
        rows.append(row(f"feed with times of its own: {what} of a pose off its time, at most", most_ms(values), "ms", target="<= 1", ok=most_ms(values) <= 1))
    for what, values in (("place of a fix", none["place_s"]), ("heading of a pose", none["turn_s"])):
        rows.append(row(f"feed without times: {what} off its arrival, p99", p99_ms(values), "ms", target="<= 5", ok=p99_ms(values) <= 5))
        rows.append(row(f"feed without times: {what}, standard deviation", 1e3 * values.std(), "ms"))
    rows.append(row("feed: late events", own["late"] + none["late"], "", target="0", ok=own["late"] + none["late"] == 0))
    return rows
