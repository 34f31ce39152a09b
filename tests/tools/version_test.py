"""Every program and every verb prints the version that the file VERSION has."""
import os
import pathlib
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(os.environ["ENSONIFY_SOURCE"])
BIN = pathlib.Path(os.environ["ENSONIFY_BUILD"]) / "bin"
sys.path.insert(0, str(SOURCE / "cmake/package"))
from help_tree import read_tree  # noqa: E402


class Version(unittest.TestCase):
    def check(self, *words):
        done = subprocess.run([*words, "--version"], capture_output=True, text=True, timeout=60)
        version = "ensonify " + (SOURCE / "VERSION").read_text().strip()
        self.assertEqual((done.returncode, done.stdout.strip(), done.stderr), (0, version, ""), words)

    def test_of_every_program(self):
        programs = sorted(BIN.glob("ensonify*"))
        self.assertIn(BIN / "ensonify-conductor", programs)
        for program in programs:
            self.check(program)

    def test_of_every_verb_and_what_is_below_it(self):
        commands = [command.words for command in read_tree(str(BIN)).all()]
        self.assertIn(["ensonify", "topic", "list"], commands)
        for words in commands:
            self.check(BIN / "ensonify", *words[1:])


if __name__ == "__main__":
    unittest.main()
