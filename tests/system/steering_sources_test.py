"""Sentences that steer, by every way in which they come: UDP, TCP to and from the run, a serial line, a log. A log, and the record of
a run, steer the boat to the same bytes again."""
import contextlib
import hashlib
import os
import pty
import socket
import threading
import time
import tty
import unittest

import ensonify
from nmea import free_port, sentence
from support import SystemTest

LAUNCH = """
ensonify: launch/1
scenario:
  ensonify: scenario/1
  site: {{ latitude_deg: 54.4, longitude_deg: 10.3 }}
  seabed: {{ kind: layers, size_m: [400, 400] }}
  vehicles: {{ boat: {{ start: {{ position_m: [0, 0, 0], heading_deg: 0, speed_mps: 1 }} }} }}
  mission: {{ speed_mps: 1, runlines: [{{ from_m: [0, 0], to_m: [0, 90] }}] }}
clock: {{ rate: {rate} }}
duration_s: {seconds}
processes:
  boat:    {{ run: vehicle, config: {{ steered_by: {{ package: {{ timeout_s: 2 }}, pilot: {{}} }} }} }}
  nav:     {{ run: navigation }}
  pager:   {{ run: terrain_pager }}
  pilot:   {{ run: autopilot }}
{feed}
  package: {{ run: steering_feed, config: {{ sources: {{ bridge: {{ {source} }} }}, speed_mps: 1.5, valid_s: 1.5{recorded} }} }}
  recorder: {{ run: recorder, config: {{ file: run.mcap, topics: [package/command, package/data, package/health, boat/helm, boat/pose] }} }}
"""
SECONDS = 8


def launch(source, rate=1, seconds=SECONDS, recorded=False, feed=""):
    text = LAUNCH.format(source=source, rate=rate, seconds=seconds, recorded=", recorded: true" if recorded else "", feed=feed)
    return text.replace(" package/data,", "") if recorded else text


def log_lines(seconds):
    """A minute of a bridge's bus: clock, an order, something else."""
    for second in range(seconds):
        yield sentence(f"GPZDA,1200{second:02d}.00,29,11,2026,,")
        if second != 3:
            yield sentence(f"IIHSC,{40 + 5 * (second // 4)}.0,T,,M")
        yield sentence("GPVTG,0,T,,M,4,N,7,K")


class SteeringSources(SystemTest):
    def counts(self, file):
        with ensonify.Record(file) as record:
            health = [message for _, _, message in record.messages("package/health")][-1]
        return {counter.name: counter.count for counter in health.counters}

    def commands(self, file):
        with ensonify.Record(file) as record:
            return [message for _, _, message in record.messages("package/command")]

    def digest(self, file, topic):
        digest, count = hashlib.sha256(), 0
        with ensonify.Record(file) as record:
            for _, t_ns, message in record.messages(topic):
                digest.update(repr((t_ns, message.to_map())).encode())
                count += 1
        self.assertGreater(count, 0, topic)
        return digest.hexdigest()

    def steer(self, source, out, connect):
        """A run in real time, to which `connect` opens a way: it yields a function that sends bytes."""
        run = self.start_launch(launch(source), out=out)
        self.wait_for_go(out)
        stop = threading.Event()

        def send():
            with connect(stop) as send_bytes:
                while not stop.wait(0.2):
                    half = sentence("IIHSC,40.5,T,,M").encode()
                    with contextlib.suppress(OSError):  # the run has ended
                        send_bytes(half[:7])
                        send_bytes(half[7:])

        sender = threading.Thread(target=send)
        sender.start()
        _, errors = run.communicate(timeout=60)
        stop.set()
        sender.join()
        self.assertEqual(run.returncode, 0, errors)
        return self.folder / out / "run.mcap"

    def check_steered(self, file):
        commands = self.commands(file)
        self.assertGreater(len(commands), 20)
        grid_deg = {round(command.heading_grid_rad * 57.29577951, 1) for command in commands}
        self.assertEqual(len(grid_deg), 1)
        self.assertLess(abs(grid_deg.pop() - 40.5), 3.0)  # the grid's convergence
        self.assertGreater(self.counts(file)["headings_taken"], 5)
        with ensonify.Record(file) as record:
            self.assertIn("package", {message.steered_by for _, _, message in record.messages("boat/helm")})

    @contextlib.contextmanager
    def connected(self, stop, port):
        connection = None
        while connection is None and not stop.is_set():
            try:
                connection = socket.create_connection(("127.0.0.1", port), timeout=2)
            except OSError:  # the port opens with the first event
                time.sleep(0.05)
        try:
            yield connection.sendall
        finally:
            connection.close()

    def test_a_tcp_connection_that_the_package_makes(self):
        port = free_port()
        self.check_steered(self.steer(f"tcp_server: {port}", "server", lambda stop: self.connected(stop, port)))

    def test_a_tcp_connection_to_the_package(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            server.settimeout(20)

            @contextlib.contextmanager
            def accepted(stop):
                connection, _ = server.accept()
                with connection:
                    yield connection.sendall

            self.check_steered(self.steer(f"tcp: {server.getsockname()[1]}", "client", accepted))

    def test_a_serial_line(self):
        ours, theirs = pty.openpty()
        tty.setraw(ours)
        try:
            @contextlib.contextmanager
            def line(stop):
                yield lambda data: os.write(ours, data)

            self.check_steered(self.steer(f"serial: {os.ttyname(theirs)}, baud: 38400", "serial", line))
        finally:
            os.close(ours)
            os.close(theirs)

    def test_a_log_steers_the_same_way_at_any_rate(self):
        log = self.write("bridge.nmea", "".join(log_lines(10)))
        files = []
        for out, rate in (("free", "free"), ("again", "free"), ("fast", 20)):
            result = self.run_launch(launch(f"file: {log}", rate=rate, seconds=10), out=out)
            self.assertEqual(result.code, 0, result.stderr)
            files.append(result.out / "run.mcap")
        for topic in ("package/command", "package/data", "boat/pose"):
            self.assertEqual(len({self.digest(file, topic) for file in files}), 1, topic)
        commands = self.commands(files[0])
        self.assertEqual(self.counts(files[0])["headings_taken"], 9)
        turns = [command.stamp_ns * 1e-9 for before, command in zip(commands, commands[1:]) if command.heading_grid_rad - before.heading_grid_rad > 0.05]
        self.assertEqual([round(t_s, 6) for t_s in turns], [4.0, 8.0])  # when the log's clock has come so far
        gap = max(later.stamp_ns - before.stamp_ns for before, later in zip(commands, commands[1:]))
        self.assertEqual(gap, 500_000_000)  # 1.5 s after the order of second 2 until that of second 4

    def test_the_record_of_a_run_steers_the_same_way(self):
        port = free_port()
        live = self.steer(f"tcp_server: {port}", "live", lambda stop: self.connected(stop, port))
        feed = f"  record: {{ run: replay, config: {{ file: {live}, topics: [package/data] }} }}"
        again = self.run_launch(launch(f"tcp_server: {port}", rate="free", recorded=True, feed=feed), out="again")
        self.assertEqual(again.code, 0, again.stderr)
        for topic in ("package/command", "boat/pose"):
            self.assertEqual(self.digest(live, topic), self.digest(again.out / "run.mcap", topic), topic)

    def test_a_log_without_times_and_wrong_ways_are_refused_with_what_is_allowed(self):
        log = self.write("orders.nmea", sentence("IIHSC,40.0,T,,M") * 3)
        for source, message in ((f"file: {log}", "no sentence of it has a time"), (f"file: {log}.none", "no such file"), ("udp: 5", "5 is outside [1024, 65535]"),
                                ("tcp: 4001, of: bridge", '"bridge" is no host'), ("senders: [127.0.0.1]", "needs one of")):
            with self.subTest(source):
                result = self.run_launch(launch(source), out=f"out{len(message)}")
                self.assertEqual(result.code, 2, result.stderr)
                self.assertIn(message, result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
