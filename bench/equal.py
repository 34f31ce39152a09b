#!/usr/bin/env python3
"""Compares a head's pings at a quality with those at `quality: reference`: the same run twice, ping by ping the same place.

    bench/equal.py HEAD [--quality 1] [--pings 100] [--set KEY=VALUE ...] [--scenario FILE] [--build build/release] [--json FILE]

HEAD is a component: multibeam, sidescan, forward_looking, scanning or echosounder. Whoever makes a head faster runs this before and
after: a new quality or a new stage is held against the same reference. Printed are the mean level per 5 degrees of beam angle and per
10 % of the range (dB over the reference), the contrast of the speckle and, of soundings, their mean and standard deviation
off a plane. Exit code 1 where one differs by more than "equal" allows: 0.1 dB, 0.01, 1 mm, 5 % (docs/physics/acoustics/reference.md);
the levels of two runs that draw different speckle scatter by 4.3 dB / sqrt(samples), which is printed and allowed three times.
"""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import ensonify
import numpy as np

from harness import ROOT

LEVEL_DB, CONTRAST, MEAN_M, SD = 0.1, 0.01, 0.001, 0.05
SECTOR_DEG, RANGES = 5.0, 10
WITHIN_DB = 30.0  # of the strongest sector or range: noise is compared nowhere


def record_of(options, quality, folder):
    """Runs the launch at this quality; the path of its record."""
    record = pathlib.Path(folder) / f"{quality}.mcap"
    seconds = (options.pings + 1) / options.rate
    words = [options.build / "bin/ensonify-run", ROOT / "bench/launch/equal.yaml", "--quiet", "--out", folder,
             "--arg", f"kind={options.head}", "--arg", f"seconds={seconds}", "--arg", f"record={record}",
             "--set", f"bow.quality={quality}"]
    if options.scenario:
        words += ["--arg", f"scenario={pathlib.Path(options.scenario).resolve()}"]
    # What makes all pings alike, one range above all, as the folder of the head states it for benchmarks.
    stated = json.loads((ROOT / "components" / options.head / "bench.json").read_text())["parameters"]
    stated["ping_rate_hz"] = options.rate
    if "amplitude_every" in stated:
        stated["amplitude_every"] = 1
    for setting in [*(f"{key}={value}" for key, value in stated.items()), *options.set]:
        words += ["--set", f"bow.{setting}"]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"equal.py: {done.stderr or done.stdout}")
    return record


def topics_of(record, start):
    return [topic for topic in record.topics() if topic.startswith(start)]


class Levels:
    """Mean squares of pings by sector of beam angle and by tenth of the range, and the contrast of amplitudes."""

    def __init__(self, record):
        self.sectors, self.ranges, self.samples = {}, {}, {}
        self.pings, means, squares = 0, None, None
        for _, _, ping in record.messages(*topics_of(record, "bow/ping")):
            amplitude = np.atleast_2d(np.asarray(ping.amplitude_upa, dtype=float))
            if amplitude.size == 0:
                amplitude = np.atleast_2d(np.asarray(ping.amplitude_count, dtype=float)) * ping.count_upa
            power = amplitude**2
            if means is None:
                means, squares = np.zeros_like(power), np.zeros_like(power)
            if power.shape != means.shape:
                sys.exit("equal.py: the pings of one run differ in size: --set one range")
            self.pings += 1
            means += power
            squares += power**2
            self._add(power, np.degrees(np.asarray(ping.beam_angle_rad, dtype=float)))
        if self.pings == 0:
            sys.exit("equal.py: the run has no ping with amplitudes")
        mean = means / self.pings
        strong = mean > 1e-3 * mean.max()
        # Of Rayleigh's amplitudes, whose power varies as much as its mean: 1. Each sample's own mean is of few pings.
        self.contrast = math.sqrt((squares[strong] / self.pings / mean[strong]**2).mean() - 1)

    def _add(self, power, angle_deg):
        count = power.shape[1]
        for beam, angle in enumerate(angle_deg):
            sector = math.floor(angle / SECTOR_DEG)
            self._sum(self.sectors, ("deg", sector * SECTOR_DEG), power[beam])
        for tenth in range(RANGES):
            part = power[:, tenth * count // RANGES:(tenth + 1) * count // RANGES]
            self._sum(self.ranges, ("range", tenth * 100 // RANGES), part)

    def _sum(self, sums, key, power):
        sums[key] = sums.get(key, 0.0) + power.sum()
        # How many independent samples carry it: (sum)^2 / sum of squares, twice that of Rayleigh's.
        one, two = self.samples.get(key, (0.0, 0.0))
        self.samples[key] = (one + power.sum(), two + (power**2).sum())

    def scatter_db(self, key):
        one, two = self.samples[key]
        return 4.34 * math.sqrt(two / one**2)


def soundings_of(record):
    """Places of all valid soundings, n x 3; None where the head has none."""
    topics = topics_of(record, "bow/soundings")
    if not topics:
        return None
    places = [np.asarray(message.position_enu_m, dtype=float).reshape(-1, 3)[np.asarray(message.valid, dtype=bool)]
              for _, _, message in record.messages(*topics)]
    places = [place for place in places if len(place)]
    return np.concatenate(places) if places else None


def off_plane(places, plane):
    east, north, up = places.T
    return up - (plane[0] + plane[1] * east + plane[2] * north)


def compared(ours, reference):
    """Rows (what, value, allowed, ok) of two records."""
    rows = []
    with ensonify.Record(ours) as a, ensonify.Record(reference) as b:
        one, other = Levels(a), Levels(b)
        if one.pings != other.pings:
            sys.exit(f"equal.py: {one.pings} pings against {other.pings}")
        for sums, others in ((one.sectors, other.sectors), (one.ranges, other.ranges)):
            strongest = max(others.values())
            for key in sorted(others):
                if not others[key] > strongest * 10**(-0.1 * WITHIN_DB):
                    continue
                difference_db = 10 * math.log10(sums[key] / others[key])
                allowed_db = LEVEL_DB + 3 * math.hypot(one.scatter_db(key), other.scatter_db(key))
                what = f"{key[1]:+.0f} to {key[1] + SECTOR_DEG:+.0f} deg" if key[0] == "deg" else f"{key[1]} % of the range on"
                rows.append((f"level, {what}, dB", difference_db, allowed_db, abs(difference_db) <= allowed_db))
        contrast = one.contrast - other.contrast
        rows.append(("speckle contrast", contrast, CONTRAST, abs(contrast) <= CONTRAST))
        ours_m, theirs_m = soundings_of(a), soundings_of(b)
        if ours_m is not None and theirs_m is not None:
            design = np.column_stack([np.ones(len(theirs_m)), theirs_m[:, 0], theirs_m[:, 1]])
            plane = np.linalg.lstsq(design, theirs_m[:, 2], rcond=None)[0]
            off, their_off = off_plane(ours_m, plane), off_plane(theirs_m, plane)
            mean_m, sd = off.mean() - their_off.mean(), off.std() / their_off.std() - 1
            scatter_m = math.hypot(off.std() / math.sqrt(len(off)), their_off.std() / math.sqrt(len(their_off)))
            rows.append(("soundings off the plane, mean, m", mean_m, MEAN_M + 3 * scatter_m, abs(mean_m) <= MEAN_M + 3 * scatter_m))
            rows.append((f"soundings off the plane, sd over {their_off.std():.4f} m, share", sd, SD, abs(sd) <= SD))
    return rows, one.pings


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("head", choices=sorted(file.parent.name for file in ROOT.glob("components/*/bench.json")), help="component")
    parser.add_argument("--quality", default="1", help="what is compared with the reference (default 1)")
    parser.add_argument("--pings", type=int, default=100, help="of each run (default 100)")
    parser.add_argument("--rate", type=float, default=5.0, help="pings a second of sim time (default 5)")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="parameter of the head; may be repeated")
    parser.add_argument("--scenario", help="another scenario (default: a slope under a thermocline)")
    parser.add_argument("--build", default="build/release", help="build folder (default: build/release)")
    parser.add_argument("--json", help="write the rows to this file")
    options = parser.parse_args()
    options.build = (ROOT / options.build).resolve()
    os.environ["PATH"] = f"{options.build / 'bin'}:{os.environ['PATH']}"
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as folder:
        rows, pings = compared(record_of(options, options.quality, folder), record_of(options, "reference", folder))
    print(f"{options.head}: quality {options.quality} over the reference, {pings} pings")
    for what, value, allowed, ok in rows:
        print(f"  {what:44} {value:+9.4f}  allowed {allowed:.4f}{'' if ok else '  NOT EQUAL'}")
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps([dict(zip(("what", "value", "allowed", "ok"), row)) for row in rows], indent=1))
    return 0 if all(ok for _, _, _, ok in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
