"""Prints the headers that other projects get: those of messages/, and of kernels/ what the project itself uses from other
folders, with what these headers include. A header that only its own folder uses is private; tests use nothing."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCES = ("cmake", "components", "examples", "kernels", "launch", "messages", "scenarios", "tools")
TEST = re.compile(r"(^|[/_])(tests?|testing|bench)([/_.]|$)")


def public_headers(files: dict) -> list:
    """Names of public headers; `files` holds the text of every header and source by its name."""
    includes = {name: {included for included in re.findall(r'^#include "([^"]+)"', text, re.MULTILINE) if included in files}
                for name, text in files.items()}
    shared = {name for name in files if name.startswith(("kernels/", "messages/")) and name.endswith(".h")}
    due = {name for name in shared if name.startswith("messages/")}
    for user, used in includes.items():
        due |= {name for name in used & shared if folder(name) != folder(user)}
    public = set()
    while due:
        public |= due
        due = set().union(*(includes[name] for name in due)) - public
    return sorted(public)


def folder(name: str) -> str:
    return name.rpartition("/")[0]


def project_files() -> dict:
    """Every header and source but those of tests and benchmarks."""
    found = [path for top in SOURCES for path in (ROOT / top).rglob("*") if path.suffix in (".h", ".cpp")]
    names = {path.relative_to(ROOT).as_posix(): path for path in found}
    return {name: path.read_text(encoding="utf-8") for name, path in names.items() if not TEST.search(name)}


def self_test() -> None:
    files = {"kernels/a/used.h": '#include "kernels/a/below.h"\n', "kernels/a/below.h": "", "kernels/a/own.h": "",
             "kernels/a/used.cpp": '#include "kernels/a/own.h"\n', "messages/all.h": "", "tools/t/main.cpp": '#include "kernels/a/used.h"\n'}
    assert public_headers(files) == ["kernels/a/below.h", "kernels/a/used.h", "messages/all.h"], public_headers(files)
    for name in ("kernels/a/test_ship.h", "kernels/a/testing/ship.h", "kernels/a/bench.cpp", "kernels/a/ship_test.cpp", "tests/x/y.cpp"):
        assert TEST.search(name), name
    for name in ("kernels/a/latest.h", "kernels/benches/x.h", "tools/contest/main.cpp"):
        assert not TEST.search(name), name


if __name__ == "__main__":
    if "--self-test" in sys.argv:
        self_test()
    else:
        print("\n".join(public_headers(project_files())))
