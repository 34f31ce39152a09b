"""The Python client's observer on a live run of stubs."""
import unittest

import ensonify
from live_run import LiveRun


class Observing(unittest.TestCase):
    def test_registry_messages_and_requests(self):
        for tcp in (False, True):
            with LiveRun(tcp=tcp) as run, ensonify.Observer(run.directory()) as seen:
                topics = {entry["topic"]: entry["type"] for entry in seen.topics()}
                self.assertEqual(topics["bow/ping"], "ping_blob/1")
                received = []
                for message in seen.messages("bow/ping", "auv/pose", timeout_s=10):
                    received.append(message)
                    if len(received) == 60:
                        break
                self.assertEqual({message.topic for message in received}, {"bow/ping", "auv/pose"})
                for message in received:
                    self.assertEqual(message.content["stamp_ns"], message.t_sim_ns)
                    if message.topic == "bow/ping":  # a view of the received frame: the stub's filler in every byte
                        self.assertEqual(message.content["data"].shape, (50000,))
                        self.assertTrue((message.content["data"] == 0x5A).all())
                self.assertEqual(seen.ask("status")["state"], "running")
                self.assertTrue(seen.ask("rate", rate=20.0)["ok"])
                self.assertIn("launch/1", seen.ask("get", what="launch")["text"])

    def test_what_is_not_there_is_the_users_mistake(self):
        with LiveRun() as run, ensonify.Observer(run.directory()) as seen:
            with self.assertRaisesRegex(ensonify.RunError, "no topic matches bow/pong; there are .*bow/ping") as raised:
                next(seen.messages("bow/pong"))
            self.assertEqual(raised.exception.code, 2)


if __name__ == "__main__":
    unittest.main()
