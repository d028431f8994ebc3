import bpy

obj = bpy.context.view_layer.objects.active
if obj is None or obj.type != "MESH":
    raise RuntimeError("No mesh object is active; select the one that gets the preset.")
if obj.library is not None:
    raise RuntimeError(f"The object '{obj.name}' is linked from another file; make it local.")
settings = obj.skin_tan

settings.first_day = 0.0
settings.last_day = 45.0
settings.exposures.clear()
for item in settings.exposures:  # on an override, those of the character's own file
    item.enabled = False
item = settings.exposures.add()
item.name = "Day 1"
item.day = 0.0
item.unit = "MMD"
item.multiple = 1.5
item = settings.exposures.add()
item.name = "Day 3"
item.day = 2.0
item.unit = "MMD"
item.multiple = 1.5
item = settings.exposures.add()
item.name = "Day 5"
item.day = 4.0
item.unit = "MMD"
item.multiple = 1.5
item = settings.exposures.add()
item.name = "Day 7"
item.day = 6.0
item.unit = "MMD"
item.multiple = 1.5
item = settings.exposures.add()
item.name = "Day 9"
item.day = 8.0
item.unit = "MMD"
item.multiple = 1.5
item = settings.exposures.add()
item.name = "Day 11"
item.day = 10.0
item.unit = "MMD"
item.multiple = 1.5
item = settings.exposures.add()
item.name = "Day 13"
item.day = 12.0
item.unit = "MMD"
item.multiple = 1.5
