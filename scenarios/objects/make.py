#!/usr/bin/python3
"""Writes the solids of this folder, which scenarios strew over the ground (scenarios/meshes.md): a coral colony and an armour
stone, a metre across, z up, the ground at z = 0. Invented shapes, their lumps sums of cosines.

    scenarios/objects/make.py [FOLDER]
"""
import math
import pathlib
import sys

# Radius and height from foot to top: a stalk, a plate that overhangs it, a low dome.
COLONY = [(0.20, -0.25), (0.17, 0.00), (0.16, 0.12), (0.22, 0.20), (0.38, 0.26), (0.49, 0.32), (0.50, 0.37), (0.42, 0.43), (0.26, 0.48), (0.10, 0.50)]


def colony(turn, radius, up):
    """The plate is lobed, and higher on one side."""
    lobes = 1 + 0.10 * math.cos(3 * turn + 0.4) + 0.07 * math.cos(7 * turn + 1.9)
    r = radius * (1 + (lobes - 1) * min(1, max(0, (up - 0.1) / 0.2)))
    return r * math.cos(turn), r * math.sin(turn), up + 0.10 * max(0, up) * math.cos(turn + 0.7)


def stone(turn, radius, up):
    """A block with rounded corners, longer than high."""
    corners = 1 + 0.09 * math.cos(4 * turn) + 0.07 * math.cos(3 * turn + 2.1) + 0.10 * math.cos(2 * turn + 6 * up)
    return 0.5 * radius * corners * math.cos(turn), 0.42 * radius * corners * math.sin(turn), 0.33 * up + 0.15


def text(what, profile, shape, around):
    """Rings around the z axis, and a vertex for each end; triangles face outwards."""
    places = [shape(2 * math.pi * i / around, radius, up) for radius, up in profile for i in range(around)]
    for radius, up in (profile[0], profile[-1]):
        x, y, z = (sum(c) / around for c in zip(*(shape(2 * math.pi * i / around, radius, up) for i in range(around))))
        places.append((x, y, z))
    foot, top = len(places) - 1, len(places)  # OBJ counts from 1
    faces = []
    for i in range(around):
        j = (i + 1) % around
        for ring in range(len(profile) - 1):
            a, b = 1 + ring * around, 1 + (ring + 1) * around
            faces += [(a + i, a + j, b + j), (a + i, b + j, b + i)]
        last = 1 + (len(profile) - 1) * around
        faces += [(foot, 1 + j, 1 + i), (top, last + i, last + j)]
    lines = [f"# {what}; made by make.py"]
    lines += ["v " + " ".join(f"{c:.3f}" for c in place) for place in places]
    lines += ["f " + " ".join(map(str, face)) for face in faces]
    return "\n".join(lines) + "\n"


def main() -> None:
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    folder = folder if folder.is_dir() else folder.parent
    ball = [(math.sin(polar), -math.cos(polar)) for polar in (math.pi * k / 7 for k in range(1, 7))]
    (folder / "colony.obj").write_text(text("a coral colony", COLONY, colony, 20), encoding="utf-8")
    (folder / "stone.obj").write_text(text("an armour stone", ball, stone, 12), encoding="utf-8")


if __name__ == "__main__":
    main()
