"""Which of an object's materials tan."""

import bpy
from bpy.props import BoolProperty, PointerProperty


class SkinTanMaterial(bpy.types.PropertyGroup):
    material: PointerProperty(
        name="Material",
        description="A material in a slot of this object",
        type=bpy.types.Material,
        options={"HIDDEN"},
    )
    tans: BoolProperty(
        name="Tans",
        description="This material is skin: Apply Tan gives it the tan, or takes it out",
    )
