"""ensonify clock against a live run."""
import json
import unittest

from live_run import LiveRun

SECOND = 1_000_000_000


class Clock(unittest.TestCase):
    def test_pause_step_resume_and_rates(self):
        with LiveRun() as run:
            self.assertEqual(run.tool("clock", "pause")[:2], (0, "paused\n"))
            self.assertEqual(run.json("clock", "status")["state"], "paused")
            first = run.json("clock", "step", "0.25")["until_ns"]
            self.assertEqual(run.json("clock", "step", "0.5")["until_ns"], first + SECOND // 2)
            # Nobody has an event left up to there, and nobody has run the next one: 100 Hz events are 10 ms apart.
            reached = run.json("clock", "status")["sim_ns"]
            self.assertGreater(reached, first + SECOND // 2)
            self.assertLessEqual(reached, first + SECOND // 2 + SECOND // 100)
            self.assertEqual(run.json("clock", "status")["sim_ns"], reached)

            self.assertEqual(run.tool("clock", "rate", "50")[:2], (0, "paced at 50x\n"))
            self.assertEqual(run.tool("clock", "resume")[0], 0)
            status = run.json("clock", "status")
            self.assertEqual((status["state"], status["rate"]), ("running", 50.0))
            self.assertEqual(run.tool("clock", "free")[0], 0)
            self.assertEqual(run.json("clock", "status")["rate"], "free")
            self.assertGreater(run.json("clock", "status")["sim_ns"], reached)

            code, text, _ = run.tool("clock", "status")
            self.assertEqual(code, 0)
            self.assertTrue(text.startswith("running, free running, t="), text)
            for name in ("auv", "pilot", "bow", "viewer"):
                self.assertRegex(text, rf"(?m)^{name} ")

            self.assertEqual(run.tool("clock", "stop")[0], 0)
            self.assertEqual(run.process.wait(20), 0)

    def test_facts_of_the_run(self):
        with LiveRun() as run:
            facts = run.json("clock", "get")["facts"]
            self.assertTrue({"launch", "scenario", "seed", "version"} <= set(facts))
            code, text, _ = run.tool("clock", "get", "launch")
            self.assertEqual(code, 0)
            self.assertIn("pose_blob/1", text)
            code, _, error = run.tool("clock", "get", "seeed")
            self.assertEqual(code, 2)
            self.assertIn("known: declarations external isa launch paced scenario seed", error)

    def test_wrong_arguments(self):
        with LiveRun() as run:
            for words in (("step", "0"), ("step", "-1"), ("rate", "0"), ("rate", "fast"), ("hurry",), ()):
                self.assertEqual(run.tool("clock", *words)[0], 2, words)
            self.assertEqual(json.loads(run.tool("clock", "status", "--json")[1])["state"], "running")


if __name__ == "__main__":
    unittest.main()
