"""How different two colours look: CIELAB and CIEDE2000. numpy only, for a scene."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

REC709_TO_XYZ = np.array(
    [
        [0.4124564, 0.3575761, 0.1804375],
        [0.2126729, 0.7151522, 0.0721750],
        [0.0193339, 0.1191920, 0.9503041],
    ]
)
"""Linear Rec.709 to tristimulus values under D65, white 1 (IEC 61966-2-1)."""


def lab(linear: ArrayLike) -> NDArray[np.float64]:
    """CIELAB under D65 of linear Rec.709 colours, (..., 3) both."""
    ratios = (
        np.asarray(linear, dtype=float) @ (REC709_TO_XYZ / REC709_TO_XYZ.sum(axis=1)[:, None]).T
    )
    low = (6.0 / 29.0) ** 3
    curve = np.where(
        ratios > low, np.cbrt(np.maximum(ratios, low)), ratios * (29.0 / 6.0) ** 2 / 3 + 4 / 29
    )
    x, y, z = np.moveaxis(curve, -1, 0)
    return np.stack([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)], axis=-1)


def ciede2000(one: ArrayLike, other: ArrayLike) -> NDArray[np.float64]:
    """CIEDE2000 (...) between CIELAB colours (..., 3), all weights 1.

    Sharma, Wu & Dalal, Color Res. Appl. 30, 21 (2005).
    """
    (l1, a1, b1), (l2, a2, b2) = (np.moveaxis(np.asarray(c, float), -1, 0) for c in (one, other))
    mean = 0.5 * (np.hypot(a1, b1) + np.hypot(a2, b2))
    stretch = 1.5 - 0.5 * np.sqrt(mean**7 / (mean**7 + 25.0**7))
    c1, c2 = np.hypot(a1 * stretch, b1), np.hypot(a2 * stretch, b2)
    h1, h2 = (np.degrees(np.arctan2(b, a * stretch)) % 360.0 for a, b in ((a1, b1), (a2, b2)))
    grey = c1 * c2 == 0.0
    turn = h2 - h1
    far = np.abs(turn) > 180.0 + 1e-9  # opposite hues, but for rounding, are not
    turn = np.where(grey, 0.0, np.where(far, turn - 360.0 * np.sign(turn), turn))
    lightness, chroma = l2 - l1, c2 - c1
    hue = 2.0 * np.sqrt(c1 * c2) * np.sin(np.radians(0.5 * turn))
    middle = 0.5 * (h1 + h2)
    middle = np.where(far, np.where(h1 + h2 < 360.0, middle + 180.0, middle - 180.0), middle)
    middle = np.where(grey, h1 + h2, middle)
    return _weighted(0.5 * (l1 + l2), 0.5 * (c1 + c2), middle, (lightness, chroma, hue))


def _weighted(
    lightness: np.ndarray, chroma: np.ndarray, hue: np.ndarray, apart: tuple[np.ndarray, ...]
) -> np.ndarray:
    """The difference, from the means of lightness, chroma and hue (degrees), and how far apart."""
    angles = zip((1.0, 2.0, 3.0, 4.0), (-30.0, 0.0, 6.0, -63.0), strict=True)
    cosines = [np.cos(np.radians(times * hue + shift)) for times, shift in angles]
    t = 1.0 - 0.17 * cosines[0] + 0.24 * cosines[1] + 0.32 * cosines[2] - 0.20 * cosines[3]
    squared = (lightness - 50.0) ** 2
    by_lightness = apart[0] / (1.0 + 0.015 * squared / np.sqrt(20.0 + squared))
    by_chroma = apart[1] / (1.0 + 0.045 * chroma)
    by_hue = apart[2] / (1.0 + 0.015 * chroma * t)
    blue = np.radians(30.0 * np.exp(-(((hue - 275.0) / 25.0) ** 2)))
    rotation = -np.sin(2.0 * blue) * 2.0 * np.sqrt(chroma**7 / (chroma**7 + 25.0**7))
    return np.sqrt(by_lightness**2 + by_chroma**2 + by_hue**2 + rotation * by_chroma * by_hue)
