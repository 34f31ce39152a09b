"""What a seabed takes of memory: bytes of a post that pager and head hold, and a multibeam over posts of 0.1 m as a whole.

All tiles lie within the head's range, so that all their posts are resident. What a post takes is the difference between fine posts and
coarse ones, of each process at its most; at few rays, as what a ping holds grows with the facets that it sees.
"""
from harness import ROOT, row

SIDE_M, FINE_M, COARSE_M = 280, 0.1, 0.4
FEW, NORMAL = 0.05, 1  # quality


def peak_bytes(b, spacing_m, quality, lod):
    """Of pager and head, at their most."""
    report = b.launch("table", "--free", "--arg", "seconds=4", "--arg", f"scenario={ROOT / 'bench/launch/table_sand.yaml'}",
                      *(word for setting in (f"seabed.post_spacing_m={spacing_m}", f"seabed.size_m=[{SIDE_M}, {SIDE_M}]", "bow.auto_range=false", "bow.range_m=200",
                                             "bow.ping_rate_hz=2", f"bow.quality={quality}", f"bow.lod.enabled={lod}") for word in ("--set", setting)))
    assert report["messages"]["pings"] >= 8, f"{report['messages']['pings']} pings"
    return {process["name"]: 1024 * process["max_rss_kib"] for process in report["processes"]}


def posts(spacing_m):
    return round(SIDE_M / spacing_m + 1) ** 2


def post_bytes(b, lod):
    fine, coarse = (peak_bytes(b, spacing_m, FEW, lod) for spacing_m in (FINE_M, COARSE_M))
    return {name: (fine[name] - coarse[name]) / (posts(FINE_M) - posts(COARSE_M)) for name in ("pager", "bow")}


def bench_memory(b):
    of = post_bytes(b, "true")
    rows = [row(f"a resident post, level of detail on (pager {of['pager']:.1f}, multibeam {of['bow']:.1f})", sum(of.values()), "bytes", target="at most 20",
                ok=sum(of.values()) <= 20)]
    whole = post_bytes(b, "false")["bow"]
    rows.append(row("a resident post in the multibeam, level of detail off", whole, "bytes", target="at most 36", ok=whole <= 36))
    head_mb = 1e-6 * peak_bytes(b, FINE_M, NORMAL, "true")["bow"]
    return [*rows, row(f"a multibeam at quality {NORMAL} over {posts(FINE_M):,} posts of {FINE_M} m", head_mb, "MB", target="at most 500", ok=head_mb <= 500)]
