"""What ends a run for one of its processes, and the exit codes that say why (launch/README.md)."""

EXIT_OK, EXIT_BAD_INPUT, EXIT_DIED, EXIT_STALL, EXIT_DATA_LOST = 0, 2, 3, 4, 5


class RunError(Exception):
    """The run cannot go on for this process. `code` is the exit code that says why; `culprit`, if any, the process whose
    message could not be used."""

    def __init__(self, message: str, code: int, culprit: str = ""):
        super().__init__(message)
        self.code = code
        self.culprit = culprit
