"""Real time starts when everybody is ready: what takes long the first time makes nothing late."""
import unittest

from support import SystemTest, bay, survey


class RealTime(SystemTest):
    def test_a_long_first_event_makes_nothing_late(self):
        result = self.run_launch(survey(seconds=1, head="first_ms: 700").replace("progress_deadline_s: 0.2", "progress_deadline_s: 5"),
                                 "--rate", "1")
        self.assertEqual(result.code, 0, result.stderr)
        report = result.clock()
        self.assertEqual((report["slips"], set(result.late_events().values())), (0, {0}))
        self.assertGreater(report["wall_s"], 0.7 + 1)

    def test_a_head_rehearses_its_first_ping_where_time_follows_the_wall_and_records_the_same(self):
        paced = self.run_launch(bay(1), "--rate", "1", "--set", "bow.quality=0.1", out="paced")
        free = self.run_launch(bay(1), "--free", "--set", "bow.quality=0.1", out="free")
        for result in (paced, free):
            self.assertEqual(result.code, 0, result.stderr)
        self.assertRegex(paced.log("bow"), r"(?m)^t=0.000 bow rehearsed took_s=")
        self.assertNotIn("rehearsed", free.log("bow"))
        same = self.tool("compare", paced.out / "run.mcap", free.out / "run.mcap")
        self.assertEqual(same.returncode, 0, same.stdout)


if __name__ == "__main__":
    unittest.main()
