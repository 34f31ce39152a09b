"""PettingZoo's parallel API: agents by themselves, then episodes of launch/keep_formation.yaml."""
import contextlib
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import warnings
from unittest import mock

import gymnasium
import numpy as np
from pettingzoo.test import parallel_api_test

import ensonify
from ensonify import episodes
from ensonify.tasks import TEAM_TASKS
from ensonify.tasks.__main__ import measured, task
from ensonify.tasks.keep_formation import KeepFormation, auv

ROOT = pathlib.Path(__file__).resolve().parents[3]
LEVEL, DOWN = np.float32([0, 0]), np.float32([1, 0])


def agent(**changes):
    """One that sees red's depth and orders its heading."""
    return ensonify.Agent(**{"observe": {"red_nav/depth": ensonify.Fields(ensonify.Depth)},
                             "act": ensonify.steer(heading_rad=(-0.5, 0.5)), "reward": lambda seen: 0.0, **changes})


def auv_with(name, **changes):
    """One of the task's, which earns nothing, changed."""
    task_agent = auv(name)
    return ensonify.Agent(**{"observe": task_agent.observe, "act": task_agent.act, "reward": lambda seen: 0.0, **changes})


def observed(seen):
    """Each agent's observation as bytes."""
    return {name: {key: value.tobytes() for key, value in one.items()} for name, one in seen.items()}


class Agents(unittest.TestCase):
    def environment(self, **agents):
        return ensonify.ParallelEnv("launch.yaml", agents=agents, truth={"red_judge/altitude": ensonify.Altitude})

    def test_spaces_are_the_same_objects_at_each_call(self):
        env = self.environment(red=agent(), blue=agent())
        self.assertEqual((env.possible_agents, env.agents, env.metadata["name"]), (["red", "blue"], [], "ensonify"))
        self.assertIs(env.action_space("red"), env.action_space("red"))
        self.assertIs(env.observation_space("blue"), env.observation_space("blue"))

    def test_truth_is_not_observed(self):
        seen = {"red_judge/altitude": ensonify.Fields(ensonify.Altitude)}
        with self.assertRaisesRegex(ensonify.TruthError, "^red_judge/altitude is marked as truth"):
            self.environment(red=agent(), blue=agent(observe=seen))
        with self.assertRaisesRegex(ensonify.TruthError, "^blue/pose is pose/1, which is truth"):
            self.environment(red=agent(observe={"blue/pose": ensonify.Fields(ensonify.Pose)}))

    def test_a_topic_has_one_type(self):
        with self.assertRaisesRegex(ValueError, "^red_nav/depth is read as depth/1 and as altitude/1$"):
            self.environment(red=agent(), blue=agent(observe={"red_nav/depth": ensonify.Fields(ensonify.Altitude)}))

    def test_an_agent_is_named_so_that_its_port_can_be(self):
        with self.assertRaisesRegex(ValueError, "^agent 'red one': a name has letters, digits and _$"):
            self.environment(**{"red one": agent()})
        for agents, error, text in ((["red"], TypeError, r"^agents is \['red'\]; it must be a dict of names and agents$"),
                                    ({"red": 7}, TypeError, r"^agents: red is 7; allowed: ensonify.Agent\(...\)$"),
                                    ({}, ValueError, "^agents is empty; there must be one$")):
            with self.assertRaisesRegex(error, text):
                ensonify.ParallelEnv("keep_formation.yaml", agents=agents)


class Episodes(unittest.TestCase):
    def make(self, **changes):
        env = KeepFormation(**{"seconds": 2, **changes})
        self.addCleanup(env.close)
        return env

    def test_the_official_checker_is_content(self):
        leaving = {"red": auv_with("red", done=lambda seen: seen.t_s >= 1), "blue": auv("blue")}
        for env in (self.make(seconds=60), self.make(agents=leaving)):
            with warnings.catch_warnings():
                warnings.simplefilter("error", UserWarning)
                warnings.filterwarnings("ignore", message="options: 'options' is not known and ignored; allowed: 'set'")
                parallel_api_test(env, num_cycles=1000)

    def test_the_same_seed_and_actions_give_the_same_observations(self):
        def episode(env, seed):
            seen, infos = env.reset(seed=seed)
            self.assertEqual({name: info["seed"] for name, info in infos.items()}, {"red": seed, "blue": seed})
            steps, turn = [observed(seen)], np.random.default_rng(5)
            while env.agents:
                actions = {name: turn.uniform(-1, 1, 2).astype(np.float32) for name in env.possible_agents}
                seen, rewards, terminated, truncated, _ = env.step(actions)
                self.assertEqual(terminated, {"red": False, "blue": False})
                steps.append((observed(seen), rewards))
            self.assertEqual(truncated, {"red": True, "blue": True})
            self.assertEqual(len(steps), 21)  # after 2 s
            return steps

        first, second = self.make(), self.make()
        with mock.patch.object(episodes, "Episode", wraps=episodes.Episode) as launches:
            steps = episode(first, 3)
            self.assertEqual(launches.call_args.args[3]["seed"], 3)  # the scenario's
            self.assertNotEqual(steps, episode(first, 4))
            self.assertEqual(steps, episode(first, 3))
            self.assertEqual(launches.call_count, 1)  # all in the same processes
            self.assertEqual(steps, episode(second, 3))
            self.assertEqual(launches.call_count, 2)

    def test_seeds_follow_from_the_last_one_given(self):
        def seeds(env):
            return [env.reset(seed)[1]["red"]["seed"] for seed in (3, None, None)]

        env = self.make()
        once = seeds(env)
        self.assertEqual(len(set(once)), 3)
        self.assertEqual(once, seeds(env))

    def test_each_agent_steers_its_own_vehicle(self):
        env = self.make(seconds=5)
        before, _ = env.reset(seed=1)
        while env.agents:
            seen, *_ = env.step({"blue": DOWN, "red": LEVEL})  # in any order
            self.assertEqual(list(seen), ["red", "blue"])
        sunk = {name: seen[name][f"{name}_nav/depth/depth_m"][0] - before[name][f"{name}_nav/depth/depth_m"][0] for name in seen}
        self.assertGreater(sunk["blue"], 1.5)
        self.assertLess(abs(sunk["red"]), 0.3)

    def test_the_launch_file_may_wire_agents_to_other_vehicles(self):
        text = (ROOT / "launch/keep_formation.yaml").read_text()
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            crossed = pathlib.Path(folder) / "crossed.yaml"
            crossed.write_text(text.replace("wiring:\n", "wiring:\n  red.command: agent/command_b\n  blue.command: agent/command_a\n"))
            act = ensonify.steer(speed_mps=1.5, depth_m=(10, 30))
            env = self.make(launch=crossed, agents={"a": auv_with("red", act=act), "b": auv_with("blue", act=act)}, seconds=5)
            before, _ = env.reset(seed=1)
            while env.agents:
                seen, *_ = env.step({"a": np.float32([20]), "b": np.float32([30])})
        at = {"a": "red_nav/depth/depth_m", "b": "blue_nav/depth/depth_m"}  # what each observes
        sunk = {name: seen[name][key][0] - before[name][key][0] for name, key in at.items()}
        self.assertGreater(sunk["a"], 1.5)
        self.assertLess(abs(sunk["b"]), 0.3)

    def test_a_reset_that_is_refused_leaves_the_episode_as_it_is(self):
        env = self.make()
        env.reset(seed=1)
        with self.assertRaisesRegex(ValueError, r"^set: seed is given by reset\(seed=...\)$"):
            env.reset(options={"set": {"seed": 2}})
        env.step({"red": LEVEL, "blue": LEVEL})

    def test_one_agent_leaves_and_its_last_order_stands(self):
        depths = []  # of red
        env = self.make(seconds=4, agents={
            "red": auv_with("red", done=lambda seen: seen.t_s > 0.55),
            "blue": auv_with("blue", reward=lambda seen: depths.append(-seen["red/pose"].position_enu_m[2]) or 0.0)})
        env.reset(seed=1)
        order = {"red": DOWN, "blue": LEVEL}
        gone = 0
        while env.agents:
            seen, rewards, terminated, truncated, infos = env.step({name: order[name] for name in env.agents})
            for each in (seen, rewards, truncated, infos):
                self.assertEqual(each.keys(), terminated.keys())
            if terminated.get("red"):
                gone = len(depths)
                self.assertEqual((env.agents, terminated), (["blue"], {"red": True, "blue": False}))
                self.assertEqual(truncated, {"red": False, "blue": False})
                with self.assertRaisesRegex(ValueError, "^red: it has left the episode; an action is due for blue$"):
                    env.step(order)
            elif gone:
                self.assertEqual(list(seen), ["blue"])
        self.assertEqual(len(depths), 40)
        self.assertLess(gone, 10)
        self.assertGreater(depths[-1] - depths[gone - 1], 1)  # red dives on
        env.reset(seed=1)
        self.assertEqual(env.agents, ["red", "blue"])

    def test_who_is_done_at_the_last_step_is_not_truncated(self):
        env = self.make(agents={"red": auv_with("red", done=lambda seen: True), "blue": auv_with("blue")}, seconds=0.1)
        env.reset(seed=1)
        _, _, terminated, truncated, _ = env.step({"red": LEVEL, "blue": LEVEL})
        self.assertEqual((terminated, truncated), ({"red": True, "blue": False}, {"red": False, "blue": True}))

    def test_wrong_actions_name_the_agent_and_the_episode_goes_on(self):
        env = self.make()
        seen, _ = env.reset(seed=1)
        for actions, error, text in (
                ({"red": LEVEL}, ValueError, "blue: its action is missing; one is due for red, blue"),
                ({"red": LEVEL, "blue": LEVEL, "green": LEVEL}, ValueError, "green: it is no agent; an action is due for red, blue"),
                ({"red": LEVEL, "blue": np.float32([0])}, ValueError, r"blue: the action has shape \(1,\), not \(2,\)"),
                ({"red": np.float32([0, np.nan]), "blue": LEVEL}, ValueError, r"red: action\[1\]: nan is outside \[-1, 1\]"),
                ({"red": LEVEL, "blue": ["a", "b"]}, TypeError, "blue: an action of <U1 does not fit float32")):
            with self.assertRaisesRegex(error, f"^{text}$"):
                env.step(actions)
        again, rewards, *_ = env.step({"red": LEVEL, "blue": LEVEL})
        undisturbed = self.make()
        undisturbed.reset(seed=1)
        self.assertEqual(observed(again), observed(undisturbed.step({"red": LEVEL, "blue": LEVEL})[0]))

    def test_no_step_follows_the_end(self):
        env = self.make(seconds=0.2)
        with self.assertRaisesRegex(gymnasium.error.ResetNeeded, r"^there is no episode yet: call reset\(\) first$"):
            env.step({})
        env.reset(seed=1)
        while env.agents:
            env.step(dict.fromkeys(env.agents, LEVEL))
        with self.assertRaisesRegex(gymnasium.error.ResetNeeded, r"^the episode has ended: call reset\(\) first$"):
            env.step({})
        env.reset(seed=1)
        env.close()
        with self.assertRaisesRegex(gymnasium.error.ResetNeeded, r"^the environment was closed: call reset\(\) first$"):
            env.step(dict.fromkeys(env.agents, LEVEL))

    def test_a_reward_depends_on_the_agents_own_action_and_is_a_number(self):
        env = self.make(agents={name: auv_with(name, reward=lambda seen: float(seen.action[0])) for name in ("red", "blue")})
        env.reset(seed=1)
        self.assertEqual(env.step({"red": LEVEL, "blue": DOWN})[1], {"red": 0, "blue": 1})
        env = self.make(agents={"red": auv("red"), "blue": auv_with("blue", reward=lambda seen: np.nan)})
        env.reset(seed=1)
        with self.assertRaisesRegex(ValueError, "^blue: the reward at t = [0-9.]+ s is nan$"):
            env.step({"red": LEVEL, "blue": LEVEL})

    def test_baselines_earn_what_the_manual_says(self):
        page = (ROOT / "docs/manual/gymnasium.md").read_text()
        for name in TEAM_TASKS:
            least, most = map(float, re.search(rf"^\| `{name}`.*\((\d+) to (\d+)\) \|$", page, re.M).groups())
            env, baseline = task(name)
            with contextlib.closing(env):
                total, _, _ = measured(env, baseline(), seed=101)
            self.assertTrue(least - 0.5 <= total <= most + 0.5, f"{name}: {total}")


class Surroundings(unittest.TestCase):
    def test_without_pettingzoo_the_rest_of_the_client_works(self):
        program = "import sys; sys.modules['pettingzoo'] = None; import ensonify; ensonify.Env; ensonify.Agent; ensonify.ParallelEnv"
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
        self.assertIn("ImportError: ensonify.ParallelEnv needs PettingZoo: pip install 'ensonify[pettingzoo]'", done.stderr)


if __name__ == "__main__":
    unittest.main()
