"""docs/manual/first-survey.md, followed to the letter: every `sh` box runs as it stands, in a folder of its own, in order.

A box must end with exit code 0, or with N if its last line ends in `# exit N`. What a `text` box quotes must have been
printed by the `sh` box before it, numbers aside. A box that ends in `&` starts a run; the next one begins when time runs.
Another run is live all the while: the page's commands reach their own.
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

from live_run import LiveRun

SOURCE = pathlib.Path(os.environ["ENSONIFY_SOURCE"])
BIN = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "bin"
PAGE = SOURCE / "docs/manual/first-survey.md"


def boxes(page):
    """(line number, language, content) of each fenced box."""
    for box in re.finditer(r"^```(\w*)\n(.*?)^```", page, re.M | re.S):
        yield page.count("\n", 0, box.start()) + 1, box[1], box[2]


def shape(line):
    """A line of output with its numbers and spaces made alike."""
    return re.sub(r"[-+]?\d[\d.,]*", "0", " ".join(line.split()))


class Tutorial(unittest.TestCase):
    def setUp(self):
        self.other = LiveRun()
        self.enterContext(self.other)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="ens-"))
        self.work = self.folder / "work"
        self.work.mkdir()
        self.environment = {**os.environ, "XDG_RUNTIME_DIR": str(self.other.folder),
                            "PATH": f"{BIN}:/usr/bin:{os.environ['PATH']}"}
        self.environment.pop("ENSONIFY_RUN", None)
        self.live = None
        self.addCleanup(self._clear)

    def _clear(self):
        if self.live is not None:
            os.killpg(self.live, signal.SIGTERM)
        shutil.rmtree(self.folder, ignore_errors=True)

    def _shell(self, commands):
        """Runs a box: (exit code, everything printed). What it leaves in the background goes on."""
        printed = self.folder / "printed"
        with printed.open("w") as out:
            shell = subprocess.Popen(["bash", "-e", "-c", commands], cwd=self.work, env=self.environment, stdout=out,
                                     stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, start_new_session=True)
            code = shell.wait()
        return code, printed.read_text(), shell.pid

    def _runs(self):
        """Directories of the page's runs."""
        return [run for run in (self.other.folder / "ensonify").glob("run-*") if run != self.other.directory()]

    def _await_time(self, group, name):
        """Returns when the run just started says that its time runs."""
        self.live = group
        while True:
            os.killpg(group, 0)  # ProcessLookupError: it has ended
            code, out, _ = self._shell(f"ensonify clock status --json --run {name}")
            if code == 0 and json.loads(out)["state"] == "running":
                return

    def _await_end(self):
        """Returns when the run that a box stopped has cleared up."""
        while self._runs():
            self._shell("ensonify clock list")
        self.live = None

    def test_every_box(self):
        boxes_run, printed = 0, ""
        for line, language, content in boxes(PAGE.read_text()):
            where = f"{PAGE.name}:{line}"
            if language == "sh":
                wanted = re.search(r"# exit (\d+)\n$", content)
                code, printed, group = self._shell(content)
                print(f"---- {where}\n{content}{printed}", flush=True)
                self.assertEqual(code, int(wanted[1]) if wanted else 0, f"{where}:\n{content}\n{printed}")
                boxes_run += 1
                if content.endswith("&\n"):
                    self._await_time(group, re.search(r"--name (\S+)", content)[1])
                elif "ensonify clock stop" in content:
                    self._await_end()
            elif language == "text":
                shapes = [shape(p) for p in printed.splitlines()]
                for quoted in content.splitlines():
                    with self.subTest(where, quoted=quoted):
                        self.assertIn(shape(quoted), shapes, f"the box before printed\n{printed}")
        self.assertGreater(boxes_run, 15)
        self.assertEqual(self._runs(), [])


if __name__ == "__main__":
    unittest.main()
