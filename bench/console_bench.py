"""What the console costs beside a run, and how old its pictures are: a fan of 512 x 2,000 at 15 Hz and a sidescan of 2 x 2,000 at 15 Hz,
a record of three seconds played in a loop."""
import os
import pathlib
import shutil
import statistics
import sys
import tempfile
import threading
import time

import numpy as np

from harness import ROOT, row

FAN, SIDE = "bow/view", "fish/view"
# A canvas with three colours and more.
SEEN = """() => { const canvas = document.querySelector('canvas.picture');
  return canvas && new Set(new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size > 2; }"""
LOADED = "performance.getEntriesByType('navigation').concat(performance.getEntriesByType('resource')).reduce((sum, entry) => sum + entry.transferSize, 0)"
PAINTED = "performance.getEntriesByName('first-paint')[0].startTime"


def bench_console(b):
    sys.path[:0] = [str(ROOT / "tests/console"), str(ROOT / "tools/plot/tests"), str(ROOT / "clients/python")]
    os.environ.setdefault("ENSONIFY_SOURCE", str(ROOT))
    os.environ["ENSONIFY_BIN"] = str(b.build / "bin")
    rows = []
    with tempfile.TemporaryDirectory(prefix="ensonify-bench-", dir="/dev/shm") as folder:
        record = written(pathlib.Path(folder) / "heads.mcap")
        for viewers, most in ((0, 0.01), (1, 0.10), (8, 0.25)):
            share, memory_mb = cost(record, viewers, 5 if b.quick else 20)
            rows.append(row(f"console: gateway with {viewers} viewers", share, "of a core", None, None, f"<= {most}", share <= most))
            most_mb = 150 + 8 * viewers
            rows.append(row(f"console: its memory with {viewers} viewers", memory_mb, "MB", None, None, f"<= {most_mb}", memory_mb <= most_mb))
        if shutil.which("chromium"):
            rows += page(record, 10 if b.quick else 60)
    return rows


def written(file):
    """Speckle, so that nothing is cheaper than it would be."""
    import ensonify
    import synthetic_heads
    random = np.random.default_rng(1)
    kept = [random.rayleigh(1e3, (512, 2000)).astype("f4") for _ in range(3)]

    def messages():
        for ping in range(45):
            stamp_ns = ping * 10**9 // 15
            shared = {"stamp_ns": stamp_ns, "ping": ping, "sample_period_s": 5e-5, "range_m": 75.0, **synthetic_heads.applied()}
            yield "bow/ping", ensonify.Ping(beam_angle_rad=np.linspace(-1.1, 1.1, 512).astype("f4"), amplitude_upa=kept[ping % 3], **shared)
            yield "fish/ping", ensonify.Ping(beam_angle_rad=np.array([-1.0, 1.0], "f4"), amplitude_upa=kept[ping % 3][:2], **shared)

    return synthetic_heads.write(file, messages())


def cost(record, viewers, seconds):
    """Share of a core, resident megabytes. Every viewer must have got every line, in order."""
    from console import Console
    from viewer import Viewer
    console = Console(record, "--loop")
    faults = []

    def watch(until):
        viewer = Viewer(console.view)
        viewer.watch(FAN, SIDE, cells=1024)
        last = None
        while time.monotonic() < until:
            frame = viewer.next()
            if frame.topic == SIDE:
                if last is not None and frame.content["ping"] != last + 1:
                    faults.append(f"ping {frame.content['ping']} after {last}")
                last = frame.content["ping"]
        viewer.close()

    stat = pathlib.Path(f"/proc/{console.process.pid}/stat")
    used = lambda: sum(map(int, stat.read_text().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")
    began = time.monotonic()
    threads = [threading.Thread(target=watch, args=(began + 2 + seconds,)) for _ in range(viewers)]
    for thread in threads:
        thread.start()
    time.sleep(1)
    before, at = used(), time.monotonic()
    time.sleep(seconds)
    share = (used() - before) / (time.monotonic() - at)
    memory_mb = int(pathlib.Path(f"/proc/{console.process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
    for thread in threads:
        thread.join()
    console.stop()
    if faults:
        raise RuntimeError(f"lines are missing: {faults[:3]}")
    return share, memory_mb


def page(record, seconds):
    """Age of what a page in Chromium has drawn, as the gateway learns it; share of the fan's pings that it got."""
    from console import Console
    from playwright.sync_api import sync_playwright
    console = Console(record, "--loop")
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox", "--enable-unsafe-swiftshader"])
            shown = browser.new_page(viewport={"width": 1400, "height": 850})
            began = time.monotonic()
            shown.goto(console.view)
            shown.wait_for_function(SEEN)
            first_picture_s = time.monotonic() - began
            loaded_kb = shown.evaluate(LOADED) / 1000
            first_paint_s = shown.evaluate(PAINTED) / 1000
            ages, sent, lost = [], 0, 0
            time.sleep(4)
            flow = lambda n: shown.locator(".flow").nth(n)
            first = int(flow(0).get_attribute("data-sent")), int(flow(0).get_attribute("data-lost")), int(flow(1).get_attribute("data-lost"))
            for _ in range(seconds):
                time.sleep(1)
                ages.append(float(flow(0).get_attribute("data-age")))
            sent = int(flow(0).get_attribute("data-sent")) - first[0]
            lost = int(flow(0).get_attribute("data-lost")) - first[1]
            lines_lost = int(flow(1).get_attribute("data-lost")) - first[2]
            browser.close()
    finally:
        console.stop()
    if sent < 5 * seconds:
        raise RuntimeError(f"{sent} pictures in {seconds} s")
    ages.sort()
    middle, late = statistics.median(ages), ages[int(0.95 * len(ages))]
    share = sent / (sent + lost)
    return [row("console: bytes that the page loads, compressed", loaded_kb, "kB", None, None, "<= 300", loaded_kb <= 300),
            row("console: first paint", first_paint_s, "s", None, None, "<= 0.3", first_paint_s <= 0.3),
            row("console: first picture", first_picture_s, "s", None, None, "<= 2", first_picture_s <= 2.0),
            row("console: arrival to drawn, fan 512 x 2,000 at 15 Hz in Chromium, median", middle * 1e3, "ms", None, None, "<= 40", middle <= 0.040),
            row("console: the same, 95 %", late * 1e3, "ms", None, None, "<= 100", late <= 0.100),
            row("console: pings of the fan that were drawn", share, "", None, None, ">= 0.99", share >= 0.99),
            row("console: sidescan lines that did not come", lines_lost, "", None, None, "<= 0", lines_lost == 0)]
