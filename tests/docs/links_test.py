"""Links inside the project's pages lead to something; README's folder map knows every folder; no page is orphaned; every
source that is cited is in the list."""
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


class Links(unittest.TestCase):
    def test_they_lead_somewhere(self):
        checked = 0
        for page in (p for p in tracked() if p.endswith(".md")):
            for target in links(page):
                with self.subTest(page=page, target=target):
                    self.assertTrue((SOURCE / page).parent.joinpath(target).exists())
                checked += 1
        self.assertGreater(checked, 30)

    def test_the_folder_map_is_whole(self):
        top = {p.split("/")[0] for p in tracked() if "/" in p}
        self.assertEqual(top - {t.split("/")[0] for t in links("README.md")}, set())

    def test_the_index_names_every_page(self):
        pages = {pathlib.PurePath(p).name for p in tracked() if re.fullmatch(r"docs/[^/]+\.(md|bib)", p)}
        self.assertEqual(pages - {"README.md"} - set(links("docs/README.md")), set())

    def test_sources_are_listed(self):
        listed = set(re.findall(r"^@\w+\{(\w+),", (SOURCE / "docs/references.bib").read_text(), re.M))
        cited = set()
        for file in (f for f in tracked() if f.endswith((".h", ".cpp", ".md", ".py"))):
            cited |= set(re.findall(r"\[([A-Z][A-Za-z]+(?:19|20)\d\d[a-z]?)\b", (SOURCE / file).read_text()))
        self.assertGreater(len(cited), 10)
        self.assertEqual(cited - listed, set())


if __name__ == "__main__":
    unittest.main()
