"""Where run directories are: the same rule as the launcher's (components/runtime/run_finder.h)."""
import os
import pathlib
import tempfile
import unittest
from unittest import mock

from ensonify.runs import LONGEST_RUN_ROOT, run_root

FALLBACK = pathlib.Path(f"/tmp/ensonify-{os.geteuid()}")


class RunRoot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(dir="/tmp")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def root_with(self, runtime):
        with mock.patch.dict(os.environ, {"XDG_RUNTIME_DIR": str(runtime)}):
            return run_root()

    def of_length(self, length):
        """A runtime folder whose `ensonify` has a path of so many bytes."""
        runtime = self.folder / ("x" * (length - len(str(self.folder)) - len("//ensonify")))
        runtime.mkdir()
        return runtime

    def test_the_runtime_folder_is_taken_up_to_the_longest_that_sockets_allow(self):
        longest, too_long = self.of_length(LONGEST_RUN_ROOT), self.of_length(LONGEST_RUN_ROOT + 1)
        self.assertEqual(self.root_with(longest), longest / "ensonify")
        self.assertEqual(self.root_with(too_long), FALLBACK)

    def test_what_is_no_folder_of_ours_is_not_taken(self):
        (self.folder / "ensonify").write_text("a file")
        self.assertEqual(self.root_with(self.folder), FALLBACK)
        self.assertEqual(self.root_with(self.folder / "missing"), FALLBACK)
        self.assertEqual(self.root_with("relative"), FALLBACK)
        self.assertEqual(self.root_with(""), FALLBACK)

    def test_the_rule_is_the_launchers(self):
        header = pathlib.Path(__file__).resolve().parents[3] / "components/runtime/run_finder.h"
        self.assertIn("kLongestRunsFolder = 107 - 60;", header.read_text())
        self.assertEqual(LONGEST_RUN_ROOT, 107 - 60)


if __name__ == "__main__":
    unittest.main()
