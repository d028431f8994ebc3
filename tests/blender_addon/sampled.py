"""What a tan's images show, sampled as the shader samples them."""

import numpy as np

from blender_addon.model.look import look
from blender_addon.model.tan import Tan, history_within
from hylios.table import MinimalDoses


def bilinear(image: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """An image (rows, columns, 3) at texture coordinates; beyond the edges their value is held."""
    rows, columns, _ = image.shape
    x, y = (np.clip(p * n - 0.5, 0.0, n - 1.0) for p, n in ((x, columns), (y, rows)))
    left, low = (np.minimum(p.astype(int), max(n - 2, 0)) for p, n in ((x, columns), (y, rows)))
    right, high = np.minimum(left + 1, columns - 1), np.minimum(low + 1, rows - 1)
    fx, fy = (x - left)[..., None], (y - low)[..., None]
    lower = image[low, left] * (1.0 - fx) + image[low, right] * fx
    upper = image[high, left] * (1.0 - fx) + image[high, right] * fx
    return lower * (1.0 - fy) + upper * fy


def coordinates(history, shares: np.ndarray, days: np.ndarray) -> np.ndarray:
    """u, v and b (N, 3) at shares and days (N,)."""
    passed = (days - history.first_day) / (history.last_day - history.first_day)
    steps = history.places.shape[1]
    half = np.full(np.shape(shares), 0.5)
    x, y = (
        bilinear(history.places, (0.5 + part * (steps - 1)) / steps, half)[..., channel]
        for channel, part in enumerate((np.asarray(shares), passed))
    )
    return bilinear(history.coordinates, x, y)


def looked_up(look, image: np.ndarray, places: np.ndarray) -> np.ndarray:
    """An image of a look at u, v and b (N, 3)."""
    rows, columns, _ = image.shape
    u, v, b = np.moveaxis(places, -1, 0)
    x = 0.5 / columns + (1.0 - 1.0 / columns) * _part(np.exp(u / 2.0), look.melanin)
    if image is not look.colour:
        y = 0.5 / rows + (1.0 - 1.0 / rows) * _part(b, look.blood)
        return bilinear(image, x, y)
    y = 0.5 / rows + (0.5 - 1.0 / rows) * _part(b, look.blood)
    part = _part(v, look.thickness)[..., None]
    thick = part + look.bulge * part * (1.0 - part)
    return bilinear(image, x, y) * (1.0 - thick) + bilinear(image, x, 1.0 - y) * thick


def colours(tan) -> np.ndarray:
    """Colours (rows, columns, 3) at the states of a tan's image."""
    return looked_up(tan.look, tan.look.colour, tan.history.coordinates)


def _part(values: np.ndarray, ends: tuple[float, float]) -> np.ndarray:
    span = ends[1] - ends[0] or 1.0
    return np.clip((values - ends[0]) / span, 0.0, 1.0)


def tan(table, received, *, mmd, med, first_day, last_day) -> Tan:
    """What doses make of the skin of a table."""
    minimal = MinimalDoses(mmd=mmd, med=med)
    days = first_day, last_day
    return Tan(history_within(table, received, minimal, days), look(table, minimal))
