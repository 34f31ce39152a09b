#!/usr/bin/python3
"""Draws the mesh of one ping of an irregular mesh, for docs/physics/mesh/irregular-meshes.md.

    docs/physics/draw/irregular.py build/release/bin
"""
import pathlib
import subprocess
import sys
import tempfile

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot as plt

PICTURES = pathlib.Path(__file__).resolve().parents[1] / "pictures"
SIDE_M, VERTICES = 120, 20000


def scattered_survey(path: pathlib.Path) -> int:
    """A TIN of points at random places over hills and a few rocks; how many triangles it has."""
    rng = np.random.default_rng(3)
    x, y = rng.uniform(-SIDE_M / 2, SIDE_M / 2, (2, VERTICES)).round(3)
    z = -20 + 1.5 * np.sin(x / 9) * np.cos(y / 14) + 0.05 * rng.standard_normal(VERTICES)
    for rock_x, rock_y, height in zip(*rng.uniform(-50, 50, (2, 40)), rng.uniform(0.5, 2, 40)):
        z += height * np.exp(-((x - rock_x) ** 2 + (y - rock_y) ** 2) / (2 * height**2))
    triangles = matplotlib.tri.Triangulation(x, y).triangles
    with path.open("w", encoding="utf-8") as file:
        file.writelines(f"v {a} {b} {c:.3f}\n" for a, b, c in zip(x, y, z))
        file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles)
    return len(triangles)


def read_obj(path: pathlib.Path):
    vertices, groups, group = [], {"source": [], "moved": []}, None
    for line in path.read_text(encoding="utf-8").splitlines():
        kind, *words = line.split()
        if kind == "v":
            vertices.append([float(word) for word in words])
        elif kind == "g":
            group = groups[words[0]]
        else:
            group.append([int(word) - 1 for word in words])
    return np.array(vertices), groups


def main() -> None:
    terrain = pathlib.Path(sys.argv[1]).resolve() / "ensonify-terrain"
    with tempfile.TemporaryDirectory() as folder:
        mesh, ping = pathlib.Path(folder) / "survey.obj", pathlib.Path(folder) / "ping.obj"
        triangles = scattered_survey(mesh)
        subprocess.run([terrain, "lod", mesh, "--at", "5", "-5", "0", "--heading", "30", "--swath", "120", "--range", "45",
                        "--ping-out", ping], check=True, stdout=subprocess.DEVNULL)
        vertices, groups = read_obj(ping)
    figure, axes = plt.subplots(figsize=(8.0, 7.2), constrained_layout=True)
    for name, colour, label in (("moved", "#8a8a8a", "moved"), ("source", "#c2410c", "as in the source")):
        axes.triplot(vertices[:, 0], vertices[:, 1], groups[name], color=colour, linewidth=0.5, label=label)
    axes.plot(5, -5, "k+", markersize=12, markeredgewidth=2)
    axes.set(aspect="equal", xlabel="east (m)", ylabel="north (m)",
             title=f"{len(groups['source']) + len(groups['moved'])} of {triangles} triangles; head at the cross, 20 m above, heading 30 degrees")
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(dict(zip(labels, handles)).values(), dict(zip(labels, handles)).keys(), loc="lower left", framealpha=1)
    figure.savefig(PICTURES / "irregular_mesh.png", dpi=110)


if __name__ == "__main__":
    main()
