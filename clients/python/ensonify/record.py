"""Reading a record (MCAP) with PyPI's `mcap`.

    with ensonify.Record("out/demo/survey.mcap") as record:
        for received in record.messages("bow/soundings"):
            ...
"""
import os
from typing import Iterator, NamedTuple

from ensonify import messages, wire
from ensonify.session import EXIT_BAD_INPUT, RunError


class Recorded(NamedTuple):
    """A message of a record."""

    topic: str
    utc_ns: int  # log time: the run's start in UTC + sim time
    content: object  # typed where the type is known, else a map


class Record:
    """A record on disk."""

    def __init__(self, file: str | os.PathLike):
        try:
            from mcap.reader import make_reader
        except ImportError:
            raise RunError("records need the package mcap: pip install mcap", EXIT_BAD_INPUT) from None
        try:
            self._stream = open(file, "rb")
        except OSError as error:
            raise RunError(f"{os.fspath(file)}: {error.strerror}", EXIT_BAD_INPUT) from None
        self.file = os.fspath(file)
        self._reader = make_reader(self._stream)

    def topics(self) -> dict:
        """Topic name to (type, number of messages)."""
        summary = self._reader.get_summary()
        if summary is None:
            raise RunError(f"{self.file}: has no summary; was the record cut short?", EXIT_BAD_INPUT)
        counts = summary.statistics.channel_message_counts if summary.statistics else {}
        return {channel.topic: (self._type(summary, channel), counts.get(channel.id, 0))
                for channel in summary.channels.values()}

    def messages(self, *topics: str) -> Iterator[Recorded]:
        """Messages of these topics (all of them if none is named), in the order of the record."""
        for schema, channel, message in self._reader.iter_messages(topics=topics or None):
            content = wire.decode_inline(message.data)
            known = messages.TYPES.get(schema.name) if schema else None
            yield Recorded(channel.topic, message.log_time, known.from_map(content) if known else content)

    def attachments(self) -> dict:
        """Name to bytes: the resolved launch and scenario, version and seed."""
        return {attachment.name: attachment.data for attachment in self._reader.iter_attachments()}

    @staticmethod
    def _type(summary, channel) -> str:
        schema = summary.schemas.get(channel.schema_id)
        return schema.name if schema else ""

    def close(self) -> None:
        """Closes the file."""
        self._stream.close()

    def __enter__(self) -> "Record":
        return self

    def __exit__(self, *_) -> None:
        self.close()
