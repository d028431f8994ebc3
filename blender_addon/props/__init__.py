"""What an artist sets on an object."""

from .biology import SkinTanBiology
from .exposure import SkinTanExposure
from .mask import SkinTanFilmMask, SkinTanMask
from .material import SkinTanMaterial
from .object import SkinTanSettings, settings_of
from .overriding import overridable
from .region import SkinTanRegion, SkinTanRegionMask
from .scene import SkinTanScene
from .skins import table_file

__all__ = [
    "CLASSES",
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

CLASSES = (
    *map(
        overridable,
        (
            SkinTanBiology,
            SkinTanMask,
            SkinTanFilmMask,
            SkinTanExposure,
            SkinTanMaterial,
            SkinTanRegionMask,
            SkinTanRegion,
            SkinTanSettings,
        ),
    ),
    SkinTanScene,
)
