"""Grid and soundings as files that other programs read."""
import numpy as np
from osgeo import gdal, osr

from ensonify_plot.grid import Frame

gdal.UseExceptions()
osr.UseExceptions()

FILLER = 0  # what a row of bytes holds besides its text


def world_crs(origin: tuple | None) -> osr.SpatialReference:
    """The world's map: transverse Mercator on WGS 84 centred at the scenario's origin, scale 1. Without an origin a
    local frame that no map knows."""
    crs = osr.SpatialReference()
    if origin is None:
        crs.ImportFromWkt('LOCAL_CS["Ensonify world, origin not recorded",UNIT["metre",1]]')
        return crs
    latitude_deg, longitude_deg = origin
    crs.SetProjCS(f"Ensonify world at {latitude_deg:.6f} {longitude_deg:.6f}")
    crs.SetWellKnownGeogCS("WGS84")
    crs.SetTM(latitude_deg, longitude_deg, 1.0, 0.0, 0.0)
    crs.SetLinearUnits("metre", 1.0)
    return crs


def geodetic_of(origin: tuple | None, east_m, north_m) -> tuple:
    """Latitudes and longitudes on WGS 84, degrees, of places of the world; NaN without an origin."""
    if origin is None:
        return np.full(len(east_m), np.nan), np.full(len(east_m), np.nan)
    return transformed(world_crs(origin), wgs84(), east_m, north_m)


def wgs84() -> osr.SpatialReference:
    """Latitude before longitude, in degrees."""
    crs = osr.SpatialReference()
    crs.ImportFromEPSG(4326)
    return crs


def transformed(source: osr.SpatialReference, target: osr.SpatialReference, x, y) -> tuple:
    """Both coordinates of places in another reference system."""
    places = osr.CoordinateTransformation(source, target).TransformPoints(np.column_stack([x, y]))
    first, second, _ = np.array(places).reshape(-1, 3).T
    return first, second


def utm_crs(latitude_deg: float, longitude_deg: float) -> osr.SpatialReference:
    """The UTM zone of a place on WGS 84, those of south-west Norway and Svalbard [DMA1989] included."""
    zone = int((longitude_deg + 180) % 360 // 6) + 1
    if 56 <= latitude_deg < 64 and 3 <= longitude_deg < 12:
        zone = 32
    if 72 <= latitude_deg < 84 and 0 <= longitude_deg < 42:
        zone = 31 + 2 * int((longitude_deg + 3) // 12)
    crs = osr.SpatialReference()
    crs.ImportFromEPSG((32600 if latitude_deg >= 0 else 32700) + zone)
    return crs


def write_geotiff(file: str, frame: Frame, up_m, count, tvu_m, crs: osr.SpatialReference, facts: dict) -> None:
    """Band 1: mean elevation up from chart datum, NaN without soundings. Band 2: number of soundings. Band 3, unless `tvu_m` is None:
    mean predicted uncertainty."""
    driver = gdal.GetDriverByName("GTiff")
    options = ["COMPRESS=DEFLATE", "ZLEVEL=1", "TILED=YES", "BIGTIFF=IF_SAFER"]
    raster = driver.Create(file, frame.cols, frame.rows, 2 if tvu_m is None else 3, gdal.GDT_Float32, options)
    west, _, _, north = frame.extent_m
    raster.SetGeoTransform((west, frame.cell_m, 0.0, north, 0.0, -frame.cell_m))
    raster.SetProjection(crs.ExportToWkt())
    raster.SetMetadata({key: str(value) for key, value in facts.items()})
    bands = [(up_m, "elevation, m, up from chart datum (mean of accepted soundings)", "metre"),
             (count, "number of accepted soundings", "1")]
    if tvu_m is not None:
        bands.append((tvu_m, "total vertical uncertainty of a sounding, m, 95 % (mean of those predicted)", "metre"))
    for number, (values, text, unit) in enumerate(bands, start=1):
        band = raster.GetRasterBand(number)
        band.SetDescription(text)
        band.SetUnitType(unit)
        band.SetNoDataValue(float("nan"))
        band.WriteArray(np.ascontiguousarray(values[::-1], np.float32))
    raster.FlushCache()


def _digits(values: np.ndarray, decimals: int, sign: bool) -> np.ndarray:
    """Rows of ASCII: the values with so many decimals, right-aligned behind FILLER; NaN is nothing else."""
    known = np.isfinite(values)
    scaled = np.rint(np.abs(np.where(known, values, 0)) * 10.0**decimals).astype(np.int64)
    negative = sign and (values < 0) & (scaled > 0)
    largest = max(int(scaled.max(initial=0)), 10**decimals)
    width = len(str(largest))
    text = np.full((len(values), width + 1 + bool(decimals)), FILLER, np.uint8)
    column = text.shape[1] - 1
    rest = scaled
    first = np.full(len(values), column)
    for place in range(width):
        if decimals and place == decimals:
            text[:, column] = ord(".")
            column -= 1
        quotient = rest // 10
        shown = (rest > 0) | (place <= decimals)
        text[shown, column] = (rest - quotient * 10)[shown] + ord("0")
        first[shown] = column
        rest = quotient
        column -= 1
    if sign:
        rows = np.flatnonzero(negative)
        text[rows, first[rows] - 1] = ord("-")
    text[~known] = FILLER
    return text


def write_csv(file: str, columns: list) -> None:
    """`columns` holds (name, values, decimals) or (name, indices, [texts])."""
    length = len(columns[0][1])
    cells = {name: _cells(how) for name, _, how in columns if isinstance(how, list)}
    with open(file, "wb") as stream:
        stream.write(",".join(name for name, _, _ in columns).encode() + b"\n")
        for begin in range(0, length, 200_000):
            part = slice(begin, begin + 200_000)
            blocks = []
            for name, values, how in columns:
                block = cells[name][values[part]] if name in cells else _digits(values[part], how, True)
                blocks += [block, np.full((len(block), 1), ord(","), np.uint8)]
            blocks[-1][:] = ord("\n")
            text = np.hstack(blocks)
            stream.write(text[text != FILLER].tobytes())


def _cells(texts: list) -> np.ndarray:
    """Texts as rows of bytes, UTF-8, quoted where a cell must be [RFC 4180], behind them FILLER."""
    quoted = [('"' + text.replace('"', '""') + '"' if set(text) & set(',"\r\n') else text).encode() for text in texts]
    width = max(map(len, quoted), default=0) or 1
    return np.frombuffer(b"".join(cell.ljust(width, bytes([FILLER])) for cell in quoted), np.uint8).reshape(-1, width)
