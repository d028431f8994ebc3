"""The button that mends skin whose scene has other units, or whose body is no person's size."""

import bpy

from hylios.errors import require_range

from . import applied
from .model.settings import LARGEST_SCALE, LEAST_SCALE
from .model.size import times_life_size
from .props import settings_of
from .scene import images, several, size
from .scene.changes import Changes
from .scene.ownership import names
from .tannable import tannable


def fit_size(obj: bpy.types.Object | None, scene: bpy.types.Scene, model_scale: float = 0.0) -> str:
    """Have light in skin go as far as it does in a person, and return a sentence on it.

    Sets how many times life-size the object is, and mends all objects of the scene whose skin was
    made for other units. Keys, settings and colours stay.

    Parameters
    ----------
    model_scale : float
        How many times life-size the object is; 0 to judge by its size.

    Raises
    ------
    InputError
        If the object cannot carry a tan or the scale is out of range.
    """
    obj = tannable(obj)
    settings, was_shown = settings_of(obj), not applied.is_changed(obj, scene)
    with Changes() as changes:
        if model_scale != 0.0:
            require_range("model scale", model_scale, LEAST_SCALE, LARGEST_SCALE)
            changes.set(settings, "model_scale", model_scale)
        else:
            factor = times_life_size(size.length(obj, scene))
            scale = min(max(settings.model_scale * factor, LEAST_SCALE), LARGEST_SCALE)
            changes.set(settings, "model_scale", scale)
        mended = size.misfits(scene)
        for other in dict.fromkeys((obj, *mended)):
            size.fit(other, scene, changes)
        if was_shown and settings.group is not None:
            applied.note(obj, applied.text_of(obj, scene), changes)
            images.note_content(
                several.own_history(settings.group), applied.digest(settings.applied)
            )
    scale = f"{settings.model_scale:.3g}"
    said = f"{obj.name!r} is {'' if scale == '1' else f'{scale} times '}life-size."
    return f"{said} Light in the skin of {names(mended)} now fits its size." if mended else said
