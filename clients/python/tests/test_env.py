"""The Gymnasium environment: spaces and actions by themselves, then episodes of launch/altitude_hold.yaml."""
import importlib
import importlib.util
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import warnings
from unittest import mock

import gymnasium
import numpy as np
from gymnasium.utils.env_checker import check_env

import ensonify
from ensonify.images import picture
from ensonify.spaces import checked
from ensonify.tasks import TASKS
from ensonify.tasks.__main__ import measured
from ensonify.tasks.profile import SEABED, TRACK, Profile
from ensonify.tasks.wall_follow import image

ROOT = pathlib.Path(__file__).resolve().parents[3]
TASK = "Ensonify/AltitudeHold-v0"
LAUNCH = pathlib.Path(ensonify.__file__).parent / "tasks" / "altitude_hold.yaml"


WINDOWS = importlib.util.find_spec("pygame") is not None
NO_DISPLAY = {"SDL_VIDEODRIVER": "dummy", "PYGAME_HIDE_SUPPORT_PROMPT": "1"}


def environment(**changes):
    """One that sees its altitude and orders depths."""
    return ensonify.Env(**{"launch": LAUNCH, "observe": {"nav/altitude": ensonify.Fields(ensonify.Altitude)},
                           "act": ensonify.steer(speed_mps=1.5, depth_m=(10, 28)), "truth": {"judge/altitude": ensonify.Altitude},
                           "reward": lambda seen: -abs(seen["judge/altitude"].range_m - 6), "seconds": 2, **changes})


def turn():
    """Orders of the REMUS class's propeller, rudder and stern planes."""
    def function(action, seen):
        return ensonify.Actuators(stamp_ns=seen.t_ns, propeller_rps=action[:1], fin_rad=action[1:])

    return ensonify.Act(ensonify.Actuators, function, gymnasium.spaces.Box(np.float32([0, -0.26, -0.26]), np.float32([25, 0.26, 0.26])), port="actuators")


def process(out, name):
    """The process id of one process of the launch whose results go to `out`."""
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().decode().split("\0")
        except OSError:
            continue
        if "--name" in words and words[words.index("--name") + 1] == name and str(out) in words:
            return int(folder.name)
    raise AssertionError(f"{name} does not run")


class Spaces(unittest.TestCase):
    def test_fields_become_arrays_of_their_own_kind(self):
        spaces = ensonify.Fields(ensonify.VelocityLog).spaces("nav/velocity_log")
        self.assertNotIn("nav/velocity_log/stamp_ns", spaces)
        self.assertEqual(spaces["nav/velocity_log/range_m"], gymnasium.spaces.Box(-np.inf, np.inf, (4,), np.float64))
        self.assertEqual(spaces["nav/velocity_log/bottom_lock"], gymnasium.spaces.Box(0, 1, (1,), np.uint8))
        message = ensonify.VelocityLog(bottom_lock=True, range_m=(1.0, 2.0, 3.0, 4.0))
        for key, value in ensonify.Fields(ensonify.VelocityLog).values("nav/velocity_log", message).items():
            self.assertTrue(spaces[key].contains(value), key)

    def test_fields_without_a_shape_or_of_no_message_are_named(self):
        with self.assertRaisesRegex(ValueError, r"^ping/1.amplitude_upa has no fixed shape: make an array of it with ensonify.Array"):
            ensonify.Fields(ensonify.Ping, "amplitude_upa")
        with self.assertRaisesRegex(ValueError, r"^depth/1 has no field depth; it has stamp_ns, depth_m$"):
            ensonify.Fields(ensonify.Depth, "depth")

    def test_a_function_makes_an_array_of_the_stated_shape(self):
        box = gymnasium.spaces.Box(0, 100, (2,), np.float32)
        part = ensonify.Array(ensonify.Depth, lambda depth: [depth.depth_m, 1], box)
        self.assertEqual(part.values("nav/depth", ensonify.Depth(depth_m=3.0))["nav/depth"].tolist(), [3, 1])
        with self.assertRaisesRegex(ValueError, r"^nav/depth: the function's array has shape \(1,\), its space \(2,\)$"):
            ensonify.Array(ensonify.Depth, lambda depth: [1], box).values("nav/depth", ensonify.Depth())

    def test_an_action_must_fit_its_space(self):
        box = gymnasium.spaces.Box(np.float32([-1, 0]), np.float32([1, 5]))
        self.assertEqual(checked([0, 2], box).dtype, np.float32)
        for action, error, text in (
                ([0.0], ValueError, r"^the action has shape \(1,\), not \(2,\)$"),
                ([0.0, np.nan], ValueError, r"^action\[1\]: nan is outside \[0, 5\]$"),
                ([-1.5, 2.0], ValueError, r"^action\[0\]: -1.5 is outside \[-1, 1\]$"),
                (["a", "b"], TypeError, r"^an action of <U1 does not fit float32$"),
                ([[1], [2, 3]], TypeError, r"^the action \[\[1\], \[2, 3\]\] is no array of numbers$"),
                ([1j, 0], TypeError, r"^an action of complex128 does not fit float32$")):
            with self.assertRaisesRegex(error, text):
                checked(action, box)

    def test_arguments_of_a_wrong_kind_are_named_before_anything_starts(self):
        for changes, error, text in (
                ({"observe": ["nav/altitude"]}, TypeError, r"^observe is \['nav/altitude'\]; it must be a dict of topics and"),
                ({"observe": {"nav/altitude": 7}}, TypeError, r"^observe: nav/altitude is 7; allowed: ensonify.Fields, ensonify.Array, ensonify.Rows$"),
                ({"reward": 3}, TypeError, "^reward is 3; allowed: a function of what is Seen$"),
                ({"done": True}, TypeError, "^done is True; allowed: a function of what is Seen$"),
                ({"image": 3, "render_mode": "rgb_array"}, TypeError, "^image is 3; allowed: a topic, a function of what is Seen$"),
                ({"act": None}, TypeError, r"^act is None; allowed: ensonify.steer\(...\)"),
                ({"truth": ["judge/altitude"]}, TypeError, "^truth is "),
                ({"truth": {"judge/altitude": None}}, TypeError, "^truth: judge/altitude is None; allowed: a message type, such as ensonify.Altitude$"),
                ({"set": ["a=1"]}, TypeError, "^set is "),
                ({"hosted": 1}, TypeError, "^hosted is 1; allowed: True or False$"),
                ({"seconds": 0}, ValueError, "^seconds is 0; it must be a number above 0$"),
                ({"patience_s": "long"}, ValueError, "^patience_s is 'long'; it must be a number above 0$")):
            with self.assertRaisesRegex(error, text):
                environment(**changes)
        with self.assertRaisesRegex(TypeError, "^Fields of 'altitude/1'; allowed: a message type, such as ensonify.Altitude$"):
            ensonify.Fields("altitude/1")
        with self.assertRaisesRegex(TypeError, "^the space of an Act is Discrete\\(3\\); allowed: a gymnasium.spaces.Box$"):
            ensonify.Act(ensonify.Guidance, lambda action, seen: None, gymnasium.spaces.Discrete(3))
        for options in ([1], {"set": ["a=1"]}):
            with self.assertRaisesRegex(TypeError, "^options(: set)? is .*; it must be a dict"):
                environment().reset(options=options)

    def test_steering_takes_what_is_a_range_from_the_action(self):
        act = ensonify.steer(heading_rad=(-np.pi, np.pi), speed_mps=1.5, depth_m=(0, 40))
        seen = mock.Mock(t_ns=7)
        command = act.function(np.float32([0.5, 12]), seen)
        self.assertEqual((command.stamp_ns, command.heading_grid_rad, command.speed_mps, command.depth_m), (7, 0.5, 1.5, 12.0))
        with self.assertRaisesRegex(ValueError, "at least one of heading_rad, speed_mps, depth_m and altitude_m"):
            ensonify.steer(speed_mps=1.5)

    def test_propellers_and_fins_are_taken_from_the_action(self):
        sent = turn().function(np.float32([20, -0.1, 0]), mock.Mock(t_ns=7)).to_map()
        self.assertEqual((sent["stamp_ns"], sent["propeller_rps"].tolist(), sent["fin_rad"].dtype), (7, [20.0], np.dtype("<f8")))
        self.assertAlmostEqual(sent["fin_rad"][0], -0.1, places=6)

    def test_an_altitude_is_a_depth_by_what_was_measured(self):
        act = ensonify.steer(altitude_m=(2, 10), altimeter="low/altitude", depth_sensor="low/depth")
        self.assertEqual(act.reads, {"low/altitude": ensonify.Altitude, "low/depth": ensonify.Depth})
        seen = mock.MagicMock(t_ns=7)
        told = {"low/altitude": ensonify.Altitude(valid=True, range_m=9.0), "low/depth": ensonify.Depth(depth_m=20.0)}
        seen.__getitem__.side_effect = told.get
        self.assertEqual(act.function(np.float32([4]), seen).depth_m, 25.0)
        told["low/altitude"] = ensonify.Altitude()
        self.assertTrue(np.isnan(act.function(np.float32([4]), seen).depth_m))  # as before
        with self.assertRaisesRegex(ValueError, "^an order has depth_m or altitude_m, not both$"):
            ensonify.steer(depth_m=(0, 5), altitude_m=3)

    def test_a_waypoint_is_a_heading_from_where_the_vehicle_is(self):
        act = ensonify.goto(east_m=(-100, 100), north_m=0.0, speed_mps=(0, 2), depth_m=5)
        seen = mock.MagicMock(t_ns=7)
        seen.__getitem__.side_effect = {"nav/estimate": ensonify.Estimate(position_enu_m=(10.0, 10.0, -5.0))}.get
        command = act.function(np.float32([20, 1.5]), seen)
        self.assertAlmostEqual(command.heading_grid_rad, 0.75 * np.pi)
        self.assertEqual((command.stamp_ns, command.speed_mps, command.depth_m), (7, 1.5, 5))
        self.assertEqual(act.reads, {"nav/estimate": ensonify.Estimate})

    def test_truth_is_not_observed(self):
        seen = {"judge/altitude": ensonify.Fields(ensonify.Altitude)}
        with self.assertRaisesRegex(ValueError, "^judge/altitude is marked as truth: reward and done may read it, an observation or an action may not$"):
            environment(observe=seen)
        with self.assertRaisesRegex(ValueError, "^judge/altitude is marked as truth"):
            environment(act=ensonify.steer(altitude_m=(3, 12), altimeter="judge/altitude"))
        with self.assertRaisesRegex(ValueError, "^auv/pose is pose/1, which is truth"):
            environment(observe={"auv/pose": ensonify.Fields(ensonify.Pose)})
        with self.assertRaisesRegex(ValueError, "^pager/object is object/1, which is truth"):
            environment(observe={"pager/object": ensonify.Fields(ensonify.Object, "instance")})


class Episodes(unittest.TestCase):
    def make(self, **changes):
        env = environment(**changes)
        self.addCleanup(env.close)
        return env

    def test_the_official_checker_is_content(self):
        for name in TASKS:
            env = gymnasium.make(f"ensonify:Ensonify/{name}-v0")
            with warnings.catch_warnings():
                warnings.simplefilter("error", UserWarning)
                warnings.filterwarnings("ignore", message=".*observation space (minimum|maximum) value")
                with mock.patch.dict(os.environ, NO_DISPLAY):
                    check_env(env.unwrapped, skip_render_check=not WINDOWS)
            env.close()

    def test_the_same_seed_and_actions_give_the_same_observations(self):
        def episode(seed, env):
            seen, info = env.reset(seed=seed)
            self.assertEqual(info["seed"], seed)
            observed, over = [seen], False
            for depth_m in np.linspace(12, 26, 30):
                if not over:
                    seen, reward, terminated, over, _ = env.step(np.float32([depth_m]))
                    observed.append({**seen, "reward": np.float64(reward)})
                    self.assertFalse(terminated)
            self.assertTrue(over)  # after 2 s
            self.assertEqual(len(observed), 21)
            return [{key: value.tobytes() for key, value in one.items()} for one in observed]

        apart, hosted = self.make(), self.make(hosted=True)
        first, other = episode(3, apart), episode(4, apart)
        self.assertEqual(first, episode(3, apart))
        self.assertNotEqual(first, other)
        self.assertEqual([episode(4, hosted), episode(3, hosted)], [other, first])

    def test_vector_environments_run_several_launches(self):
        for mode in ("sync", "async"):
            envs = gymnasium.make_vec(TASK, 2, vectorization_mode=mode)
            seen, _ = envs.reset(seed=[5, 6])
            for _ in range(10):
                seen, *_ = envs.step(np.full((2, 1), 0.5, np.float32))
            self.assertEqual(seen["nav/altitude/range_m"].shape, (2, 1))
            self.assertNotEqual(*seen["nav/altitude/range_m"].ravel())
            envs.close()

    def test_baselines_earn_what_the_manual_says(self):
        page = (ROOT / "docs/manual/gymnasium.md").read_text()
        for name, module in TASKS.items():
            least, most = map(float, re.search(rf"^\| `{name}-v0`.*\((-?\d+) to (\d+)\) \|$", page, re.M).groups())
            env = gymnasium.make(f"Ensonify/{name}-v0")
            policy = importlib.import_module(f"ensonify.tasks.{module}").Baseline()
            total, _, _ = measured(env, policy, seed=101)
            env.close()
            self.assertTrue(least - 0.5 <= total <= most + 0.5, f"{name}: {total}")

    def test_done_ends_an_episode_and_no_step_follows(self):
        env = self.make(done=lambda seen: seen["judge/altitude"].range_m > 1)
        with self.assertRaisesRegex(gymnasium.error.ResetNeeded, r"^there is no episode yet: call reset\(\) first$"):
            env.step(np.float32([20]))
        env.reset(seed=1)
        self.assertEqual(env.step(np.float32([20]))[2:4], (True, False))
        with self.assertRaisesRegex(gymnasium.error.ResetNeeded, r"^the episode has ended: call reset\(\) first$"):
            env.step(np.float32([20]))
        env.reset(seed=1)
        env.close()
        with self.assertRaisesRegex(gymnasium.error.ResetNeeded, r"^the environment was closed: call reset\(\) first$"):
            env.step(np.float32([20]))

    def test_a_bad_action_does_not_end_the_episode(self):
        env = self.make()
        env.reset(seed=1)
        with self.assertRaisesRegex(ValueError, r"^action\[0\]: nan is outside \[10, 28\]$"):
            env.step(np.float32([np.nan]))
        env.step(np.float32([20]))

    def test_a_topic_that_nobody_publishes_is_named(self):
        env = self.make(observe={"nav/altitud": ensonify.Fields(ensonify.Altitude)})
        with self.assertRaisesRegex(ensonify.RunError, r"no process publishes nav/altitud \(did you mean nav/altitude\?\)"):
            env.reset()

    def test_a_topic_of_another_type_is_named(self):
        env = self.make(observe={"nav/altitude": ensonify.Fields(ensonify.Depth)})
        with self.assertRaisesRegex(ensonify.RunError, "nav/altitude is altitude/1, the input takes depth/1"):
            env.reset()

    def test_a_topic_that_stays_silent_is_named(self):
        env = self.make(set={"nav.altimeter.outages_s": [0, 100]}, settle_s=2)
        with self.assertRaisesRegex(TimeoutError, "^nav/altitude: nothing came within 2 s of sim time$"):
            env.reset()

    def test_parameters_may_change_with_each_reset(self):
        env = self.make(set={"nav.altimeter.dropout": 0})
        seen, _ = env.reset(seed=1, options={"set": {"nav.altimeter.dropout": 1}})
        self.assertEqual(seen["nav/altitude/valid"], [0])
        seen, _ = env.reset(seed=1)
        self.assertEqual(seen["nav/altitude/valid"], [1])
        with self.assertRaisesRegex(ensonify.RunError, "nav.altimeter.drop_out: is not a known key; did you mean dropout"):
            env.reset(options={"set": {"nav.altimeter.drop_out": 1}})
        with self.assertRaisesRegex(ValueError, r"^set: seed is given by reset\(seed=...\)$"):
            env.reset(options={"set": {"seed": 1}})
        with self.assertRaisesRegex(ValueError, "^options has 'sets'; allowed: 'set'$"):
            env.reset(options={"sets": {}})

    def test_an_ordered_altitude_is_held_and_a_waypoint_reached(self):
        env = self.make(act=ensonify.steer(speed_mps=1.5, altitude_m=(3, 12)), seconds=1000)
        env.reset(seed=2)
        for _ in range(250):
            _, reward, *_ = env.step(np.float32([6]))
        altitude_m = [6 + env.step(np.float32([6]))[1] for _ in range(50)]  # the reward is minus the error
        self.assertLess(max(abs(each - 6) for each in altitude_m), 1.5)
        env.close()
        env = self.make(act=ensonify.goto(east_m=(-200, 200), north_m=(-300, 300), speed_mps=2.0), seconds=1000, truth={"auv/pose": ensonify.Pose},
                        reward=lambda seen: np.hypot(seen["auv/pose"].position_enu_m[0] - 60, seen["auv/pose"].position_enu_m[1] + 160))
        env.reset(seed=2)
        away_m = [env.step(np.float32([60, -160]))[1] for _ in range(450)]
        self.assertGreater(away_m[0], 60)
        self.assertLess(min(away_m), 3)

    def test_a_process_that_dies_is_named(self):
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            env = self.make(out=folder, seconds=1000)
            env.reset(seed=1)
            os.kill(process(f"{folder}/0000", "nav"), signal.SIGKILL)
            with self.assertRaisesRegex(ensonify.RunError, "with exit code 3: process nav: was killed by signal 9") as raised:
                for _ in range(5000):
                    env.step(np.float32([20]))
            self.assertEqual((raised.exception.code, raised.exception.culprit), (3, "nav"))
            with self.assertRaisesRegex(gymnasium.error.ResetNeeded, "^the episode broke off"):
                env.step(np.float32([20]))
            env.reset(seed=1)  # and all is well again
            env.step(np.float32([20]))

    def test_an_agent_turns_the_rudder_itself(self):
        remus = ROOT / "components/vehicle/hydrodynamic/remus_100.yaml"
        for fin, sign in ((0.1, 1), (-0.1, -1)):  # positive to starboard
            env = self.make(act=turn(), seconds=1000, set={"vehicles.auv.kind": "hydrodynamic", "vehicles.auv.dynamics": str(remus), "vehicles.auv.turning_radius_m": 25},
                            truth={"auv/pose": ensonify.Pose}, reward=lambda seen: seen["auv/pose"].rate_body_radps[2])
            env.reset(seed=1)
            for _ in range(100):
                _, rate_radps, *_ = env.step(np.float32([20, fin, 0]))
            self.assertGreater(sign * rate_radps, 0.03)
            env.close()

    def test_a_process_that_may_be_lost_ends_no_episode_and_the_next_one_has_it_again(self):
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            launch = pathlib.Path(folder) / "launch.yaml"
            text = LAUNCH.read_text()
            self.assertIn("judge: { run: navigation,", text)
            launch.write_text(text.replace("judge: { run: navigation,", "judge: { may_be_lost: true, run: navigation,"))
            env = self.make(launch=launch, out=f"{folder}/out", seconds=1000)
            env.reset(seed=1)
            os.kill(process(f"{folder}/out/0000", "judge"), signal.SIGKILL)
            rewards = [env.step(np.float32([20]))[1] for _ in range(200)]
            self.assertEqual(len(set(rewards[-100:])), 1)  # by its last message
            env.reset(seed=1)  # another launch
            self.assertTrue(process(f"{folder}/out/0001", "judge"))
            rewards = [env.step(np.float32([20]))[1] for _ in range(200)]
            self.assertGreater(len(set(rewards[-100:])), 50)
            env.close()

    def test_a_process_that_hangs_is_noticed(self):
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            env = self.make(out=folder, seconds=1000, patience_s=2)
            env.reset(seed=1)
            os.kill(process(f"{folder}/0000", "nav"), signal.SIGSTOP)
            with self.assertRaisesRegex(ensonify.RunError, "^nav: no answer; agent: the others have made no progress for 2 s$") as raised:
                for _ in range(5000):
                    env.step(np.float32([20]))
            self.assertEqual((raised.exception.code, raised.exception.culprit), (4, "nav"))
            with self.assertRaises(AssertionError):
                process(f"{folder}/0000", "nav")

    def test_a_launch_that_awaits_nobody_or_is_not_there_says_so(self):
        with self.assertRaisesRegex(ensonify.RunError, "nowhere.yaml: no such file"):
            self.make(launch="nowhere.yaml").reset()
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            alone = pathlib.Path(folder) / "alone.yaml"
            alone.write_text(LAUNCH.read_text().replace("agent: { external: true }", ""))
            with self.assertRaisesRegex(ensonify.RunError, "alone.yaml: awaits nobody: it needs a process with `external: true`"):
                self.make(launch=alone).reset()

    def test_who_has_not_joined_is_named(self):
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            two = pathlib.Path(folder) / "two.yaml"
            two.write_text(LAUNCH.read_text().replace("  agent: {", "  friend: { external: true }\n  agent: {"))
            with self.assertRaisesRegex(ensonify.RunError, "^friend: has not joined; agent: the others have made no progress for 1 s$") as raised:
                self.make(launch=two, patience_s=1).reset(seed=1)
        self.assertEqual((raised.exception.code, raised.exception.culprit), (4, "friend"))

    def test_an_agent_that_the_launch_starts_itself_is_refused_at_once(self):
        for name in ("nav", "nobody"):
            began = time.monotonic()
            with self.assertRaises(ensonify.RunError) as raised:
                self.make(agent=name).reset(seed=1)
            self.assertLess(time.monotonic() - began, 20)  # patience_s is 300
            self.assertEqual((raised.exception.code, raised.exception.culprit), (2, name))
            self.assertEqual(str(raised.exception), f"{LAUNCH}: agent={name!r} is not external there; allowed, as it marks them `external: true`: agent")

    def test_two_environments_do_not_share_a_folder(self):
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            first, second = self.make(out=folder), self.make(out=folder)
            first.reset(seed=1)
            with self.assertRaisesRegex(ensonify.RunError, f"{folder}/0000: another run puts its results there"):
                second.reset(seed=1)
            first.step(np.float32([20]))

    def test_a_reward_may_depend_on_the_action(self):
        env = self.make(reward=lambda seen: -float(seen.action[0]))
        env.reset(seed=1, options={"set": {"nav.altimeter.rotation_deg": np.zeros(3)}})
        self.assertEqual(env.step(np.float32([20]))[1], -20)
        env = self.make(reward=lambda seen: None)
        env.reset(seed=1)
        with self.assertRaisesRegex(TypeError, "^the reward at t = [0-9.]+ s is None, which is no number$"):
            env.step(np.float32([20]))
        env = self.make(reward=lambda seen: float("nan"))
        env.reset(seed=1)
        with self.assertRaisesRegex(ValueError, "^the reward at t = [0-9.]+ s is nan$"):
            env.step(np.float32([20]))

    def test_a_launch_that_ends_too_soon_says_when(self):
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            short = pathlib.Path(folder) / "short.yaml"
            short.write_text(LAUNCH.read_text().replace("duration_s: 3600", "duration_s: 1"))
            env = self.make(launch=short, seconds=1000)
            env.reset(seed=1)
            with self.assertRaisesRegex(ensonify.RunError, "the run ended at t = 1.000 s with exit code 0"):
                for _ in range(5000):
                    env.step(np.float32([20]))


    def test_a_picture_is_the_newest_ping_with_port_left_and_far_first(self):
        ping = ensonify.Ping(beam_angle_rad=np.float32([0.1, -0.1]), amplitude_upa=np.float32([[1000, 1, 100], [1, 10, 1000]]))
        image = picture(ping)  # of the port beam 60, 40 and 0 dB below the strongest
        self.assertEqual(image[..., 0].tolist(), [[255, 170], [85, 0], [0, 255]])
        self.assertEqual((image.shape, image.dtype), ((3, 2, 3), np.uint8))

    def test_a_wall_image_has_near_first_port_left_and_a_fixed_scale(self):
        amplitude = np.full((64, 256), 1e-3, np.float32)
        amplitude[0, 3], amplitude[63, 255] = 1e6, 1e8  # 120 and 160 dB; 80 is black
        ping = ensonify.Ping(beam_angle_rad=np.linspace(1, -1, 64, dtype=np.float32), amplitude_upa=amplitude,
                             sample_period_s=40 / 1480 / 256)
        seen = image(ping)
        self.assertEqual((seen.shape, seen.dtype), ((64, 64), np.uint8))
        self.assertEqual([(*map(int, at), int(seen[tuple(at)])) for at in np.argwhere(seen)], [(0, 63, 128), (63, 0, 255)])

    def test_a_dive_is_drawn_over_the_seabed_that_was_measured(self):
        past = {"nav/depth": [ensonify.Depth(depth_m=depth_m) for depth_m in (5.0, 10.0, 20.0)],
                "nav/altitude": [ensonify.Altitude(valid=valid, range_m=10.0) for valid in (True, False, True)]}
        drawn = Profile()(mock.Mock(last=past.get))
        self.assertEqual((drawn.shape, drawn.dtype), ((160, 300, 3), np.uint8))
        track, seabed = ((drawn == colour).all(axis=2) for colour in (TRACK, SEABED))
        self.assertEqual([np.flatnonzero(column).mean() / 4 for column in track.T[-3:]], [5 - 0.125, 10 - 0.125, 20 - 0.125])
        self.assertEqual(seabed.sum(axis=0)[-4:].tolist(), [0, 100, 0, 40])  # 25 m and 10 m of it down to 40 m

    def test_a_head_renders(self):
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            with_head = pathlib.Path(folder) / "with_head.yaml"
            head = "  eye: { run: multibeam, config: { beams: 16, ping_rate_hz: 5 } }\n  agent: {"
            text = LAUNCH.read_text().replace("  agent: {", head)
            text += "wiring: { eye.estimate: nav/estimate, eye.sound_speed: nav/sound_speed, eye.attitude: nav/attitude }\n"
            with_head.write_text(text.replace("      start:", "      mountings: { eye: { actual: {} } }\n      start:"))
            env = self.make(launch=with_head, image="eye/ping", render_mode="rgb_array")
            env.reset(seed=1)
            image = env.render()
            self.assertEqual((image.shape[1:], image.dtype, image.max()), ((16, 3), np.uint8, 255))
        with self.assertRaisesRegex(ValueError, "^render_mode='rgb_array' needs image=: the topic of a head's pings, or a function"):
            environment(render_mode="rgb_array")
        with self.assertRaisesRegex(ValueError, "^render_mode is 'ansi'; allowed: None, 'rgb_array', 'human'$"):
            environment(render_mode="ansi")

    @unittest.skipUnless(WINDOWS, "there is no pygame")
    def test_a_window_shows_each_step_by_itself(self):
        import pygame
        frames = iter((10, 20, 30, 40))

        def image(seen):
            return np.full((4, 8, 3), (next(frames), 0, 255), np.uint8)

        with mock.patch.dict(os.environ, NO_DISPLAY):
            env = self.make(image=image, render_mode="human", fps=1000)
            shown = lambda: tuple(pygame.display.get_surface().get_at((511, 255)))[:3]
            env.reset(seed=1)
            self.assertEqual((pygame.display.get_surface().get_size(), shown()), ((512, 256), (10, 0, 255)))
            env.step(np.float32([20]))
            self.assertEqual((env.render(), shown()), (None, (20, 0, 255)))
            env.close()
            self.assertIsNone(pygame.display.get_surface())
            env.reset(seed=1)
            self.assertEqual(shown(), (30, 0, 255))


class Surroundings(unittest.TestCase):
    def test_without_the_programs_an_exception_says_so(self):
        with mock.patch.dict(os.environ, {"ENSONIFY_BIN": "/nowhere"}):
            with self.assertRaisesRegex(ensonify.RunError, r"^the program `ensonify` is not in /nowhere \(ENSONIFY_BIN\)$"):
                environment().reset()
        with mock.patch.dict(os.environ, {"PATH": "/nowhere"}):
            del os.environ["ENSONIFY_BIN"]
            with self.assertRaisesRegex(ensonify.RunError, "^the program `ensonify` is not on PATH; ENSONIFY_BIN can name the folder"):
                environment().reset()

    def test_a_window_without_pygame_or_a_display_says_what_it_lacks(self):
        with mock.patch.dict(sys.modules, {"pygame": None}):
            with self.assertRaisesRegex(ImportError, "^render_mode='human' needs pygame: pip install 'ensonify\\[human\\]'; without it 'rgb_array'"):
                environment(image="eye/ping", render_mode="human")
        if WINDOWS:
            with mock.patch.dict(os.environ):
                for name in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"):
                    os.environ.pop(name, None)
                with self.assertRaisesRegex(RuntimeError, "^render_mode='human' needs a display; without one 'rgb_array' is allowed, or None$"):
                    environment(image="eye/ping", render_mode="human")

    def test_without_gymnasium_the_rest_of_the_client_works(self):
        program = "import sys; sys.modules['gymnasium'] = None; import ensonify; ensonify.Observer; ensonify.Env"
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
        self.assertIn("ImportError: ensonify.Env needs Gymnasium: pip install 'ensonify[gym]'", done.stderr)

    def test_the_manuals_code_runs_as_it_stands(self):
        code = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs/manual/gymnasium.md").read_text(), re.M | re.S)
        self.assertEqual(len(code), 6)
        done = subprocess.run([sys.executable, "-c", "\n".join(code)], cwd=ROOT, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(float(done.stdout), 440)

    def test_the_launch_files_of_tasks_are_installed_with_the_client(self):
        client = pathlib.Path(__file__).resolve().parents[1]
        with tempfile.TemporaryDirectory(prefix="ens-") as folder:
            source, target = pathlib.Path(folder) / "source", pathlib.Path(folder) / "installed"
            shutil.copytree(client, source / "clients" / "python", symlinks=True, ignore=shutil.ignore_patterns("build", "*.egg-info"))
            shutil.copytree(client.parents[1] / "launch", source / "launch")
            subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", "--no-build-isolation",
                            "--target", target, source / "clients" / "python"], check=True)
            for file in (client / "ensonify" / "tasks").glob("*.yaml"):
                self.assertEqual((target / "ensonify" / "tasks" / file.name).read_text(), file.read_text())

    def test_a_launch_ends_with_the_program_that_started_it(self):
        program = ("import os, signal, sys, gymnasium, ensonify; env = gymnasium.make('Ensonify/AltitudeHold-v0', out=sys.argv[1]);"
                   "env.reset(seed=1); print('started', flush=True); ENDING")
        for ending in ("raise SystemExit", "os.kill(os.getpid(), signal.SIGKILL)"):
            with tempfile.TemporaryDirectory(prefix="ens-") as folder:
                done = subprocess.run([sys.executable, "-c", program.replace("ENDING", ending), folder], capture_output=True, text=True)
                self.assertEqual(done.stdout, "started\n", done.stderr)
                result = pathlib.Path(folder) / "0000" / "run.json"
                while not result.exists():  # written last; a run that goes on is ended by the test's time limit
                    pass


if __name__ == "__main__":
    unittest.main()
