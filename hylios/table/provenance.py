"""The skin that a table's provenance describes, as the objects that computations need.

The one reader of a provenance, for the builder and the add-on.
"""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from hylios.errors import InputError
from hylios.skin import UNTANNED, Skin
from hylios.skin.specimen import Specimen
from hylios.sun.action_spectra import Absorptance
from hylios.table.schema import PROVENANCE, dynamics_from
from hylios.tanning import PIGMENTATIONS, Kinetics, MelaninDynamics


@dataclass(frozen=True)
class MinimalDoses:
    """Doses in SED from which skin tans (`mmd`) and burns (`med`)."""

    mmd: float
    med: float


def skin_of(provenance: Mapping[str, Any]) -> Skin:
    """The skin that a table was made for.

    Raises
    ------
    InputError
        If the provenance lacks a part of it or a part cannot be used.
    """
    names = {sentence: name for name, sentence in UNTANNED.items()}
    doses = minimal_doses(provenance)
    return Skin(
        specimen=Specimen(**_value(provenance, "specimen_parameters")),
        pigmentation=_value(provenance, "pigmentation"),
        mmd=doses.mmd,
        med=doses.med,
        dynamics=melanin_dynamics(provenance),
        untanned=names[_value(provenance, "untanned_state")],
    )


def minimal_doses(provenance: Mapping[str, Any]) -> MinimalDoses:
    """Minimal doses of a table's skin.

    Raises
    ------
    InputError
        If the provenance lacks one or it cannot be used.
    """
    return MinimalDoses(
        mmd=float(_value(provenance, "mmd_sed")), med=float(_value(provenance, "med_sed"))
    )


def absorptance(provenance: Mapping[str, Any]) -> Absorptance:
    """What the untanned skin of a table absorbs in the ultraviolet.

    Raises
    ------
    InputError
        If the provenance does not say it, as the first tables' does not, or it cannot be used.
    """
    if "absorptance" not in provenance:
        raise InputError(
            "the table does not say what its skin absorbs in the ultraviolet, as sun by date needs "
            "it; give that exposure in SED, or build the table anew."
        )
    told = _value(provenance, "absorptance")
    return Absorptance(np.array(told["wavelengths_nm"]), np.array(told["values"]))


def described_dynamics(dynamics: MelaninDynamics) -> dict[str, float | list[float]]:
    """Melanin dynamics as a table's provenance holds them, `melanin_dynamics`."""
    return {
        name: list(value) if isinstance(value, tuple) else value
        for name, value in asdict(dynamics).items()
    }


def melanin_dynamics(provenance: Mapping[str, Any]) -> MelaninDynamics:
    """How a table's skin makes melanin.

    The numbers in `melanin_dynamics`; a table that has none, as the first ones, says the name of
    a set of table 6.4 in `pigmentation`.

    Raises
    ------
    InputError
        If neither can be used.
    """
    if "melanin_dynamics" in provenance:
        return dynamics_from(_value(provenance, "melanin_dynamics"))
    return PIGMENTATIONS[_value(provenance, "pigmentation")]


def melanin_kinetics(provenance: Mapping[str, Any], kinetics: str = "thesis") -> Kinetics:
    """What the melanin of a table's skin follows, by one of `hylios.tanning.KINETICS`.

    By the thesis these are its `melanin_dynamics`; one table serves both.

    Raises
    ------
    InputError
        As `melanin_dynamics`, or for measured kinetics `skin_of`; or there is no such kinetics.
    """
    if kinetics == "thesis":
        return melanin_dynamics(provenance)
    return replace(skin_of(provenance), kinetics=kinetics).melanin_kinetics


def own_spectra(provenance: Mapping[str, Any]) -> dict[str, str | None]:
    """Names of the spectra of the user's own that a table was made with, each with its digest.

    The digest is None in a table of a builder that kept none. Where the files were is not told:
    no file is opened because a table names it.

    Raises
    ------
    InputError
        If the provenance cannot be used.
    """
    names = _value(provenance, "own_figures") if "own_figures" in provenance else {}
    digests = _value(provenance, "own_spectra_sha256") if "own_spectra_sha256" in provenance else {}
    return {name: digests.get(name) for name in names}


def _value(provenance: Mapping[str, Any], key: str) -> Any:
    """A value of the provenance that fits the schema; a table may have been made in memory."""
    if key not in provenance:
        raise InputError(f"the table does not say its {key.replace('_', ' ')}.")
    PROVENANCE[key](key, provenance[key])
    return provenance[key]
