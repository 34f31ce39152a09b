"""How far above the physical limit of its ping rate each head pings in a free run, everything else included."""
import statistics

from harness import row

# Kind, slant range m, dead time s, its other parameters. The boat is 14 to 24 m above the bay.
HEADS = (
    ("multibeam", 75, 0.0005, {"auto_range": "false", "range_m": 75, "ping_rate_hz": 100, "amplitude_every": 1000}),
    ("sidescan", 100, 0.001, {"ping_rate_hz": 100}),
    ("forward_looking", 40, 0.001, {"range_m": 40, "tilt_deg": 25, "ping_rate_hz": 100}),
    ("scanning", 40, 0.02, {"range_m": 40, "tilt_deg": 25, "ping_rate_hz": 200}),
    ("echosounder", 100, 0.001, {"ping_rate_hz": 100}),
)


def bench_heads(b):
    """Sim time over wall time of a head that pings as fast as 2 R / c and its dead time allow."""
    rows = []
    seconds = 10 if b.quick else 30
    for kind, range_m, dead_time_s, parameters in HEADS:
        limit_hz = 1 / (2 * range_m / 1500 + dead_time_s)
        options = ["--arg", f"kind={kind}", "--arg", f"seconds={seconds}"]
        for key, value in parameters.items():
            options += ["--set", f"bow.{key}={value}"]

        def factor():
            report = b.launch("head", *options)
            pings = report["messages"]["pings"]
            assert abs(pings - limit_hz * seconds) <= 0.03 * limit_hz * seconds + 2, (kind, pings, limit_hz * seconds)
            return report["sim_s"] / report["wall_s"]

        value = statistics.median(factor() for _ in range(b.repeat))
        rows.append(row(f"{kind}, {range_m} m: over its limit of {limit_hz:.1f} pings/s", value, "x"))
    return rows
