"""The page in a real browser, for tests. Screenshots go to ENSONIFY_SHOTS, where that is set."""
import io
import os
import pathlib
import shutil
import unittest

import numpy as np
from PIL import Image

from console import ConsoleTest

SHOT_SCALE, SHOT_COLOURS = 0.8, 200
CHROMIUM = shutil.which("chromium")
try:
    from playwright.sync_api import sync_playwright
except ImportError:
    sync_playwright = None

# Every pixel of a canvas as numbers, and the cursor's line for one of them.
PIXELS = """canvas => { const d = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  return {width: d.width, height: d.height, data: Array.from(new Uint32Array(d.data.buffer))}; }"""


@unittest.skipUnless(CHROMIUM and sync_playwright, "no chromium, or no playwright")
class BrowserTest(ConsoleTest):
    @classmethod
    def setUpClass(cls):
        cls.playwright = sync_playwright().start()
        cls.browser = cls.playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox", "--enable-unsafe-swiftshader"])

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.playwright.stop()

    def open(self, url, width=1400, height=850, **more):
        page = self.browser.new_page(viewport={"width": width, "height": height}, **more)
        self.addCleanup(page.close)
        self.errors, self.asked = [], set()
        page.on("pageerror", lambda error: self.errors.append(error.stack or str(error)))
        page.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
        page.on("request", lambda request: self.asked.add(request.url.split("/")[2]) if request.url.startswith("http") else None)
        page.goto(url)
        return page

    def picture(self, page, topic):
        """The canvas as height x width numbers, 0xAABBGGRR."""
        return self.pixels(page.locator(f'canvas[data-topic="{topic}"]'))

    def pixels(self, canvas):
        made = canvas.evaluate(PIXELS)
        return np.array(made["data"], np.uint32).reshape(made["height"], made["width"])

    def wait_for_flow(self, page, panes=1):
        self.wait_for(lambda: page.locator(".flow").count() >= panes, 15)

    def cursor(self, page, topic, x, y):
        page.locator(f'canvas[data-topic="{topic}"]').hover(position={"x": x, "y": y})
        return page.locator(f'.pane:has(canvas[data-topic="{topic}"]) .cursor').inner_text()

    def shot(self, page, name):
        """Small enough for a page: of fewer pixels and colours."""
        if not os.environ.get("ENSONIFY_SHOTS"):
            return
        seen = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
        small = seen.resize((round(SHOT_SCALE * seen.width), round(SHOT_SCALE * seen.height)), Image.Resampling.LANCZOS)
        few = small.quantize(SHOT_COLOURS, Image.Quantize.MAXCOVERAGE, kmeans=2, dither=Image.Dither.NONE)
        few.save(pathlib.Path(os.environ["ENSONIFY_SHOTS"]) / f"{name}.png", optimize=True)
