"""Everything the tanning model needs to know about one person's skin."""

from hylios.skin.skin import (
    LEAST_PIGMENTATION,
    MOST_PIGMENTATION,
    THICKENED,
    UNTANNED,
    USUAL_PIGMENTATION,
    Skin,
    varied,
    whole_thickening,
)

__all__ = [
    "LEAST_PIGMENTATION",
    "MOST_PIGMENTATION",
    "THICKENED",
    "UNTANNED",
    "USUAL_PIGMENTATION",
    "Skin",
    "varied",
    "whole_thickening",
]
