"""Launch files with expectations as tests of pytest: `pytest launch/` runs each by `ensonify test`.

A YAML file is collected where a line of it says `ensonify: launch/1` and it may hold expectations; nothing else is touched. One test a
file: it fails with the expectations that failed, and is skipped where the launch needs an argument or waits for somebody. The program
`ensonify` is found as the client finds it: in the folder that ENSONIFY_BIN names, else on PATH.
"""
import json
import pathlib
import re
import subprocess

import pytest

from ensonify.launching import program
from ensonify.session import RunError

HEADER = re.compile(r"^ensonify:\s*launch/", re.MULTILINE)
MAY_EXPECT = re.compile(r"^(expect|include):", re.MULTILINE)


def pytest_addoption(parser):
    """Options of every test run."""
    group = parser.getgroup("ensonify", "launch files of Ensonify")
    group.addoption("--ensonify-arg", action="append", default=[], metavar="NAME=VALUE", help="an argument, for the launch files that have it")
    group.addoption("--ensonify-set", action="append", default=[], metavar="KEY=VALUE", help="a parameter, for every launch file")
    group.addoption("--ensonify-out", default="out/pytest", metavar="DIR", help="folder of results (default: out/pytest)")


def pytest_collect_file(file_path, parent):
    """A launch file that may hold expectations."""
    if file_path.suffix not in (".yaml", ".yml"):
        return None
    text = file_path.read_text(errors="replace")
    if not (HEADER.search(text) and MAY_EXPECT.search(text)):
        return None
    return LaunchFile.from_parent(parent, path=file_path)


class LaunchFailed(Exception):
    """A launch did not hold; the text says why."""


class LaunchFile(pytest.File):
    """A launch file: one test."""

    def collect(self):
        yield LaunchItem.from_parent(self, name="launch")


class LaunchItem(pytest.Item):
    """One run of a launch file."""

    def runtest(self):
        listed = ensonify_test(self.path, "--list")
        if listed["verdict"] == "skipped" and not self._args(listed):
            pytest.skip(listed["why"])
        if listed["verdict"] == "unreadable":
            raise LaunchFailed(listed["why"])
        words = ["--out", str(self._out())]
        for argument in self._args(listed):
            words += ["--arg", argument]
        for assignment in self.config.getoption("--ensonify-set"):
            words += ["--set", assignment]
        result = ensonify_test(self.path, *words)
        if result["verdict"] == "skipped":
            pytest.skip(result["why"])
        if result["verdict"] != "passed":
            raise LaunchFailed(reasons(result))

    def _args(self, listed: dict) -> list:
        return [given for given in self.config.getoption("--ensonify-arg") if given.split("=")[0] in listed["args"]]

    def _out(self) -> pathlib.Path:
        """A folder of this file alone, whatever else runs beside it."""
        try:
            path = self.path.relative_to(self.config.rootpath)
        except ValueError:
            path = pathlib.Path(*self.path.parts[1:])
        return pathlib.Path(self.config.getoption("--ensonify-out")) / "_".join(path.with_suffix("").parts)

    def repr_failure(self, excinfo):
        """What the launch said, without our own stack."""
        if isinstance(excinfo.value, (LaunchFailed, RunError)):
            return str(excinfo.value)
        return super().repr_failure(excinfo)

    def reportinfo(self):
        return self.path, 0, f"launch {self.path.name}"


def ensonify_test(path: pathlib.Path, *words: str) -> dict:
    """What `ensonify test` says of one launch file. Raises RunError where it says nothing."""
    done = subprocess.run([program(), "test", str(path), "--json", *words], capture_output=True, text=True, check=False)
    try:
        [result] = json.loads(done.stdout)["launches"]
    except (ValueError, KeyError):
        raise RunError(done.stderr.strip() or f"ensonify test ended with exit code {done.returncode}", done.returncode) from None
    return result


def reasons(result: dict) -> str:
    """Why a launch failed, a line for each expectation."""
    lines = [f"failed: {one['name']}: {one['message']} (t={one['t_s']:.3f} s)" for one in result.get("expect", []) if not one["ok"]]
    if not lines:
        lines = [f"exit code {result['exit_code']}: {result['message']}"]
    return "\n".join([*lines, f"logs: {result['out']}/log"])
