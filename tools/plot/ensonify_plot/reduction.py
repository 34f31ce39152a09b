"""Soundings reduced to chart datum without trusting the estimate's heights: by tide gauge, or by satellite. With true inputs both give
the same depth.

A sounding's height is the estimate's height at transmission less what the head found below it. Here the first is taken off and put
in anew: the height of the vehicle's reference point, m, up from chart datum,

    by gauge      water level - settlement(speed over ground) + heave
    by satellite  height above the geoid + undulation - chart datum above the ellipsoid
"""
import dataclasses
import datetime

import numpy as np
from osgeo import gdal, osr

import ensonify
from ensonify_plot.files import world_crs
from ensonify_plot.errors import UserError
from ensonify_plot.survey import Survey

gdal.UseExceptions()
osr.UseExceptions()


def reduce(survey: Survey, record: ensonify.Record, gauge: str | None, settlement: list, separation: str | None) -> str:
    """Soundings with heights by what was given, a gauge's file with a table (m/s, m) or a separation's; those before the first and
    after the last height are dropped. Returns how, in words. Raises UserError."""
    estimates = record.topics_of(ensonify.Estimate)
    if len(estimates) != 1:
        raise UserError(f"{record.file}: holds {len(estimates)} topics of estimate/1; to take its heights off soundings one is needed")
    estimated = [m.content for m in record.messages(estimates[0])]
    estimated_s = _seconds(estimated)
    if gauge:
        speed_mps = np.array([np.hypot(*m.velocity_enu_mps[:2]) for m in estimated])
        t_s, heave_m = _heave(record)
        height_m = water_level_m(gauge, record, t_s) - settled_m(settlement, np.interp(t_s, estimated_s, speed_mps)) + heave_m
    else:
        t_s, height_m = _heights_by_satellite(record, separation, survey.origin)
    s = survey.soundings
    anew_m = np.interp(s.t_s, t_s, height_m, left=np.nan, right=np.nan)
    estimated_m = np.interp(s.t_s, estimated_s, [m.position_enu_m[2] for m in estimated])
    known = np.isfinite(anew_m)
    if not known.any():
        raise UserError(f"{record.file}: no sounding lies between the first and the last height")
    survey.soundings = dataclasses.replace(s, up_m=s.up_m + (anew_m - estimated_m)).chosen(known)
    return "by tide gauge" if gauge else "by satellite"


def settlement_of(text: str) -> list:
    """"0:0,4:0.06" as rows of speed (m/s, rising) and how much lower the reference point runs (m)."""
    rows = [tuple(float(word) for word in pair.split(":")) for pair in text.split(",")]
    speeds = [row[0] for row in rows]
    if any(len(row) != 2 for row in rows) or sorted(set(speeds)) != speeds or not np.isfinite(rows).all():
        raise ValueError
    return rows


def settled_m(table: list, speed_mps: np.ndarray) -> np.ndarray:
    """Straight lines between the rows of a table, the last beyond it."""
    return np.interp(speed_mps, *np.array(table or [(0.0, 0.0)]).T)


def water_level_m(gauge: str, record: ensonify.Record, t_s: np.ndarray) -> np.ndarray:
    """Above chart datum at sim times, from lines "2025-06-01T12:00:00Z,1.35"; # begins a remark, the first line may be names."""
    rows = []
    with open(gauge, encoding="utf-8") as lines:
        for number, line in enumerate(lines, 1):
            if not line.strip() or line.startswith("#"):
                continue
            row = _reading(line)
            if row and (not rows or row[0] > rows[-1][0]):
                rows.append(row)
            elif number > 1:
                raise UserError(f"{gauge}:{number}: is no reading later than those before; allowed: a UTC time and a height in m, "
                                "2025-06-01T12:00:00Z,1.35")
    utc_s = record.utc_start_ns * 1e-9 + t_s
    if not rows or rows[0][0] > utc_s[0] or rows[-1][0] < utc_s[-1]:
        raise UserError(f"{gauge}: does not cover the survey; allowed: readings from before its start to after its end")
    return np.interp(utc_s, *np.array(rows).T)


def _reading(line: str) -> tuple | None:
    """Seconds since 1970 and metres, or nothing."""
    words = line.replace(";", ",").replace("\t", ",").split(",")
    try:
        time, height_m = datetime.datetime.fromisoformat(words[0].strip()), float(words[1])
    except (ValueError, IndexError):
        return None
    return (time.timestamp(), height_m) if time.tzinfo and np.isfinite(height_m) else None


def grid_at(path: str, east_m: np.ndarray, north_m: np.ndarray, origin: tuple | None) -> np.ndarray:
    """A grid that GDAL reads, at places of the world: bilinear between the centres of its cells. `origin`: the world's, latitude and
    longitude in degrees."""
    try:
        grid = gdal.Open(path)
        values = grid.GetRasterBand(1).ReadAsArray().astype(float)
    except RuntimeError as fault:
        raise UserError(f"{path}: cannot be read: {fault}") from None
    values[values == grid.GetRasterBand(1).GetNoDataValue()] = np.nan
    x, y = _cells_of(grid, path, east_m, north_m, origin)
    i, j = (np.clip(np.floor(v), 0, n - 2).astype(int) for v, n in ((x, values.shape[1]), (y, values.shape[0])))
    u, v = np.clip(x - i, 0, 1), np.clip(y - j, 0, 1)
    found = (1 - v) * ((1 - u) * values[j, i] + u * values[j, i + 1]) + v * ((1 - u) * values[j + 1, i] + u * values[j + 1, i + 1])
    bare = ~np.isfinite(found) | (np.abs(x - i - 0.5) > 1) | (np.abs(y - j - 0.5) > 1)
    if bare.any():
        raise UserError(f"{path}: has no value at ({east_m[bare][0]:.1f}, {north_m[bare][0]:.1f}) m; allowed: a grid over the whole "
                        "survey, in metres of the world or with a coordinate system")
    return found


def _cells_of(grid: gdal.Dataset, path: str, east_m: np.ndarray, north_m: np.ndarray, origin: tuple | None) -> tuple:
    """Column and row, whole numbers at cells' centres. A grid without a coordinate system is in metres of the world."""
    x, y, crs = east_m, north_m, grid.GetSpatialRef()
    if crs is not None:
        if origin is None:
            raise UserError(f"{path}: has a coordinate system, and the record does not state where the world is (no chart/1)")
        crs.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
        into = osr.CoordinateTransformation(world_crs(origin), crs)
        x, y, _ = np.array(into.TransformPoints(np.column_stack([east_m, north_m]))).T
    west, width, _, top, _, height = grid.GetGeoTransform()
    return (x - west) / width - 0.5, (y - top) / height - 0.5


def _heave(record: ensonify.Record) -> tuple:
    """Sim times and heave, that which knows what came after where it was recorded."""
    for kind in (ensonify.DelayedHeave, ensonify.Attitude):
        if topics := record.topics_of(kind):
            messages = [m.content for m in record.messages(topics[0])]
            return _seconds(messages), np.array([m.heave_m for m in messages])
    raise UserError(f"{record.file}: holds neither delayed_heave/1 nor attitude/1, so there is no heave")


def _heights_by_satellite(record: ensonify.Record, separation: str, origin: tuple | None) -> tuple:
    topics = record.topics_of(ensonify.Position)
    if not topics:
        raise UserError(f"{record.file}: holds no position/1, so there are no heights by satellite")
    fixes = [m.content for m in record.messages(topics[0])]
    east_m, north_m = np.array([fix.position_enu_m[:2] for fix in fixes]).T
    above_ellipsoid_m = np.array([fix.height_above_geoid_m + fix.geoid_above_ellipsoid_m for fix in fixes])
    return _seconds(fixes), above_ellipsoid_m - grid_at(separation, east_m, north_m, origin)


def _seconds(messages: list) -> np.ndarray:
    return np.array([m.stamp_ns for m in messages]) * 1e-9
