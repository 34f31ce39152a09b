#!/usr/bin/env python3
"""Prints what took longest: the steps of a CI run and the programs of its tests.

  slowest.py STEPS [RESULTS.xml ...]

STEPS has a line `NAME SECONDS` for each step; a RESULTS.xml is ctest's JUnit file, named by the preset whose folder it is in.
"""
import pathlib
import sys
import xml.etree.ElementTree as xml

MOST = 10


def main(steps, results):
    timed = []
    for line in pathlib.Path(steps).read_text(encoding="utf-8").splitlines():
        name, seconds = line.rsplit(" ", 1)
        timed.append((float(seconds), "step", name))
    for file in map(pathlib.Path, results):
        if file.is_file():
            for program in xml.parse(file).getroot().iter("testcase"):
                timed.append((float(program.get("time") or 0.0), f"test, {file.parent.name}", program.get("name")))
    print(f"the {MOST} slowest:")
    for seconds, kind, name in sorted(timed, reverse=True)[:MOST]:
        print(f"  {seconds:7.1f} s  {name} ({kind})")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
