"""docs/wiring.svg, the drawing in docs/architecture.md, shows what `ensonify graph launch/demo.yaml` prints today."""
import html
import os
import pathlib
import re
import subprocess
import unittest

SOURCE = pathlib.Path(os.environ.get("ENSONIFY_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
BUILD = pathlib.Path(os.environ.get("ENSONIFY_BUILD", "build/dev")).resolve()
ANEW = "to draw it anew: ensonify graph launch/demo.yaml --svg docs/wiring.svg"


class Wiring(unittest.TestCase):
    def setUp(self):
        # Layout differs between versions of Graphviz, so arrows and their texts are compared, not bytes.
        self.dot = subprocess.run([BUILD / "bin/ensonify", "graph", "launch/demo.yaml", "--dot"], cwd=SOURCE, check=True,
                                  capture_output=True, text=True).stdout
        self.drawing = html.unescape((SOURCE / "docs/wiring.svg").read_text()).replace("\N{NO-BREAK SPACE}", " ")

    def test_the_drawing_has_the_arrows_of_today(self):
        reported = re.findall(r'^  "(\S+)" -> "(\S+)" ', self.dot, re.M)
        drawn = re.findall(r"<title>(\S+)->(\S+)</title>", self.drawing)
        self.assertGreater(len(reported), 5)
        self.assertEqual(sorted(reported), sorted(drawn), ANEW)

    def test_the_arrows_have_the_texts_of_today(self):
        reported = [text for label in re.findall(r'-> "\S+" \[label="([^"]*)"', self.dot) for text in label.split(r"\n")]
        drawn = re.findall(r'font-size="9.00">([^<]*)</text>', self.drawing)
        squeezed = lambda texts: sorted(" ".join(text.split()) for text in texts)
        self.assertEqual(squeezed(reported), squeezed(drawn), ANEW)


if __name__ == "__main__":
    unittest.main()
