#!/usr/bin/env python3
"""Does what the pages on adding a component and a head say, in a folder of its own: stage_recipe.py SOURCE STAGE

Runs each page's `sh` blocks on copies of the files that they name and writes its yaml files. Of
components/CMakeLists.txt only the lines that the pages add are left, so that the new components alone are added to the
build that called us. Files that did not change keep their times.
"""
import filecmp
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


# Page, example to copy, component made of it, and the line that names it to the build.
RECIPES = (
    ("docs/manual/adding-a-component.md", "gyro", "compass", "ensonify_component(compass CompassNode)"),
    ("docs/manual/agent-in-cpp.md", "altitude_agent", "my_agent", "ensonify_component(my_agent MyAgentNode)"),
    ("docs/adding-a-head.md", "profiler", "pencil", "ensonify_component(pencil PencilNode)"),
)


def follow(source, stage):
    listing = source / "components/CMakeLists.txt"
    (stage / "components").mkdir()
    shutil.copy(listing, stage / "components")
    for page, example, component, _ in RECIPES:
        follow_page(source / page, source / "examples" / example, component, stage)

    before = listing.read_text().splitlines()
    added = [line for line in (stage / "components/CMakeLists.txt").read_text().splitlines() if line not in before]
    if sorted(added) != sorted(line for *_, line in RECIPES):
        sys.exit(f"the recipes added these lines to components/CMakeLists.txt: {added}")
    (stage / "components/CMakeLists.txt").write_text("\n".join(added) + "\n")


def files_in(row):
    """The files that a table's row names: `config.h/.cpp` are two."""
    for name in re.findall(r"`([^`]+)`", row):
        stem, *more = name.split("/.")
        yield stem
        yield from (f"{stem.rpartition('.')[0]}.{ending}" for ending in more)


def follow_page(page, example, component, stage):
    shutil.copytree(example, stage / "examples" / example.name)
    text = page.read_text()
    commands = re.findall(r"^```sh\n(.*?)^```", text, re.M | re.S)
    for command in commands:
        subprocess.run(["sh", "-e", "-c", command], cwd=stage, check=True)
    files = re.findall(r"^`([^`\s]+\.yaml)`[^\n]*:\n\n```yaml\n(.*?)^```", text, re.M | re.S)
    for name, content in files:
        (stage / name).parent.mkdir(parents=True, exist_ok=True)
        (stage / name).write_text(content)
    if len(commands) != 2 or len(files) != 2:
        sys.exit(f"the page has {len(commands)} sh blocks and {len(files)} yaml files; 2 and 2 are expected")
    made = {file.name for file in (stage / "components" / component).iterdir()}
    named = {name for row in re.findall(r"^\| (`.+?) \|", text, re.M) for name in files_in(row)}
    if not made <= named:
        sys.exit(f"the page's table does not name {sorted(made - named)}")
    for file in (stage / "components" / component).iterdir():
        if example.name in file.read_text().lower() or example.name in file.name:
            sys.exit(f"the recipe left the template's name in {file.name}")


def main():
    source, target = map(pathlib.Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        stage = pathlib.Path(folder)
        follow(source, stage)
        wanted = {file.relative_to(stage) for file in stage.rglob("*") if file.is_file()}
        for file in [f for f in target.rglob("*") if f.is_file()]:
            if file.relative_to(target) not in wanted:
                file.unlink()
        for name in wanted:
            if not (target / name).is_file() or not filecmp.cmp(stage / name, target / name, shallow=False):
                (target / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(stage / name, target / name)


if __name__ == "__main__":
    main()
