"""What is told to the user instead of a trace."""


class UserError(Exception):
    """What the user gave cannot be plotted; the text says why. Exit code 2."""
