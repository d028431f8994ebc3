"""What subsurface scattering costs a render: Cycles with it and without."""

import tempfile
from pathlib import Path

import bpy

from examples.demo import interrupt
from examples.simplifications.light import seconds

SIZE, SAMPLES = 96, 64
ROUNDS = 3


def time_with_subsurface() -> float:
    """Processor time of rendering a ball of skin, as a multiple of that without subsurface."""
    material = _ball()
    with tempfile.TemporaryDirectory() as folder, interrupt.removing(Path(folder)):

        def render(weight: float) -> float:
            material.inputs["Subsurface Weight"].default_value = weight
            return seconds(bpy.ops.render.render)

        render(1.0)
        times = [(render(1.0), render(0.0)) for _ in range(ROUNDS)]
    return min(with_it for with_it, _ in times) / min(without for _, without in times)


def _ball():
    """A ball of 10 cm that fills the picture, lit by a lamp, and its shader."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.05)
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    material = bpy.data.materials.new("skin")
    if material.node_tree is None:
        material.use_nodes = True  # Blender 4.5
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (0.5, 0.27, 0.17, 1.0)
    shader.inputs["Subsurface Radius"].default_value = (3.0, 1.5, 1.0)
    shader.inputs["Subsurface Scale"].default_value = 1e-3
    shader.subsurface_method = "BURLEY"
    ball.data.materials.append(material)
    bpy.ops.object.light_add(type="AREA", radius=0.3, location=(0.3, -0.3, 0.3))
    bpy.context.object.data.energy = 5.0
    bpy.context.object.rotation_euler = (0.9, 0.0, 0.8)
    bpy.ops.object.camera_add(location=(0.0, -0.16, 0.0), rotation=(1.5708, 0.0, 0.0))
    scene.camera = bpy.context.object
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = SAMPLES
    scene.cycles.use_denoising = False
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    return shader
