"""launch/presets/COMPONENT/*.yaml: the component takes each of them, each value has a source that is listed in
docs/references.bib or is called assumed, and docs/manual/instruments.md describes each."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ.get("ENSONIFY_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
BUILD = pathlib.Path(os.environ.get("ENSONIFY_BUILD", "build/dev")).resolve()
PRESETS = sorted((SOURCE / "launch/presets").rglob("*.yaml"))
LISTED = set(re.findall(r"^@\w+\{(\w+),", (SOURCE / "docs/references.bib").read_text(), re.M))
PAGE = (SOURCE / "docs/manual/instruments.md").read_text()

LAUNCH = """
ensonify: launch/1
scenario: {source}/scenarios/bay/scenario.yaml
processes:
  bow: {{ run: {component}, config: {preset} }}
"""


def check(component, preset):
    """(exit code, what is wrong) of the component as the head `bow` of a launch with this preset."""
    with tempfile.TemporaryDirectory() as folder:
        launch = pathlib.Path(folder) / "launch.yaml"
        launch.write_text(LAUNCH.format(source=SOURCE, component=component, preset=preset))
        done = subprocess.run([BUILD / f"bin/ensonify-{component}", "--launch", launch, "--name", "bow", "--check"],
                              capture_output=True, text=True)
    return done.returncode, done.stderr


def unsourced(text):
    """Lines with a value whose comment is neither `[Source]...` nor `assumed: why`, or whose source is not listed."""
    faults = []
    for line in text.splitlines():
        value, _, comment = line.partition("#")
        if value.strip() and (not re.match(r"(\[\w+\]|assumed: \w)", comment.strip())
                              or not set(re.findall(r"\[(\w+)\]", comment)) <= LISTED):
            faults.append(line)
    return faults


class Presets(unittest.TestCase):
    def test_each_is_accepted_by_its_component(self):
        self.assertGreater(len(PRESETS), 8)
        for preset in PRESETS:
            with self.subTest(preset=preset.name):
                self.assertEqual(check(preset.parent.name, preset.relative_to(SOURCE)), (0, ""))

    def test_a_key_that_the_component_does_not_know_is_a_fault(self):
        with tempfile.TemporaryDirectory() as folder:
            preset = pathlib.Path(folder) / "typo.yaml"
            preset.write_text("frequency_khz: 300\n")
            code, fault = check("multibeam", preset)
        self.assertEqual(code, 2)
        self.assertIn("frequency_khz: is not a known key", fault)

    def test_each_value_has_a_source_or_is_called_assumed(self):
        for preset in PRESETS:
            with self.subTest(preset=preset.name):
                self.assertEqual(unsourced(preset.read_text()), [])

    def test_a_value_without_a_source_is_noticed(self):
        for line in ("beams: 256", "beams: 256  # as usual", "beams: 256  # [Nobody]", "beams: 256  # assumed:"):
            self.assertEqual(unsourced(f"# A head.\n{line}\nswath_deg: 130  # assumed: why not\n"), [line])

    def test_the_page_describes_each(self):
        self.assertEqual([p.name for p in PRESETS if p.name not in PAGE], [])

    def test_the_sources_of_the_page_are_listed(self):
        cited = set(re.findall(r"\[([A-Z]\w+)\](?!\()", re.sub(r"`[^`\n]*`", "", PAGE)))
        self.assertGreater(len(cited), 10)
        self.assertEqual(cited - LISTED, set())


if __name__ == "__main__":
    unittest.main()
