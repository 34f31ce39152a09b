"""How far above the physical limit of its ping rate each head pings in a free run, everything else included."""
import json
import statistics

from harness import ROOT, row


def bench_heads(b):
    """Sim time over wall time of each head that pings as fast as 2 R / c and its dead time allow. The boat is 14 to 24 m above the
    bay. A head's folder states in bench.json the range, the dead time and the parameters by which it does."""
    rows = []
    seconds = 10 if b.quick else 30
    for file in sorted(ROOT.glob("components/*/bench.json")):
        kind, stated = file.parent.name, json.loads(file.read_text())
        range_m = stated["range_m"]
        limit_hz = 1 / (2 * range_m / 1500 + stated["dead_time_s"])
        options = ["--arg", f"kind={kind}", "--arg", f"seconds={seconds}"]
        for key, value in stated["parameters"].items():
            options += ["--set", f"bow.{key}={value}"]

        def factor():
            report = b.launch("head", *options)
            pings = report["messages"]["pings"]
            assert abs(pings - limit_hz * seconds) <= 0.03 * limit_hz * seconds + 2, (kind, pings, limit_hz * seconds)
            return report["sim_s"] / report["wall_s"]

        value = statistics.median(factor() for _ in range(b.repeat))
        rows.append(row(f"{kind}, {range_m} m: over its limit of {limit_hz:.1f} pings/s", value, "x"))
    return rows
