"""What labels cost a head: its processor time in one and the same run with and without them, in turns."""
import statistics

from harness import row

RUNS = {"sidescan over objects": "side", "imaging head before targets": "eye"}


def bench_labels(b):
    """Masks and shadows over the head without labels; energies over it without energies, in pings without labels."""
    rows = []
    for what, head in RUNS.items():
        def head_s(labels):
            report = b.launch(f"labels_{head}", "--arg", f"labels={labels}")
            return next(one["cpu_s"] for one in report["processes"] if one["name"] == head), report["messages"]["pings"]

        times = [[head_s(labels) for labels in ("none", "masks", "energies")] for _ in range(b.repeat)]
        assert len({pings for one in times for _, pings in one}) == 1, f"{what}: not the same run"
        none = statistics.median(one[0][0] for one in times)
        for label, ratios, most in (("masks", [masks / without for (without, _), (masks, _), _ in times], 1.15),
                                    ("energies", [1 + (both - masks) / without for (without, _), (masks, _), (both, _) in times], 2.0)):
            value = statistics.median(ratios)
            rows.append(row(f"{what}: {label}, over the head without", value * none, "s", none, value, target=f"at most {most}",
                            ok=value <= most))
    return rows
