"""Skin that tans over the timeline, in Blender.

- `model`: what to show, as numbers. Knows no Blender and runs without it.
- `scene`: images, nodes, materials and keys, and who owns them. Knows no physics.
- `views`: has all skin of a file show one band of light.
- `apply`: takes an object's settings through `model` to `scene`.
- `props`, `ops`, `ui`: what an artist sets, the buttons, the panels.
- `translations`: what they say in other languages.

Imports go one way: ui -> ops -> apply -> views -> props -> model and scene. What Apply leaves in a
file needs neither this add-on nor scripts. This module imports no bpy, so that `model` can be used
and tested where there is no Blender.
"""


def register():
    """Register all classes with Blender, and `skin_tan` on objects."""
    from . import registration

    registration.register()


def unregister():
    """Take all that `register` added back."""
    from . import registration

    registration.unregister()
