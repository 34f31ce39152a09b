"""Alarms: raised by known messages, kept by the page until somebody acknowledges them."""
import unittest

import ensonify
import numpy as np

from browser import BrowserTest
from console import ConsoleTest, write_record
from viewer import Viewer

MARKUP = "<b>no estimate</b>"


def trouble():
    """20 s at 5 Hz: no bottom from 4 s to 8 s; 12 m to port of the line from 6 s to 7 s; a process degraded from 2 s to 9 s that skips two
    pings then; slips at 5 s."""
    for i in range(100):
        t_s = i / 5
        stamp_ns = int(t_s * 1e9)
        found = not 4 <= t_s < 8
        yield "bow/soundings", ensonify.Soundings(stamp_ns=stamp_ns, ping=i, valid=np.array([found], "u1"), beam_angle_rad=np.zeros(1, "f4"),
                                                  travel_time_s=np.full(1, 0.02, "f4"), position_enu_m=np.array([[0.0, 0.0, -15.0]]))
        yield "pilot/mission", ensonify.MissionState(stamp_ns=stamp_ns, state="on_line", line=0, line_count=1, cross_track_m=-12.0 if 6 <= t_s < 7 else 1.0)
        if i % 5 == 0:
            yield "clock/health", ensonify.ClockHealth(stamp_ns=stamp_ns, state="running", rate=1.0, slips=int(t_s >= 5), slip_s=2.5 * (t_s >= 5))
        if t_s in (0.0, 2.0, 9.0):
            yield "bow/health", ensonify.Health(stamp_ns=stamp_ns, state="degraded" if t_s == 2.0 else "ok", message=MARKUP if t_s == 2.0 else "",
                                                counters=[ensonify.Counter(name="pings_skipped", count=2 * (t_s >= 9))])


WANTED = {("no_bottom", "bow/soundings"), ("off_line", "pilot/mission"), ("slips", "clock"), ("degraded", "bow"), ("late_pings", "bow")}


class Alarms(ConsoleTest):
    def test_each_alarm_is_raised_by_its_cause_and_ends_with_it(self):
        at = self.console(write_record(self.folder / "trouble.mcap", trouble()), "--rate", "4")
        viewer = Viewer(at.view)
        viewer.watch("alarms")
        active, kinds, last = set(), {}, {}
        while len(kinds) < len(WANTED) or any(alarm["active"] for alarm in last):
            last = viewer.of("console_alarms/1").content["alarms"]
            for alarm in last:
                kinds[alarm["kind"], alarm["source"]] = alarm
                if alarm["active"]:
                    active.add(alarm["kind"])
        self.assertEqual(set(kinds), WANTED)
        self.assertEqual(active, {"no_bottom", "off_line", "degraded"})
        self.assertEqual([alarm["raised"] for alarm in kinds.values()], [1] * len(WANTED))
        self.assertEqual(kinds["no_bottom", "bow/soundings"]["since_ns"], 4_800_000_000)  # the fifth ping in a row
        self.assertEqual(kinds["no_bottom", "bow/soundings"]["text"], "no bottom in the last 20 pings")
        self.assertEqual(kinds["off_line", "pilot/mission"]["text"], "12.0 m to port of the runline")
        self.assertEqual(kinds["off_line", "pilot/mission"]["since_ns"], 6_000_000_000)
        late = Viewer(at.view)
        late.watch("alarms")
        self.assertEqual(late.of("console_alarms/1").content["alarms"], last)
        late.close()
        viewer.close()


    def test_limits_are_options_of_the_command(self):
        at = self.console(write_record(self.folder / "trouble.mcap", trouble()), "--free", "--alarm-off-line", 13, "--alarm-no-bottom", 10)
        viewer = Viewer(at.view)
        viewer.watch("alarms")
        alarms = viewer.until(lambda f: f.type == "console_alarms/1" and any(a["kind"] == "late_pings" for a in f.content["alarms"])).content["alarms"]
        since_ns = {alarm["kind"]: alarm["since_ns"] for alarm in alarms}
        self.assertEqual(since_ns["no_bottom"], 5_800_000_000)  # the tenth ping
        self.assertNotIn("off_line", since_ns)  # 12 m
        viewer.close()


class AlarmsOnThePage(BrowserTest):
    def test_they_stay_until_acknowledged_by_keyboard_and_come_back_when_raised_again(self):
        at = self.console(write_record(self.folder / "trouble.mcap", trouble()), "--rate", "8", "--loop")
        page = self.open(at.control)
        page.wait_for_selector('[data-alarm="late_pings bow"]', timeout=15_000)
        page.get_by_role("button", name="pause").click()
        page.wait_for_selector("text=resume")
        self.shot(page, "alarms")
        shown = {tuple(one.get_attribute("data-alarm").split(" ", 1)) for one in page.locator("[data-alarm]").all()}
        self.assertLessEqual(WANTED, shown)
        over = page.locator('[data-alarm="off_line pilot/mission"]')
        self.assertIn("over", over.inner_text())  # its cause has passed, and it is there
        self.assertIn(MARKUP, page.locator('[data-alarm="degraded bow"]').inner_text())
        page.get_by_label("acknowledge off the line pilot/mission").focus()
        page.keyboard.press("Enter")
        self.wait_for(lambda: over.count() == 0)
        self.assertGreater(page.locator("[data-alarm]").count(), 3)  # the others are there
        page.get_by_role("button", name="acknowledge all").click()
        self.wait_for(lambda: page.locator("[data-alarm].new").count() == 0)
        page.get_by_role("button", name="resume").click()
        self.wait_for(lambda: over.count() == 1, 20)  # the next round of the record
        self.assertIn("2 times", over.inner_text())
        self.assertEqual(self.errors, [])


if __name__ == "__main__":
    unittest.main()
