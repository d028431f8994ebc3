"""Specimens as TOML files: the fields of `hylios.skin.specimen.Specimen` by name, one to a line."""

import tomllib
from dataclasses import asdict
from pathlib import Path
from typing import Any

from hylios.errors import InputError
from hylios.skin.phototypes import named_specimen
from hylios.skin.physiology import PHYSIOLOGY
from hylios.skin.specimen import Specimen, parameters, specimen_of


def read_specimen(path: Path, *, allow_unphysical: bool = False) -> Specimen:
    """Read a specimen from a TOML file.

    `base = "S3"` starts from a specimen that has a name (S1 to S4, I to VI), of which the file
    then needs to hold only what differs. Without a base it holds all of table 6.1; its name is
    the file's unless it gives one.

    Raises
    ------
    InputError
        If the file cannot be read or does not hold a specimen (`specimen_of`).
    """
    values = _values(path)
    try:
        start = {"name": path.stem}
        if "base" in values:
            start = asdict(named_specimen(str(values.pop("base"))))
        return specimen_of({**start, **values}, allow_unphysical=allow_unphysical)
    except InputError as error:
        raise InputError(f"the specimen in {path} cannot be used: {error}") from error


def _values(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        reason = error.strerror
    except RecursionError:
        reason = "its values are nested too deeply"
    except ValueError as error:
        reason = str(error)
    raise InputError(f"the specimen in {path} cannot be read: {reason}.")


def specimen_toml(specimen: Specimen) -> str:
    """The specimen as TOML that `read_specimen` turns into an equal one.

    A comment on each line gives the unit, the physiological range and the meaning.
    """
    lines = [
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
