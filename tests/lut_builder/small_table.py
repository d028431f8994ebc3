"""A small table with all planes, which many tests look at."""

from hylios.skin import Skin
from hylios.skin.specimen import SPECIMENS
from lut_builder.settings import Settings

SKIN = Skin.of(SPECIMENS["S3"], "intermediate", 2.89, 1.7)
SMALL = Settings(
    knots=(3, 2, 2, 2),
    colour_wavelengths=5,
    profile_error=0.025,
    profile_wavelengths=4,
    profile_states=24,
)
