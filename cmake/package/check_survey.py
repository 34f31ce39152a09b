"""Sees that a survey's folder holds what its summary lists, and that each picture shows something.
     check_survey.py FOLDER"""
import json
import pathlib
import sys

import matplotlib.image
from osgeo import gdal

gdal.UseExceptions()
folder = pathlib.Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
assert summary["whole_record"], "the record was cut short"
pictures = [folder / name for name in summary["files"] if name.endswith(".png")]
assert pictures, summary["files"]
for name in summary["files"]:
    assert (folder / name).stat().st_size > 0, f"{name} is empty"
for picture in pictures:
    pixels = matplotlib.image.imread(picture)
    assert min(pixels.shape[:2]) > 200 and pixels.std() > 0.05, f"{picture}: {pixels.shape}, spread {pixels.std():.3f}"
for name in summary["files"]:
    if name.endswith(".tif"):
        raster = gdal.Open(str(folder / name))  # its bands do not keep it alive
        minimum, maximum = raster.GetRasterBand(1).ComputeRasterMinMax()
        print(f"{name}: {minimum:.2f} to {maximum:.2f}")
print(f"{len(pictures)} pictures, {len(summary['files'])} files")
