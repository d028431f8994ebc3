"""What an artist sets on an object."""

from .exposure import SkinTanExposure
from .object import SkinTanSettings

CLASSES = (SkinTanExposure, SkinTanSettings)
