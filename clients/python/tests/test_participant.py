"""Participants and observers on real sockets, conducted by tests/tiny_clock.py."""
import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile
import threading
import unittest
from unittest import mock

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import ensonify  # noqa: E402
from ensonify import injections  # noqa: E402
from tiny_clock import TinyClock  # noqa: E402

SECOND = 1_000_000_000


class Head(threading.Thread):
    """Publishes pings at 20 Hz whose content is their own time, and may hold each step back by an event."""

    def __init__(self, clock, rate=20, delay_ms=0.0):
        super().__init__(daemon=True)
        self.clock, self.rate, self.delay_ms = clock, rate, delay_ms
        self.commands = []  # (own time, time of the command)
        self.end_code = None

    def run(self):
        with ensonify.Participant("head", clock=self.clock, config={}) as me:
            out = me.publish("ping", ensonify.Ping, max_bytes=1 << 20, rate=self.rate)
            commands = me.subscribe("command", ensonify.Guidance, delay_ms=self.delay_ms) if self.delay_ms else []
            for n, step in enumerate(me.steps(rate=self.rate)):
                self.commands += [(step.t_ns, command.stamp_ns) for command in commands]
                out.send(ensonify.Ping(stamp_ns=step.t_ns, ping=n, amplitude_upa=np.full((4, 100), n, "f4")))
        self.end_code = me.end_code


class InARun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="ens-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def start(self, expected, wiring, end_ns, endpoint=None):
        clock = TinyClock(endpoint or f"ipc://{self.folder}/clock", expected, wiring, end_ns)
        clock.start()
        return clock

    def finish(self, clock, *threads):
        for thread in (clock, *threads):
            thread.join(10)
            self.assertFalse(thread.is_alive())
        self.assertIsNone(clock.problem)

    def test_each_step_sees_exactly_what_is_due(self):
        for endpoint in (None, "tcp://127.0.0.1:*"):
            clock = self.start(["head", "agent"], {"agent.ping": "head/ping"}, 2 * SECOND, endpoint)
            head = Head(clock.endpoint)
            head.start()
            seen = []
            with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
                pings = me.subscribe("ping", ensonify.Ping)
                for step in me.steps(rate=10):
                    seen.append((step.t_ns, [ping.stamp_ns for ping in pings]))
                    for ping in pings:
                        self.assertTrue((ping.amplitude_upa == ping.ping).all())
            self.finish(clock, head)
            expected = [(0, [0])] + [(n * SECOND // 10, [(2 * n - 1) * SECOND // 20, 2 * n * SECOND // 20]) for n in range(1, 21)]
            self.assertEqual(seen, expected)
            self.assertEqual((me.end_code, head.end_code), (0, 0))

    def test_a_loop_with_a_delayed_edge(self):
        clock = self.start(["head", "agent"], {"agent.ping": "head/ping", "head.command": "agent/command"}, 2 * SECOND)
        head = Head(clock.endpoint, delay_ms=100)
        head.start()
        with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
            pings = me.subscribe("ping", ensonify.Ping)
            command = me.publish("command", ensonify.Guidance, rate=20)
            for step in me.steps(rate=20):
                self.assertEqual(pings.latest.stamp_ns, step.t_ns)
                command.send(ensonify.Guidance(stamp_ns=step.t_ns))
        self.finish(clock, head)
        self.assertEqual(head.commands, [(n * SECOND // 20, (n - 2) * SECOND // 20) for n in range(2, 41)])

    def test_a_step_may_choose_the_next_one(self):
        clock = self.start(["agent"], {}, SECOND)
        times = []
        with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
            for step in me.steps(first_ns=5):
                times.append(step.t_ns)
                step.next_ns = step.t_ns * 10
        self.finish(clock)
        self.assertEqual(times, [5 * 10**n for n in range(9)])

    def test_rates_are_exact(self):
        clock = self.start(["agent"], {}, SECOND)
        with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
            times = [step.t_ns for step in me.steps(rate=15)]
        self.finish(clock)
        self.assertEqual(times, [n * SECOND // 15 for n in range(16)])

    def test_finish_ends_the_run_for_all(self):
        clock = self.start(["head", "agent"], {"agent.ping": "head/ping"}, 1000 * SECOND)
        head = Head(clock.endpoint)
        head.start()
        with ensonify.Participant("agent", clock=clock.endpoint, config={}, may_finish=True) as me:
            me.subscribe("ping", ensonify.Ping)
            for step in me.steps(rate=1):
                if step.t_ns == 3 * SECOND:
                    me.finish()
        self.finish(clock, head)
        self.assertEqual(step.t_ns, 4 * SECOND)
        self.assertEqual(clock.counts[0], 81)
        self.assertEqual(me.facts, {"seed": "1"})

    def test_leaving_the_loop_lets_the_run_go_on(self):
        clock = self.start(["head", "agent"], {"agent.ping": "head/ping"}, 5 * SECOND)
        head = Head(clock.endpoint)
        head.start()
        with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
            me.subscribe("ping", ensonify.Ping)
            for step in me.steps(rate=10):
                break
        self.finish(clock, head)
        self.assertEqual(clock.counts[0], 101)

    def test_an_error_ends_the_run_and_says_why(self):
        clock = self.start(["agent"], {}, SECOND)
        with self.assertRaisesRegex(ZeroDivisionError, "planted"):
            with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
                for _ in me.steps(rate=10):
                    raise ZeroDivisionError("planted")
        self.finish(clock)
        self.assertEqual((clock.failed["code"], clock.failed["message"]), (3, "ZeroDivisionError: planted"))

    def agent_beside(self, publish):
        """An agent that reads the pings of a head which publishes by `publish(me, out, step)`: exit code and last words of
        the agent, and what it said to the clock."""
        clock = self.start(["head", "agent"], {"agent.ping": "head/ping"}, SECOND)

        def head_of_the_run():
            with ensonify.Participant("head", clock=clock.endpoint, config={}) as me:
                out = me.publish("ping", ensonify.Ping, rate=20)
                for step in me.steps(rate=20):
                    publish(me, out, step)

        head = threading.Thread(target=head_of_the_run, daemon=True)
        head.start()
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), self.assertRaises(SystemExit) as left:
            with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
                me.subscribe("ping", ensonify.Ping)
                list(me.steps(rate=20))
        self.finish(clock, head)
        self.assertEqual(clock.failed["culprit"], "head")
        return left.exception.code, errors.getvalue(), clock.failed

    def test_a_lost_message_ends_the_run_with_5(self):
        def lossy(me, out, step):
            if step.t_ns == SECOND // 2:
                me._session._published[out.topic_id] += 1  # as if a message had vanished
            out.send(ensonify.Ping())

        code, words, failed = self.agent_beside(lossy)
        self.assertEqual((code, failed["code"]), (5, 5))
        self.assertIn("head lost messages: head/ping: seq 10 is missing, 11 came", words)

    def test_what_is_counted_and_never_comes_is_lost_by_its_publisher(self):
        def boasting(me, out, step):
            me._session._published[out.topic_id] += 1  # counted, not sent

        with mock.patch("ensonify.session.PATIENCE_S", 0.5):
            code, words, failed = self.agent_beside(boasting)
        self.assertEqual((code, failed["code"]), (5, 5))
        self.assertRegex(words, r"^head lost messages: head/ping: its DONE counted \d+, 0 have come$")

    def test_a_message_that_cannot_be_read_is_its_senders_mistake(self):
        def babbling(me, out, step):
            me._session.publish(out._topic_frame, out.topic_id, out._hash, step.t_ns, [b"\xc1"])

        code, words, _ = self.agent_beside(babbling)
        self.assertEqual(code, 3)
        self.assertIn("head sent a message that cannot be used: head/ping: seq 0: ", words)

    def test_a_clock_that_vanishes_is_noticed(self):
        clock = self.start(["agent"], {}, 10**6 * SECOND)
        errors = io.StringIO()
        with contextlib.redirect_stderr(errors), self.assertRaises(SystemExit) as left:
            with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
                for step in me.steps(rate=1):
                    clock.vanish = True
                    step.next_ns = ensonify.NEVER
        clock.join(10)
        self.assertEqual(left.exception.code, 3)
        self.assertIn("the clock is gone", errors.getvalue())

    def test_misuse_is_refused(self):
        clock = self.start(["agent"], {}, SECOND)
        with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
            command = me.publish("command", ensonify.Guidance, max_bytes=128)
            with self.assertRaisesRegex(RuntimeError, "within a step"):
                command.send(ensonify.Guidance())
            with self.assertRaisesRegex(RuntimeError, "may_finish"):
                me.finish()
            for _ in me.steps(rate=1):
                with self.assertRaisesRegex(TypeError, "carries guidance/1, not Pose"):
                    command.send(ensonify.Pose())
        self.finish(clock)

    def test_a_message_may_not_exceed_what_was_declared(self):
        clock = self.start(["agent"], {}, SECOND)
        with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
            out = me.publish("ping", ensonify.Ping, max_bytes=1000)
            for _ in me.steps(rate=1):
                with self.assertRaisesRegex(ValueError, "at most 1000 were declared"):
                    out.send(ensonify.Ping(amplitude_upa=np.zeros(1000, "f4")))
        self.finish(clock)

    def test_a_flood_is_refused_where_it_is_sent(self):
        clock = self.start(["agent"], {}, 3 * SECOND)
        with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
            out = me.publish("command", ensonify.Guidance, rate=4)
            for n, step in enumerate(me.steps(rate=2)):
                for _ in range(6 if n == 0 else 2):  # 4 of a second and 2 more, then as many as come
                    out.send(ensonify.Guidance())
                with self.assertRaisesRegex(ValueError, r"^command: more than 4 Hz with 6 at once: publish\(rate=...\) declares"):
                    out.send(ensonify.Guidance())
        self.finish(clock)

    def test_an_observer_sees_typed_messages_and_the_registry(self):
        clock = self.start(["head", "agent"], {"agent.ping": "head/ping"}, 10**6 * SECOND)
        head = Head(clock.endpoint)
        head.start()
        (self.folder / "clock.endpoint").write_text(clock.endpoint + "\n")
        seen = []

        def watch():
            with ensonify.Observer(self.folder) as run:
                for received in run.messages("head/*", timeout_s=5):
                    seen.append(received)
                    if len(seen) == 3:
                        return

        watcher = threading.Thread(target=watch, daemon=True)
        with ensonify.Participant("agent", clock=clock.endpoint, config={}, may_finish=True) as me:
            me.subscribe("ping", ensonify.Ping)
            for _ in me.steps(rate=20):
                if watcher.ident is None:
                    watcher.start()
                elif not watcher.is_alive():
                    me.finish()
        self.finish(clock, head)
        self.assertEqual(len(seen), 3)
        self.assertTrue(all(isinstance(received.content, ensonify.Ping) for received in seen))
        self.assertEqual([r.t_sim_ns for r in seen], [r.content.stamp_ns for r in seen])

    def test_one_live_run_is_found_without_a_name(self):
        clock = self.start(["agent"], {}, SECOND)
        root = self.folder / "runtime"
        for run, endpoint in (("live", clock.endpoint), ("dead", f"ipc://{self.folder}/nobody")):
            (root / "ensonify" / run).mkdir(parents=True)
            (root / "ensonify" / run / "clock.endpoint").write_text(endpoint)
        with mock.patch.dict(os.environ, {"XDG_RUNTIME_DIR": str(root)}):
            os.environ.pop("ENSONIFY_RUN", None)
            self.assertEqual(ensonify.find_clock(), clock.endpoint)
            self.assertEqual(ensonify.find_clock("dead"), f"ipc://{self.folder}/nobody")
            with self.assertRaisesRegex(ensonify.RunError, "is no run directory"):
                ensonify.find_clock("missing")
        with ensonify.Participant("agent", clock=clock.endpoint, config={}) as me:
            list(me.steps(rate=1))
        self.finish(clock)


class WithoutARun(unittest.TestCase):
    def test_check_prints_the_ports_and_exits(self):
        me = ensonify.Participant("agent", config={})
        me.subscribe("ping", ensonify.Ping, delay_ms=2.5)
        me.publish("command", ensonify.Guidance, rate=(30000, 1001))
        printed = io.StringIO()
        with mock.patch.object(sys, "argv", ["agent.py", "--check"]), contextlib.redirect_stdout(printed):
            with self.assertRaises(SystemExit) as left:
                next(me.steps(rate=10))
        self.assertEqual(left.exception.code, 0)
        ports = json.loads(printed.getvalue())
        self.assertEqual(ports["in"], [{"port": "ping", "type": "ping/1", "delay_ns": 2_500_000, "optional": False, "topics": []}])
        self.assertEqual(ports["out"], [{"port": "command", "type": "guidance/1", "max_bytes": 4096, "rate": [30000, 1001]}])

    def test_without_a_clock_the_exit_code_is_2(self):
        errors = io.StringIO()
        with mock.patch.dict(os.environ), contextlib.redirect_stderr(errors), self.assertRaises(SystemExit) as left:
            os.environ.pop("ENSONIFY_CLOCK", None)
            with ensonify.Participant("agent", config={}) as me:
                next(me.steps(rate=1))
        self.assertEqual(left.exception.code, 2)
        self.assertIn("ENSONIFY_CLOCK is not set", errors.getvalue())

    def test_configuration_comes_from_the_launcher(self):
        with mock.patch.dict(os.environ, {"ENSONIFY_CONFIG": '{"blind": true}'}):
            self.assertEqual(ensonify.Participant("agent").config, {"blind": True})
        with mock.patch.dict(os.environ, {"ENSONIFY_CONFIG": "blind"}):
            with self.assertRaisesRegex(ensonify.RunError, "is no JSON"):
                ensonify.Participant("agent")


class Faults(unittest.TestCase):
    def test_a_corrupt_value_is_put_into_a_copy(self):
        place = (1.0, 2.0, 3.0)
        content = {"place": place, "map": {"list": [1, 2]}}
        injections.put(content, "place.2", "9.5", "a/b")
        injections.put(content, "map.list.0", "7", "a/b")
        self.assertEqual(content, {"place": (1.0, 2.0, 9.5), "map": {"list": [7, 2]}})
        self.assertEqual(place, (1.0, 2.0, 3.0))
        for path in ("place.7", "place.x", "none", "map.none"):
            with self.assertRaises(ensonify.RunError):
                injections.put(content, path, "1", "a/b")


if __name__ == "__main__":
    unittest.main()
