"""Reading a record: an uncompressed MCAP file (https://mcap.dev/spec) whose payloads are msgpack maps.

    with ensonify.Record("out/demo/survey.mcap") as record:
        for topic, t_sim_ns, soundings in record.messages("bow/soundings"):
            ...

The file is mapped, not loaded: only what is asked for is touched. A truncated record is read to its last whole chunk.
"""
import array
import fnmatch
import heapq
import mmap
import os
import struct
from typing import Any, Iterator, NamedTuple

from ensonify import messages, wire
from ensonify.session import EXIT_BAD_INPUT, RunError
from ensonify.typed import declared_in

_MAGIC = b"\x89MCAP0\r\n"
_PROFILE = "x-ensonify/1"
_HEADER, _FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK = 1, 2, 3, 4, 5, 6
_ATTACHMENT, _METADATA, _DATA_END = 9, 12, 15

_RECORD = struct.Struct("<BQ")
_MESSAGE_HEAD = struct.Struct("<HIQQ")
_CHUNK_HEAD = struct.Struct("<QQQI")


class Recorded(NamedTuple):
    """A message of a record."""

    topic: str
    t_sim_ns: int  # time of the event that published it
    content: Any  # typed where the type is known, else a map


class _Channel(NamedTuple):
    topic: str
    type: str


class _Cursor:
    """Reads fields of an MCAP record front to back."""

    def __init__(self, data, at: int):
        self.data, self.at = data, at

    def take(self, form: str) -> int:
        (value,) = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return value

    def bytes(self, length: int) -> bytes:
        self.at += length
        return self.data[self.at - length:self.at]

    def text(self) -> str:
        return self.bytes(self.take("I")).decode()

    def map(self) -> dict:
        end = self.take("I") + self.at
        pairs = {}
        while self.at < end:
            key = self.text()
            pairs[key] = self.text()
        return pairs


class Record:
    """A record on disk."""

    def __init__(self, file: str | os.PathLike):
        self.file = os.fspath(file)
        try:
            with open(file, "rb") as stream:
                self._data = mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ)
        except (OSError, ValueError) as error:
            raise RunError(f"{self.file}: {getattr(error, 'strerror', None) or error}", EXIT_BAD_INPUT) from None
        self._schemas: dict = {0: ""}
        self._channels: dict = {}  # id -> _Channel
        self._messages: dict = {}  # channel id -> log time, begin, end of the payload, one after another
        self.attachments: dict = {}  # name to bytes: the resolved launch and scenario
        self.info: dict = {}  # version, seed, utc_start_ns
        self.missed: dict = {}  # of a record that an observer wrote: topic name to number of messages that it missed
        self.whole = False  # the record was closed in order
        try:
            self._index()
        except (struct.error, UnicodeDecodeError) as error:
            raise RunError(f"{self.file}: is damaged: {error}", EXIT_BAD_INPUT) from None
        self.utc_start_ns = int(self.info.get("utc_start_ns", 0))

    def declared(self, message_type: type) -> dict:
        """What processes declared of themselves before the run, by process: `declared(ensonify.HeadDeclaration)["bow"]`. Empty if
        none declared one of this type, or if the record was made before there were any."""
        try:
            return declared_in(self.attachments.get("declarations.json", b"{}"), message_type)
        except wire.DecodeError as error:
            raise RunError(f"{self.file}: {error}", EXIT_BAD_INPUT) from None

    def topics(self) -> dict:
        """Topic name to (type, number of messages)."""
        return {channel.topic: (channel.type, len(self._messages.get(number, ())) // 3)
                for number, channel in self._channels.items()}

    def topics_of(self, message_type: type) -> list:
        """Names of the topics of a type, in the order of the launch file."""
        return [channel.topic for _, channel in sorted(self._channels.items()) if channel.type == message_type.TYPE]

    def messages(self, *patterns: str, least_apart_ns: int = 0) -> Iterator[Recorded]:
        """Messages of the topics that match ("*" and "bow/*" are patterns, as an Observer takes them; all topics if none is
        named), in the order of the record; with `least_apart_ns`, none that is nearer than this to the last one of its topic."""
        topics = [channel.topic for channel in self._channels.values()]
        unknown = [pattern for pattern in patterns if not fnmatch.filter(topics, pattern)]
        if unknown:
            raise RunError(f"{self.file}: has no topic {', '.join(unknown)}; it has {', '.join(topics)}", EXIT_BAD_INPUT)
        chosen = [n for n, channel in self._channels.items()
                  if not patterns or any(fnmatch.fnmatchcase(channel.topic, pattern) for pattern in patterns)]
        for begin, end, utc_ns, number in heapq.merge(*(self._places(n, least_apart_ns) for n in chosen)):
            channel = self._channels[number]
            content: Any = wire.decode_inline(self._data[begin:end])
            known_type = messages.TYPES.get(channel.type)
            if known_type is not None:
                content = known_type.from_map(content)
            yield Recorded(channel.topic, utc_ns - self.utc_start_ns, content)

    def _places(self, number: int, least_apart_ns: int) -> Iterator[tuple]:
        """(begin, end, log time, channel) of a channel's messages."""
        places, last_ns = self._messages.get(number, ()), None
        for at in range(0, len(places), 3):
            utc_ns, begin, end = places[at:at + 3]
            if last_ns is None or utc_ns - last_ns >= least_apart_ns:
                last_ns = utc_ns
                yield begin, end, utc_ns, number

    def _records(self, at: int, end: int) -> Iterator[tuple]:
        """(opcode, begin, end) of each whole record."""
        while at + _RECORD.size <= end:
            op, length = _RECORD.unpack_from(self._data, at)
            begin = at + _RECORD.size
            at = begin + length
            if at > end:
                return
            yield op, begin, at

    def _index(self) -> None:
        if self._data[:len(_MAGIC)] != _MAGIC:
            raise RunError(f"{self.file}: is no MCAP file", EXIT_BAD_INPUT)
        for op, begin, end in self._records(len(_MAGIC), len(self._data)):
            cursor = _Cursor(self._data, begin)
            if op == _HEADER and (profile := cursor.text()) != _PROFILE:
                raise RunError(f"{self.file}: has the profile {profile!r}, not {_PROFILE}", EXIT_BAD_INPUT)
            elif op == _CHUNK:
                self._note_chunk(cursor)
            elif op == _ATTACHMENT:
                cursor.at += 16  # times
                name, _ = cursor.text(), cursor.text()
                self.attachments[name] = cursor.bytes(cursor.take("Q"))
            elif op == _METADATA:
                name = cursor.text()
                if name == "ensonify":
                    self.info = cursor.map()
                elif name == "ensonify_live":
                    self.missed = {key.removesuffix("/missed"): int(number)
                                   for key, number in cursor.map().items() if key.endswith("/missed")}
            elif op == _DATA_END:
                self.whole = True
                return
            else:
                self._note_channel(op, cursor)

    def _note_chunk(self, cursor: _Cursor) -> None:
        cursor.at += _CHUNK_HEAD.size
        compression = cursor.text()
        if compression:
            raise RunError(f"{self.file}: has chunks compressed with {compression}; records are not", EXIT_BAD_INPUT)
        length = cursor.take("Q")
        for op, begin, end in self._records(cursor.at, cursor.at + length):
            if op == _MESSAGE:
                number, _, utc_ns, _ = _MESSAGE_HEAD.unpack_from(self._data, begin)
                self._messages.setdefault(number, array.array("Q")).extend((utc_ns, begin + _MESSAGE_HEAD.size, end))
            else:
                self._note_channel(op, _Cursor(self._data, begin))

    def _note_channel(self, op: int, cursor: _Cursor) -> None:
        if op == _SCHEMA:
            number = cursor.take("H")
            self._schemas[number] = cursor.text()
        elif op == _CHANNEL:
            number, schema = cursor.take("H"), cursor.take("H")
            topic, _, facts = cursor.text(), cursor.text(), cursor.map()
            self._channels[number] = _Channel(topic, self._schemas.get(schema) or facts.get("type", ""))

    def close(self) -> None:
        """Closes the file."""
        self._data.close()

    def __enter__(self) -> "Record":
        return self

    def __exit__(self, *_) -> None:
        self.close()
