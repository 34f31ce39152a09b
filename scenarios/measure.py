#!/usr/bin/python3
"""Writes truth.json and seabed.png of the shipped scenarios, by hand, when one of them changes.

    scenarios/measure.py build/dev/bin [NAME ...]
"""
import pathlib
import subprocess
import sys

from PIL import Image

HERE = pathlib.Path(__file__).resolve().parent
# South-west corner, and spacing and posts where they are not the seabed's own and 1024.
WINDOWS = {
    "canyon_head": ("walls=-990,-620,4,256",),
    "coral_bank": ("reef=-51,-51",),
    "harbour": ("basin=0,-100",),
    "patch_test": ("pad=-450,-60,0.5,256",),
    "ripple_field": ("dunes=20,20", "smooth=-248,-150,0.1,800"),
    "river_bank": ("bed=-28,-25,0.05,640",),
    "slope_overlap": ("middle=0,0",),
    "survey_10km": ("rock_and_sand=0,0,0.4,1024",),
    "target_field": ("mud=-400,200", "sand=200,200", "ripples=-400,-400", "rock=200,-400"),
    "trawl_scars": ("scars=-500,-100",),
}


def main() -> None:
    program, *names = sys.argv[1:]
    terrain = pathlib.Path(program).resolve() / "ensonify-terrain"
    for name in names or WINDOWS:
        folder = HERE / name
        words = [word for window in WINDOWS[name] for word in ("--window", window)]
        done = subprocess.run([terrain, "truth", folder / "scenario.yaml", *words], check=True, capture_output=True, text=True)
        (folder / "truth.json").write_text(done.stdout, encoding="utf-8")
        picture = folder / "seabed.png"
        subprocess.run([terrain, "plot", folder / "scenario.yaml", "--out", picture], check=True)
        Image.open(picture).convert("RGB").quantize(96, dither=Image.Dither.NONE).save(picture, optimize=True)


if __name__ == "__main__":
    main()
