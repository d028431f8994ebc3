"""A layout that records what panels draw, and raises where Blender would only print."""

import bpy

from blender_addon.ui import panel

ICONS = {
    item.identifier
    for item in bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
}


class Layout:
    """Records the labels; refuses properties, operators and icons that do not exist."""

    ATTRIBUTES = {
        "use_property_split",
        "use_property_decorate",
        "scale_y",
        "emboss",
        "active",
        "enabled",
    }

    def __init__(self, labels: list[str]):
        object.__setattr__(self, "labels", labels)

    def __setattr__(self, name, value):
        assert name in self.ATTRIBUTES and name in bpy.types.UILayout.bl_rna.properties
        object.__setattr__(self, name, value)

    def row(self, align=False):
        return Layout(self.labels)

    column = row

    def split(self, *, factor):
        assert 0.0 < factor < 1.0
        return Layout(self.labels)

    def separator(self):
        pass

    def label(self, *, text, icon="NONE"):
        assert icon in ICONS
        self.labels.append(text)

    def prop(self, data, name, *, text=None, emboss=True, icon="NONE", placeholder=""):
        assert name in data.bl_rna.properties
        if placeholder and not getattr(data, name):
            self.labels.append(placeholder)
        assert icon in ICONS

    def operator(self, name, *, text=None, icon="NONE", icon_value=0, depress=False):
        assert icon in ICONS
        module, function = name.split(".")
        properties = getattr(getattr(bpy.ops, module), function).get_rna_type().properties
        if depress:
            self.labels.append(f"[{text}]")
        return Properties(properties)

    def menu(self, name, *, text, icon):
        assert icon in ICONS
        kind = getattr(bpy.types, name)
        kind.draw(Panel(self.labels), bpy.context)

    def template_icon(self, icon_value, *, scale):
        assert icon_value >= 0 and scale > 1.0

    def popover(self, *, panel, icon, text):
        assert icon in ICONS and hasattr(bpy.types, panel)

    def template_list(self, kind, identifier, data, name, active_data, active_name, *, rows):
        assert name in data.bl_rna.properties and active_name in active_data.bl_rna.properties
        for item in getattr(data, name):
            getattr(bpy.types, kind).draw_item(
                None, bpy.context, Layout(self.labels), data, item, 0, active_data, active_name
            )


class Properties:
    """Values of an operator's button; refuses those that it has not."""

    def __init__(self, properties):
        object.__setattr__(self, "properties", properties)

    def __setattr__(self, name, value):
        assert value in self.properties[name].enum_items


class Panel:
    def __init__(self, labels):
        self.layout = Layout(labels)


def drawn(*kinds) -> list[str]:
    """Labels of some panels, or of the whole sidebar."""
    labels: list[str] = []
    for kind in kinds or panel.SIDEBAR:
        if not hasattr(kind, "poll") or kind.poll(bpy.context):
            if hasattr(kind, "draw_header_preset"):
                kind.draw_header_preset(Panel(labels), bpy.context)
            kind.draw(Panel(labels), bpy.context)
    return labels
