"""The images and numbers that a tan's node group shows."""

from collections.abc import Mapping
from dataclasses import dataclass

import bpy

from .plan import LIGHT, LOOK

BY_CHOICE = ("own_image", "peel_image")
"""Roles of images that not all tans have."""

IMAGE_KEYS = {name: f"skin_tan_{name}" for name in ("states", "places", *LOOK, *BY_CHOICE)}
"""Custom properties of a group: the images that were made for it, whatever its nodes show."""

FORMER_KEYS = tuple(f"skin_tan_{role}" for role in ("colour", *LIGHT))
"""Those of groups of earlier versions."""


@dataclass(frozen=True)
class Sampled:
    """The images of a tan, and what their axes mean.

    Attributes
    ----------
    states : Image
        Coordinates of the skin's states over days and shares.
    places : Image
        Where shares and days lie in it.
    look : mapping
        Images by the names of `LOOK`.
    melanin, blood, thickness : pairs of float
        What the ends of the look's images stand for: square root of melanin, logarithms of blood
        and of thickness.
    bulge : float
        How the share of thick skin follows the thickness: x being how far this lies from thin to
        thick, it is x + bulge x (1 - x).
    level : float
        Base colour of a shader over the colour, seen at 8 degrees.
    near_weight : float
        Of the shader that shows near light.
    roughness : float
        Of the skin.
    has_profile : bool
        Whether light scatters below the surface.
    first_day, last_day : float
    scene_unit : float
        Length of a scene unit in metres, on a body of life-size.
    own_image : Image or None
        Melanin and blood of painted colours, where these say how skin tans.
    peel_image : Image or None
        What peels over days and shares, where skin peels.
    """

    states: bpy.types.Image
    places: bpy.types.Image
    look: Mapping[str, bpy.types.Image]
    melanin: tuple[float, float]
    blood: tuple[float, float]
    thickness: tuple[float, float]
    bulge: float
    level: float
    near_weight: float
    roughness: float
    has_profile: bool
    first_day: float
    last_day: float
    scene_unit: float
    own_image: bpy.types.Image | None = None
    peel_image: bpy.types.Image | None = None

    @property
    def made(self) -> dict[str, bpy.types.Image]:
        """The images, by the custom properties of a group that say which were made for it."""
        made = {"states": self.states, "places": self.places, **self.look, **self._by_choice()}
        return {IMAGE_KEYS[name]: image for name, image in made.items()}

    @property
    def images(self) -> dict[str, bpy.types.Image]:
        """Images by the roles that show them."""
        return {
            "states": self.states,
            "columns": self.places,
            "rows": self.places,
            **dict.fromkeys(("colour", "thick_colour", "untanned"), self.look["colours"]),
            **dict.fromkeys((*LIGHT, "let_through"), self.look["light"]),
            **self._by_choice(),
        }

    def _by_choice(self) -> dict[str, bpy.types.Image]:
        """Those of `BY_CHOICE` that this one has."""
        return {role: image for role in BY_CHOICE if (image := getattr(self, role)) is not None}

    def of_history(self) -> list[bpy.types.Image]:
        """The images that come from the history."""
        return [self.states, self.places, *([self.peel_image] if self.peel_image else [])]

    def of_look(self) -> list[bpy.types.Image]:
        """The images that come from the look."""
        return [*self.look.values(), *([self.own_image] if self.own_image else [])]
