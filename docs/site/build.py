#!/usr/bin/env python3
"""Builds the site of all pages into build/site: docs/, the folders' READMEs, and the files that they link to.

  build.py [--out FOLDER]
  build.py --self-test      checks the checks

Pages are copied to build/pages as they lie in the tree, so that relative links hold. A file of source that a page links to
becomes a page of its own, and so does a folder without a README. A link or anchor that leads nowhere, and a built page that
would load anything from elsewhere, fail the build.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"(?<=\]\()([^)\s#]+)((?:#[^)\s]*)?)(?=\))")
SHOWN = {".png", ".svg"}  # copied; other files become pages
LANGUAGES = {".h": "cpp", ".cpp": "cpp", ".py": "python", ".yaml": "yaml", ".txt": "cmake", ".bib": "bibtex"}
STATIC = ("docs/site/iframe-worker.js",)

# Order of the site: title, and its pages; `*` adds what else lies in the folder.
ORDER = (
    ("Ensonify", ["README.md", "docs/README.md", "docs/architecture.md", "docs/contributing.md", "docs/adding-a-head.md",
                  "docs/glossary.md"]),
    ("Manual", ["docs/manual/README.md", "docs/manual/first-survey.md", "docs/manual/train-a-detector.md", "docs/manual/gymnasium.md",
                "docs/manual/test-my-autopilot.md", "docs/manual/ship-nmea.md", "docs/manual/patch-test.md", "docs/manual/*"]),
    ("Physics", ["docs/physics/README.md", "docs/physics/acceptance.md", "docs/physics/gallery.md",
                 *(f"docs/physics/{chapter}/" for chapter in
                   ("water", "seabed", "mesh", "acoustics", "vehicle", "instruments", "survey"))]),
    ("Decisions", ["docs/decisions/README.md", "docs/decisions/*"]),
    ("Components", ["components/README.md", "components/*"]),
    ("Worlds", ["scenarios/README.md", "scenarios/layers.md", "scenarios/meshes.md", "scenarios/*"]),
    ("More", ["launch/README.md", "kernels/README.md", "clients/python/README.md", "*"]),
)


def tracked():
    listed = subprocess.run(["git", "-c", f"safe.directory={ROOT}", "-C", ROOT, "ls-files", "--cached", "--others",
                             "--exclude-standard"], capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.splitlines() if (ROOT / name).is_file()]


def with_empty_lines(text):
    """The page with an empty line before each list and table, which the generator's Markdown needs."""
    out, in_code = [], False
    for line in text.split("\n"):
        in_code ^= line.lstrip().startswith("```")
        starts = re.match(r"(?:[-*+] |\d+\. |\|)", line)
        before = out[-1] if out else ""
        follows = re.match(r"(?:[-*+] |\d+\. |\||\s)", before) or not before.strip()
        out += [""] if starts and not follows and not in_code and not _continues_item(out, line) else []
        out.append(line)
    return "\n".join(out)


def _continues_item(out, line):
    """The line goes on with a list whose last item runs over several lines."""
    for before in reversed(out):
        if not before.strip():
            return False
        if re.match(r"(?:[-*+] |\d+\. )", before):
            return not line.startswith("|")
    return False


class Pages:
    """The pages of the site, as they are staged."""

    def __init__(self, folder):
        self.folder, self.tracked = folder, tracked()
        self.staged = {}  # page in the site -> its title or None

    def put(self, name, text, title=None):
        target = self.folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")
        self.staged[name] = title

    def copy(self, name):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, self.folder / name)

    def page_of_file(self, name):
        page = f"{name}.md"
        if page not in self.staged:
            language = LANGUAGES.get(pathlib.PurePath(name).suffix, "text")
            text = (ROOT / name).read_text(encoding="utf-8")
            fence = "`" * 4
            self.put(page, f"---\nsearch: {{ exclude: true }}\n---\n# {name}\n\n{fence}{language}\n{text.rstrip()}\n{fence}\n", name)
        return page

    def page_of_folder(self, name):
        page = f"{name}/README.md"
        if page not in self.staged and page not in self.tracked:
            files = sorted(file for file in self.tracked if file.startswith(f"{name}/"))
            self.put(page, f"---\nsearch: {{ exclude: true }}\n---\n# {name}\n\n" + "".join(f"- `{file}`\n" for file in files), name)
        return page

    def aim(self, page, match):
        """The link's target in the site."""
        target, anchor = match[1], match[2]
        if re.match(r"[a-z]+:", target):
            return match[0]
        aimed = (ROOT / page).parent.joinpath(target).resolve()
        name = aimed.relative_to(ROOT).as_posix() if aimed.is_relative_to(ROOT) else ""
        if aimed.is_dir():
            name = self.page_of_folder(name)
        elif aimed.suffix in SHOWN:
            self.copy(name)
        elif aimed.is_file() and aimed.suffix != ".md":
            name = self.page_of_file(name)
        up = len(pathlib.PurePath(page).parts) - 1
        return ("../" * up + name if name else target) + anchor

    def stage(self):
        for name in STATIC:
            self.copy(name)
        for page in [name for name in self.tracked if name.endswith(".md")]:
            text = (ROOT / page).read_text(encoding="utf-8")
            parts = re.split(r"(^ *```.*?^ *```|`[^`\n]*`)", text, flags=re.M | re.S)  # links are not in code
            parts[::2] = [LINK.sub(lambda match: self.aim(page, match), part) for part in parts[::2]]
            self.put(page, with_empty_lines("".join(parts)))

    def nav(self):
        """The pages in order, each once; pages of files and folders are in no menu."""
        left = sorted(page for page, title in self.staged.items() if title is None)
        take = lambda chosen: [left.remove(page) or page for page in chosen if page in left]
        menu = []
        for title, patterns in ORDER:
            entries = []
            for pattern in patterns:
                if pattern.endswith("/"):
                    chapter = take([page for page in left if page.startswith(pattern)])
                    entries.append({pathlib.PurePath(pattern).name.capitalize(): sorted(chapter, key=lambda p: not p.endswith("README.md"))})
                else:
                    entries += take([page for page in left if page == pattern or (pattern.endswith("*") and page.startswith(pattern[:-1]))])
            menu.append({title: entries})
        return menu


def loads_from_elsewhere(site):
    """Lines of built pages by which a browser would fetch something from the network."""
    loading = re.compile(r"<(?:script|img|iframe|source|video|audio)[^>]*\ssrc=[\"']?(?:https?:)?//[^\"'> ]+"
                         r"|<link[^>]*\shref=[\"']?(?:https?:)?//[^>]*rel=[\"']?(?:stylesheet|preconnect|icon|preload)"
                         r"|<link[^>]*rel=[\"']?(?:stylesheet|preconnect|icon|preload)[^>]*\shref=[\"']?(?:https?:)?//"
                         r"|@import\s+(?:url\()?[\"']?(?:https?:)?//|url\([\"']?(?:https?:)?//")
    for page in sorted(p for p in site.rglob("*") if p.suffix in (".html", ".css")):
        for match in loading.finditer(page.read_text(encoding="utf-8")):
            yield f"{page.relative_to(site)}: loads {match[0][:120]}"


# Pieces of a page, and whether a browser would fetch something for them.
FETCHING = (
    ('<script src="https://cdn.example/x.js"></script>', True), ('<link rel="stylesheet" href="//fonts.example/f.css">', True),
    ('<link href="https://fonts.example" rel="preconnect">', True), ("<style>@import url(https://x.example/a.css);</style>", True),
    ('<img alt="x" src=http://x.example/a.png>', True), ('<a href="https://example.org">a link is not fetched</a>', False),
    ('<script src="assets/x.js"></script><link rel="stylesheet" href="a.css">', False), ('<img src="../a.png">', False),
)


def self_test():
    wrong = []
    for piece, fetches in FETCHING:
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "page.html").write_text(piece, encoding="utf-8")
            if bool(list(loads_from_elsewhere(pathlib.Path(folder)))) != fetches:
                wrong.append(f"judged wrongly: {piece}")
    spaced = with_empty_lines("Text:\n- one\n  goes on\n- two\n\nText\n| a |\n|---|\n```\ncode\n- code\n```")
    if spaced != "Text:\n\n- one\n  goes on\n- two\n\nText\n\n| a |\n|---|\n```\ncode\n- code\n```":
        wrong.append(f"spaced wrongly:\n{spaced}")
    print("\n".join(wrong) or f"{len(FETCHING)} pieces judged rightly")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/site")
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    site = arguments.out.resolve()
    work = ROOT / "build/pages"
    shutil.rmtree(work, ignore_errors=True)
    pages = Pages(work / "tree")
    pages.stage()
    hidden = "".join(f"/{page}\n" for page, title in pages.staged.items() if title)
    settings = {"INHERIT": str(ROOT / "docs/site/mkdocs.yml"), "docs_dir": "tree", "site_dir": str(site), "nav": pages.nav(),
                "not_in_nav": hidden}
    (work / "mkdocs.yml").write_text(json.dumps(settings, indent=1), encoding="utf-8")  # JSON is YAML
    # Not --quiet: it would keep warnings from being counted.
    built = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict", "--config-file", work / "mkdocs.yml"],
                           env={**os.environ, "NO_MKDOCS_2_WARNING": "1"}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if built.returncode:
        print("\n".join(line for line in built.stdout.splitlines() if not line.startswith("INFO")))
        return built.returncode
    fetched = list(loads_from_elsewhere(site))
    count = sum(1 for _ in site.rglob("*.html"))
    print("\n".join(fetched) or f"{count} pages; open {site}/index.html")
    return 1 if fetched else 0


if __name__ == "__main__":
    sys.exit(main())
