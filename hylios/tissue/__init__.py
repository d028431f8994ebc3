"""Optical layers of a skin at a wavelength.

`model` says what is taken for granted, `absorbers` what absorbs where, `melanosomes` what they do
in a layer, `layers` puts them together as a `Stack`.
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
