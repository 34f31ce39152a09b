"""What callers give, checked before anything starts."""
import numbers
from typing import Any, Mapping


def mapping(name: str, given: Any, of: str) -> dict:
    """A copy of it. A TypeError where it is none."""
    if not isinstance(given, Mapping):
        raise TypeError(f"{name} is {given!r}; it must be a dict of {of}")
    return dict(given)


def one_of(name: str, given: Any, kinds: tuple, allowed: str) -> Any:
    """It, if it is of one of these kinds. A TypeError where not."""
    if not isinstance(given, kinds):
        raise TypeError(f"{name} is {given!r}; allowed: {allowed}")
    return given


def positive(name: str, given: Any) -> float:
    """It, as a number above 0. A ValueError where it is none."""
    if isinstance(given, bool) or not isinstance(given, numbers.Real) or not given > 0:
        raise ValueError(f"{name} is {given!r}; it must be a number above 0")
    return given
