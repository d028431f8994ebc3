"""Optical layers of a skin at a wavelength.

`model` holds the spectra and readings that light is computed with. `absorbers` and `melanosomes`
say what absorbs in a layer, and `layers` puts all of it together as a `Stack`.
"""

from hylios.tissue.absorbers import ABSORBERS, PARTS, SPECTRA, absorbers
from hylios.tissue.layers import Layer, Stack
from hylios.tissue.model import Model
from hylios.tissue.readings import READINGS, complete_readings

__all__ = [
    "ABSORBERS",
    "PARTS",
    "READINGS",
    "SPECTRA",
    "Layer",
    "Model",
    "Stack",
    "absorbers",
    "complete_readings",
]
