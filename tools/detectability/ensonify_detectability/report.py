"""What was measured, as text, tables and pictures."""
import csv
import json
import math
import shlex
from pathlib import Path

from matplotlib.figure import Figure
from PIL import Image, ImageDraw


def text(whole: dict, axes: dict) -> str:
    least, most = whole["interval"]
    lines = [f"{whole['pictures']} pictures, {whole['things']} things, {1e6 * whole['km2']:.0f} m2; threshold {whole['threshold']:.2f}"]
    if whole["things"]:
        lines.append(f"  probability of detection  {whole['probability']:.2f}  ({least:.2f} to {most:.2f})")
    alarms = f"  false alarms              {whole['false_alarms']}: {whole['false_alarms_per_picture']:.3f} a picture"
    if whole["km2"]:
        low, high = whole["false_alarms_per_km2_interval"]
        alarms += f", {whole['false_alarms_per_km2']:.0f} a km2 ({low:.0f} to {high:.0f})"
    lines.append(alarms)
    for axis, rows in axes.items():
        lines.append(f"  {axis}")
        lines += [f"    {span(row):<26} {row['found']:>5} of {row['things']:<5} " + ("" if row["probability"] is None else
                  f"{row['probability']:.2f}  ({row['interval'][0]:.2f} to {row['interval'][1]:.2f})") for row in rows]
    return "\n".join(lines)


def span(row: dict) -> str:
    return plain(row["from"]) if row["from"] == row["to"] else f"{plain(row['from'])} to {plain(row['to'])}"


def plain(value) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def write(folder: Path, whole: dict, axes: dict, curve: list, things: list, missed: list, words: list) -> None:
    """report.json, limits.csv, curve.csv, things.csv, missed.csv with the command that shows each again, limits.png."""
    folder.mkdir(parents=True, exist_ok=True)
    content = {"whole": whole, "against": axes, "curve": curve}
    (folder / "report.json").write_text(json.dumps(finite(content), indent=1) + "\n")
    _table(folder / "limits.csv", ["axis", "from", "to", "things", "found", "probability", "least", "most"],
           [[row["axis"], row["from"], row["to"], row["things"], row["found"], row["probability"], *row["interval"]] for rows in axes.values() for row in rows])
    _table(folder / "curve.csv", ["threshold", "probability", "least", "most", "false_alarms_per_picture", "false_alarms_per_km2"],
           [[of["threshold"], of["probability"], *of["interval"], of["false_alarms_per_picture"], of["false_alarms_per_km2"]] for of in curve])
    columns = sorted({name for _, thing, _ in things for name in thing.known})
    _table(folder / "things.csv", ["picture", "seed", "thing", "score", *columns],
           [[picture.name, picture.seed, thing.name, "" if math.isinf(score) else score, *(thing.known.get(name, "") for name in columns)]
            for picture, thing, score in things])
    _table(folder / "missed.csv", ["picture", "seed", "thing", "again"],
           [[picture.name, picture.seed, thing.name, shlex.join([*words, "--only", str(picture.number), "-o", f"again_{picture.number}"])]
            for picture, thing in missed])
    drawn(whole, axes, curve).savefig(folder / "limits.png", dpi=110)


def finite(value):
    """For JSON: infinities and what is no number as null."""
    if isinstance(value, dict):
        return {key: finite(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _table(file: Path, columns: list, rows: list) -> None:
    with open(file, "w", newline="", encoding="utf-8") as to:
        writer = csv.writer(to)
        writer.writerow(columns)
        writer.writerows(rows)


def drawn(whole: dict, axes: dict, curve: list) -> Figure:
    """Detection over false alarms, and against each axis."""
    count = 1 + len(axes)
    wide = min(count, 3)
    figure = Figure(figsize=(4.6 * wide, 3.6 * math.ceil(count / wide)), layout="constrained")
    places = figure.subplots(math.ceil(count / wide), wide, squeeze=False).flat
    _curve(next(places), whole, curve)
    for (axis, rows), place in zip(axes.items(), places):
        _axis(place, axis, [row for row in rows if row["things"]])
    for place in places:
        place.set_axis_off()
    return figure


def _curve(place, whole: dict, curve: list) -> None:
    rate = [of["false_alarms_per_picture"] for of in curve]
    place.fill_between(rate, [of["interval"][0] for of in curve], [of["interval"][1] for of in curve], alpha=0.2, linewidth=0)
    place.plot(rate, [of["probability"] for of in curve])
    if whole["probability"] is not None:
        place.plot([whole["false_alarms_per_picture"]], [whole["probability"]], "o")
    place.set_xscale("symlog", linthresh=0.1)
    place.set(xlabel="false alarms a picture", ylabel="probability of detection", ylim=(-0.02, 1.02), xlim=(0, max([1, *rate])))


def _axis(place, axis: str, rows: list) -> None:
    share = [row["probability"] for row in rows]
    errors = [[of - row["interval"][0] for of, row in zip(share, rows)], [row["interval"][1] - of for of, row in zip(share, rows)]]
    if all(row["from"] != row["to"] for row in rows):
        middles = [0.5 * (row["from"] + row["to"]) for row in rows]
        halves = [0.5 * (row["to"] - row["from"]) for row in rows]
        place.errorbar(middles, share, yerr=errors, xerr=halves, fmt="o", capsize=3)
    else:
        place.errorbar(range(len(rows)), share, yerr=errors, fmt="o", capsize=3)
        place.set_xticks(range(len(rows)), [span(row) for row in rows], rotation=30, ha="right")
    place.set(xlabel=axis, ylim=(-0.02, 1.02))


def picture(of, boxes, scores, threshold: float) -> Image.Image:
    """A picture with its things (blue) and finds (orange)."""
    image = Image.fromarray(of.grey).convert("RGB")
    pen = ImageDraw.Draw(image)
    for thing in of.things():
        pen.rectangle([float(edge) for edge in thing.box], outline=(80, 160, 255))
        pen.text((thing.box[0], thing.box[3] + 1), str(thing.known["class"]), fill=(80, 160, 255))
    for box, score in zip(boxes, scores):
        if score >= threshold:
            pen.rectangle([float(edge) for edge in box], outline=(255, 150, 0))
            pen.text((box[0], max(box[1] - 11, 0)), f"{score:.2f}", fill=(255, 210, 0))
    return image
