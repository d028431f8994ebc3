"""What an artist sets on an object."""

from .exposure import SkinTanExposure
from .object import SkinTanSettings, settings_of

__all__ = ["CLASSES", "SkinTanExposure", "SkinTanSettings", "settings_of"]

CLASSES = (SkinTanExposure, SkinTanSettings)
