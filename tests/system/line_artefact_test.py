"""Surveys of the trawled plain, 51 m under the head: as good as real ones where all is right, and with the artefacts along lines that
real ones have where sound speed or draught is entered a little wrong. NOAA's grids of such a seabed (Bering shelf) hold 2 to 7 cm rms,
and line artefacts of 5 cm; 2 to 8 are allowed here."""
import unittest

import ensonify
import numpy as np
from ensonify_plot.survey import read_survey
from support import SOURCE, SystemTest

LAUNCH = f"""
ensonify: launch/1
scenario: {SOURCE}/scenarios/trawl_scars/scenario.yaml
set:
  mission.lawnmower: {{ centre_m: [-200, 0], heading_deg: 90, length_m: 40, spacing_m: 90, count: 2 }}
processes:
  boat: {{ run: vehicle }}
  nav: {{ run: navigation }}
  pilot: {{ run: autopilot }}
  pager: {{ run: terrain_pager }}
  bow: {{ run: multibeam, config: {{ beams: 96, ping_rate_hz: 1, amplitude_every: 1000, quality: 0.25 }} }}
  recorder: {{ run: recorder, config: {{ file: survey.mcap, topics: [bow/soundings, boat/pose, pilot/mission, pager/tile] }} }}
expect:
  - {{ name: both lines are surveyed, eventually: {{ topic: pilot/mission, where: {{ field: state, equals: done }}, within_s: 200 }} }}
"""
CELL_M = 4
SPIKE_M = 1  # what is further off is a spike, which an operator takes out: an outermost beam that detects the bottom below the keel


class Line:
    """Errors of the soundings of one runline, spikes taken out."""

    def __init__(self, soundings, error_m, known, number):
        of_line = known & (soundings.line == number)
        self.beam_angle_rad = soundings.beam_angle_rad[of_line]
        self.east_m, self.north_m, self.error_m = soundings.east_m[of_line], soundings.north_m[of_line], error_m[of_line]


def gridded_m(*lines):
    """Mean error of each cell."""
    east, north, error = (np.concatenate([getattr(line, name) for line in lines]) for name in ("east_m", "north_m", "error_m"))
    cells = np.floor(np.stack([east, north]) / CELL_M).astype(int)
    _, cell, count = np.unique(cells, axis=1, return_inverse=True, return_counts=True)
    return np.bincount(cell.ravel(), error) / count


def across_m(line):
    """Mean error along the line by tenths of the swath, and the tangents of their beam angles."""
    tangent = np.tan(line.beam_angle_rad)
    tenth = np.clip(np.digitize(tangent, np.linspace(-2, 2, 11)) - 1, 0, 9)
    count = np.bincount(tenth, minlength=10)
    return np.bincount(tenth, line.error_m, 10) / count, np.bincount(tenth, tangent, 10) / count


class LineArtefacts(SystemTest):
    def lines(self, out, *options):
        result = self.run_launch(LAUNCH, "--free", "--in-process", *options, out=out, timeout=400)
        self.assertEqual(result.code, 0, result.stderr)
        survey = read_survey(ensonify.Record(result.out / "survey.mcap"))
        soundings = survey.soundings
        error_m = soundings.up_m - survey.seabed.height_m(soundings.east_m, soundings.north_m)
        known = np.abs(error_m) < SPIKE_M  # not so where no true tile is recorded
        self.assertGreater(known.mean(), 0.998)
        return [Line(soundings, error_m, known, number) for number in range(len(survey.lines))]

    def test_artefacts_are_those_of_real_surveys(self):
        right = self.lines("right")
        rms_m = gridded_m(*right).std()
        self.assertGreater(rms_m, 0.02)
        self.assertLess(rms_m, 0.07)
        for line in right:  # what stands still along a line is noise of the navigation's height, a centimetre or two
            self.assertLess(across_m(line)[0].std(), 0.02)

        # Level plane of depth d, speed wrong by dc: d (1 - tan^2) dc / c. The water's speed is that of 8 degrees, 35 psu.
        one_line = ("--set", "mission.lawnmower.count=1")
        true_mps, applied_mps, depth_m = 1482.48, 1483.7, 52.0
        [speed] = self.lines("speed", *one_line, "--set", f"water.applied.sound_speed_mps={applied_mps}")
        across, tangent = across_m(speed)
        artefact_m = across - across.mean()
        self.assertGreater(artefact_m.std(), 0.02)
        self.assertLess(artefact_m.std(), 0.08)
        frown_m = -depth_m * (1 - tangent**2) * (applied_mps - true_mps) / true_mps
        np.testing.assert_allclose(artefact_m, frown_m - frown_m.mean(), atol=0.02)

        # A line with 10 cm more draught than entered, beside one without: a step between them, half of it the deviation of both.
        [loaded] = self.lines("draught", *one_line, "--set", "vehicles.boat.mountings.bow.measured.position_m=[1.5, 0.2, 0.7]")
        step_m = loaded.error_m.mean() - right[1].error_m.mean()
        self.assertAlmostEqual(step_m, 0.1, delta=0.03)
        artefact_m = np.concatenate([gridded_m(loaded), gridded_m(right[1])]).std()
        self.assertGreater(artefact_m, 0.05)
        self.assertLess(artefact_m, 0.08)


if __name__ == "__main__":
    unittest.main(verbosity=2)
