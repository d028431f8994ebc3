"""Skin specimens: the parameters of tables 6.1 and 6.2 of the thesis."""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, Field, asdict, dataclass, field, fields, replace
from functools import cache
from importlib.resources import files
from numbers import Real
from types import MappingProxyType
from typing import Any

import numpy as np

from hylios.errors import InputError, require_range
from hylios.skin.physiology import MOST_EPIDERMAL_MELANIN, PHYSIOLOGY

EPIDERMIS = ("granulosum", "spinosum", "basale")
LAYERS = ("corneum", *EPIDERMIS, "papillary", "reticular")
"""Layers of a specimen, from the surface down."""

ARRANGEMENTS = ("individual", "complexes", "compact_complexes")
MELANOSOME_SCALE = {"granulosum": 0.25, "spinosum": 0.5, "basale": 1.0}
"""Size of the melanosomes of a layer relative to table 6.1 (degradation upwards, section 6.1.1)."""


def _parameter(unit: str, low: float, high: float, what: str, default: Any = MISSING) -> Any:
    limits = {"unit": unit, "low": low, "high": high, "what": what}
    return field(default=default, metadata=limits)


def _fixed(value: float, unit: str, low: float, high: float, what: str) -> Any:
    return _parameter(unit, low, high, what, default=value)


@dataclass(frozen=True, kw_only=True)
class Specimen:
    """A skin specimen, with the names and units of tables 6.1 (no default) and 6.2 (defaults).

    Every field but the first two is a number; its metadata hold the unit and the possible range,
    `hylios.skin.physiology.PHYSIOLOGY` the physiological one. Only what is impossible is refused
    here, so that a computation may leave physiology; `specimen_of` and `with_values` refuse more.

    Raises
    ------
    InputError
        If a number is none or lies outside its possible range, or a text cannot be used.

    Examples
    --------
    A variation of a specimen that has a name:

    >>> from dataclasses import replace
    >>> import hylios
    >>> ruddy = replace(hylios.specimen("III"), papillary_blood=0.8)
    >>> ruddy.papillary_blood
    0.8
    """

    name: str
    melanosome_arrangement: str
    surface_fold_aspect_ratio: float = _parameter("1", 0.0, 10.0, "aspect ratio of surface folds")
    corneum_thickness: float = _parameter("cm", 1e-8, 10.0, "stratum corneum thickness")
    granulosum_thickness: float = _parameter("cm", 1e-8, 10.0, "stratum granulosum thickness")
    spinosum_thickness: float = _parameter("cm", 1e-8, 10.0, "stratum spinosum thickness")
    basale_thickness: float = _parameter("cm", 1e-8, 10.0, "stratum basale thickness")
    papillary_thickness: float = _parameter("cm", 1e-8, 10.0, "papillary dermis thickness")
    reticular_thickness: float = _parameter("cm", 1e-8, 10.0, "reticular dermis thickness")
    granulosum_melanosomes: float = _parameter("%", 0.0, 100.0, "volume in granulosum")
    spinosum_melanosomes: float = _parameter("%", 0.0, 100.0, "volume in spinosum")
    basale_melanosomes: float = _parameter("%", 0.0, 100.0, "volume in basale")
    granulosum_colloidal_melanin: float = _parameter("%", 0.0, 100.0, "volume in granulosum")
    spinosum_colloidal_melanin: float = _parameter("%", 0.0, 100.0, "volume in spinosum")
    basale_colloidal_melanin: float = _parameter("%", 0.0, 100.0, "volume in basale")
    eumelanin_concentration: float = _parameter("mg/mL", 0.0, 1500.0, "within melanosomes")
    pheomelanin_concentration: float = _parameter("mg/mL", 0.0, 1500.0, "within melanosomes")
    melanosome_major_axis: float = _parameter("um", 0.01, 10.0, "full axis, in the basale")
    melanosome_minor_axis: float = _parameter("um", 0.01, 10.0, "full axis, in the basale")
    papillary_blood: float = _parameter("%", 0.0, 100.0, "volume in papillary dermis")
    reticular_blood: float = _parameter("%", 0.0, 100.0, "volume in reticular dermis")
    oxygenated_blood: float = _parameter("%", 0.0, 100.0, "of the functional hemoglobin")

    corneum_refractive_index: float = _fixed(1.55, "1", 1.0, 4.0, "at 1300 nm")
    epidermis_refractive_index: float = _fixed(1.4, "1", 1.0, 4.0, "at 1300 nm")
    papillary_refractive_index: float = _fixed(1.39, "1", 1.0, 4.0, "at 1300 nm")
    reticular_refractive_index: float = _fixed(1.41, "1", 1.0, 4.0, "at 1300 nm")
    melanin_refractive_index: float = _fixed(1.7, "1", 1.0, 4.0, "at every wavelength")
    hemoglobin: float = _fixed(147.0, "mg/mL", 0.0, 500.0, "functional, in whole blood")
    methemoglobin: float = _fixed(1.5, "mg/mL", 0.0, 500.0, "in whole blood")
    carboxyhemoglobin: float = _fixed(1.5, "mg/mL", 0.0, 500.0, "in whole blood")
    sulfhemoglobin: float = _fixed(0.0, "mg/mL", 0.0, 500.0, "in whole blood")
    blood_bilirubin: float = _fixed(0.003, "mg/mL", 0.0, 10.0, "in whole blood")
    corneum_beta_carotene: float = _fixed(2.1e-4, "mg/mL", 0.0, 10.0, "in stratum corneum")
    epidermis_beta_carotene: float = _fixed(2.1e-4, "mg/mL", 0.0, 10.0, "in epidermis")
    blood_beta_carotene: float = _fixed(7.0e-5, "mg/mL", 0.0, 10.0, "in whole blood")
    corneum_water: float = _fixed(35.0, "%", 0.0, 100.0, "volume in stratum corneum")
    epidermis_water: float = _fixed(60.0, "%", 0.0, 100.0, "volume in epidermis")
    papillary_water: float = _fixed(75.0, "%", 0.0, 100.0, "volume in papillary dermis")
    reticular_water: float = _fixed(75.0, "%", 0.0, 100.0, "volume in reticular dermis")
    corneum_lipids: float = _fixed(35.0, "%", 0.0, 100.0, "volume in stratum corneum")
    epidermis_lipids: float = _fixed(20.0, "%", 0.0, 100.0, "volume in epidermis")
    papillary_lipids: float = _fixed(15.1, "%", 0.0, 100.0, "volume in papillary dermis")
    reticular_lipids: float = _fixed(17.33, "%", 0.0, 100.0, "volume in reticular dermis")
    corneum_keratin: float = _fixed(65.0, "%", 0.0, 100.0, "volume in stratum corneum")
    corneum_urocanic_acid: float = _fixed(0.01, "mol/L", 0.0, 1.0, "in stratum corneum")
    hypodermis_reflectance: float = _fixed(100.0, "%", 0.0, 100.0, "of what reaches it")
    skin_dna: float = _fixed(0.185, "mg/mL", 0.0, 100.0, "in the epidermis")

    def __post_init__(self):
        if not (isinstance(self.name, str) and self.name and self.name.isprintable()):
            raise InputError(f"name is {self.name!r}; allowed is printable text.")
        if self.melanosome_arrangement not in ARRANGEMENTS:
            raise InputError(
                f"melanosome_arrangement is {self.melanosome_arrangement!r}; "
                f"allowed is {', '.join(ARRANGEMENTS)}."
            )
        for name, low, high, unit in _limits():
            value = getattr(self, name)
            if not isinstance(value, float) or not low <= value <= high:
                require_range(name, _number(name, value), low, high, unit)
        for layer, content in zip(reversed(EPIDERMIS), self.melanin.tolist(), strict=True):
            if content > 1.0 + 1e-9:
                raise InputError(
                    f"{layer}_melanosomes and {layer}_colloidal_melanin together are "
                    f"{100.0 * content:g} %; allowed is 0 to 100 %."
                )
        if self.melanosome_major_axis < self.melanosome_minor_axis:
            raise InputError(
                f"melanosome_major_axis is {self.melanosome_major_axis:g} um; allowed is the "
                f"minor axis, {self.melanosome_minor_axis:g} um, or more."
            )

    @property
    def melanin(self) -> np.ndarray:
        """Melanin content of basale, spinosum, granulosum, both forms, as volume fraction (3,)."""
        return 0.01 * np.array(
            [
                getattr(self, f"{layer}_melanosomes") + getattr(self, f"{layer}_colloidal_melanin")
                for layer in reversed(EPIDERMIS)
            ]
        )

    @property
    def epidermal_thickness(self) -> np.ndarray:
        """Thickness of basale, spinosum, granulosum in cm (3,)."""
        return np.array([getattr(self, f"{layer}_thickness") for layer in reversed(EPIDERMIS)])

    @property
    def pigmentation(self) -> float:
        """Volume fraction of the epidermis that is melanin: the p of equations 3.1 and 3.2."""
        thickness = self.epidermal_thickness
        return float(self.melanin @ thickness / thickness.sum())


def require_specimen(specimen: Specimen) -> Specimen:
    """The specimen, if it is one and not its name or a skin that tans.

    Raises
    ------
    InputError
        If it is anything else.
    """
    if isinstance(specimen, Specimen):
        return specimen
    if isinstance(getattr(specimen, "specimen", None), Specimen):
        raise InputError(
            "the specimen is a skin, which looks different in every tanning state; "
            "skin.at(state) is a specimen, without sun skin.at(skin.untanned_state)."
        )
    raise InputError(
        f"the specimen is {str(specimen)[:60]!r}; expected a Specimen, such as "
        'hylios.specimen("S3") or skin.at(state).'
    )


def parameters() -> list[Field]:
    """The numeric fields of `Specimen`, with unit, range and meaning in their metadata."""
    return [parameter for parameter in fields(Specimen) if parameter.metadata]


def _unit(parameter: Field) -> str:
    """A field's unit as it stands behind a number."""
    return "" if parameter.metadata["unit"] == "1" else parameter.metadata["unit"]


@cache
def _limits() -> tuple[tuple[str, float, float, str], ...]:
    """Name, least and largest value of the numeric fields, and unit as it stands behind them."""
    return tuple(
        (
            parameter.name,
            parameter.metadata["low"],
            parameter.metadata["high"],
            _unit(parameter),
        )
        for parameter in parameters()
    )


def _number(name: str, value: Any) -> float:
    if isinstance(value, Real) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError as error:
            raise InputError(f"{name} is too large; expected a number.") from error
    raise InputError(f"{name} is {str(value)[:40]!r}; expected a number.")


def specimen_of(values: Mapping[str, Any], *, allow_unphysical: bool = False) -> Specimen:
    """A specimen from its fields by name; those of table 6.2 may be left out.

    Raises
    ------
    InputError
        If a field is unknown, missing or no number, or lies outside its physiological range (with
        `allow_unphysical`, outside its possible range).
    """
    names = [field.name for field in fields(Specimen)]
    for name in values:
        if name not in names:
            raise InputError(f"there is no parameter {name!r}; there are {', '.join(names)}.")
    missing = [
        field.name
        for field in fields(Specimen)
        if field.default is MISSING and field.name not in values
    ]
    if missing:
        raise InputError(f"the specimen lacks {', '.join(missing)}.")
    if not allow_unphysical:
        _require_physiological_ranges(values)
    made = Specimen(**values)
    if not allow_unphysical and made.pigmentation > MOST_EPIDERMAL_MELANIN:
        raise InputError(
            f"melanin is {100 * made.pigmentation:g} % of the epidermis; physiological is 0 to "
            f"{100 * MOST_EPIDERMAL_MELANIN:g} %, allowed is 0 to 100 % with allow_unphysical."
        )
    return made


def _require_physiological_ranges(values: Mapping[str, Any]) -> None:
    for parameter in parameters():
        name = parameter.name
        if name not in values:
            continue
        value, physiology = _number(name, values[name]), PHYSIOLOGY[name]
        if not physiology.holds(value):
            unit = f" {_unit(parameter)}".rstrip()
            low, high = parameter.metadata["low"], parameter.metadata["high"]
            raise InputError(
                f"{name} is {value:g}{unit}; physiological is {physiology.low:g} to "
                f"{physiology.most:g}{unit}, allowed is {low:g} to {high:g}{unit} with "
                "allow_unphysical."
            )


def with_values(
    specimen: Specimen, values: Mapping[str, Any], *, allow_unphysical: bool = False
) -> Specimen:
    """The specimen with some parameters set by name: numbers, and the melanosomes' arrangement.

    Raises
    ------
    InputError
        If there is no such parameter, or the specimen would not be physiological (with
        `allow_unphysical`, not possible).
    """
    if "name" in values:
        raise InputError("the name of a specimen is no parameter; a file can give one.")
    return specimen_of({**asdict(specimen), **values}, allow_unphysical=allow_unphysical)


def tanned(
    specimen: Specimen,
    melanin: np.ndarray,
    thickness: float,
    untanned: np.ndarray | None = None,
    thickened: Sequence[str] = LAYERS,
) -> Specimen:
    """The specimen in a tanning state (equation 5.16, sections 5.2.2 and 5.3).

    Every layer's melanin becomes m_i(t) of 5.16, in the specimen's own proportion of melanosomes
    to colloidal melanin in that layer (of the whole epidermis where the layer has neither);
    every layer's thickness is scaled, and its melanin content divided by the same factor. What
    would fill more than the whole layer is cut to fill it: a layer's content is never above 1
    and never falls where the state's melanin rises.

    As printed, 5.16 gives each layer the tanning model's share of the total melanin, not the
    specimen's own: the untanned state of a tan is then not quite the specimen itself, unless its
    melanin lies so already. With `untanned` it always is: each layer's own melanin is scaled by
    m_i(t)/m_i(0). That keeps every layer's ratio to its start, but the total only as far as the
    layers' shares are the model's.

    Parameters
    ----------
    melanin : (3,) array
        Melanin of basale, spinosum, granulosum relative to the total at the start.
    thickness : float
        Thickness relative to the start.
    untanned : (3,) array, optional
        The state's melanin at which the specimen is what it is; 5.16 as printed by default.
    thickened : sequence of str
        Layers whose thickness is scaled, those of the epidermis among them; all by default, as in
        5.29.

    Raises
    ------
    InputError
        If a content is negative, the thickness or the untanned melanin not positive, or one of
        them not finite.
    """
    content = np.minimum(_content(specimen, melanin, thickness, untanned), 1.0)
    changes = {
        f"{layer}_thickness": getattr(specimen, f"{layer}_thickness") * thickness
        for layer in thickened
    }
    for layer, percent in zip(reversed(EPIDERMIS), 100.0 * content, strict=True):
        inside = percent * _melanosome_share(specimen, layer)
        changes[f"{layer}_melanosomes"] = inside
        changes[f"{layer}_colloidal_melanin"] = percent - inside
    return replace(specimen, **changes)


def overfull(
    specimen: Specimen,
    melanin: np.ndarray,
    thickness: float,
    untanned: np.ndarray | None = None,
) -> bool:
    """Whether `tanned` has to cut melanin in a tanning state because it would overfill a layer."""
    return bool(np.any(_content(specimen, melanin, thickness, untanned) > 1.0))


def _content(
    specimen: Specimen, melanin: np.ndarray, thickness: float, untanned: np.ndarray | None
) -> np.ndarray:
    """Melanin content of basale, spinosum, granulosum as volume fraction, before any cut (3,)."""
    melanin = np.asarray(melanin, dtype=float)
    if melanin.shape != (3,) or not (np.all(np.isfinite(melanin)) and np.all(melanin >= 0)):
        raise InputError(f"relative melanin is {melanin.tolist()}; allowed are 3 values from 0 on.")
    require_range("relative thickness", thickness, 1e-3, 1e3)
    return _uncut(specimen, melanin, np.array(thickness), untanned)


def contents(
    specimen: Specimen,
    melanin: np.ndarray,
    thickness: np.ndarray,
    untanned: np.ndarray | None = None,
) -> np.ndarray:
    """Melanin content (..., 3) of `tanned` in many states: melanin (..., 3), thickness (...)."""
    return np.minimum(_uncut(specimen, melanin, thickness, untanned), 1.0)


def _uncut(
    specimen: Specimen, melanin: np.ndarray, thickness: np.ndarray, untanned: np.ndarray | None
) -> np.ndarray:
    """Melanin content (..., 3), before any cut."""
    if untanned is None:
        total = specimen.melanin @ specimen.epidermal_thickness
        return total * melanin / specimen.epidermal_thickness / thickness[..., None]
    untanned = np.asarray(untanned, dtype=float)
    if untanned.shape != (3,) or not (np.all(np.isfinite(untanned)) and np.all(untanned > 0)):
        raise InputError(
            f"relative melanin without sun is {untanned.tolist()}; allowed are 3 values above 0."
        )
    return specimen.melanin * melanin / untanned / thickness[..., None]


def _melanosome_share(specimen: Specimen, layer: str) -> float:
    """Share of a layer's melanin that lies in melanosomes."""
    inside = getattr(specimen, f"{layer}_melanosomes")
    both = inside + getattr(specimen, f"{layer}_colloidal_melanin")
    if both > 0:
        return inside / both
    whole = specimen.melanin.sum()
    if whole == 0:
        return 0.0
    return 0.01 * sum(getattr(specimen, f"{other}_melanosomes") for other in EPIDERMIS) / whole


def _read() -> Mapping[str, Specimen]:
    text = files("hylios.skin").joinpath("specimens.toml").read_text(encoding="utf-8")
    return MappingProxyType(
        {name: Specimen(name=name, **values) for name, values in tomllib.loads(text).items()}
    )


SPECIMENS: Mapping[str, Specimen] = _read()
"""The four specimens of table 6.1, as `specimens.toml` has them: S1 to S3 lightly, S4 darkly
pigmented."""
