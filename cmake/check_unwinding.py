#!/usr/bin/env python3
"""Checks that no program has an unwind entry of no length: check_unwinding.py FOLDER_OF_PROGRAMS

g++ 12 may leave a cold part of a function that holds nothing. Its entry then stands where the next function's begins, the linker keeps
both, and an exception that passes there finds the empty one: the program is aborted although somebody would have caught it.
-fno-reorder-blocks-and-partition (Settings.cmake) makes no such parts. Exit code 1 if there is one.
"""
import pathlib
import re
import subprocess
import sys

ENTRY = re.compile(r"FDE .*pc=([0-9a-f]+)\.\.([0-9a-f]+)")


def empty_entries(program):
    """Addresses with an entry of no length where a function begins."""
    text = subprocess.run(["readelf", "--debug-dump=frames", program], capture_output=True, text=True, check=True).stdout
    ranges = [match.groups() for match in ENTRY.finditer(text)]
    starts = {first for first, end in ranges if first != end}
    return len(ranges), sorted(first for first, end in ranges if first == end and first in starts)


def main():
    programs = [file for file in sorted(pathlib.Path(sys.argv[1]).iterdir()) if file.read_bytes()[:4] == b"\x7fELF"]
    if not programs:
        sys.exit(f"{sys.argv[1]}: holds no program")
    wrong = 0
    for program in programs:
        entries, empty = empty_entries(program)
        if entries == 0:
            sys.exit(f"{program}: has no unwind entries, or readelf shows them otherwise")
        for address in empty:
            print(f"{program.name}: an empty unwind entry at 0x{address} hides a function's")
            wrong += 1
    print(f"{len(programs)} programs, {wrong} hidden functions")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
