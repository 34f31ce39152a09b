"""examples/learn_altitude: some thousand steps of training earn more than none, on seeds that the agent has not seen."""
import importlib.util
import sys
import unittest

from support import SOURCE

STEPS = 12000  # of the world
NEEDED = ("torch", "stable_baselines3", "gymnasium")


@unittest.skipUnless(all(map(importlib.util.find_spec, NEEDED)),
                     "there is no trainer: apt-get install python3-torch, and pip install --no-deps stable-baselines3==2.4.1")
class Learn(unittest.TestCase):
    def test_a_short_training_beats_none(self):
        sys.path.insert(0, str(SOURCE / "examples/learn_altitude"))
        import learn
        env = learn.environment("AltitudeHold", shaped=True)
        untrained, model = [learn.learner(env, 1, learn.Budget()) for _ in range(2)]
        model.learn(STEPS // learn.HOLD)
        env.close()
        means = learn.evaluate("AltitudeHold", model, untrained, seeds=learn.UNSEEN[:2])
        self.assertGreater(means["trained"], means["untrained"] + 100)  # of 600 that an episode can earn
        self.assertGreater(means["trained"], 0.5 * means["baseline"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
