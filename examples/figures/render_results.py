"""A rendered shot with what was read from it and what the table and the model predict."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from blender_addon.model.views import VIEWS, VISIBLE, inside_in_view
from examples.figures.shots import Shot
from examples.figures.tans import exposures_of
from hylios.adding import colours
from hylios.lab.colour import difference, lab
from hylios.quadrature import MOST
from hylios.skin import Skin
from hylios.table import SkinTable


@dataclass(frozen=True)
class Result:
    """A shot, and what was read from it; colours are linear Rec.709.

    Attributes
    ----------
    picture : (rows, columns, 3) array
        sRGB, 0 to 1.
    readings : (parts + 1, 3) array
        Light out of the skin as a share of a white diffuser's: of each part in the sun, then of
        covered skin.
    predicted : (parts + 1, 3) array
        The same by the table at the tanning state of the day, tinted in a view; not a number
        under a film.
    exact : (parts + 1, 3) array or None
        The same by the light model without noise; None in a view.
    shine : (2,) array
        Light reflected by the surface, mean of the brightest hundredth, in the sun and covered.
    sun_distance : (rows, columns) array
        Metres to the edge of what the sun reached, negative beyond it; not a number elsewhere.
    subject : str
        Who is in the picture.
    """

    shot: Shot
    picture: np.ndarray
    readings: np.ndarray
    predicted: np.ndarray
    exact: np.ndarray | None
    shine: np.ndarray
    sun_distance: np.ndarray
    subject: str

    @property
    def lightness(self) -> np.ndarray:
        """L* (parts + 1,) as read."""
        return lab(self.readings)[:, 0]

    @property
    def contrast(self) -> np.ndarray:
        """CIEDE2000 (parts,) between the parts in the sun and covered skin, as read."""
        return difference(self.readings[:-1], self.readings[-1])


def result(shot: Shot, skin: Skin, table: SkinTable, folder: Path) -> Result:
    """What was read from a shot, with what the table and the model predict."""
    states = tanning_states(shot, skin)
    with np.load(folder / f"{shot.name}.npz") as file:
        return Result(
            shot=shot,
            picture=file["picture"],
            readings=file["readings"],
            predicted=_without_film(predicted(table, states, shot.view), shot),
            exact=None
            if shot.view != VISIBLE
            else _without_film(np.array([model_colour(skin, state) for state in states]), shot),
            shine=file["shine"],
            sun_distance=file["sun_distance"],
            subject=str(file["subject"]),
        )


def predicted(table: SkinTable, states: np.ndarray, view: str) -> np.ndarray:
    """Colour (N, 3) of the light out of skin in tanning states (N, 4) by its table, in a view."""
    if view == VISIBLE:
        return table.plane("subsurface_colour", states)
    return inside_in_view(table, table.plane("band_reflectance", states), VIEWS[view])


def _without_film(colours: np.ndarray, shot: Shot) -> np.ndarray:
    """Colours of a shot's parts and of covered skin, where sunscreen lies on this not a number."""
    if shot.gloss:
        colours = np.array(colours)
        colours[-1] = np.nan
    return colours


def tanning_states(shot: Shot, skin: Skin) -> np.ndarray:
    """States (parts + 1, 4) on the day of a shot: of each schedule, and without sun."""
    hours = [24.0 * shot.day]
    schedules = (*shot.schedules, ())
    return np.array([skin.states(exposures_of(schedule), hours)[0] for schedule in schedules])


def model_colour(skin: Skin, state: np.ndarray) -> np.ndarray:
    """Colour (3,) of the light out of skin in a tanning state (4,), without noise."""
    return colours(skin, state[None], count=MOST).subsurface[0]
