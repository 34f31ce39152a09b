#!/usr/bin/env python3
"""Counts the tests in a JUnit file of ctest: prints `N passed, N failed, N skipped`.

  count_tests.py RESULTS.xml | --self-test

A test is skipped when it said so itself (ctest's SKIP_ properties) or is disabled. One that could not run for any
other reason (program missing, fixture failed) counts as failed. Exit code 1 on a failure or when nothing passed.
"""
import io
import sys
import xml.etree.ElementTree as xml


def count(file):
    passed = failed = skipped = 0
    for case in xml.parse(file).getroot().iter("testcase"):
        status = case.get("status")
        reason = case.find("skipped")
        if status == "run":
            passed += 1
        elif status == "disabled" or (reason is not None and reason.get("message", "").startswith("SKIP_")):
            skipped += 1
        else:
            failed += 1
    return passed, failed, skipped


# What ctest 3.25 writes for each way in which a test can end, with one that passes.
EVERY_END = """<testsuite>
  <testcase name="passes" status="run"/>
  <testcase name="fails, times out or crashes" status="fail"><failure message=""/></testcase>
  <testcase name="no program" status="notrun"><skipped message="Unable to find executable"/></testcase>
  <testcase name="no fixture" status="notrun"><skipped message="Fixture dependency failed"/></testcase>
  <testcase name="skips by exit code" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/></testcase>
  <testcase name="skips by its text" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/></testcase>
  <testcase name="is disabled" status="disabled"/>
</testsuite>"""


def self_test():
    found = count(io.StringIO(EVERY_END))
    print(f"expected (1, 3, 3), found {found}")
    return 0 if found == (1, 3, 3) else 1


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
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
