"""Whether what an artist has set is what Apply has last shown."""

import ast
import functools
import hashlib
from typing import Any

import bpy

from .model.timing import SCENE, SPEED
from .props import SkinTanSettings, settings_of
from .scene import timeline
from .scene.changes import Changes

NOTES = frozenset(
    "rna_type name group material keyed own_day applied undone exposure_index region_index live "
    "kinetics_kept redness_kept".split()
)
"""Properties of an object that do not change its look."""

SCHEDULE = frozenset("exposures own_minimal_doses mmd med redness darkening".split())
"""Properties that change the history of the skin and nothing else."""

BIOLOGY = "biology"
"""Property that changes the look and nothing else."""

SKIN = frozenset("skin table_path kinetics".split())
"""Properties that say whose look it is, and in which tans it is at all."""

LATER = frozenset("peeling darkening altitude cloud ground through depth".split())
"""Properties that came after files held such texts: one that nobody has set is not told, so that a
tan of before counts as shown."""

SEPARATOR = "\n"

ROUGHLY = ", 'roughly']"
"""How a line of settings ends that a tan shows for a moment only."""

Frames = tuple[int, int, int, float]
"""Of a scene: the first, the last, those of a second, and what divides these."""


def scene_frames(scene: bpy.types.Scene) -> Frames:
    return scene.frame_start, scene.frame_end, scene.render.fps, scene.render.fps_base


def applied_frames(obj: bpy.types.Object, scene: bpy.types.Scene) -> Frames:
    """The scene's frames as the last Apply has met them; before one, as they are."""
    rest = settings_of(obj).applied.split(SEPARATOR)[-1]
    return _frames_in(rest) or scene_frames(scene)


@functools.lru_cache(maxsize=256)
def _frames_in(rest: str) -> Frames | None:
    """The frames in the last line of `text_of`, which is asked for at every change of a frame."""
    try:
        _, frames, *_ = ast.literal_eval(rest)
        first, last, rate, base = frames
        return first, last, rate, base
    except (ValueError, SyntaxError, TypeError):
        return None


def is_left_behind(obj: bpy.types.Object, scene: bpy.types.Scene) -> bool:
    """Whether Apply would key an object's days elsewhere, since the scene has other frames now."""
    settings, former, now = settings_of(obj), applied_frames(obj, scene), scene_frames(scene)
    way = settings.timing_values().way
    is_moved = (way == SCENE and former[:2] != now[:2]) or (
        way == SPEED and former[2] * now[3] != now[2] * former[3]
    )
    is_own = timeline.is_driven(obj) or timeline.has_own_keys(obj, tuple(settings.keyed))
    return is_moved and not is_own


def text_of(obj: bpy.types.Object, scene: bpy.types.Scene, frames: Frames | None = None) -> str:
    """All that decides an object's look, in lines: schedule, biology, skin, and the rest.

    Parameters
    ----------
    frames : tuple, optional
        Of the scene. By default those of the last Apply: what else is set there, a shorter range
        to render, or another scene with the object, is no change of the tan.
    """
    settings = settings_of(obj)
    names = _names(settings)
    others = {*NOTES, *SCHEDULE, *SKIN, BIOLOGY}
    schedule, skin, rest = (
        [_value(settings, name) for name in kept]
        for kept in (
            [name for name in names if name in SCHEDULE],
            [name for name in names if name in SKIN],
            [name for name in names if name not in others],
        )
    )
    units, biology = scene.unit_settings, _value(settings, BIOLOGY)
    frames = frames or applied_frames(obj, scene)
    lines = schedule, biology, skin, (rest, frames, units.system, units.scale_length)
    return SEPARATOR.join(map(repr, lines))


def note(obj: bpy.types.Object, text: str, changes: Changes) -> None:
    """Remember that an object's look is that of its settings, of which a text tells."""
    if settings_of(obj).applied != text:
        changes.set(settings_of(obj), "applied", text)


def roughly(text: str, *, look: bool, history: bool) -> str:
    """A text that no settings have, for those that show for a moment: they count as changed.

    Parameters
    ----------
    look, history : bool
        Whether that is rough.
    """
    schedule, biology, *others = text.split(SEPARATOR)
    return SEPARATOR.join([_marked(schedule, history), _marked(biology, look), *others])


def _marked(line: str, is_rough: bool) -> str:
    return line.removesuffix("]") + ROUGHLY if is_rough else line


def digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def content(text: str, *, rough: bool) -> str:
    """What an image comes from that shows settings exactly or roughly."""
    return digest(text) + " roughly" * rough


def look_digest(text: str, *, rough: bool = False) -> str:
    """Digest of what decides a look in a text: biology, skin, and sensitivity by hand.

    A rough look has another, so that none counts as exact after an undo.
    """
    doses = _sensitivity(text)
    more = [*([repr(doses)] if doses else []), *(["rough"] if rough else [])]
    return digest(SEPARATOR.join([*text.split(SEPARATOR)[1:3], *more]))


def is_changed(obj: bpy.types.Object, scene: bpy.types.Scene) -> bool:
    """Whether an object shows another tan than its settings describe.

    It cannot be told of objects to which an earlier version of the add-on has given a tan.
    """
    settings = settings_of(obj)
    return bool(settings.group and settings.applied) and settings.applied != text_of(obj, scene)


def is_only_schedule_changed(former: str, now: str) -> bool:
    """Whether no setting but the times in the sun and the sensitivity differs in two texts."""
    return former != now and former.split(SEPARATOR)[1:] == now.split(SEPARATOR)[1:]


def has_look(obj: bpy.types.Object, scene: bpy.types.Scene) -> bool:
    """Whether the last Apply has made the look that an object's settings describe."""
    former, now = settings_of(obj).applied, text_of(obj, scene)
    return is_only_schedule_changed(former, now) and not is_sensitivity_changed(former, now)


def is_sensitivity_changed(former: str, now: str) -> bool:
    """Whether the doses from which skin tans and burns differ in two texts: the look lies along
    the states that they lead to."""
    return _sensitivity(former) != _sensitivity(now)


def _sensitivity(text: str) -> list[object]:
    """Whether doses are set by hand, and which: the first of a schedule."""
    by_hand, *doses = ast.literal_eval(text.split(SEPARATOR)[0])[:3]
    return doses if by_hand else []


def is_only_biology_changed(former: str, now: str) -> bool:
    """Whether no setting but the biology differs in two texts, however rough the history is."""
    schedule, _, *others = former.replace(ROUGHLY + SEPARATOR, "]" + SEPARATOR).split(SEPARATOR)
    schedule_now, _, *others_now = now.split(SEPARATOR)
    return former != now and (schedule, others) == (schedule_now, others_now)


def _value(group: bpy.types.PropertyGroup | SkinTanSettings, name: str) -> object:
    value, kind = getattr(group, name), _kinds(type(group))[name]
    if kind == "COLLECTION":
        return [_values(item) for item in value]
    if kind == "POINTER" and isinstance(value, bpy.types.PropertyGroup):
        return _values(value)
    if kind == "POINTER":
        return value and value.name_full
    return tuple(value) if kind == "FLOAT" and hasattr(value, "__len__") else value


def _values(group: bpy.types.PropertyGroup) -> list[object]:
    return [_value(group, name) for name in _names(group) if name not in ("rna_type", "name")]


def _names(group: bpy.types.PropertyGroup | SkinTanSettings) -> list[str]:
    names = _kinds(type(group))
    return [name for name in names if name not in LATER or group.is_property_set(name)]


@functools.lru_cache(maxsize=32)
def _kinds(cls: Any) -> dict[str, str]:
    """Kinds of a class's properties by name, in order: a year of days asks for them often."""
    return {prop.identifier: prop.type for prop in cls.bl_rna.properties}
