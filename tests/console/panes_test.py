"""Edges between panes: by mouse, keyboard and touch; what a browser keeps of them."""
import unittest

from browser import BrowserTest
from console import fan, health, seabed_chart, sides, survey, write_record

# An element as it is drawn: the pixels of its canvas and of its place.
DRAWN = "canvas => [canvas.width, canvas.height, Math.floor(canvas.clientWidth), Math.floor(canvas.clientHeight)]"
UNDER = "([x, y]) => document.elementFromPoint(x, y).getAttribute('aria-label')"
COLUMNS, ROW = "width of the left column", "height of row 1"


class Panes(BrowserTest):
    def play(self, **more):
        streams = (fan(pings=200), sides(pings=200), survey(pings=400), health(), seabed_chart())
        at = self.console(write_record(self.folder / "all.mcap", *streams), "--loop")
        page = self.open(at.view, 1440, 900, **more)
        self.wait_for_flow(page, 2)
        return page

    def pane(self, page, name):
        return page.locator(f'.pane:has(h2:text-is("{name}"))').bounding_box()

    def middle(self, page, edge):
        box = page.get_by_label(edge, exact=True).bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 4  # not where two edges cross

    def now(self, page, edge):
        return int(page.get_by_label(edge, exact=True).get_attribute("aria-valuenow"))

    def check_sharp(self, page):
        """Each picture has a pixel of its own for every one of the screen, and is not blank."""
        for topic in ("bow/view", "fish/view"):
            canvas = page.locator(f'canvas[data-topic="{topic}"]')
            self.wait_for(lambda: canvas.evaluate(DRAWN)[:2] == canvas.evaluate(DRAWN)[2:])
            self.wait_for(lambda: len(set(self.picture(page, topic).flat)) > 1)
        chart = page.locator(".map canvas").first
        self.wait_for(lambda: chart.evaluate("c => c.width") == round(self.pane(page, "chart")["width"]) - 2)

    def test_an_edge_is_dragged_and_the_pictures_follow(self):
        page = self.play()
        before = self.pane(page, "bow/view")
        x, y = self.middle(page, COLUMNS)
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 60, y)
        page.mouse.move(x - 200, y)
        page.mouse.up()
        page.mouse.move(x - 300, y)  # let go: it stays
        after = self.pane(page, "bow/view")
        self.assertAlmostEqual(after["width"], before["width"] - 200, delta=3)
        self.assertEqual(after["height"], before["height"])
        self.check_sharp(page)
        x, y = page.get_by_label(ROW, exact=True).bounding_box()["x"] + 30, self.middle(page, ROW)[1]
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x, y + 5000)  # no pane is pushed out of the page
        page.mouse.up()
        self.assertEqual(self.now(page, ROW), 90)
        self.check_sharp(page)
        self.assertEqual(self.errors, [])

    def test_arrow_keys_move_the_edge_that_has_the_focus(self):
        page = self.play()
        before, first = self.pane(page, "bow/view"), self.now(page, ROW)
        edge = page.get_by_label(ROW, exact=True)
        self.assertEqual([edge.get_attribute(name) for name in ("role", "aria-orientation", "tabindex")], ["separator", "horizontal", "0"])
        edge.focus()
        for _ in range(3):
            page.keyboard.press("ArrowDown")
        self.assertEqual(self.now(page, ROW), first + 6)
        page.keyboard.press("Shift+ArrowUp")
        self.assertEqual(self.now(page, ROW), first - 4)
        page.keyboard.press("ArrowLeft")  # the other way of the page
        self.assertEqual(self.now(page, ROW), first - 4)
        self.assertLess(self.pane(page, "bow/view")["height"], before["height"] - 20)
        self.check_sharp(page)

    def test_a_finger_finds_the_edge_on_40_pixels_and_drags_it(self):
        page = self.play(has_touch=True, is_mobile=True)
        x, y = self.middle(page, COLUMNS)
        for off in (-19, 0, 19):
            self.assertEqual(page.evaluate(UNDER, [x + off, y]), COLUMNS)
        before = self.pane(page, "bow/view")
        finger = page.context.new_cdp_session(page)
        touch = lambda kind, *points: finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": a, "y": b} for a, b in points]})  # noqa: E731
        touch("touchStart", (x + 15, y))
        touch("touchMove", (x - 50, y))
        touch("touchMove", (x - 135, y))
        touch("touchEnd")
        self.wait_for(lambda: abs(self.pane(page, "bow/view")["width"] - before["width"] + 150) < 4)
        self.check_sharp(page)

    def test_sizes_are_kept_for_each_layout_until_they_are_reset(self):
        page = self.play()
        first = self.now(page, COLUMNS)
        self.assertTrue(page.get_by_text("reset sizes").is_disabled())
        page.get_by_label(COLUMNS, exact=True).focus()
        page.keyboard.press("Shift+ArrowRight")
        page.reload()
        self.wait_for_flow(page, 2)
        self.assertEqual(self.now(page, COLUMNS), first + 10)
        page.get_by_label("layout", exact=True).select_option("navigation")
        self.wait_for(lambda: page.locator(".pane h2").all_inner_texts()[0] == "chart")
        self.assertEqual(self.now(page, COLUMNS), first)
        page.get_by_label("layout", exact=True).select_option("survey")
        self.wait_for(lambda: self.now(page, COLUMNS) == first + 10)
        page.get_by_text("reset sizes").click()
        self.assertEqual(self.now(page, COLUMNS), first)
        page.evaluate("""localStorage.setItem('sizes', '{"survey 4": {"columns": [7, "<b>"], "rows": []}}')""")
        page.reload()
        self.wait_for_flow(page, 2)
        self.assertEqual(self.now(page, COLUMNS), first)
        self.assertEqual(self.errors, [])


if __name__ == "__main__":
    unittest.main()
