#!/usr/bin/python3
"""Writes what the shipped scenarios measure and their pictures, by hand, when one of them changes.

    scenarios/measure.py build/dev/bin [NAME ...]

Of FOLDER/scenario.yaml that is FOLDER/truth.json and FOLDER/seabed.png, of FOLDER/other.yaml other.truth.json and other.png.
"""
import pathlib
import subprocess
import sys

from PIL import Image

HERE = pathlib.Path(__file__).resolve().parent
# Windows by scenario: south-west corner, and spacing and posts where they are not the seabed's own and 1024.
UNIT = ("all=-31.75,-31.75,0.25,256",)
WINDOWS = {
    "billion": ("rock_and_sand=650,-1200,0.4",),
    "canyon_head": ("walls=-990,-620,4,256",),
    "coral_bank": ("reef=-51,-51",),
    "coral_bank/inset": ("reef=-10.2,-10.2,0.02,1020",),
    "harbour": ("basin=0,-100",),
    "patch_test": ("pad=-550,-125,1,256",),
    "ripple_field": ("dunes=20,20", "smooth=-248,-150,0.1,800"),
    "river_bank": ("bed=-28,-25,0.05,640",),
    "slope_overlap": ("middle=0,0",),
    "survey_10km": ("rock_and_sand=700,-100,0.4", "mud=-3500,1500,0.4"),
    "target_field": ("mud=-400,200", "sand=200,200", "ripples=-400,-400", "rock=200,-400"),
    "trawl_scars": ("plain=-500,-250,2,256", "scars=-500,-100"),
    "unit/fbm": ("all=-128,-128",),
    **{f"unit/{case}": UNIT for case in ("plane", "ramp", "step", "sphere", "sinusoid")},
}


def main() -> None:
    program, *names = sys.argv[1:]
    terrain = pathlib.Path(program).resolve() / "ensonify-terrain"
    for name in names or WINDOWS:
        folder, _, stem = name.partition("/")
        scenario = HERE / folder / f"{stem or 'scenario'}.yaml"
        words = [word for window in WINDOWS[name] for word in ("--window", window)]
        done = subprocess.run([terrain, "truth", scenario, *words], check=True, capture_output=True, text=True)
        scenario.with_name(f"{stem}.truth.json" if stem else "truth.json").write_text(done.stdout, encoding="utf-8")
        picture = scenario.with_name(f"{stem or 'seabed'}.png")
        title = ("--title", f"{folder}, {stem}") if stem else ()
        subprocess.run([terrain, "plot", scenario, "--out", picture, *title], check=True)
        Image.open(picture).convert("RGB").quantize(96, dither=Image.Dither.NONE).save(picture, optimize=True)


if __name__ == "__main__":
    main()
