"""docs/manual/test-my-autopilot.md: its pilot and its launch file, as they stand there, pass; a pilot that steers wrong fails."""
import re
import unittest

from support import SOURCE, SystemTest

PAGE = (SOURCE / "docs/manual/test-my-autopilot.md").read_text()


class AutopilotPage(SystemTest):
    def box(self, language, of):
        """The first box of a language that has a text."""
        return next(box for box in re.findall(rf"```{language}\n(.*?)```", PAGE, re.S) if of in box)

    def run_page(self, pilot):
        launch = self.box("yaml", "my_pilot.py").replace("my_pilot.py", str(self.write("my_pilot.py", pilot)))
        junit = self.folder / "test.xml"
        result = self.run_launch(self.write("my_test.yaml", launch), "--junit", junit)
        return result, junit.read_text()

    def test_the_page_passes(self):
        result, junit = self.run_page(self.box("python", "ensonify.Participant"))
        self.assertEqual(result.code, 0, result.stderr)
        self.assertIn('failures="0"', junit)

    def test_a_pilot_that_steers_east_fails(self):
        pilot = self.box("python", "ensonify.Participant")
        self.assertIn("heading_grid_rad=0.0", pilot)
        result, _ = self.run_page(pilot.replace("heading_grid_rad=0.0", "heading_grid_rad=1.57"))
        self.assertEqual(result.code, 1, result.stderr)
        self.assertIn("failed: it stays within 5 m of the line", result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
