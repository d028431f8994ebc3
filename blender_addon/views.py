"""Views: all tanned skin of a file in one band, or in the visible again."""

import json
from collections.abc import Callable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from hylios.errors import InputError
from hylios.table import MinimalDoses

from .model import catalogue
from .model.biology import table_with
from .model.settings import Biology, TanSettings
from .model.tan import Tan
from .model.views import VIEWS, VISIBLE, BandLook, band_look, left_by_film
from .props import SkinTanSettings, table_file
from .scene import images, nodes, views
from .scene.changes import Changes
from .scene.film import FILM_KEY
from .scene.ownership import is_local, names

SOURCE_KEY = "skin_tan_source"
"""Custom property of a group: the table and doses of its look, which settings may have left."""


def remember_source(
    group: Any, settings: SkinTanSettings, values: TanSettings, tan: Tan, changes: Changes
) -> None:
    """Note in a group what its look was made from."""
    doses = values.minimal_doses(catalogue.provenance(values.table))
    source = {
        "skin": settings.skin,
        "table_path": settings.table_path,
        "mmd": doses.mmd,
        "med": doses.med,
        "biology": asdict(values.biology),
        "kinetics": values.kinetics,
        "ends": _ends(tan.look),
    }
    changes.set_key(group, SOURCE_KEY, json.dumps(source))


def switch_view(view: str) -> str:
    """Have all tanned skin of the file show a view, and return a sentence on it.

    Skin that cannot show it shows the visible; the sentence says why. Linked skin stays as it is.

    Raises
    ------
    InputError
        If there is no such view, or if no skin of the file can show it; all is as it was then.
    """
    if view != VISIBLE and view not in VIEWS:
        raise InputError(f"view is {view!r}; allowed is one of {', '.join((VISIBLE, *VIEWS))}.")
    with Changes() as changes:
        groups = views.groups_of_file()
        own = [group for group in groups if is_local(group)]
        band = _bands(view)
        failed = {
            group: why
            for group in own
            if (why := _switch(group, views.trees_of(group, groups[group]), view, band, changes))
        }
        if own and len(failed) == len(own):
            says = f"{_called(view).capitalize()} cannot be shown on"
            raise InputError(_sentence(says, failed, groups))
        views.set_view_of_file(None if view == VISIBLE else view, changes)
        views.remove_unused_images(changes)
    linked = [obj for group in groups.keys() - set(own) for obj in groups[group]]
    shown = [obj for group in own if group not in failed for obj in groups[group]]
    return " ".join(
        [
            f"{_called(view).capitalize()} is shown on {names(shown) or 'no skin yet'}.",
            *([_sentence("The visible stays on", failed, groups)] if failed else []),
            *([f"Linked skin stays as it is: {names(linked)}."] if linked else []),
        ]
    )


def keep_view(group: Any, trees: list[Any], changes: Changes) -> list[str]:
    """Have a group whose look has changed show the view of the file; a sentence where it cannot.

    The trees lead to it from materials.
    """
    view = views.view_of_file() or VISIBLE
    if view not in VIEWS:
        view = VISIBLE  # of a later version
    why = _switch(group, trees, view, _bands(view), changes)
    views.remove_unused_images(changes)
    return [f"It shows the visible, not {_called(view)}: {why}."] if why else []


Bands = Callable[[Any], views.Band]
"""What a group shows in a view; raises InputError where it has no such band."""


def _switch(group: Any, trees: list[Any], view: str, band: Bands, changes: Changes) -> str:
    """Switch one group; why it shows the visible, where it should not."""
    if view != VISIBLE:
        try:
            views.show(group, trees, band(group), changes)
        except InputError as error:
            views.hide(group, trees, changes)
            return str(error).rstrip(".")
        return ""
    views.hide(group, trees, changes)
    return ""


def _bands(view: str) -> Bands:
    """What groups show in a view; what several have in common is computed once."""
    looks: dict[str, BandLook] = {}

    def band(group: Any) -> views.Band:
        source = group.get(SOURCE_KEY)
        if source is None or not nodes.is_of_today(group):
            raise InputError("an earlier version made this tan; press Apply Tan.")
        if source not in looks:
            looks[source] = _look(json.loads(source), view)
        plan = VIEWS[view]
        image = images.shared_image(
            f"Skin Tan {_called(view)}", looks[source].colour, is_colour=True
        )
        image[views.IMAGE_KEY] = True
        film = left_by_film(group.get(FILM_KEY, ""), plan)
        return views.Band(view, image, plan.tint, plan.nearest, film)

    return band


def _look(source: Mapping[str, Any], view: str) -> BandLook:
    path: Path = table_file(source["skin"], source["table_path"])
    doses = MinimalDoses(mmd=source["mmd"], med=source["med"])
    biology = Biology(**source.get("biology", {}))
    kinetics = source.get("kinetics", "thesis")
    table = table_with(path, biology, kinetics=kinetics, bands=True)
    look = band_look(table, doses, VIEWS[view], kinetics)
    if not np.allclose(_ends(look), source["ends"], atol=1e-3):
        raise InputError("the table has changed since Apply; press Apply Tan.")
    return look


def _ends(look: Any) -> list[float]:
    return [*look.melanin, *look.blood, *look.thickness]


def _called(view: str) -> str:
    return "the visible" if view == VISIBLE else f"{VIEWS[view].nm:g} nm"


def _sentence(
    says: str, failed: Mapping[Any, str], groups: Mapping[Any, list[bpy.types.Object]]
) -> str:
    """What is said of objects that cannot show a view, and why the first of them cannot."""
    objects = [obj for group in failed for obj in groups[group]]
    return f"{says} {names(objects)}: {next(iter(failed.values()))}."
