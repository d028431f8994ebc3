"""What the planes of a table mean."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hylios.errors import InputError
from hylios.table.axes import AXIS_UNIT, LARGEST_COORDINATE, STATE_NAMES


@dataclass(frozen=True)
class Meaning:
    """Meaning of a plane.

    Attributes
    ----------
    says : str
        What its numbers are.
    unit : str
    components : tuple of str
        Names of the numbers of a state; none where there is one to each wavelength in
        `bands_nm` of the table's provenance.
    fits_half : bool
        Whether numbers of 16 bits can hold it.
    low, high : float
        Between which all its numbers are.
    """

    says: str
    unit: str
    components: tuple[str, ...] = ("R", "G", "B")
    fits_half: bool = True
    low: float = 0.0
    high: float = 1e30


MOST_REFLECTANCE = 1.5
"""Largest value of a colour's channel or a band; saturated colours have more than 1 in one."""

COLOUR_UNIT = "linear Rec.709"


def _colour(says: str) -> Meaning:
    return Meaning(says, COLOUR_UNIT, high=MOST_REFLECTANCE)


MEANINGS = {
    "subsurface_colour": _colour(
        "light that has been inside the skin: the albedo of a shader; incident at 8 degrees, as "
        "what does not say another angle"
    ),
    "total_colour": _colour(
        "the same with the light that the surface reflects: what a measurement sees"
    ),
    "subsurface_colour_45": _colour("light that has been inside the skin, incident at 45 degrees"),
    "subsurface_colour_60": _colour("light that has been inside the skin, incident at 60 degrees"),
    "subsurface_colour_70": _colour("light that has been inside the skin, incident at 70 degrees"),
    "total_colour_45": _colour("all light that is reflected, incident at 45 degrees"),
    "wet_subsurface_colour": _colour(
        "light that has been inside the skin, under a film of water of index 1.33"
    ),
    "band_reflectance": Meaning(
        "total reflectance at a wavelength",
        "share of the incident light",
        components=(),
        high=MOST_REFLECTANCE,
    ),
    "near_share": Meaning(
        "share of the light that has been inside the skin that leaves where it came in, as seen "
        "from .1 mm on",
        "share of the light that leaves",
        high=1.0,
    ),
    "far_width": Meaning("width d of Burley's diffusion profile of the rest", "mm", high=1e6),
    "profile_width": Meaning("width d of Burley's diffusion profile", "mm", high=1e6),
    "colour_error": Meaning("estimated standard error of total_colour", COLOUR_UNIT),
    "near_share_error": Meaning(
        "estimated standard error of near_share", "share of the light that leaves"
    ),
    "far_width_error": Meaning("estimated standard error of far_width", "mm"),
    "profile_error": Meaning(
        "estimated standard error of the share of light that leaves within a distance, at the "
        "distance where it is largest",
        "share of the light that leaves",
    ),
    "profile_effective_samples": Meaning(
        "number of rays of equal weight that would give as good a profile",
        "rays",
        fits_half=False,
    ),
    "state": Meaning(
        "the state that these numbers are of, and within: how far from a state what is looked up "
        "here may lie, in each of the four, for the table to hold that state",
        AXIS_UNIT,
        components=(*STATE_NAMES[:4], "within"),
        low=-LARGEST_COORDINATE,
        high=LARGEST_COORDINATE,
    ),
}
PLANES = tuple(MEANINGS)
"""Names of the planes that have a meaning; a table has one or more of them."""


def component_names(plane: str, provenance: Mapping[str, Any]) -> tuple[str, ...]:
    """Names of the numbers that a plane has to a state.

    Raises
    ------
    InputError
        If the provenance lacks the wavelengths of a plane that has one number to each.
    """
    if MEANINGS[plane].components:
        return MEANINGS[plane].components
    try:
        # A dot would part a channel's name anew.
        names = tuple(f"{float(band):g}nm".replace(".", "_") for band in provenance["bands_nm"])
    except (KeyError, OverflowError, TypeError, ValueError) as error:
        raise InputError(f"the plane {plane} needs wavelengths bands_nm: {error!r}.") from error
    if not names or len(set(names)) < len(names):
        raise InputError(f"the plane {plane} needs wavelengths bands_nm that differ.")
    return names


def require_values(plane: str, values: np.ndarray) -> None:
    """Raise InputError unless all numbers of a plane are within what they can mean."""
    meaning = MEANINGS[plane]
    outside = values[~((values >= meaning.low) & (values <= meaning.high))]
    if outside.size:
        raise InputError(
            f"the table's plane {plane} has a number of {outside[0]:g}; "
            f"allowed is {meaning.low:g} to {meaning.high:g}."
        )
