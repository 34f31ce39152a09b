#!/usr/bin/env python3
"""Counts the tests in a JUnit file of ctest: prints `N passed, N failed, N skipped`.

A test is skipped when it said so itself (ctest's SKIP_ properties) or is disabled. One that could not run for any
other reason (program missing, fixture failed) counts as failed. Exit code 1 on a failure or when nothing passed.
"""
import sys
import xml.etree.ElementTree as xml


def count(path):
    passed = failed = skipped = 0
    for case in xml.parse(path).getroot().iter("testcase"):
        status = case.get("status")
        reason = case.find("skipped")
        if status == "run":
            passed += 1
        elif status == "disabled" or (reason is not None and reason.get("message", "").startswith("SKIP_")):
            skipped += 1
        else:
            failed += 1
    return passed, failed, skipped


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: count_tests.py RESULTS.xml")
    try:
        passed, failed, skipped = count(sys.argv[1])
    except (OSError, xml.ParseError) as error:
        print(f"no test results: {error}", file=sys.stderr)
        passed, failed, skipped = 0, 0, 0
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
