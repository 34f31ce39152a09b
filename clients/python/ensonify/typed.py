"""What a typed message is made of: dataclasses whose fields know how they travel (see messages.py)."""
import dataclasses
import functools
import json
from typing import Any, Callable

import numpy as np

from ensonify.wire import DTYPES, DecodeError


class Struct:
    """Base of messages and of the structs inside them. Fields that are not given keep their default."""

    __slots__ = ()

    def to_map(self) -> dict:
        """The field names and values as they travel, numpy arrays included."""
        return {name: encode(getattr(self, name)) for name, encode, _ in _codecs(type(self))}

    @classmethod
    def from_map(cls, content: dict) -> "Struct":
        """Unknown keys are ignored, missing ones keep their default; a value of the wrong type is a DecodeError."""
        known = {}
        for name, _, decode in _codecs(cls):
            if name in content:
                try:
                    known[name] = decode(content[name])
                except (TypeError, ValueError) as error:
                    raise DecodeError(f"{name}: {error}") from None
        return cls(**known)


class Message(Struct):
    """A message type; TYPE is its name and major version on the wire."""

    __slots__ = ()
    TYPE = ""


def declared_in(text: str | bytes, message_type: type) -> dict:
    """Declarations of one type, by process, in the JSON text that a run or a record has of all. A DecodeError for another text."""
    try:
        return {process: message_type.from_map(declarations[message_type.TYPE])
                for process, declarations in json.loads(text).items() if message_type.TYPE in declarations}
    except (ValueError, AttributeError, TypeError) as error:
        raise DecodeError(f"declarations: {error}") from None


def array(dtype: str) -> Any:
    """A field that travels as one raw frame; `dtype` in numpy's short form. Empty unless given."""
    empty = np.empty(0, DTYPES[dtype])
    return dataclasses.field(default_factory=lambda: empty, metadata={"array": dtype})


def fixed(*values) -> Any:
    """A field of as many numbers as there are default values."""
    return dataclasses.field(default=values, metadata={"fixed": len(values)})


def list_of(struct: type) -> Any:
    """A field that holds any number of structs, or of texts."""
    return dataclasses.field(default_factory=list, metadata={"list_of": struct})


def _integer(value):
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise TypeError(f"is no integer: {value!r}")
    return value.__index__()


def _number(value):
    if isinstance(value, (bool, str)):
        raise TypeError(f"is no number: {value!r}")
    return float(value)


def _text(value):
    if not isinstance(value, str):
        raise TypeError(f"is no text: {value!r}")
    return value


def _boolean(value):
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"is no boolean: {value!r}")
    return bool(value)


_SCALARS: dict = {int: _integer, float: _number, str: _text, bool: _boolean}


def _array_out(dtype: str) -> Callable:
    wanted = DTYPES[dtype]

    def encode(value):
        given = np.asarray(value)
        if not np.can_cast(given.dtype, wanted, "same_kind"):
            raise TypeError(f"an array of {given.dtype} does not fit {dtype}")
        return given.astype(wanted, copy=False)

    return encode


def _array_in(dtype: str) -> Callable:
    wanted = DTYPES[dtype]

    def decode(value):
        if not isinstance(value, np.ndarray) or value.dtype != wanted:
            raise TypeError(f"is no array of {dtype}")
        return value

    return decode


def _fixed(length: int, element: Callable) -> Callable:
    def convert(value):
        if len(value) != length:
            raise ValueError(f"has {len(value)} numbers, not {length}")
        return tuple(element(number) for number in value)

    return convert


def _texts(value):
    if not isinstance(value, list):
        raise TypeError("is no list of texts")
    return [_text(element) for element in value]


def _list_in(struct: type) -> Callable:
    def decode(value):
        if not isinstance(value, list) or not all(isinstance(element, dict) for element in value):
            raise TypeError("is no list of maps")
        return [struct.from_map(element) for element in value]

    return decode


@functools.lru_cache(maxsize=None)
def _codecs(cls: type) -> tuple:
    """(name, encode, decode) of each field."""
    codecs = []
    for field in dataclasses.fields(cls):
        how = field.metadata
        if "array" in how:
            codecs.append((field.name, _array_out(how["array"]), _array_in(how["array"])))
        elif "fixed" in how:
            convert = _fixed(how["fixed"], _SCALARS[type(field.default[0])])
            codecs.append((field.name, convert, convert))
        elif how.get("list_of") is str:
            codecs.append((field.name, _texts, _texts))
        elif "list_of" in how:
            codecs.append((field.name, lambda structs: [s.to_map() for s in structs], _list_in(how["list_of"])))
        else:
            codecs.append((field.name, _SCALARS[field.type], _SCALARS[field.type]))
    return tuple(codecs)
