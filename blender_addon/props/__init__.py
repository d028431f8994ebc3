"""What an artist sets on an object."""

from .exposure import SkinTanExposure
from .material import SkinTanMaterial
from .object import SkinTanSettings, settings_of, table_file
from .scene import SkinTanScene

__all__ = [
    "CLASSES",
    "SkinTanExposure",
    "SkinTanMaterial",
    "SkinTanScene",
    "SkinTanSettings",
    "settings_of",
    "table_file",
]

CLASSES = (SkinTanExposure, SkinTanMaterial, SkinTanSettings, SkinTanScene)
