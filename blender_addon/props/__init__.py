"""What an artist sets on an object."""

from .baked import baked
from .biology import SkinTanBiology
from .exposure import HOUR_OF_DAY, SkinTanExposure
from .mask import SkinTanFilmMask, SkinTanMask
from .material import SkinTanMaterial
from .object import SkinTanSettings, settings_of
from .overriding import overridable
from .region import SkinTanRegion, SkinTanRegionMask
from .scene import SkinTanScene
from .skins import table_file

__all__ = [
    "CLASSES",
    "HOUR_OF_DAY",
    "SkinTanBiology",
    "SkinTanExposure",
    "SkinTanFilmMask",
    "SkinTanMask",
    "SkinTanMaterial",
    "SkinTanRegion",
    "SkinTanRegionMask",
    "SkinTanScene",
    "SkinTanSettings",
    "settings_of",
    "table_file",
]

_OF_OBJECTS = (
    SkinTanBiology,
    SkinTanMask,
    SkinTanFilmMask,
    SkinTanExposure,
    SkinTanMaterial,
    SkinTanRegionMask,
    SkinTanRegion,
    SkinTanSettings,
)

CLASSES = (*(overridable(baked(group)) for group in _OF_OBJECTS), baked(SkinTanScene))
