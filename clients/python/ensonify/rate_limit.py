"""What a port may publish, by the rate that it declares."""


class RateLimit:
    """At most what one second of the rate brings and 2 more at once, in sim time, as the clock counts."""

    def __init__(self, rate: tuple):
        self._hz = rate[0] / rate[1]
        self._most = self._hz + 2.0  # at once
        self._room, self._at_ns = self._most, 0

    def take(self, t_ns: int) -> bool:
        """Takes a message at t_ns, which never goes back; false when there are too many."""
        self._room += self._hz * (t_ns - self._at_ns) * 1e-9
        self._at_ns = t_ns
        if self._room < 1:
            return False
        self._room = min(self._most, self._room - 1)
        return True

    def __str__(self) -> str:
        return f"{self._hz:g} Hz with {self._most:g} at once"
