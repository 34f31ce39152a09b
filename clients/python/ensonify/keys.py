"""Keys of a run whose sockets are on a network (CURVE), and who may connect to what a process has bound (ZAP)."""
import ipaddress
import json
import os
import pathlib
import threading
from typing import NamedTuple

import zmq
import zmq.utils.z85

FILE = "keys.json"


class Keys(NamedTuple):
    """In ZeroMQ's text form: of every socket that is bound, of every one that connects; addresses that may connect."""

    bound_public: bytes
    bound_secret: bytes
    connected_public: bytes
    connected_secret: bytes
    allowed: tuple


def keys_for(endpoint: str, folder: str | os.PathLike | None = None) -> Keys | None:
    """Of the run directory, or where that is not known of the file that $ENSONIFY_KEYS names; None for `ipc://`, and where
    there is no file."""
    if endpoint.startswith("ipc://"):
        return None
    file = pathlib.Path(folder) / FILE if folder else os.environ.get("ENSONIFY_KEYS")
    if not file or not pathlib.Path(file).exists():
        return None
    read = json.loads(pathlib.Path(file).read_text())
    return Keys(*(read[name].encode() for name in Keys._fields[:4]), tuple(ipaddress.ip_network(a) for a in read["allowed"]))


def set_bound(socket, keys: Keys | None) -> None:
    """Options before it is bound."""
    if keys is not None:
        socket.curve_server, socket.curve_secretkey = True, keys.bound_secret


def set_connected(socket, keys: Keys | None) -> None:
    """Options before it is connected."""
    if keys is not None:
        socket.curve_serverkey = keys.bound_public
        socket.curve_publickey, socket.curve_secretkey = keys.connected_public, keys.connected_secret


class Gate:
    """Answers ZeroMQ's question who may connect to the context's bound sockets: holders of the key at allowed addresses."""

    def __init__(self, context: zmq.Context, keys: Keys):
        self._key = zmq.utils.z85.decode(keys.connected_public)
        self._allowed = keys.allowed
        self._end, ended = context.socket(zmq.PAIR), context.socket(zmq.PAIR)
        questions = context.socket(zmq.REP)
        questions.bind("inproc://zeromq.zap.01")
        ended.bind("inproc://gate-ends")
        self._end.connect("inproc://gate-ends")
        self._thread = threading.Thread(target=self._serve, args=(questions, ended), daemon=True)
        self._thread.start()

    def _serve(self, questions, ended) -> None:
        poller = zmq.Poller()
        poller.register(questions, zmq.POLLIN)
        poller.register(ended, zmq.POLLIN)
        while ended not in dict(poller.poll()):
            _, number, _, address, _, mechanism, *key = questions.recv_multipart()
            may = (mechanism == b"CURVE" and key == [self._key]
                   and any(ipaddress.ip_address(address.decode()) in network for network in self._allowed))
            questions.send_multipart([b"1.0", number, b"200" if may else b"400", b"", b"", b""])
        questions.close(0)
        ended.close(0)

    def close(self) -> None:
        self._end.send(b"end")
        self._thread.join()
        self._end.close(0)
