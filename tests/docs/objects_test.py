"""The shipped solids are what make.py writes: closed surfaces that face outwards, a metre across, with their ground at z = 0."""
import collections
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

FOLDER = pathlib.Path(os.environ["ENSONIFY_SOURCE"]) / "scenarios" / "objects"


def read(file):
    rows = [line.split() for line in file.read_text(encoding="utf-8").splitlines()]
    places = np.array([row[1:] for row in rows if row[0] == "v"], dtype=float)
    return places, np.array([row[1:] for row in rows if row[0] == "f"], dtype=int) - 1


class Objects(unittest.TestCase):
    def test_files_are_what_the_script_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["/usr/bin/python3", str(FOLDER / "make.py"), folder], check=True, timeout=60)
            made = {path.name: path.read_text(encoding="utf-8") for path in pathlib.Path(folder).iterdir()}
        self.assertEqual(made, {path.name: path.read_text(encoding="utf-8") for path in FOLDER.glob("*.obj")})

    def test_they_are_closed_with_outward_normals(self):
        for file in FOLDER.glob("*.obj"):
            with self.subTest(file.name):
                places, faces = read(file)
                # Each edge once in either direction.
                edges = collections.Counter((face[k], face[(k + 1) % 3]) for face in faces for k in range(3))
                self.assertTrue(all(count == 1 and edges[b, a] == 1 for (a, b), count in list(edges.items())))
                a, b, c = (places[faces[:, k]] for k in range(3))
                volume_m3 = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
                self.assertTrue(0.05 < volume_m3 < 0.4, volume_m3)
                low, high = places.min(axis=0), places.max(axis=0)
                self.assertTrue(0.95 < (high - low)[:2].max() < 1.2, high - low)
                self.assertTrue(low[2] < 0 < high[2])

    def test_the_colony_overhangs(self):
        places, faces = read(FOLDER / "colony.obj")
        a, b, c = (places[faces[:, k]] for k in range(3))
        normal = np.cross(b - a, c - a)
        under = (normal[:, 2] < 0) & (np.minimum(np.minimum(a, b), c)[:, 2] > 0.1)
        self.assertGreater(-0.5 * normal[under, 2].sum(), 0.3)  # m2 of its underside, seen from below: pi 0.5^2 less the stalk


if __name__ == "__main__":
    unittest.main()
