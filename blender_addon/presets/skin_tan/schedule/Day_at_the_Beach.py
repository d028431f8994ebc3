import bpy

obj = bpy.context.view_layer.objects.active
if obj is None or obj.type != "MESH":
    raise RuntimeError("No mesh object is active; select the one that gets the preset.")
settings = obj.skin_tan

settings.first_day = 0.0
settings.last_day = 30.0
settings.exposures.clear()
item = settings.exposures.add()
item.name = "Beach"
item.day = 0.0
item.unit = "MMD"
item.multiple = 2.0
