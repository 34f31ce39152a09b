"""A clock for tests of the client: joins the expected participants, proves edges, grants conservatively, asks no wall
clock. It has no pacing, no checks of the wiring and no faults: the real one has."""
import json
import threading

import zmq

from ensonify import wire

WINDOW_NS = 1_000_000_000
FINISH_MARGIN_NS = 1_000_000_000  # from the event that ends the run to the end


class TinyClock(threading.Thread):
    """Runs until `end_ns` of sim time. `wiring` maps "process.port" of an input to a topic."""

    def __init__(self, endpoint, expected, wiring, end_ns, epoch=1):
        super().__init__(daemon=True)
        self.wiring, self.expected, self.end_ns, self.epoch = wiring, expected, end_ns, epoch
        self.context = zmq.Context()
        self.router = self.context.socket(zmq.ROUTER)
        self.router.setsockopt(zmq.RCVTIMEO, 5000)
        self.router.setsockopt(zmq.LINGER, 1000)
        self.router.bind(endpoint)
        self.endpoint = self.router.getsockopt_string(zmq.LAST_ENDPOINT).rstrip("\0")
        self.members = []  # by rank: dict of identity, hello, next, running, granted
        self.topics = {}  # name -> dict of id, rank, out
        self.edges = []  # dict of topic, to, delay_ns, token
        self.counts = {}  # topic id -> published
        self.failed = None  # what a participant said before leaving
        self.vanish = False  # leave without a word, as a killed clock does
        self.problem = None  # why the clock itself gave up

    def run(self):
        try:
            self._join()
            self._conduct()
        except zmq.Again:
            self.problem = "a participant did not answer within 5 s"
        finally:
            self.router.close()
            self.context.term()

    def _receive(self):
        identity, data = self.router.recv_multipart()
        return identity, json.loads(data) if data[:1] == b"{" else data

    def _send_control(self, identity, message):
        self.router.send_multipart([identity, json.dumps(message).encode()])

    def _join(self):
        while len(self.members) < len(self.expected):
            identity, hello = self._receive()
            if hello["kind"] == "hello":
                self.members.append({"identity": identity, "hello": hello, "next": hello["first_ns"], "running": False,
                                     "granted": -1})
        self.members.sort(key=lambda m: self.expected.index(m["hello"]["name"]))
        for rank, member in enumerate(self.members):
            for out in member["hello"]["out"]:
                self.topics[f'{member["hello"]["name"]}/{out["port"]}'] = {"id": len(self.topics), "rank": rank, "out": out}
        self.counts = {topic["id"]: 0 for topic in self.topics.values()}
        for rank, member in enumerate(self.members):
            for port in member["hello"]["in"]:
                name = self.wiring[f'{member["hello"]["name"]}.{port["port"]}']
                self.edges.append({"topic": name, "to": rank, "in": port, "token": f"e{len(self.edges)}"})
        for rank in range(len(self.members)):
            self._send_control(self.members[rank]["identity"], self._welcome(rank))
        unproven = {edge["token"] for edge in self.edges}
        while unproven:
            _, message = self._receive()
            if message["kind"] == "proven":
                unproven -= set(message["tokens"])

    def _welcome(self, rank):
        outs = [{"port": t["out"]["port"], "topic": name, "topic_id": t["id"],
                 "tokens": [e["token"] for e in self.edges if e["topic"] == name]}
                for name, t in self.topics.items() if t["rank"] == rank]
        ins = []
        for edge in (e for e in self.edges if e["to"] == rank):
            topic = self.topics[edge["topic"]]
            hello = self.members[topic["rank"]]["hello"]
            ins.append({"port": edge["in"]["port"], "topic": edge["topic"], "topic_id": topic["id"],
                        "type": topic["out"]["type"], "publisher": hello["name"], "rank": topic["rank"],
                        "endpoint": hello["sync"], "delay_ns": edge["in"]["delay_ns"],
                        "max_bytes": topic["out"]["max_bytes"], "token": edge["token"]})
        return {"kind": "welcome", "epoch": self.epoch, "rank": rank, "facts": {"seed": "1"}, "out": outs, "in": ins}

    def _horizon(self, rank):
        horizon = self.end_ns
        for edge in self.edges:
            publisher = self.topics[edge["topic"]]["rank"]
            if edge["to"] == rank:
                horizon = min(horizon, self.members[publisher]["next"] + edge["in"]["delay_ns"] - 1)
            if publisher == rank:
                horizon = min(horizon, self.members[edge["to"]]["next"] + WINDOW_NS)
        for member in self.members:
            if member["hello"]["may_finish"]:
                horizon = min(horizon, member["next"] + FINISH_MARGIN_NS)
        return horizon

    def _conduct(self):
        while True:
            for rank, member in enumerate(self.members):
                horizon = self._horizon(rank)
                if not member["running"] and member["next"] <= horizon:
                    member["running"] = True
                    needed = sorted({(self.topics[e["topic"]]["id"]) for e in self.edges if e["to"] == rank})
                    grant = wire.Grant(self.epoch, horizon, [(i, self.counts[i]) for i in needed])
                    self.router.send_multipart([member["identity"], wire.encode_grant(grant)])
            if not any(member["running"] for member in self.members):
                break
            identity, message = self._receive()
            if self.vanish:
                return
            if isinstance(message, bytes):
                self._done(identity, wire.decode_done(message))
            elif message["kind"] == "failed":
                self.failed = message
                break
            elif message["kind"] == "registry":
                self._send_control(identity, {"kind": "registry", "topics": self._registry()})
        self._end()

    def _registry(self):
        return [{"topic": name, "type": t["out"]["type"], "publisher": self.members[t["rank"]]["hello"]["name"],
                 "live": self.members[t["rank"]]["hello"]["live"], "max_bytes": t["out"]["max_bytes"],
                 "subscribers": []} for name, t in self.topics.items()]

    def _done(self, identity, done):
        member = next(m for m in self.members if m["identity"] == identity)
        member["running"], member["next"] = False, done.next_ns
        self.counts.update(done.counts)
        if done.finish:
            self.end_ns = min(self.end_ns, done.next_ns - 1 + FINISH_MARGIN_NS)

    def _end(self):
        for member in self.members:
            self._send_control(member["identity"], {"kind": "end", "code": 3 if self.failed else 0})
        leaving = len(self.members) - (1 if self.failed else 0)
        while leaving:
            _, message = self._receive()
            leaving -= not isinstance(message, bytes) and message["kind"] == "bye"
