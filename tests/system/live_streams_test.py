"""Live streams of a survey, received by the client of docs/manual/live-streams.md, which knows nothing of Ensonify: its files are
the logger's, byte for byte. On the loopback interface, to a group there, and on a machine of its own (a network namespace)."""
import os
import re
import shutil
import socket
import subprocess
import sys
import unittest

import ensonify
import support

SECONDS = 9
PAGE = support.SOURCE / "docs/manual/live-streams.md"
COLUMN = "mode: water_column, amplitude_every: 4, seabed_image: { published: true }"
BOW = "  bow:   { run: multibeam }\n"


def launch(send, formats="[all, kmall, wcd, kmwcd]", rate=1, seconds=SECONDS, topics="[bow/soundings]"):
    text = support.bay(seconds, topics).replace("rate: free", f"rate: {rate}")
    return text.replace(BOW, BOW.replace("}", f", config: {{ {COLUMN} }} }}")) + (
        f"  log: {{ run: logger, config: {{ head: bow, formats: {formats}, rotate_s: 4, send: [{', '.join(send)}] }} }}\n")


def receiver(address, formats, more=""):
    return f"{{ to: '{address}', formats: [{', '.join(formats)}]{more} }}"


def streamed(log):
    """Of the logger's log: what was sent by receiver."""
    lines = re.findall(r" streamed to=(\S+) (.*)", log)
    return {to: {key: float(value) for key, value in (pair.split("=") for pair in pairs.split())} for to, pairs in lines}


class LiveStreams(support.SystemTest):
    def setUp(self):
        super().setUp()
        self.received = self.folder / "received"
        self.received.mkdir()
        code = re.search(r"```python\n(.*?)```", PAGE.read_text(), re.S).group(1)
        self.assertNotIn("ensonify", code)
        self.client = self.write("receive.py", code)

    def bound(self):
        """A socket of a port that the system chose."""
        one = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(one.close)
        one.bind(("127.0.0.1", 0))
        return one, one.getsockname()[1]

    def free_port(self):
        one, port = self.bound()
        one.close()
        return port

    def receive(self, port, *words, prefix=()):
        client = subprocess.Popen([*prefix, sys.executable, str(self.client), str(port), str(self.received), *words],
                                  stdout=subprocess.PIPE, text=True, env={"PATH": os.environ["PATH"]})
        self.addCleanup(client.stdout.close)
        self.addCleanup(client.wait)
        self.addCleanup(client.kill)
        self.assertEqual(client.stdout.readline(), "ready\n")
        return client

    def expect_logged(self, out, port, ending):
        """The client's files of a port are the logger's with that ending, one after the other."""
        logged = sorted(out.glob(f"*.{ending}"))
        received = sorted(self.received.glob(f"{port}_*"))
        self.assertEqual(len(received), len(logged))
        self.assertEqual(len(logged), 2)
        for theirs, ours in zip(received, logged):
            self.assertTrue(theirs.read_bytes() == ours.read_bytes(), f"{theirs.name} is not {ours.name}")
            self.assertGreater(ours.stat().st_size, 50_000)

    def test_the_client_of_the_page_makes_the_files_of_the_logger(self):
        formats = ("all", "kmall", "wcd", "kmwcd")
        ports = {one: self.free_port() for one in formats}
        groups = {one: self.free_port() for one in formats[:2]}
        both, km_both, absent, (_, unread) = self.free_port(), self.free_port(), self.free_port(), self.bound()
        clients = [self.receive(port) for port in (*ports.values(), both, km_both)]
        clients += [self.receive(port, "239.255.77.7", "127.0.0.1") for port in groups.values()]
        send = [receiver(f"127.0.0.1:{port}", [one]) for one, port in ports.items()]
        send += [receiver(f"239.255.77.7:{port}", [one]) for one, port in groups.items()]
        send += [receiver(f"127.0.0.1:{both}", ["all", "wcd"]), receiver(km_both, ["kmall", "kmwcd"]), receiver(absent, ["all"]), receiver(unread, ["kmall", "kmwcd"])]
        result = self.run_launch(launch(send, topics="[log/health]"), timeout=120)
        self.assertEqual(result.code, 0, result.stderr)
        for client in clients:
            self.assertEqual(client.wait(30), 0)
        for one, port in [*ports.items(), *groups.items()]:
            self.expect_logged(result.out, port, one)
        # Beside .all the water column's datagrams are k alone, beside .kmall #MWC and #CHE.
        for port, split, of_column, (soundings, column) in ((both, all_datagrams, (b"k",), ("all", "wcd")),
                                                            (km_both, kmall_datagrams, (b"#MWC", b"#CHE"), ("kmall", "kmwcd"))):
            received = [split(file.read_bytes()) for file in sorted(self.received.glob(f"{port}_*"))]
            logged = [split(file.read_bytes()) for file in sorted(result.out.glob(f"*.{column}"))]
            rest = [b"".join(data for kind, data in file if kind not in of_column) for file in received]
            self.assertTrue(rest == [file.read_bytes() for file in sorted(result.out.glob(f"*.{soundings}"))], soundings)
            of_received, of_logged = ([[data for kind, data in file if kind in of_column] for file in files] for files in (received, logged))
            self.assertTrue(of_received == of_logged, column)
            self.assertGreater(len(of_received[0]), 4)
        # Nothing is lost on the way out; an absent receiver is counted, and one that does not read cannot be known.
        sent = streamed(result.log("log"))
        self.assertEqual(len(sent), len(send))
        self.assertEqual({to: one["lost"] for to, one in sent.items() if one["lost"]}, {})
        self.assertGreater(sent[f"127.0.0.1:{absent}"]["refused"], 20)
        self.assertEqual(sent[f"127.0.0.1:{unread}"]["refused"], 0)
        with ensonify.Record(result.out / "run.mcap") as record:
            health = [message.content for message in record.messages("log/health")][-1]
        counts = {counter.name: counter.count for counter in health.counters}
        self.assertGreater(counts["stream_refused"], 20)
        self.assertGreater(counts["stream_bytes"], 1_000_000)
        self.assertLessEqual(counts["stream_bytes"], sum(one["bytes"] for one in sent.values()))
        self.assertNotIn("stream_lost", counts)
        # #MWC are longer than a datagram of UDP.
        self.assertGreater(sent[f"127.0.0.1:{ports['kmwcd']}"]["datagrams"], 2 * sum(
            file.read_bytes().count(b"#MWC") for file in result.out.glob("*.kmwcd")))

    def test_the_client_takes_no_length_for_a_start_mark(self):
        def of_length(kind, length):
            return length.to_bytes(4, "little") + kind + bytes(length - 12) + length.to_bytes(4, "little")
        sent = [of_length(b"#IIP", 258)] + [of_length(b"#SPO", length) for length in range(24, 600)]
        port = self.free_port()
        client = self.receive(port)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            for one in sent:
                sender.sendto(one, ("127.0.0.1", port))
        self.assertEqual(client.wait(30), 0)
        self.assertTrue((self.received / f"{port}_1.kmall").read_bytes() == b"".join(sent))

    def test_a_machine_of_its_own_gets_the_streams(self):
        if os.geteuid() != 0 or not shutil.which("ip"):
            self.skipTest("two network namespaces need root and iproute2")
        here, there = f"ens{os.getpid()}s", f"ens{os.getpid()}r"
        try:
            for namespace in (here, there):
                subprocess.run(["ip", "netns", "add", namespace], capture_output=True, text=True, check=True)
                self.addCleanup(subprocess.run, ["ip", "netns", "del", namespace])
            subprocess.run(["ip", "link", "add", "v0", "netns", here, "type", "veth", "peer", "name", "v0", "netns", there],
                           capture_output=True, text=True, check=True)
        except subprocess.CalledProcessError as error:
            self.skipTest(f"network namespaces are not to be had here: {error.stderr.strip()}")
        for namespace, address in ((here, "10.78.0.1"), (there, "10.78.0.2")):
            subprocess.run(["ip", "-n", namespace, "addr", "add", f"{address}/24", "dev", "v0"], check=True)
            for device in ("lo", "v0"):
                subprocess.run(["ip", "-n", namespace, "link", "set", device, "up"], check=True)

        inside = ("ip", "netns", "exec", there)
        clients = [self.receive(16101, prefix=inside), self.receive(16102, prefix=inside),
                   self.receive(16103, "239.255.77.7", "10.78.0.2", prefix=inside)]
        send = [receiver("10.78.0.2:16101", ["all"]), receiver("10.78.0.2:16102", ["kmwcd"]),
                receiver("239.255.77.7:16103", ["kmall"], ", interface: 10.78.0.1"), receiver("10.99.0.1:16104", ["all"])]
        result = self.run_launch(launch(send), timeout=120, prefix=("ip", "netns", "exec", here))
        self.assertEqual(result.code, 0, result.stderr)
        for client in clients:
            self.assertEqual(client.wait(30), 0)
        for port, ending in ((16101, "all"), (16102, "kmwcd"), (16103, "kmall")):
            self.expect_logged(result.out, port, ending)
        sent = streamed(result.log("log"))
        self.assertEqual(sent["10.99.0.1:16104"]["datagrams"], 0)  # no way there
        self.assertGreater(sent["10.99.0.1:16104"]["lost"], 20)

    def test_a_stream_too_slow_for_a_free_run_loses_and_the_files_are_the_same(self):
        def run(send, out):
            return self.run_launch(launch(send, rate="free", seconds=6, topics="[bow/*, nav/*]"), out=out, timeout=120)
        absent = self.free_port()
        slow, none = run([receiver(absent, ["all", "wcd"], ", rate_mb_s: 0.01")], "slow"), run([], "none")
        self.assertEqual((slow.code, none.code), (0, 0), slow.stderr + none.stderr)
        self.assertGreater(streamed(slow.log("log"))[f"127.0.0.1:{absent}"]["lost"], 20)
        names = sorted(file.name for file in none.out.glob("0*"))
        self.assertEqual(names, sorted(file.name for file in slow.out.glob("0*")))
        self.assertEqual({name for name in names if (none.out / name).read_bytes() != (slow.out / name).read_bytes()}, set())
        compared = self.tool("compare", none.out / "run.mcap", slow.out / "run.mcap")
        self.assertEqual(compared.returncode, 0, compared.stdout)
        # Who converts the record sends nothing.
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as reader:
            reader.bind(("127.0.0.1", absent))
            done = self.tool("convert", slow.out, "--to", "all,wcd", self.folder / "converted", timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRaises(BlockingIOError, reader.recv, 1, socket.MSG_DONTWAIT)
        for file in none.out.glob("*.all"):
            self.assertTrue((self.folder / "converted" / file.name).read_bytes() == file.read_bytes())

    def test_receivers_that_cannot_be_are_2_with_place_and_what_is_allowed(self):
        for send, message in (
                ("{ to: 'ship:16101' }", 'send[0].to: "ship" is no host; allowed: an IPv4 address'),
                ("{ to: '10.0.0.1:0' }", 'send[0].to: "0" is no port; allowed: 1 to 65535'),
                ("{ to: '1', formats: [xtf] }", 'send[0].formats: "xtf" is no format; allowed: all, kmall, wcd, kmwcd'),
                ("{ to: '1', formats: [kmall] }", "send[0].formats: kmall is sent as it is logged")):
            with self.subTest(send=send):
                file = self.write("wrong.yaml", launch([send], formats="[all]"))
                for done in (self.tool("check", file), self.tool("run", file, "--out", self.folder / "wrong")):
                    self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                    self.assertIn(message, done.stderr)
                    self.assertRegex(done.stderr, r"wrong\.yaml:\d+:\d+: ")
        missing = self.run_launch(launch(["{ to: '239.255.77.7:16101', interface: 203.0.113.7 }"], formats="[all]"), out="missing")
        self.assertEqual(missing.code, 2, missing.stderr)
        self.assertIn("log: send[0].interface: cannot send to 239.255.77.7:16101 by the interface 203.0.113.7", missing.stderr)


def all_datagrams(data):
    """(type, bytes) of each."""
    offset, found = 0, []
    while offset < len(data):
        length = 4 + int.from_bytes(data[offset:offset + 4], "little")
        found.append((data[offset + 5:offset + 6], data[offset:offset + length]))
        offset += length
    return found


def kmall_datagrams(data):
    offset, found = 0, []
    while offset < len(data):
        length = max(24, int.from_bytes(data[offset:offset + 4], "little"))
        found.append((data[offset + 4:offset + 8], data[offset:offset + length]))
        offset += length
    return found


if __name__ == "__main__":
    unittest.main(verbosity=2)
