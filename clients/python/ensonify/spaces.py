"""Spaces for what messages carry, and what an agent may do with them."""
import dataclasses
import weakref
from typing import Any, Callable, Sequence

import gymnasium
import numpy as np

from ensonify.arguments import one_of
from ensonify.typed import Message

Box = gymnasium.spaces.Box


class Fields:
    """Fields of a message as arrays, each in a space of its own: a number as an array of one, a boolean as 0 or 1.
    Without names all fields but the stamp."""

    def __init__(self, message_type: type, *names: str):
        if not dataclasses.is_dataclass(message_type):
            raise TypeError(f"Fields of {message_type!r}; allowed: a message type, such as ensonify.Altitude")
        self.message_type = message_type
        known = {field.name: field for field in dataclasses.fields(message_type)}
        for name in names:
            if name not in known:
                raise ValueError(f"{message_type.TYPE} has no field {name}; it has {', '.join(known)}")
        chosen = names or [name for name in known if name != "stamp_ns" and box_of(known[name]) is not None]
        self._boxes = {name: box_of(known[name]) for name in chosen}
        for name, box in self._boxes.items():
            if box is None:
                raise ValueError(f"{message_type.TYPE}.{name} has no fixed shape: make an array of it with ensonify.Array(...)")

    def spaces(self, topic: str) -> dict:
        """Each field's space, under TOPIC/FIELD."""
        return {f"{topic}/{name}": box for name, box in self._boxes.items()}

    def values(self, topic: str, message: Message) -> dict:
        """What the message has in them."""
        return {f"{topic}/{name}": np.array(getattr(message, name), box.dtype).reshape(box.shape)
                for name, box in self._boxes.items()}


class Array:
    """What a function makes of a message, in a space that you state."""

    def __init__(self, message_type: type, function: Callable[[Any], Any], space: Box):
        self.message_type = message_type
        self._function = function
        self._space = one_of("the space of an Array", space, (Box,), "a gymnasium.spaces.Box")

    def spaces(self, topic: str) -> dict:
        """The space, under the topic's name."""
        return {topic: self._space}

    def values(self, topic: str, message: Message) -> dict:
        """What the function says of the message. A ValueError where that is not in the space's shape."""
        value = np.asarray(self._function(message), self._space.dtype)
        if value.shape != self._space.shape:
            raise ValueError(f"{topic}: the function's array has shape {value.shape}, its space {self._space.shape}")
        return {topic: value}


class Rows:
    """A picture of the newest messages, such as a sidescan's waterfall: a function makes a row of each, the newest is row 0. The space
    is of rows x columns; rows are 0 until as many messages have come."""

    def __init__(self, message_type: type, function: Callable[[Any], Any], space: Box):
        if len(space.shape) != 2:
            raise ValueError(f"the space of Rows has shape {space.shape}; it must be rows x columns")
        self.message_type = message_type
        self.keeps = space.shape[0]
        self._row = Array(message_type, function, Box(space.low[0], space.high[0], dtype=space.dtype.type))
        self._space = space
        self._known: weakref.WeakKeyDictionary = weakref.WeakKeyDictionary()  # rows by their messages, as long as these are kept

    def spaces(self, topic: str) -> dict:
        """The space, under the topic's name."""
        return {topic: self._space}

    def values(self, topic: str, messages: Sequence[Message]) -> dict:
        """What the function says of each message, the newest last. A ValueError where that is not a row of the space."""
        picture = np.zeros(self._space.shape, self._space.dtype)
        for at, message in enumerate(reversed(messages[-self.keeps:])):
            if message not in self._known:
                self._known[message] = self._row.values(topic, message)[topic]
            picture[at] = self._known[message]
        return {topic: picture}


def box_of(field: dataclasses.Field) -> Box | None:
    """The space of a message's field; None for texts, lists, and arrays, whose shape no type states."""
    value = field.default
    if value is dataclasses.MISSING:
        return None
    first, shape = (value[0], (len(value),)) if isinstance(value, tuple) else (value, (1,))
    if isinstance(first, bool):
        return Box(0, 1, shape, np.uint8)
    if isinstance(first, int):
        limits = np.iinfo(np.int64)
        return Box(limits.min, limits.max, shape, np.int64)
    return Box(-np.inf, np.inf, shape, np.float64) if isinstance(first, float) else None


def checked(action: Any, space: Box) -> np.ndarray:
    """The action as an array of the space. A TypeError or a ValueError says what is wrong with it."""
    try:
        given = np.asarray(action)
    except ValueError:
        raise TypeError(f"the action {action!r} is no array of numbers") from None
    if given.dtype.kind not in "fiu" or not np.can_cast(given.dtype, space.dtype, "same_kind"):
        raise TypeError(f"an action of {given.dtype} does not fit {space.dtype}")
    if given.shape != space.shape:
        raise ValueError(f"the action has shape {given.shape}, not {space.shape}")
    array = given.astype(space.dtype)
    wrong = np.argwhere(~((array >= space.low) & (array <= space.high)))  # NaN is in no range
    if len(wrong):
        at = tuple(wrong[0])
        raise ValueError(f"action[{', '.join(map(str, at))}]: {array[at]:g} is outside [{space.low[at]:g}, {space.high[at]:g}]")
    return array
