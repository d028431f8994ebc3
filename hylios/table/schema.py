"""The schema of a table's header: its keys, and what their values may be, by format version.

Nothing else knows them: the file's reader and writer require them here, and what comes out of
`hylios.table.provenance` has been through here. Libraries were weighed: jsonschema and pydantic do
more and bring compiled parts, which the add-on, with numpy alone, cannot carry; so the kinds are a
few functions of our own.
"""

import json
from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from typing import Any

import numpy as np

from hylios.errors import InputError
from hylios.skin import UNTANNED
from hylios.skin.specimen import Specimen
from hylios.sun.action_spectra import Absorptance
from hylios.table.axes import (
    AXIS_UNIT,
    LARGEST_COORDINATE,
    LOOK_AXES,
    STATE_NAMES,
    Axes,
    LookAxes,
    StateAxes,
    require_axes,
)
from hylios.table.interpolation import INTERPOLATIONS
from hylios.table.kinds import (
    Kind,
    brief,
    choice,
    holding,
    is_number,
    list_of,
    mapping_of,
    number,
    optional,
    require_plain,
    text,
    truth,
    unfit,
    whole,
)
from hylios.table.planes import MEANINGS, component_names
from hylios.tanning import KINETICS, PIGMENTATIONS, MelaninDynamics, Spread
from hylios.tanning.spread import TERMS, across

FORMAT = "skin tan table"
FORMAT_VERSION, PRINCIPAL_AXES_VERSION = 4, 3
"""Version of the tables that are written now, and of those with principal axes."""

LONGEST_HEADER = 1_000_000

MOST_STATES, MOST_KNOTS, MOST_AXES, MOST_BANDS = 20_000, 100, 4, 100
FIRST_NM, LAST_NM = 250.0, 2500.0
"""First and last wavelength of the spectra."""

_SED = number(0.01, 1000.0, "SED")
_STATES = whole(0, MOST_STATES)
_BANDS = list_of(number(FIRST_NM, LAST_NM, "nm"), 0, MOST_BANDS)


def _specimen(name: str, value: Any) -> None:
    holding({"name": text, "melanosome_arrangement": text})(name, value)
    parameters = {field.name: field.default is MISSING for field in fields(Specimen)}
    for key in value:
        if key not in parameters:
            raise InputError(f"the table's {name} has {brief(key)}, which no specimen has.")
    for key, is_needed in parameters.items():
        if is_needed and key not in value:
            raise InputError(f"the table's {name} has no {key}.")
    try:
        Specimen(**value)
    except (InputError, TypeError, ValueError) as error:
        raise InputError(f"the table's {name} is of no skin: {error}") from error


def _dynamics(name: str, value: Any) -> None:
    rates = {field.name: field.default is MISSING for field in fields(MelaninDynamics)}
    if not isinstance(value, Mapping) or set(value) != set(rates):
        raise InputError(f"the table's melanin dynamics need the rates {', '.join(rates)}.")
    for rate, is_per_layer in rates.items():
        numbers = value[rate] if is_per_layer else [value[rate]]
        count = 3 if is_per_layer else 1
        if not isinstance(numbers, list | tuple) or [*map(is_number, numbers)] != [True] * count:
            raise unfit(rate, value[rate], "3 numbers" if is_per_layer else "a number")
    dynamics_from(value)


def dynamics_from(described: Mapping[str, Any]) -> MelaninDynamics:
    """Melanin dynamics from the numbers in a header, which have been required to fit.

    Raises
    ------
    InputError
        If a rate is out of its range.
    """
    rates: dict[str, Any] = {
        name: tuple(map(float, value)) if isinstance(value, list | tuple) else float(value)
        for name, value in described.items()
    }
    return MelaninDynamics(**rates)


def _absorptance(name: str, value: Any) -> None:
    pair = list_of(number(0.0, 10_000.0), 2, 10_000)
    holding({"wavelengths_nm": pair, "values": pair})(name, value)
    try:
        Absorptance(np.array(value["wavelengths_nm"]), np.array(value["values"]))
    except InputError as error:
        raise InputError(f"the table's {name} cannot be used: {error}") from error


PROVENANCE: dict[str, Kind] = {
    "software": text,
    "skin": optional(text),
    "specimen": text,
    "specimen_parameters": _specimen,
    "untanned_state": choice(tuple(UNTANNED.values())),
    "pigmentation": choice(tuple(PIGMENTATIONS)),
    "melanin_dynamics": _dynamics,
    "mmd_sed": _SED,
    "med_sed": _SED,
    "solver": text,
    "settings": holding(
        {},
        {
            "knots": list_of(whole(1, MOST_KNOTS), 1, MOST_AXES),
            "colour_wavelengths": whole(0, 1000),
            "bands": _BANDS,
            "profile_error": number(0.0, 1.0),
            "profile_wavelengths": whole(0, 1000),
            "profile_states": whole(0, 1000),
            "nodes": whole(1, 1000),
            "interpolation": choice(INTERPOLATIONS),
            "half": truth,
        },
    ),
    "readings": mapping_of(text),
    "own_figures": mapping_of(text),
    "own_spectra_sha256": mapping_of(text),
    "bands_nm": _BANDS,
    "angle_deg": number(0.0, 90.0, "degrees"),
    "film_index": number(1.0, 2.0),
    "seed": whole(0, 2**32 - 1),
    "states_computed": _STATES,
    "states_for_any_sun": _STATES,
    "states_with_melanin_cut": _STATES,
    "colour": text,
    "illuminant": text,
    "observer": text,
    "illuminant_power": holding(
        {
            "wavelengths_nm": list_of(number(1.0, 1e5), 2, 10_000),
            "values": list_of(number(0.0, 1e12), 2, 10_000),
        }
    ),
    "profile_width_unit": text,
    "estimated_figures": list_of(text, 0, 1000),
    "absorptance": _absorptance,
}
"""Kinds of the provenance's keys. Any key may be missing; other keys may hold any plain value."""

_KNOTS = list_of(number(-LARGEST_COORDINATE, LARGEST_COORDINATE), 1, MOST_STATES)
_PRINCIPAL_AXIS = holding(
    {"direction": list_of(number(-1.1, 1.1), 4, 4), "knots": _KNOTS},
    {"name": text, "unit": text},
)
_PRINCIPAL_AXES = holding(
    {
        "untanned": list_of(number(1e-6, 1e3), 4, 4),
        "list": list_of(_PRINCIPAL_AXIS, 1, MOST_AXES),
    },
    {"state": list_of(text, 4, 4)},
)
_LOOK_AXIS = holding({"name": choice(LOOK_AXES), "knots": _KNOTS}, {"unit": text})
_SHEET = holding(
    {
        "untanned_melanin": list_of(number(1e-6, 1.0), 3, 3),
        "direction": list_of(number(-1.1, 1.1), 3, 3),
        "thicknesses": _KNOTS,
        "least_melanin": _KNOTS,
        "most_melanin": _KNOTS,
        "coefficients": list_of(list_of(number(-1e4, 1e4), 2, 2), TERMS, TERMS),
    }
)
_LOOK_AXES = holding(
    {
        "sheets": holding({name: _SHEET for name in KINETICS}),
        "aside": list_of(number(-1.1, 1.1), 3, 3),
        "bounded": truth,
        "list": list_of(_LOOK_AXIS, len(LOOK_AXES), len(LOOK_AXES)),
    },
    {"state": list_of(text, 5, 5)},
)
_OTHERS = {
    "interpolation": choice(INTERPOLATIONS),
    "planes": mapping_of(
        holding({"components": list_of(text, 1, MOST_BANDS)}, {"unit": text, "says": text})
    ),
    "provenance": holding({}),
}
_HEADERS: dict[int, dict[str, Kind]] = {
    PRINCIPAL_AXES_VERSION: {"axes": _PRINCIPAL_AXES, **_OTHERS},
    FORMAT_VERSION: {"axes": _LOOK_AXES, **_OTHERS},
}
"""What the header of a format version must have, besides `format` and `format_version`."""


@dataclass(frozen=True)
class Header:
    """What a header says.

    Attributes
    ----------
    axes : StateAxes or LookAxes
    components : mapping of planes' names to tuples of str
        Of the planes whose meaning is known here.
    provenance : dict
    interpolation : str
    """

    axes: Axes
    components: dict[str, tuple[str, ...]]
    provenance: dict[str, Any]
    interpolation: str


def parsed(header: str) -> Header:
    """What a header's JSON says.

    Raises
    ------
    InputError
        If it is no header of a format that is read here, lacks a key or has a value that does not
        fit.
    """
    content = _content(header)
    require_plain("header", content)
    for key, kind in _HEADERS[content["format_version"]].items():
        if key not in content:
            raise InputError(f"the table's header has no {key}.")
        kind(key, content[key])
    require_provenance(content["provenance"])
    axes = _axes(content)
    require_axes(axes)
    components = {
        name: tuple(described["components"])
        for name, described in content["planes"].items()
        if name in MEANINGS
    }
    require_planes(tuple(components))
    for name, listed in components.items():
        expected = component_names(name, content["provenance"])
        if listed != expected:
            raise InputError(
                f"the table's plane {name} has the components {brief(', '.join(listed))}; "
                f"expected {', '.join(expected)}."
            )
    return Header(axes, components, content["provenance"], content["interpolation"])


def _axes(content: Mapping[str, Any]) -> Axes:
    told = content["axes"]
    knots = tuple(np.array(axis["knots"], dtype=float) for axis in told["list"])
    if content["format_version"] == PRINCIPAL_AXES_VERSION:
        return StateAxes(
            untanned=np.array(told["untanned"], dtype=float),
            basis=np.array([axis["direction"] for axis in told["list"]], dtype=float).T,
            knots=knots,
        )
    names = tuple(axis["name"] for axis in told["list"])
    if names != LOOK_AXES:
        raise InputError(
            f"the table's axes are {', '.join(names)}; expected {', '.join(LOOK_AXES)}."
        )
    thesis, measured = (_sheet(told["sheets"][name]) for name in KINETICS)
    aside = np.array(told["aside"], dtype=float)
    return LookAxes(thesis, measured, aside, knots, told["bounded"])


def _sheet(told: Mapping[str, Any]) -> Spread:
    numbers = {key: np.array(value, dtype=float) for key, value in told.items()}
    return Spread(
        untanned=numbers["untanned_melanin"],
        directions=across(numbers["direction"]),
        thicknesses=numbers["thicknesses"],
        least=numbers["least_melanin"],
        most=numbers["most_melanin"],
        coefficients=numbers["coefficients"],
    )


def _described_sheet(sheet: Spread) -> dict[str, Any]:
    return {
        "untanned_melanin": sheet.untanned.tolist(),
        "direction": sheet.directions[:, 0].tolist(),
        "thicknesses": sheet.thicknesses.tolist(),
        "least_melanin": sheet.least.tolist(),
        "most_melanin": sheet.most.tolist(),
        "coefficients": sheet.coefficients.tolist(),
    }


def described_axes(axes: Axes) -> tuple[int, dict[str, Any]]:
    """Format version of a table with such axes, and the axes as its header has them."""
    if isinstance(axes, LookAxes):
        return FORMAT_VERSION, {
            "state": list(STATE_NAMES),
            "sheets": {
                name: _described_sheet(sheet)
                for name, sheet in zip(KINETICS, (axes.sheet, axes.measured), strict=True)
            },
            "aside": axes.aside.tolist(),
            "bounded": axes.bounded,
            "list": [
                {"name": name, "unit": AXIS_UNIT, "knots": knots.tolist()}
                for name, knots in zip(LOOK_AXES, axes.knots, strict=True)
            ],
        }
    return PRINCIPAL_AXES_VERSION, {
        "state": list(STATE_NAMES[:4]),
        "untanned": axes.untanned.tolist(),
        "list": [
            {
                "name": f"principal axis {number}",
                "unit": AXIS_UNIT,
                "direction": direction.tolist(),
                "knots": knots.tolist(),
            }
            for number, (direction, knots) in enumerate(
                zip(axes.basis.T, axes.knots, strict=True), start=1
            )
        ],
    }


def require_provenance(provenance: Mapping[str, Any]) -> None:
    """Raise InputError where a key of a provenance that is known here has a value that is unfit."""
    require_plain("provenance", provenance)
    for key, kind in PROVENANCE.items():
        if key in provenance:
            kind(key, provenance[key])


def require_planes(names: tuple[str, ...]) -> None:
    """Raise InputError unless a table has planes."""
    if not names:
        raise InputError("the table has no plane that has a meaning.")


def require_interpolation(name: Any) -> None:
    """Raise InputError unless there is such an interpolation."""
    choice(INTERPOLATIONS)("interpolation", name)


def _content(header: str) -> dict[str, Any]:
    if len(header) > LONGEST_HEADER:
        raise InputError(
            f"the table's header has {len(header)} characters; allowed are {LONGEST_HEADER}."
        )
    try:
        content = json.loads(header, parse_float=_finite, parse_constant=_finite)
    except (RecursionError, ValueError) as error:
        raise InputError(f"the table's header is not JSON: {str(error)[:80]}.") from error
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise InputError(f"the file is not a {FORMAT}.")
    version = content.get("format_version")
    if isinstance(version, bool) or not isinstance(version, int) or version not in _HEADERS:
        raise InputError(
            f"the table has format version {brief(version)}; this program reads "
            f"{', '.join(map(str, _HEADERS))}."
        )
    return content


def _finite(literal: str) -> float:
    value = float(literal)
    if not np.isfinite(value):
        raise ValueError(f"{literal[:20]} is no finite number")
    return value
