#!/usr/bin/env python3
"""Writes docs/performance.md, and its figure, out of what `bench/run.py --json FILE` measured.

    bench/run.py --only table,whole,scaling --json table.json && bench/publish.py table.json > docs/performance.md
"""
import argparse
import json
import pathlib

from scaling_figure import draw, series

HEAD = """# How fast it is

Pings, or images, a second of wall time in a free run: vehicle, navigation, pager and head as processes of their own, all effects on. Sim time keeps
2 R / c and the dead time, so many of these are faster than the sea allows. Windy is 5 m/s of wind, whose waves leave no path by the surface; calm has
the echoes by way of the surface. Rays are those traced in a ping. `./dev bench --only table,whole --json FILE` measures it again (bench/table_bench.py has the
configurations), `bench/publish.py FILE` writes this page, and `bench/compare.py COMMIT` holds a commit against another, in turns.

| head | sea | pings/s | goal | rays | processor time of a ping | of a ray |
|---|---|---|---|---|---|---|
"""
WHOLE = """
A whole launch in real time ({seconds} s, bench/launch/table_whole.yaml) takes {share:.0f} % of the cores (goal: 60), and {late} of its events are late (goal: none). It has a multibeam of
512 beams at 10 Hz and quality 0.25, a sidescan at 15 Hz, a forward-looking sonar of 128 beams as above at 10 Hz, and graded navigation. A recorder keeps soundings, sidescan
and every tenth image: {pings}.
"""
DEMO = """
| | x real time | goal |
|---|---|---|
"""
SCALING = """
![What a ping costs against rays, beams, posts of the seabed, depth, heads and cores](pictures/scaling.svg)

A multibeam's ping of {few:,.0f} to {many:,.0f} rays takes {least:.0f} to {most:.0f} ns of processor time a ray, and over a seabed of 10^10 posts {posts:.2f} times what it takes over 10^6.
The panels vary one thing each, from 256 beams at quality 0.5 over rock 20 m deep on posts of 0.1 m, range 60 m; that of the cores is at quality 4 (`./dev bench --only scaling`).{machine}
"""
OTHER_MACHINE = " They were measured elsewhere than the tables: {cpu}, {cores} cores, commit {commit}."
TAIL = """
**A faster picture**: `most_rays` of a head bounds the rays of a transmission; beyond it all parts give way alike. The row of 128 beams is
`{{ beams: 128, most_samples: 256, range_m: 20, most_rays: 21000 }}`. `quality` is the number of rays that cells of
resolution and facets ask for: 0.25 for a look, 1 to trust levels. `bench/equal.py` says by how much a setting differs from `quality: reference`.
{cpu}, {cores} cores, commit {commit}.{note} What each stage of a ping takes is shown by `ensonify run --profile` ([benchmarks](manual/benchmarks.md)); what made stages fast, and what
did not, is in [decisions](decisions/speed.md). Absolute times belong to a machine and its load.
"""


def scaling(points: list) -> dict:
    """What the text says of the figure."""
    rays = series(points, "quality")
    ray_ns = [1e6 * cost_ms / count for count, cost_ms, _ in rays]
    posts = series(points, "posts")
    return {"few": rays[0][0], "many": rays[-1][0], "least": min(ray_ns), "most": max(ray_ns), "posts": posts[-1][1] / posts[0][1]}


def page(results: dict, note: str) -> str:
    lines = [HEAD]
    for row in (row for row in results["rows"] if "case" in row):
        goal = f"{row['goal']}{'' if row['value'] >= row['goal'] else ' (missed)'}" if row["goal"] else ""
        lines.append(f"| {row['case']} | {row['sea']} | {row['value']:.3g} | {goal} | {row['rays']:,.0f} | "
                     f"{row['processor_ms']:.3g} ms | {1e6 * row['processor_ms'] / row['rays']:.0f} ns |\n")
    demos = [row for row in results["rows"] if "demo" in row]
    if demos:
        lines.append(DEMO)
    for row in demos:
        lines.append(f"| {row['demo']} | {row['value']:.3g} | {row['goal']}{'' if row['value'] >= row['goal'] else ' (missed)'} |\n")
    lines += [WHOLE.format(share=row["value"], **row["whole"]) for row in results["rows"] if "whole" in row]
    points = [row["scaling"] for row in results["rows"] if "scaling" in row]
    if points:
        draw(points)
        machine = results.get("scaling_machine", results["machine"])
        elsewhere = "" if machine == results["machine"] else OTHER_MACHINE.format(**machine)
        lines.append(SCALING.format(**scaling(points), machine=elsewhere))
    lines.append(TAIL.format(**results["machine"], note=f" {note}" if note else ""))
    return "".join(lines)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, nargs="+", help="JSON of bench/run.py, one or several of the same machine; that of the scaling may be of another")
    parser.add_argument("--note", default="", help="a sentence about the machine's load")
    options = parser.parse_args()
    parts = [json.loads(file.read_text()) for file in options.results]
    whole = parts[0] | {"rows": [row for part in parts for row in part["rows"]]}
    for part in parts:
        if any("scaling" in row for row in part["rows"]):
            whole["scaling_machine"] = part["machine"]
    print(page(whole, options.note), end="")
