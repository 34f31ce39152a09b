"""What is planned and marked, and the relief of a run that nobody records."""
import unittest

import ensonify
import numpy as np

from browser import BrowserTest
from console import SOURCE, Console, voyage, write_record
from support import SystemTest
from viewer import Viewer

LAUNCH = f"""
ensonify: launch/1
scenario: {SOURCE}/scenarios/bay/scenario.yaml
duration_s: 600
processes:
  boat:  {{ run: vehicle }}
  nav:   {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
"""
# mission.lawnmower of the bay: 5 lines of 300 m to north and south, 45 m apart about the origin.
EAST_M = (-90, -45, 0, 45, 90)


def adaptive():
    for number in (0, 1, 2):
        yield "coverage/next", ensonify.NextLine(stamp_ns=number * 10**9, number=number, start_enu_m=(20.0 * number, 0.0), end_enu_m=(20.0 * number, 100.0))
    yield "pilot/mark", ensonify.Mark(stamp_ns=10**9, text="<b>wreck</b>", position_enu_m=(30.0, 40.0, -5.0))


AUTO = """
ensonify: scenario/1
site: { name: Plane, origin: raster }
seabed: { kind: raster, post_spacing_m: 2, sediments: { 0: medium sand }, raster: { path: depths.asc, values: elevation, holes: fill } }
vehicles: { boat: { turning_radius_m: 10 } }
mission: { speed_mps: 4, run_in_m: 20, auto: { count: 3, longest_m: 200 } }
"""
AUTO_LAUNCH = """
ensonify: launch/1
scenario: auto.yaml
duration_s: 2
processes:
  boat:  { run: vehicle }
  nav:   { run: navigation }
  pilot: { run: autopilot }
  pager: { run: terrain_pager }
  recorder: { run: recorder, config: { file: run.mcap, topics: all } }
"""


class Plan(BrowserTest):
    def test_lines_and_marks_of_a_record_come_and_are_drawn(self):
        at = self.console(write_record(self.folder / "plan.mcap", voyage(), adaptive()), "--rate", "5")
        viewer = Viewer(at.view)
        viewer.watch("plan")
        plan = viewer.until(lambda f: f.type == "console_plan/1" and f.content["line_enu_m"].shape[0] == 3 and f.content["marks"]).content
        np.testing.assert_array_equal(plan["line_enu_m"], [[0, 0, 0, 100], [20, 0, 20, 100], [40, 0, 40, 100]])
        self.assertEqual(plan["marks"], [{"text": "<b>wreck</b>", "position_enu_m": [30.0, 40.0]}])
        page = self.open(at.view)
        page.wait_for_selector('.map[data-plan="3 1"]', timeout=15_000)
        self.assertEqual(self.errors, [])
        viewer.close()


class Run(SystemTest):
    def test_who_joins_late_a_run_without_a_record_gets_its_relief_and_its_plan(self):
        run = self.start_launch(LAUNCH, "--rate", "2", "--name", "late")
        self.addCleanup(run.communicate, timeout=60)
        self.addCleanup(run.send_signal, 2)
        self.wait_for_go()
        at = Console("--run", "late", env=self.environment)
        self.addCleanup(at.stop)
        for _ in range(2):  # and again: whoever leaves may come back
            viewer = Viewer(at.view)
            viewer.watch("relief")
            relief = viewer.until(lambda f: f.type == "console_relief/1" and f.content["shade"].size, patience_s=30).content
            self.assertGreater(len(np.unique(relief["shade"])), 20)
            self.assertGreater(relief["contour_depth_m"].size, 0)
            viewer.close()
            viewer = Viewer(at.view)
            viewer.watch("plan")
            lines = viewer.of("console_plan/1", patience_s=30).content["line_enu_m"]
            np.testing.assert_allclose(sorted(lines[:, 0]), EAST_M, atol=1e-6)
            np.testing.assert_allclose(np.abs(lines[:, 3] - lines[:, 1]), 300, atol=1e-6)
            viewer.close()

    def test_lines_that_are_laid_over_a_chart_are_those_that_the_autopilot_runs(self):
        side = 200  # cells of 2 m, 20 m deep
        (self.folder / "depths.asc").write_text(f"ncols {side}\nnrows {side}\nxllcorner 500000\nyllcorner 5872000\ncellsize 2\n" + ("-20 " * side + "\n") * side)
        (self.folder / "depths.prj").write_text('PROJCS["WGS 84 / UTM zone 29N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],'
                                                'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],'
                                                'PARAMETER["central_meridian",-9],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]]')
        self.write("auto.yaml", AUTO)
        done = self.run_launch(AUTO_LAUNCH, "--free")
        self.assertEqual(done.code, 0, done.stderr)
        record = done.out / "run.mcap"
        at = Console(record, env=self.environment)
        self.addCleanup(at.stop)
        viewer = Viewer(at.view)
        viewer.watch("plan")
        lines = viewer.until(lambda f: f.type == "console_plan/1" and f.content["line_enu_m"].size, patience_s=30).content["line_enu_m"]
        viewer.close()
        mission = next(iter(ensonify.Record(record).messages("pilot/mission"))).content
        self.assertEqual(len(lines), mission.line_count)
        # The boat begins with the run-in of the first line.
        place = np.array(next(iter(ensonify.Record(record).messages("boat/pose"))).content.position_enu_m[:2])
        start, end = lines[0, :2], lines[0, 2:]
        np.testing.assert_allclose(place, start - 20 * (end - start) / np.linalg.norm(end - start), atol=1.0)


if __name__ == "__main__":
    unittest.main()
