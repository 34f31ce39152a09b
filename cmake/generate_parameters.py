"""Writes what follows from the lists of parameters: default.yaml of every component, and the table between
`<!-- parameters -->` and `<!-- /parameters -->` of its README.

  generate_parameters.py BIN_FOLDER            rewrites the files
  generate_parameters.py BIN_FOLDER --check    says which files are not what the programs print, exit code 1
"""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
MARKED = re.compile(r"(<!-- parameters -->\n).*?(<!-- /parameters -->)", re.DOTALL)


def printed(program, form):
    return subprocess.run([program, "--parameters", form], capture_output=True, text=True, check=True).stdout


def wanted_files(folder, program):
    """Path and text of each file that follows from a component's list."""
    yield folder / "default.yaml", printed(program, "yaml")
    readme = folder / "README.md"
    text, tables = MARKED.subn(lambda m: m[1] + printed(program, "table") + m[2], readme.read_text(encoding="utf-8"))
    if tables != 1:
        sys.exit(f"{readme.relative_to(ROOT)}: one pair of parameter marks is expected, {tables} are there")
    yield readme, text


def main():
    bin_folder, check = pathlib.Path(sys.argv[1]), "--check" in sys.argv[2:]
    stale, components = [], 0
    for default in sorted(ROOT.glob("components/*/default.yaml")):
        program = bin_folder / f"ensonify-{default.parent.name}"
        if "`" not in printed(program, "table"):  # it has no list: its file is written by hand
            continue
        components += 1
        for path, text in wanted_files(default.parent, program):
            if path.read_text(encoding="utf-8") == text:
                continue
            stale.append(str(path.relative_to(ROOT)))
            if not check:
                path.write_text(text, encoding="utf-8")
    if check and stale:
        sys.exit("not what the programs print; run cmake/generate_parameters.py:\n" + "\n".join(stale))
    print(f"{components} components, {len(stale)} files {'stale' if check else 'written'}")


main()
