import bpy

settings = bpy.context.view_layer.objects.active.skin_tan

settings.first_day = 0.0
settings.last_day = 30.0
settings.exposures.clear()
item = settings.exposures.add()
item.name = "Beach"
item.day = 0.0
item.unit = "MMD"
item.multiple = 2.0
