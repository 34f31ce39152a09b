#!/usr/bin/env python3
"""Counts the tests in a JUnit file of ctest: prints `N passed, N failed, N skipped`.

  count_tests.py RESULTS.xml | --self-test

ctest knows programs; what is counted are their cases, where a program says how many it ran (unittest, Catch2). A program
that says nothing of cases is one. A case is skipped when unittest says so, or, since Catch2 2 cannot skip, when it warns
`skipped: REASON`. A program is skipped when it said so itself (ctest's SKIP_ properties) or is disabled. One that could
not run for any other reason (program missing, fixture failed) counts as failed. Exit code 1 on a failure or when
nothing passed. The file must hold whole outputs (ctest's --test-output-size-passed and --test-output-size-failed).
"""
import io
import re
import sys
import xml.etree.ElementTree as xml

CATCH_PASSED = re.compile(r"^All tests passed \(.* in (\d+) test cases?\)$", re.M)
CATCH_FAILED = re.compile(r"^test cases: +(\d+) \|.*?(\d+) failed", re.M)
CATCH_SKIPPED = re.compile(r"^ +skipped: ", re.M)
UNITTEST = re.compile(r"^Ran (\d+) tests? in .*\n\n(?:OK|FAILED)(?: \((.*)\))?$", re.M)


def cases(output):
    """(cases, failed, skipped) as the program's output gives; a program without cases is (1, 0, 0)."""
    if found := UNITTEST.search(output):
        counts = dict(part.split("=") for part in (found[2] or "").split(", ") if part)
        failed, skipped = int(counts.get("failures", 0)) + int(counts.get("errors", 0)), int(counts.get("skipped", 0))
        return max(int(found[1]), failed + skipped), failed, skipped  # a module that skips itself ran no test
    if found := CATCH_PASSED.search(output):
        return int(found[1]), 0, len(CATCH_SKIPPED.findall(output))
    if found := CATCH_FAILED.search(output):
        return int(found[1]), int(found[2]), len(CATCH_SKIPPED.findall(output))
    return 1, 0, 0


def count(file):
    passed = failed = skipped = 0
    for program in xml.parse(file).getroot().iter("testcase"):
        status = program.get("status")
        reason = program.find("skipped")
        if status == "disabled" or (reason is not None and reason.get("message", "").startswith("SKIP_")):
            skipped += 1
            continue
        ran, bad, left_out = cases(program.findtext("system-out") or "")
        if status != "run":
            bad = max(bad, 1)  # also one that crashed, hung or never started
        failed += bad
        skipped += left_out
        passed += max(ran - bad - left_out, 0)
    return passed, failed, skipped


# What ctest 3.25 writes for each way in which a program can end, and its output with each number of passed, failed and
# skipped cases.
EVERY_END = """<testsuite>
  <testcase name="1 0 0: passes" status="run"/>
  <testcase name="0 1 0: fails, times out or crashes" status="fail"><failure message=""/></testcase>
  <testcase name="0 1 0: no program" status="notrun"><skipped message="Unable to find executable"/></testcase>
  <testcase name="0 1 0: no fixture" status="notrun"><skipped message="Fixture dependency failed"/></testcase>
  <testcase name="0 0 1: skips by exit code" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/></testcase>
  <testcase name="0 0 1: skips by its text" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/></testcase>
  <testcase name="0 0 1: is disabled" status="disabled"/>
  <testcase name="5 0 0: unittest" status="run"><system-out>test_a (m.C) ... ok
Ran 5 tests in 0.001s

OK</system-out></testcase>
  <testcase name="3 0 2: unittest" status="run"><system-out>test_b (m.C) ... skipped 'needs root'
Ran 5 tests in 1.001s

OK (skipped=2)</system-out></testcase>
  <testcase name="0 0 1: unittest, a whole module" status="run"><system-out>Ran 0 tests in 0.000s

OK (skipped=1)</system-out></testcase>
  <testcase name="1 3 1: unittest" status="fail"><failure message=""/><system-out>Ran 5 tests in 0.001s

FAILED (failures=1, errors=2, skipped=1)</system-out></testcase>
  <testcase name="6 0 1: Catch2" status="run"><system-out>a_test.cpp:82: warning:
  skipped: no rasters in data

===============================================================================
All tests passed (1234 assertions in 7 test cases)
</system-out></testcase>
  <testcase name="1 0 0: Catch2" status="run"><system-out>All tests passed (1 assertion in 1 test case)
</system-out></testcase>
  <testcase name="4 2 0: Catch2" status="fail"><failure message=""/><system-out>test cases:  6 |  4 passed | 2 failed
assertions: 20 | 17 passed | 3 failed
</system-out></testcase>
  <testcase name="0 1 0: Catch2, all failed" status="fail"><failure message=""/><system-out>test cases: 1 | 1 failed
assertions: 1 | 1 failed
</system-out></testcase>
</testsuite>"""


def self_test():
    """Each program alone against the numbers in its name, then all together."""
    names = [program.get("name") for program in xml.fromstring(EVERY_END)]
    wanted = [tuple(int(number) for number in name.split(":")[0].split()) for name in names]
    found = []
    for program in xml.fromstring(EVERY_END):
        alone = xml.Element("testsuite")
        alone.append(program)
        found.append(count(io.BytesIO(xml.tostring(alone))))
    for name, one in zip(names, found):
        print(f"{name}: found {one}")
    return 0 if found == wanted and count(io.StringIO(EVERY_END)) == tuple(map(sum, zip(*wanted))) else 1


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
