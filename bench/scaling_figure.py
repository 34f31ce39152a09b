"""The figure of docs/performance.md: what a ping costs, out of the rows of bench/scaling_bench.py."""
import pathlib

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

FILE = pathlib.Path(__file__).resolve().parent.parent / "docs/pictures/scaling.svg"
AXES = {"quality": "thousand rays of a ping", "beams": "beams", "posts": "posts of the seabed", "depth, m": "depth, a third of the range, m",
        "heads": "heads in one launch", "cores": "cores"}
BY_RAYS = {"quality", "depth, m"}  # where their number changes: the cost of one is drawn too


def series(points, against):
    """x, cost of a ping (ms) and its rays, rising; against quality x is the number of rays."""
    chosen = [point for point in points if point["against"] == against]
    return sorted((point["rays"] if against == "quality" else point["x"], point["ping_ms"], point["rays"]) for point in chosen)


def draw_panel(axis, against, points):
    x, cost_ms, rays = zip(*series(points, against))
    if against == "quality":
        x = [1e-3 * count for count in x]
    axis.plot(x, cost_ms, "o-", markersize=3)
    axis.set(xlabel=AXES[against], ylabel=f"{'wall' if against == 'cores' else 'processor'} time of a ping, ms", ylim=(0, 1.15 * max(cost_ms)))
    if against == "posts":
        axis.set_xscale("log")
        axis.minorticks_off()
    if against in ("heads", "cores"):
        axis.set_xticks(x)
    axis.grid(alpha=0.3)
    if against in BY_RAYS:
        of_a_ray = axis.twinx()
        ray_ns = [1e6 * cost / count for cost, count in zip(cost_ms, rays)]
        of_a_ray.plot(x, ray_ns, "s--", color="C1", markersize=3)
        of_a_ray.set_ylabel("of a ray, ns (dashed)", color="C1")
        of_a_ray.set_ylim(0, 1.15 * max(ray_ns))


def draw(points):
    plt.rcParams.update({"svg.hashsalt": "scaling", "svg.fonttype": "none", "font.size": 8})
    figure, axes = plt.subplots(2, 3, figsize=(9, 4.5), constrained_layout=True)
    for axis, against in zip(axes.flat, AXES):
        draw_panel(axis, against, points)
    figure.savefig(FILE, metadata={"Date": None})
    plt.close(figure)
