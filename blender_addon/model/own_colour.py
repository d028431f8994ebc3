"""How a painted place of skin differs from the skin around it, as its colour tells.

Blood hardly changes the red, so red tells the melanin; green over red then tells the blood. Both
are over those of the usual colour, the one in which most of the skin is painted.
"""

import numpy as np
from numpy.typing import NDArray

from .look import Look, untanned_colour

RED_STEP, REDNESS_STEP = 0.05, 0.05
"""How far columns and rows of the image lie apart: logarithms of red, and of green over red."""

COLUMNS, ROWS = 62, 33
USUAL_COLUMN, USUAL_ROW = 25, 20
"""Where the usual colour lies: its texel is exact, so that there the tan is that of the skin."""

SLOPE = (1.0 / (RED_STEP * COLUMNS), 1.0 / (REDNESS_STEP * ROWS))
START = ((USUAL_COLUMN + 0.5) / COLUMNS, (USUAL_ROW + 0.5) / ROWS)
"""From logarithms of red, and of green over red, to a place in the image."""

BLOODS = 40
"""Amounts of blood at which melanin is told from red, between which it is told by lines."""

LUMINANCE = (0.2126, 0.7152, 0.0722)


def offsets(look: Look) -> NDArray[np.float32]:
    """Melanin and blood of painted colours over those of the skin, by the look without sun.

    Parameters
    ----------
    look : Look

    Returns
    -------
    (ROWS, COLUMNS, 3) float32 array
        Melanin over that of the skin, b (the logarithm of blood over that of the skin), and 0;
        over logarithms of green over red and of red, over those of the usual colour. What no such
        skin has is held: melanin at none and at as much as a tan can still darken, blood at the
        least and the most of the look.
    """
    reds = RED_STEP * (np.arange(COLUMNS) - USUAL_COLUMN)
    rednesses = REDNESS_STEP * (np.arange(ROWS) - USUAL_ROW)
    melanin = np.linspace(*look.melanin, look.colour.shape[1]) ** 2
    bloods, red, redness = _colours(look)
    last = _last_column(look, melanin)
    # By blood: the melanin that gives a red, and the redness that such skin has.
    falling = np.minimum.accumulate(red[:, : last + 1], axis=1)
    held = np.stack([np.interp(-reds, -own, melanin[: last + 1]) for own in falling])
    shown = np.stack(
        [np.interp(own, melanin, line) for own, line in zip(held, redness, strict=True)]
    )
    image = np.zeros((ROWS, COLUMNS, 3))
    for column in range(COLUMNS):
        falling = np.minimum.accumulate(shown[:, column])
        most = bloods[shown[:, column].argmin()]
        blood = np.interp(-rednesses, -falling, bloods, right=most)
        image[:, column, 0] = np.interp(blood, bloods, held[:, column])
        image[:, column, 1] = blood
    image[USUAL_ROW, USUAL_COLUMN] = 1.0, 0.0, 0.0
    return image.astype(np.float32)


def _colours(look: Look) -> tuple[NDArray, NDArray, NDArray]:
    """Blood (B,), and (B, columns) logarithms of red and of green over red of thin skin."""
    rows = look.colour.shape[0] // 2
    bloods = np.linspace(*look.blood, BLOODS) if look.blood[1] > look.blood[0] else np.zeros(1)
    places = np.clip((bloods - look.blood[0]) / max(np.ptp(look.blood), 1e-9), 0.0, 1.0)
    below = np.minimum((places * (rows - 1)).astype(int), max(rows - 2, 0))
    part = (places * (rows - 1) - below)[:, None, None]
    above = np.minimum(below + 1, rows - 1)
    colour = look.colour[below] * (1.0 - part) + look.colour[above] * part
    logs = np.log(np.maximum(colour[..., :2], 1e-4) / untanned_colour(look)[:2])
    return bloods, logs[..., 0], logs[..., 1] - logs[..., 0]


def _last_column(look: Look, melanin: NDArray) -> int:
    """The darkest skin that all of a tan still darkens, or the half of it if tans reach so far.

    The look holds so much melanin, and with more of it the model's skin is not paler again.
    """
    darkest = int((look.colour[0] @ LUMINANCE).argmin())
    most = max(melanin[-1] / np.exp(look.most_tan), np.sqrt(melanin[-1]))
    room = int(np.searchsorted(melanin, most, side="right")) - 1
    usual = int(abs(melanin - 1.0).argmin())
    return max(min(darkest, room), usual)
