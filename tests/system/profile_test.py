"""`ensonify run --profile`: the stages of every process are reported, add up, and change no message."""
import json
import unittest

import ensonify
from support import SOURCE, SystemTest

PARTS = {"spread", "transforms", "noise"}  # of beamform, summed over threads


class Profile(SystemTest):
    def run_it(self, out, *options):
        result = self.run_launch(SOURCE / "launch/forward_looking.yaml", "--free", "--arg", "ping_rate_hz=1", *options, out=out, timeout=200)
        self.assertEqual(result.code, 0, result.stderr)
        return result

    def test_a_profile_adds_up_and_changes_nothing(self):
        measured = self.run_it("measured", "--profile")
        profile = json.loads((measured.out / "run.json").read_text())["profile"]
        self.assertEqual(sorted(profile), ["auv", "expect", "eye", "nav", "pager", "pilot", "recorder"])
        for name, process in profile.items():
            with self.subTest(process=name):
                step = process["stages"]["step"]
                self.assertLessEqual(step["wall_s"], process["wall_s"])
                inner = [stage for stage_name, stage in process["stages"].items() if stage_name != "step" and stage_name not in PARTS]
                self.assertLessEqual(sum(stage["wall_s"] for stage in inner), step["wall_s"])

        head = profile["eye"]["stages"]
        with ensonify.Record(measured.out / "forward_looking.mcap") as record:
            images = len(list(record.messages("eye/ping")))
        for stage in ("probes", "trace", "weigh", "merge", "echoes", "patterns", "beamform", "message", *PARTS):
            self.assertGreater(head[stage]["wall_s"], 0, stage)
        self.assertLessEqual(sum(head[part]["processor_s"] for part in PARTS), 1.05 * head["beamform"]["processor_s"])
        self.assertEqual(head["echoes"]["count"], images)
        self.assertEqual(head["probes"]["count"], images)
        # Of what the head computes, little lies outside its stages.
        inside_s = sum(stage["wall_s"] for name, stage in head.items() if name != "step" and name not in PARTS)
        self.assertGreater(inside_s, 0.7 * head["step"]["wall_s"])
        self.assertRegex(measured.stderr, r"\neye: [\d.]+ s, [\d.]+ s of processor time\n(  .*\n)*  trace +\d")

        events = json.loads((measured.out / "profile.json").read_text())["traceEvents"]
        names = {event["pid"]: event["args"]["name"] for event in events if event["ph"] == "M"}
        self.assertEqual(sorted(names.values()), sorted(profile))
        of_head = [event for event in events if event["ph"] == "X" and names[event["pid"]] == "eye"]
        steps = [event for event in of_head if event["name"] == "step"]
        self.assertEqual(len(steps), head["step"]["count"])
        for event in of_head:
            inside = any(step["ts"] <= event["ts"] and event["ts"] + event["dur"] <= step["ts"] + step["dur"] + 0.01 for step in steps)
            self.assertTrue(inside, event)

        plain = self.run_it("plain")
        self.assertNotIn("profile", json.loads((plain.out / "run.json").read_text()))
        same = self.tool("compare", measured.out / "forward_looking.mcap", plain.out / "forward_looking.mcap")
        self.assertEqual(same.returncode, 0, same.stdout)

    def test_an_older_profile_is_removed_and_one_process_has_none(self):
        left = self.folder / "again" / "profile.json"
        left.parent.mkdir()
        left.write_text("{}")
        self.run_it("again", "--set", "eye.quality=0.05")
        self.assertFalse(left.exists())
        refused = self.run_launch(SOURCE / "launch/forward_looking.yaml", "--profile", "--in-process", out="none")
        self.assertEqual(refused.code, 2)
        self.assertIn("--in-process", refused.stderr)


if __name__ == "__main__":
    unittest.main()
