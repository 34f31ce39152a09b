"""Writes what follows from lists in the code: default.yaml of every component, the tables between
`<!-- parameters -->` and `<!-- /parameters -->` of its README, those between `<!-- parameters NAME -->` and the same end
of other pages (`ensonify describe NAME --table`), and the schemas of launch, recipe, scenario and mission files.

  generate_parameters.py BIN_FOLDER            rewrites the files
  generate_parameters.py BIN_FOLDER --check    says which files are not what the programs print, exit code 1
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MARKED = re.compile(r"(<!-- parameters(?: (\S+))? -->\n).*?(<!-- /parameters -->)", re.DOTALL)
BIN = pathlib.Path(sys.argv[1])


def printed(*words):
    return subprocess.run([BIN / words[0], *words[1:]], capture_output=True, text=True, check=True).stdout


def filled(page, table_of):
    """The page with its tables as they are now, and how many there are."""
    return MARKED.subn(lambda m: m[1] + table_of(m[2]) + m[3], page.read_text(encoding="utf-8"))


def wanted_files():
    """Path and text of each file that is generated, in whole or in part."""
    for default in sorted(ROOT.glob("components/*/default.yaml")):
        program = f"ensonify-{default.parent.name}"
        if "`" not in printed(program, "--parameters", "table"):  # it has no list: its file is written by hand
            continue
        yield default, printed(program, "--parameters", "yaml")
        readme = default.parent / "README.md"
        text, tables = filled(readme, lambda _: printed(program, "--parameters", "table"))
        if tables != 1:
            sys.exit(f"{readme.relative_to(ROOT)}: one pair of parameter marks is expected, {tables} are there")
        yield readme, text
    for page in sorted([*ROOT.glob("scenarios/*.md"), *ROOT.glob("docs/manual/*.md")]):
        text, tables = filled(page, lambda name: printed("ensonify-describe", name, "--table"))
        if tables:
            yield page, text
    for kind in ("launch", "recipe", "scenario", "mission"):
        yield ROOT / f"launch/schema/{kind}.json", printed("ensonify-describe", kind, "--schema")


def main():
    check = "--check" in sys.argv[2:]
    stale, files = [], 0
    for path, text in wanted_files():
        files += 1
        if path.exists() and path.read_text(encoding="utf-8") == text:
            continue
        stale.append(str(path.relative_to(ROOT)))
        if not check:
            path.write_text(text, encoding="utf-8")
    if check and stale:
        sys.exit("not what the programs print; run cmake/generate_parameters.py:\n" + "\n".join(stale))
    print(f"{files} files, {len(stale)} of them {'stale' if check else 'written'}")


main()
