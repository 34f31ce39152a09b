"""What the tests of `ensonify terrain import` share."""
import json
import math
import subprocess

from support import BIN, SystemTest

try:
    from osgeo import gdal, osr
    gdal.UseExceptions()
except ImportError:
    gdal = osr = None


def terrain(*words, text=None):
    return subprocess.run([BIN / "ensonify-terrain", *map(str, words)], capture_output=True, text=True, input=text, timeout=200)


def world(origin):
    """The scenario's map, for GDAL."""
    return f"+proj=tmerc +lat_0={origin['latitude_deg']} +lon_0={origin['longitude_deg']} +k=1 +ellps=WGS84 +units=m"


class Import(SystemTest):
    def run_import(self, *words, name="tiles"):
        folder = self.folder / name
        done = terrain("import", *words, "--out", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(terrain("verify", folder).returncode, 0)
        self.assertTrue(done.stdout)
        return folder, json.loads((folder / "import.json").read_text())

    def refused(self, *words, causes, name="refused"):
        done = terrain("import", *words, "--out", self.folder / name)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        for cause in causes:
            self.assertIn(cause, done.stderr)
        self.assertFalse((self.folder / name / "tileset.yaml").exists())

    def heights(self, folder):
        """The set as GDAL reads it, with the posts' places."""
        raster = gdal.Open(str(folder / "seabed.vrt"))
        west, step, _, north, _, _ = raster.GetGeoTransform()
        heights = raster.ReadAsArray()
        return heights, west, north, step

    def warped(self, path, folder, report, **options):
        """What gdalwarp makes of a file on the posts of a set, each from the cells around it and no others."""
        heights, west, north, step = self.heights(folder)
        rows, columns = heights.shape
        kind = gdal.GRA_Bilinear if "resampleAlg" not in options else options.pop("resampleAlg")
        memory = gdal.Warp("", str(path), format="MEM", dstSRS=world(report["origin"]), resampleAlg=kind, dstNodata=math.nan,
                           outputType=gdal.GDT_Float64, errorThreshold=0, warpOptions=["XSCALE=1", "YSCALE=1"], width=columns, height=rows,
                           outputBounds=(west, north - rows * step, west + columns * step, north), **options)
        return heights, memory.GetRasterBand(1).ReadAsArray()
