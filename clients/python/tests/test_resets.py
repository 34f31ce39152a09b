"""Resets of an environment: the same processes, the bytes of a fresh launch, and nothing left behind.
ENSONIFY_RESETS says how many for the last (CI: 60)."""
import os
import pathlib
import tempfile
import unittest

import numpy as np

import ensonify

RESETS = int(os.environ.get("ENSONIFY_RESETS", "60"))
LAUNCH = pathlib.Path(ensonify.__file__).parent / "tasks" / "altitude_hold.yaml"


def environment(**changes):
    return ensonify.Env(LAUNCH, **{"observe": {"nav/altitude": ensonify.Fields(ensonify.Altitude), "nav/depth": ensonify.Fields(ensonify.Depth)},
                                   "act": ensonify.steer(speed_mps=1.5, depth_m=(10, 28)), "reward": lambda seen: 0.0, **changes})


def processes(out):
    """Folders in /proc of the processes of a launch whose results go to `out`, by name; the clock without one."""
    found = {}
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().decode().split("\0")
        except OSError:
            continue
        if str(out) in words and pathlib.Path(words[0]).name.startswith("ensonify-"):
            found[words[words.index("--name") + 1] if "--name" in words else pathlib.Path(words[0]).name] = folder
    return found


def held(folder):
    """Descriptors, threads, and resident memory in kB of a process."""
    status = dict(line.split(":", 1) for line in (folder / "status").read_text().splitlines())
    return len(list((folder / "fd").iterdir())), int(status["Threads"]), int(status["VmRSS"].split()[0])


class Resets(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(prefix="ens-")
        self.addCleanup(scratch.cleanup)
        self.out = pathlib.Path(scratch.name)

    def make(self, **changes):
        env = environment(**changes)
        self.addCleanup(env.close)
        return env

    def episode(self, env, seed, **options):
        seen, _ = env.reset(seed=seed, options=options)
        observed = [seen] + [env.step(np.float32([depth_m]))[0] for depth_m in np.linspace(12, 26, 20)]
        return [{key: value.tobytes() for key, value in one.items()} for one in observed]

    def test_an_episode_in_the_same_processes_has_the_bytes_of_a_new_launch(self):
        other_sea = {"nav.altimeter.dropout": 0.5, "water.sound_speed_mps": 1530, "auv.pose_rate_hz": 40}
        env = self.make(out=self.out / "a")
        self.episode(env, 3)
        first = processes(self.out / "a" / "0000")
        self.assertEqual(set(first), {"auv", "nav", "judge", "pager", "ensonify-conductor", "ensonify-run"})
        again = [self.episode(env, 8), self.episode(env, 9, set=other_sea), self.episode(env, 8)]
        self.assertEqual(processes(self.out / "a" / "0000"), first)
        fresh = [self.episode(self.make(), 8), self.episode(self.make(), 9, set=other_sea)]
        self.assertEqual(again, [*fresh, fresh[0]])
        self.assertNotEqual(fresh[0], self.episode(self.make(), 9))
        self.assertEqual(sorted(folder.name for folder in (self.out / "a").iterdir()), ["0000", "0001", "0002", "0003"])

    def test_a_list_of_numbers_may_be_set_again_and_again(self):
        env = self.make(out=self.out / "a", set={"nav.altimeter.rotation_deg": np.zeros(3)})
        env.reset(seed=1)
        first = processes(self.out / "a" / "0000")
        env.reset(seed=2)
        env.reset(seed=3, options={"set": {"nav.altimeter.rotation_deg": np.float32([0, 1, 0])}})
        self.assertEqual(processes(self.out / "a" / "0000"), first)

    def test_what_cannot_be_in_the_same_processes_begins_a_new_launch(self):
        env = self.make(out=self.out / "a")
        env.reset(seed=1, options={"set": {"nav.altimeter.dropout": 0.5}})
        first = processes(self.out / "a" / "0000")
        env.reset(seed=1)  # the launch has what this episode is to have no more
        self.assertEqual(processes(self.out / "a" / "0000"), {})
        second = processes(self.out / "a" / "0001")
        self.assertEqual(set(second), set(first))
        env.reset(seed=2, options={"set": {"clock.window_s": 0.5}})  # holds for a whole launch
        self.assertEqual(processes(self.out / "a" / "0001"), {})
        third = processes(self.out / "a" / "0002")
        with self.assertRaisesRegex(ensonify.RunError, "dropout"):  # a process refuses it, in a new launch too
            env.reset(seed=2, options={"set": {"clock.window_s": 0.5, "nav.altimeter.dropout": -1}})
        self.assertEqual(set(third), set(first))
        self.episode(env, 4)

    def test_a_participant_that_knows_no_epochs_makes_every_episode_a_launch(self):
        agent = self.out / "quiet.py"
        agent.write_text("import ensonify\nwith ensonify.Participant() as me:\n    for step in me.steps(rate=1): pass\n")
        file = self.out / "with.yaml"
        file.write_text(LAUNCH.read_text().replace("  agent: {", f"  quiet: {{ run: [python3, {agent}] }}\n  agent: {{"))
        env = ensonify.Env(file, observe={"nav/altitude": ensonify.Fields(ensonify.Altitude)}, act=ensonify.steer(speed_mps=1.5, depth_m=(10, 28)),
                           reward=lambda seen: 0.0, out=self.out / "a")
        self.addCleanup(env.close)
        env.reset(seed=1)
        env.reset(seed=2)
        self.assertIn("nav", processes(self.out / "a" / "0001"))

    def test_many_resets_leave_nothing_behind(self):
        env = self.make()
        for seed in range(10):
            env.reset(seed=seed)
        scratch = pathlib.Path(env._episodes._running._scratch.name)
        launch = processes(scratch)
        files = sorted(path for path in scratch.rglob("*"))
        before, own = {name: held(folder) for name, folder in launch.items()}, len(os.listdir("/proc/self/fd"))
        for seed in range(RESETS):
            env.reset(seed=seed)
            env.step(np.float32([20]))
        self.assertEqual(processes(scratch), launch)
        self.assertEqual(sorted(path for path in scratch.rglob("*")), files)
        self.assertEqual(len(os.listdir("/proc/self/fd")), own)
        for name, folder in launch.items():
            descriptors, threads, memory_kb = held(folder)
            self.assertEqual((descriptors, threads), before[name][:2], name)
            # A heap that has found its size moves by some MB with the tiles that a seed needs; a leak grows by resets.
            self.assertLess(memory_kb - before[name][2], 20_000 + 5 * RESETS, name)


if __name__ == "__main__":
    unittest.main()
