"""Specimens as TOML files: the fields of `hylios.skin.specimen.Specimen` by name, one to a line."""

import os
import tomllib
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from hylios.errors import InputError, shown
from hylios.files import as_path, regular_bytes
from hylios.skin.phototypes import named_specimen
from hylios.skin.physiology import PHYSIOLOGY
from hylios.skin.specimen import Specimen, parameters, specimen_of

MOST_BYTES = 2**16
"""Most bytes of a file; all parameters with their comments have a tenth of that."""

LONGEST_LINE = 1000
"""Most characters of a line."""


def read_specimen(path: str | os.PathLike[str], *, allow_unphysical: bool = False) -> Specimen:
    """Read a specimen from a TOML file.

    `base = "S3"` starts from a specimen that has a name (S1 to S4, I to VI), of which the file
    then needs to hold only what differs. Without a base it holds all of table 6.1; its name is
    the file's unless it gives one.

    Raises
    ------
    InputError
        If the file cannot be read or does not hold a specimen (`specimen_of`).

    Examples
    --------
    >>> import hylios
    >>> specimen = hylios.read_specimen("mine.toml")  # doctest: +SKIP
    """
    path = as_path(path)
    values = _values(path)
    try:
        start = {"name": path.stem}
        if "base" in values:
            start = asdict(named_specimen(str(values.pop("base"))))
        return specimen_of({**start, **values}, allow_unphysical=allow_unphysical)
    except InputError as error:
        raise InputError(f"the specimen in {shown(path)} cannot be used: {error}") from error


def _values(path: Path) -> dict[str, Any]:
    data = regular_bytes(path, MOST_BYTES)
    try:
        text = data.decode("utf-8")
        _require_short_lines(text)
        return tomllib.loads(text)
    except RecursionError:
        reason = "its values are nested too deeply"
    except ValueError as error:
        reason = str(error).removesuffix(".")
    raise InputError(f"the specimen in {shown(path)} cannot be read: {reason}.")


def _require_short_lines(text: str) -> None:
    """Raise ValueError where a line is too long; so no key has so many parts that it fills memory.

    A key stands on one line, and what it costs to read grows with the square of its parts.
    """
    for number, line in enumerate(text.splitlines(), start=1):
        if len(line) > LONGEST_LINE:
            raise ValueError(
                f"line {number} has {len(line)} characters; allowed are up to {LONGEST_LINE}"
            )


def specimen_toml(specimen: Specimen, remarks: Iterable[str] = ()) -> str:
    """The specimen as TOML that `read_specimen` turns into an equal one.

    A comment on each line gives the unit, the physiological range and the meaning.

    Parameters
    ----------
    remarks : iterable of str, optional
        Comments before the rest, a line each; what cannot be printed, such as a line break in a
        file's name, is escaped.
    """
    lines = [
        *(f"# {shown(remark)}" for remark in remarks),
        f"name = {_quoted(specimen.name)}",
        f"melanosome_arrangement = {_quoted(specimen.melanosome_arrangement)}",
    ]
    for parameter in parameters():
        name, physiology, said = parameter.name, PHYSIOLOGY[parameter.name], parameter.metadata
        line = f"{name} = {float(getattr(specimen, name))!r}"
        usual = f"{physiology.low:g} to {physiology.high:g}"
        lines.append(f"{line:<40} # {said['unit']}; {usual}; {said['what']}")
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    """A printable text, as `Specimen` makes sure that it is, as a string of TOML."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
