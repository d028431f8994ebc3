"""Short lines for artists that can be told in other languages."""

from typing import Any


class Line(str):
    """A line in English that keeps its message and the values in it.

    Parameters
    ----------
    message : str
        As `str.format` takes it.
    values
        By the names of its fields.
    """

    message: str
    values: dict[str, Any]

    def __new__(cls, message: str, **values: Any) -> "Line":
        line = super().__new__(cls, message.format(**values))
        line.message, line.values = message, values
        return line
