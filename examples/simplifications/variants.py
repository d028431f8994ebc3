"""The light model with one part of it left out."""

from collections.abc import Callable
from dataclasses import replace

from hylios.skin.specimen import EPIDERMIS, Specimen
from hylios.tissue import Stack

Variant = Callable[[Specimen, float], Stack]
"""Optical layers of a specimen at a wavelength in nm."""

EPIDERMAL = slice(1, 1 + len(EPIDERMIS))

NO_RARE_PIGMENTS = {
    "methemoglobin": 0.0,
    "carboxyhemoglobin": 0.0,
    "sulfhemoglobin": 0.0,
    "corneum_beta_carotene": 0.0,
    "epidermis_beta_carotene": 0.0,
    "blood_beta_carotene": 0.0,
}


def whole(specimen: Specimen, wavelength: float) -> Stack:
    """The model as it is."""
    return Stack.of(specimen, wavelength)


def plain_absorber(specimen: Specimen, wavelength: float) -> Stack:
    """Melanosomes dissolved: their melanin absorbs evenly and nothing scatters in the epidermis."""
    contents = {}
    for layer in EPIDERMIS:
        inside = getattr(specimen, f"{layer}_melanosomes")
        colloidal = getattr(specimen, f"{layer}_colloidal_melanin")
        contents[f"{layer}_melanosomes"] = 0.0
        contents[f"{layer}_colloidal_melanin"] = min(inside + colloidal, 100.0)
    return Stack.of(replace(specimen, **contents), wavelength)


def no_rayleigh(specimen: Specimen, wavelength: float) -> Stack:
    """The papillary dermis does not scatter."""
    return without_rayleigh(Stack.of(specimen, wavelength))


def without_rayleigh(stack: Stack) -> Stack:
    """Layers whose fibres do not scatter."""
    return replace(stack, layers=tuple(replace(layer, rayleigh=0.0) for layer in stack.layers))


def spread_evenly(specimen: Specimen, wavelength: float) -> Stack:
    """Melanin of either form spread over the three epidermal layers alike."""
    thickness = [getattr(specimen, f"{layer}_thickness") for layer in EPIDERMIS]
    contents = {}
    for form in ("melanosomes", "colloidal_melanin"):
        held = [getattr(specimen, f"{layer}_{form}") for layer in EPIDERMIS]
        mean = sum(a * b for a, b in zip(held, thickness, strict=True)) / sum(thickness)
        contents |= {f"{layer}_{form}": mean for layer in EPIDERMIS}
    return Stack.of(replace(specimen, **contents), wavelength)


def one_epidermis(specimen: Specimen, wavelength: float) -> Stack:
    """One epidermal layer with the mean contents, its melanosomes of the stratum basale's size."""
    stack = Stack.of(specimen, wavelength)
    *upper, basale = parts = stack.layers[EPIDERMAL]
    thickness = sum(layer.thickness for layer in parts)

    def mean(quantities) -> float:
        return (
            sum(q * layer.thickness for q, layer in zip(quantities, parts, strict=True)) / thickness
        )

    # Melanosomes attenuate as their content over their size (4.3).
    joined = replace(
        basale,
        thickness=thickness,
        absorption=mean(layer.absorption for layer in parts),
        encounter=mean(layer.encounter * layer.semi_minor for layer in parts) / basale.semi_minor,
    )
    return replace(stack, layers=(stack.layers[0], joined, *stack.layers[EPIDERMAL.stop :]))


def no_rare_pigments(specimen: Specimen, wavelength: float) -> Stack:
    """Neither dysfunctional haemoglobins nor carotene."""
    return Stack.of(replace(specimen, **NO_RARE_PIGMENTS), wavelength)


def all_of_it(specimen: Specimen, wavelength: float) -> Stack:
    """All of these at once: plain absorbers in one epidermis over a clear dermis."""
    return without_rayleigh(plain_absorber(replace(specimen, **NO_RARE_PIGMENTS), wavelength))
