"""README's folder map knows every folder; no page is orphaned; every source that is cited is in the list. (Links: docs/check.py.)"""
import os
import pathlib
import re
import subprocess
import unittest

SOURCE = pathlib.Path(os.environ["ENSONIFY_SOURCE"])


def tracked():
    listed = subprocess.run(["git", "-c", f"safe.directory={SOURCE}", "-C", SOURCE, "ls-files"], capture_output=True,
                            text=True)
    if listed.returncode != 0:
        raise unittest.SkipTest("not a git checkout")
    return listed.stdout.splitlines()


def links(page):
    """Targets of [text](target), but for other sites."""
    text = re.sub(r"^```.*?^```", "", (SOURCE / page).read_text(), flags=re.M | re.S)
    targets = re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`\n]*`", "", text))
    return [t.split("#")[0] for t in targets if "://" not in t and not t.startswith("#")]


class Pages(unittest.TestCase):
    def test_the_folder_map_is_whole(self):
        top = {p.split("/")[0] for p in tracked() if "/" in p}
        self.assertEqual(top - {t.split("/")[0] for t in links("README.md")}, set())

    def test_an_index_names_every_page(self):
        pages = {p for p in tracked() if re.fullmatch(r"docs/.*\.(md|bib)", p)}
        named = {"docs/README.md"}
        for index in (p for p in pages if p.endswith("/README.md")):
            named |= {os.path.normpath(pathlib.PurePath(index).parent / target) for target in links(index)}
        self.assertEqual(pages - named, set())

    def test_sources_are_listed(self):
        listed = set(re.findall(r"^@\w+\{(\w+),", (SOURCE / "docs/references.bib").read_text(), re.M))
        cited = set()
        for file in (f for f in tracked() if f.endswith((".h", ".cpp", ".md", ".py"))):
            cited |= set(re.findall(r"\[([A-Z][A-Za-z]+(?:19|20)\d\d[a-z]?)\b", (SOURCE / file).read_text()))
        self.assertGreater(len(cited), 10)
        self.assertEqual(cited - listed, set())


if __name__ == "__main__":
    unittest.main()
