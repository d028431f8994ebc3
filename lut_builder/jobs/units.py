"""A unit of work: its digest, and its results as bytes.

A unit is a function, its arguments and a name; its results depend on nothing else, so a table made
of them is the same bytes whoever did the units, in whatever order, and however often the work was
interrupted. Linear algebra runs in one thread: its last digits depend on the number of threads.
"""

import hashlib
import json
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, is_dataclass
from types import FunctionType
from typing import Any

import numpy as np

from hylios.threads import one_thread

Arrays = dict[str, np.ndarray]


@dataclass(frozen=True)
class Unit:
    """A piece of work that depends on nothing but what is in it.

    Attributes
    ----------
    name : str
        Unlike every other's in the same work, and fit for the name of a file: letters, digits,
        `-`, `_` and `.`, at most 100.
    function : function
        Of a module's top level, which imports at its own top what it needs. It gives a mapping of
        names to arrays of numbers or truth values; randomness comes from a seed in the arguments.
    arguments : tuple
        Numbers, texts, arrays, functions, None, and tuples, lists, sets, dictionaries and data
        classes of them: what `pickle` carries and `unit_digest` describes.
    size : float
        How long it takes relative to the others; for the time left. A unit of less than a tenth of
        a second had better be joined with others: keeping one takes about a millisecond.
    """

    name: str
    function: Callable[..., Mapping[str, np.ndarray]]
    arguments: tuple
    size: float = 1.0

    def __post_init__(self):
        if not re.fullmatch(r"[A-Za-z0-9_-][A-Za-z0-9_.-]{0,99}", self.name):
            raise ValueError(f"{self.name!r} cannot be a unit's name")
        if not 0.0 < self.size < math.inf:
            raise ValueError(f"the size of unit {self.name} is {self.size}")


def unit_digest(unit: Unit, software: str) -> str:
    """Digest of what decides a unit's results: software, function and arguments.

    Raises
    ------
    TypeError
        If an argument is of a kind that is not described.
    """
    described = _described((software, unit.name, unit.function, unit.arguments))
    return hashlib.sha256(described.encode()).hexdigest()


def _described(value: Any) -> str:
    """A text that is the same in every process for equal values, and for no others."""
    kind = f"{type(value).__module__}.{type(value).__qualname__}"
    if value is None or isinstance(value, bool | int | str | bytes):
        return f"{kind} {value!r}"
    if isinstance(value, float):
        return f"{kind} {value.hex()}"
    if isinstance(value, np.ndarray | np.generic) and not value.dtype.hasobject:
        content = hashlib.sha256(value.tobytes()).hexdigest()
        return f"array {value.dtype.str} {value.shape} {content}"
    if isinstance(value, FunctionType) and "<" not in value.__qualname__:
        return f"function {value.__module__}.{value.__qualname__}"
    if isinstance(value, Mapping):
        return f"{kind} {_described(tuple(value.items()))}"
    if isinstance(value, set | frozenset):
        return f"{kind} {sorted(map(_described, value))}"
    if isinstance(value, tuple | list):
        return f"{kind} ({','.join(map(_described, value))})"
    if is_dataclass(value) and not isinstance(value, type):
        held = tuple(getattr(value, field.name) for field in fields(value))
        return f"{kind} {_described(held)}"
    raise TypeError(f"a unit's argument is {value!r}, which has no digest")


def perform(unit: Unit, software: str) -> bytes:
    """Do a unit; its results as the bytes of its file.

    The file is a line with the SHA-256 of the rest, a line of JSON with the unit's digest and
    [name, type, shape] of each array, and the arrays' elements, row by row.

    Raises
    ------
    TypeError
        If its results are anything but arrays of numbers or truth values.
    """
    with one_thread():
        given = unit.function(*unit.arguments)
    results = {name: np.asarray(array) for name, array in given.items()}
    for name, array in results.items():
        if array.dtype.kind not in "biufc":
            raise TypeError(f"{name} of unit {unit.name} is an array of {array.dtype}")
    arrays = [[name, array.dtype.str, array.shape] for name, array in results.items()]
    header = json.dumps({"digest": unit_digest(unit, software), "arrays": arrays})
    body = b"\n".join([header.encode(), b"".join(array.tobytes() for array in results.values())])
    return hashlib.sha256(body).hexdigest().encode() + b"\n" + body


def unpacked(content: bytes) -> Arrays:
    """The arrays in the bytes of `perform`."""
    _, header, data = content.split(b"\n", 2)
    arrays, start = {}, 0
    for name, kind, shape in json.loads(header)["arrays"]:
        count = math.prod(shape)
        # A copy is aligned and may be written to, whatever the length of the header.
        array = np.frombuffer(data, kind, count, start).reshape(shape).copy()
        arrays[name], start = array, start + array.nbytes
    return arrays


def is_result(content: bytes, digest: str) -> bool:
    """Whether bytes are what `perform` gave for the unit of a digest, whole and unchanged."""
    checksum, _, body = content.partition(b"\n")
    if checksum != hashlib.sha256(body).hexdigest().encode():
        return False
    return json.loads(body.split(b"\n", 1)[0])["digest"] == digest
