"""Ten kilometres over ten billion posts: how long until the first ping, what stays in memory, and what a large world costs."""
import os
import pathlib
import subprocess
import tempfile
import time

from harness import ROOT, row

# A square of rock 20 m deep; all of the swath fits on one tile of it.
WORLD = """
ensonify: scenario/1
site: {{ name: Square, latitude_deg: 57.5, longitude_deg: -1.5 }}
seed: 10
seabed:
  kind: layers
  post_spacing_m: 0.1
  size_m: [{side_m}, {side_m}]
  layers: {{ plane: {{ plane: {{ depth_m: 20 }} }}, rock: {{ spectral: {{ rms_m: 0.3, outer_scale_m: 50 }} }} }}
vehicles: {{ boat: {{ turning_radius_m: 30, mountings: {{ bow: {{ actual: {{ position_m: [1.5, 0.2, 0.8] }} }} }} }} }}
mission: {{ speed_mps: 4, run_in_m: 0, runlines: [{{ from_m: [-45, 0], to_m: [45, 0] }}] }}
"""
PINGS_HZ = 5
LAUNCH = """
ensonify: launch/1
scenario: world.yaml
clock: {{ rate: free }}
duration_s: {seconds}
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
  bow:   {{ run: multibeam, config: {{ ping_rate_hz: {pings_hz}, amplitude_every: 1000, quality: 0.25 }} }}
"""


def descendants(pid):
    children = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    return [pid] + [d for child in children for d in descendants(int(child))]


class Watched:
    """A run, watched from outside: wall time, and of each program the most memory and the processor time."""

    def __init__(self, b, launch, *options):
        self.peak_mb, self.cpu_s = {}, {}
        with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as out:
            began = time.monotonic()
            run = subprocess.Popen([str(b.build / "bin" / "ensonify-run"), str(launch), "--free", "--out", out, *map(str, options)],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            while run.poll() is None:
                self.sample(run.pid)
                time.sleep(0.05)
            self.wall_s = time.monotonic() - began
            if run.returncode != 0:
                raise RuntimeError(f"{launch}: exit {run.returncode}: {run.stderr.read()}")

    def sample(self, pid):
        try:
            for process in descendants(pid):
                name = pathlib.Path(os.readlink(f"/proc/{process}/exe")).name
                status = pathlib.Path(f"/proc/{process}/status").read_text().split("VmHWM:")
                times = pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
                self.peak_mb[name] = max(self.peak_mb.get(name, 0.0), 1.024e-3 * float(status[1].split()[0]))
                self.cpu_s[name] = (int(times[11]) + int(times[12])) / os.sysconf("SC_CLK_TCK")
        except (OSError, IndexError):
            pass  # one has just ended


def bench_drive(b):
    survey = ROOT / "launch" / "survey_10km.yaml"
    rows = []
    # The first soundings come at 0.29 s of 0.4. Cold, nothing of the seabed is on disk; warm, what the start before kept.
    cold_s, warm_s = zip(*(starts_s(b, survey) for _ in range(b.repeat)))
    for name, start_s, most_s in (("cold", min(cold_s), 5), ("warm", min(warm_s), 1)):
        rows.append(row(f"survey_10km, {name}: from nothing to the first ping's soundings", start_s, "s", target=f"<= {most_s}",
                        ok=start_s <= most_s))
    # Its expectations are those of the launch: no ping lost, none empty.
    drive = Watched(b, survey, *(["--arg", "seconds=120"] if b.quick else []), "--arg", "pings_hz=0.5", "--set",
                    "pager.cache_mb=0")
    for program in ("ensonify-terrain_pager", "ensonify-multibeam"):
        peak = drive.peak_mb[program]
        rows.append(row(f"survey_10km: {program} at its most", peak, "MB", target="<= 1500", ok=peak <= 1500))
    rows.append(row(f"survey_10km: {480 if b.quick else 9960} m, 8 m between pings", drive.wall_s, "s"))
    large, small = cost_per_ping_s(b, 10_000), cost_per_ping_s(b, 102.4)
    rows.append(row("processor time of a ping and its paging over 10^10 posts", 1e3 * large, "ms", 1e3 * small,
                    large / small, "<= 1.2 x that over 10^6", large <= 1.2 * small))
    return rows


def starts_s(b, survey):
    """Wall time of a cold start and of a warm one, until all processes have ended again. Nothing else runs meanwhile."""
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as folder:
        def took_s(seconds):
            began = time.monotonic()
            subprocess.run([str(b.build / "bin" / "ensonify-run"), str(survey), "--free", "--quiet", "--out", f"{folder}/out",
                            "--arg", f"seconds={seconds}"], check=True, env={**os.environ, "XDG_CACHE_HOME": f"{folder}/cache"})
            return time.monotonic() - began
        cold_s = took_s(0.4)
        took_s(3)  # so long that what a start makes ahead of need is there too
        return cold_s, took_s(0.4)


def cost_per_ping_s(b, side_m):
    """Of pager and head, once they are under way: what 20 s cost more than 5 s."""
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-") as folder:
        world, launch = pathlib.Path(folder) / "world.yaml", pathlib.Path(folder) / "launch.yaml"
        world.write_text(WORLD.format(side_m=side_m))
        cost_s = []
        for seconds in (5, 20):
            launch.write_text(LAUNCH.format(seconds=seconds, pings_hz=PINGS_HZ))
            run = Watched(b, launch)
            cost_s.append(run.cpu_s["ensonify-terrain_pager"] + run.cpu_s["ensonify-multibeam"])
        return (cost_s[1] - cost_s[0]) / (15 * PINGS_HZ)
