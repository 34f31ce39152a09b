"""Any message as text; the tables of processes and topics."""
import re
import unittest

import ensonify
import numpy as np

from browser import BrowserTest
from console import survey, voyage, write_record

MARKUP = '<img src=x onerror="alert(1)">'


def pace(seconds=20):
    """A clock that charges a fourth of the wall time to `bow`, and once a lateness of 1.5 s."""
    for t_s in range(1, seconds):
        one = ensonify.Pace(name="bow", grants=10 * t_s, cost_s=0.25 * t_s, late_events=3, worst_lateness_s=1.5)
        yield "clock/health", ensonify.ClockHealth(stamp_ns=t_s * 10**9, state="running", rate=1.0, wall_s=float(t_s), participants=[one])
        yield "bow/health", ensonify.Health(stamp_ns=t_s * 10**9, state="degraded", message=MARKUP, counters=[ensonify.Counter(name="late_ping", count=t_s)])


class Message(BrowserTest):
    def play(self, *streams):
        at = self.console(write_record(self.folder / "some.mcap", *streams), "--loop")
        page = self.open(at.view)
        page.get_by_label("message", exact=True).check()
        page.wait_for_selector('h2:text-is("message")')
        return page

    def test_the_newest_message_of_a_topic_is_text_with_all_its_fields(self):
        page = self.play(voyage(), survey(), pace())
        shown = page.locator("pre")
        page.get_by_label("topic of the message").select_option("echo/altitude")
        self.wait_for(lambda: "range_m: " in shown.inner_text())
        lines = shown.inner_text().splitlines()
        self.assertEqual([line.split(":")[0] for line in lines], [field for field in vars(ensonify.Altitude()) if not field.startswith("_")])
        values = dict(line.split(": ") for line in lines)
        self.assertAlmostEqual(float(values["range_m"]), 30.0 - float(values["stamp_ns"]) * 1e-9, places=6)
        self.assertEqual(values["valid"], "true")

        page.get_by_label("topic of the message").select_option("bow/soundings")
        self.wait_for(lambda: "position_enu_m: [41 x 3] 0.25, " in shown.inner_text())
        page.get_by_label("topic of the message").select_option("bow/health")
        self.wait_for(lambda: "counters:" in shown.inner_text())
        self.assertIn(r'message: "<img src=x onerror=\"alert(1)\">"', shown.inner_text())
        self.assertRegex(shown.inner_text(), r"counters:\n  0:\n    name: \"late_ping\"\n    count: \d+")
        self.assertEqual(page.locator(".pane img").count(), 0)
        self.assertEqual(self.errors, [])

    def test_it_is_held_while_somebody_reads(self):
        page = self.play(voyage())
        page.get_by_label("topic of the message").select_option("boat/pose")
        stamp = lambda: page.locator("pre").inner_text().split("stamp_ns: ")[-1].split()[0]  # noqa: E731
        self.wait_for(lambda: stamp().isdigit())
        page.get_by_label("hold").check()
        page.wait_for_timeout(300)
        held = stamp()
        page.wait_for_timeout(1500)  # five messages and more
        self.assertEqual(stamp(), held)
        page.get_by_label("hold").uncheck()
        self.wait_for(lambda: stamp() != held)

    def test_the_tables_have_cost_and_lateness_of_processes_and_rate_and_bytes_of_topics(self):
        page = self.play(voyage(), pace())
        page.get_by_label("topic of the message").select_option("boat/pose")
        process = lambda: page.locator('tr:has(th:text-is("bow"))').inner_text().replace("\u00a0", " ").split("\t")  # noqa: E731
        topic = lambda name: page.locator(f'tr:has(td:text-is("{name}"))').inner_text().replace("\u00a0", " ").split("\t")  # noqa: E731
        self.wait_for(lambda: page.locator('tr.degraded:has(th:text-is("bow"))').count() and process()[5])
        bow = process()
        self.assertEqual([bow[2], bow[5], bow[6], bow[7]], ["degraded", "25.0 %", "3", "1.5 s"])
        self.assertEqual(bow[8], f"{MARKUP} late_ping {int(bow[3]) // 10}")
        self.assertEqual(topic("boat/pose")[:3], ["boat", "boat/pose", "pose/1"])

        def rates():  # 5 Hz of voyage()
            told = topic("boat/pose")[3]  # "5.0 /s", once the gateway has reported
            return "/s" in told and abs(float(told.split()[0]) - 5.0) < 1.2
        self.wait_for(rates)
        bytes_each = int(re.search(r"(\d+) bytes", page.locator('.pane:has(h2:text-is("message")) header').inner_text())[1])
        self.assertTrue(np.isclose(float(topic("boat/pose")[4].split()[0]) * 1000, 5 * bytes_each, rtol=0.5))
        self.assertEqual(topic("echo/altitude")[3], "not watched here")
        self.assertEqual(self.errors, [])


if __name__ == "__main__":
    unittest.main()
