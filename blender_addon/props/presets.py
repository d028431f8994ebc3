"""Settings as the text of a preset, which sets them on the active object."""

from collections.abc import Collection, Iterator

import bpy

HEADER = """import bpy

obj = bpy.context.view_layer.objects.active
if obj is None or obj.type != "MESH":
    raise RuntimeError("No mesh object is active; select the one that gets the preset.")
if obj.library is not None:
    raise RuntimeError(f"The object '{obj.name}' is linked from another file; make it local.")
settings = obj.skin_tan

"""

SKIN = (
    *("skin", "table_path", "biology", "own_minimal_doses", "mmd", "med"),
    *("kinetics", "redness", "peeling", "darkening"),
)
SCHEDULE = ("first_day", "last_day", "exposures")
"""Names of what a preset of a skin and of a schedule holds."""

OF_ONE_MESH = frozenset({"mask", "own_mask"})
"""Properties of an exposure that mean nothing on another mesh, and that a new one is not given: a
brush would paint on the mask of both."""


def preset_text(settings: bpy.types.PropertyGroup, names: Collection[str]) -> str:
    """Python that gives an object the values of some settings."""
    lines = [line for name in names for line in _lines(settings, "settings", name)]
    return HEADER + "".join(f"{line}\n" for line in lines)


def _lines(group: bpy.types.PropertyGroup, path: str, name: str) -> Iterator[str]:
    value, kind = getattr(group, name), group.bl_rna.properties[name].type
    if kind == "COLLECTION":
        yield f"{path}.{name}.clear()"
        yield f"for item in {path}.{name}:  # on an override, those of the character's own file"
        yield "    item.enabled = False"
        for item in value:
            yield f"item = {path}.{name}.add()"
            for inner in item.bl_rna.properties:
                if item.is_property_set(inner.identifier) and inner.type != "POINTER":
                    if inner.identifier not in OF_ONE_MESH:
                        yield from _lines(item, "item", inner.identifier)
    elif kind == "POINTER":
        for inner in value.bl_rna.properties:
            if inner.identifier not in ("rna_type", "name"):
                yield from _lines(value, f"{path}.{name}", inner.identifier)
    elif kind == "FLOAT" and hasattr(value, "__len__"):
        yield f"{path}.{name} = {tuple(value)!r}"
    else:
        yield f"{path}.{name} = {value!r}"
