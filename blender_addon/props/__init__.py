"""What an artist sets on an object."""

from .exposure import SkinTanExposure
from .mask import SkinTanMask
from .material import SkinTanMaterial
from .object import SkinTanSettings, settings_of, table_file
from .scene import SkinTanScene

__all__ = [
    "CLASSES",
    "SkinTanExposure",
    "SkinTanMask",
    "SkinTanMaterial",
    "SkinTanScene",
    "SkinTanSettings",
    "settings_of",
    "table_file",
]

CLASSES = (SkinTanMask, SkinTanExposure, SkinTanMaterial, SkinTanSettings, SkinTanScene)
