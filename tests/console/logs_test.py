"""Logs of a run's processes beside its record: known lines, in order, as text."""
import unittest

from browser import BrowserTest
from console import sides, write_record
from viewer import Viewer

MARKUP = "<img src=x onload=alert(1)>"


class Logs(BrowserTest):
    def play(self):
        (self.folder / "log").mkdir()
        (self.folder / "log/bow.log").write_text(f"t=1.000 bow started\nt=3.000 bow late_ping ping=57 {MARKUP}\n")
        (self.folder / "log/nav.log").write_text("t=2.000 nav go\n")
        (self.folder / "log/link.log").symlink_to("/etc/passwd")
        return self.console(write_record(self.folder / "sides.mcap", sides(pings=50)), "--loop")

    def append(self, text):
        with open(self.folder / "log/nav.log", "a") as file:
            file.write(text)

    def test_lines_come_in_order_and_as_they_are_written(self):
        at = self.play()
        viewer = Viewer(at.view)
        viewer.watch("log")
        log = viewer.of("console_log/1").content
        self.assertEqual([(line["process"], line["level"], line["text"]) for line in log["lines"]],
                         [("bow", "info", "t=1.000 bow started"), ("nav", "info", "t=2.000 nav go"),
                          ("bow", "warning", f"t=3.000 bow late_ping ping=57 {MARKUP}")])
        self.append("t=4.000 nav error: it \x1b[31mfailed\n")
        more = viewer.of("console_log/1").content
        self.assertEqual(more["first"], 3)
        self.assertEqual([(line["level"], line["text"]) for line in more["lines"]], [("error", "t=4.000 nav error: it \\x1b[31mfailed")])
        viewer.close()

    def test_the_page_shows_them_as_text_and_by_level_process_and_word(self):
        at = self.play()
        page = self.open(at.view)
        page.get_by_label("logs", exact=True).check()
        page.wait_for_selector(".log .warning")
        self.assertIn(MARKUP, page.locator(".log .warning").inner_text())
        self.assertEqual(page.locator(".log img").count(), 0)
        self.append("t=4.000 nav error: the antenna is gone\n" + "".join(f"t=5.{i:03} nav fix {i}\n" for i in range(400)))
        page.wait_for_selector("text=fix 399")
        at_end = "e => e.scrollHeight - e.scrollTop - e.clientHeight < 8"
        self.wait_for(lambda: page.locator(".log").evaluate(at_end))
        self.shot(page, "logs")
        self.assertEqual(page.locator(".log > div").count(), 300)  # the newest
        self.assertTrue(page.locator(".log").evaluate(at_end))
        page.get_by_label("least level").select_option("error")
        self.wait_for(lambda: page.locator(".log > div").all_inner_texts() == ["nav t=4.000 nav error: the antenna is gone"])
        page.get_by_label("least level").select_option("info")
        page.get_by_label("process", exact=True).select_option("bow")
        self.wait_for(lambda: page.locator(".log > div").count() == 2)
        page.get_by_label("process", exact=True).select_option("")
        page.get_by_label("text to find").fill("FIX 7")
        self.wait_for(lambda: page.locator(".log > div").count() == 11)  # 7, 70 ... 79
        self.assertEqual(self.errors, [])


if __name__ == "__main__":
    unittest.main()
