"""Pictures put together in Blender's sequencer: a contact sheet, and a video."""

import os
from collections.abc import Sequence
from pathlib import Path

import bpy

from examples.demo.render import set_file_format

COLUMNS = 3
PICTURE_WIDTH = 360
GAP = 10
CAPTION_HEIGHT = 46
FONT = "Inter.woff2"  # of those that come with Blender
PAPER, INK, WHITE = (0.96, 0.96, 0.96), (0.1, 0.1, 0.1, 1.0), (1.0, 1.0, 1.0, 1.0)
FRAMES_PER_SECOND = 12


def contact_sheet(pictures: Sequence[Path], captions: Sequence[str], path: Path) -> None:
    """Write pictures of one size in rows of three, a caption under each, into a PNG file."""
    width, height = _size(pictures[0])
    shrunk = PICTURE_WIDTH / width
    cell = (PICTURE_WIDTH + GAP, round(height * shrunk) + CAPTION_HEIGHT)
    rows = -(-len(pictures) // COLUMNS)
    sheet = (COLUMNS * cell[0] + GAP, rows * cell[1] + GAP)
    scene = _sequencer(sheet, frames=1)
    for index, (picture, caption) in enumerate(zip(pictures, captions, strict=True)):
        row, column = divmod(index, COLUMNS)
        middle = GAP + column * cell[0] + PICTURE_WIDTH / 2
        bottom = (rows - 1 - row) * cell[1]
        strip = _image(scene, [picture], channel=2 + 2 * index)
        strip.transform.scale_x = strip.transform.scale_y = shrunk
        strip.transform.filter = "BOX"
        strip.transform.offset_x = middle - sheet[0] / 2
        strip.transform.offset_y = bottom + (cell[1] + CAPTION_HEIGHT - sheet[1]) / 2
        _text(scene, caption, (middle, bottom + CAPTION_HEIGHT / 2), INK, channel=3 + 2 * index)
    set_file_format(scene, "IMAGE", "PNG")
    _write(scene, path, animation=False)


def video(pictures: Sequence[Path], captions: Sequence[str], path: Path) -> None:
    """Write pictures of one size in one folder, each with its caption, into an MP4 file (H.264)."""
    width, height = _size(pictures[0])
    scene = _sequencer((width, height), frames=len(pictures))
    scene.render.fps = FRAMES_PER_SECOND
    _image(scene, pictures, channel=2)
    for frame, caption in enumerate(captions, start=1):
        _text(scene, caption, (0.15 * width, 0.95 * height), WHITE, channel=3, frame=frame)
    set_file_format(scene, "VIDEO", "FFMPEG")
    scene.render.ffmpeg.format = "MPEG4"
    scene.render.ffmpeg.codec = "H264"
    scene.render.ffmpeg.constant_rate_factor = "HIGH"
    _write(scene, path, animation=True)


def _sequencer(size: tuple[int, int], *, frames: int) -> bpy.types.Scene:
    """A scene of its own whose sequencer shows paper."""
    scene = bpy.data.scenes.new("Montage")
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.view_settings.view_transform = "Standard"
    scene.frame_start, scene.frame_end = 1, frames
    scene.sequence_editor_create()
    _effect(scene, "COLOR", channel=1, frame=1, length=frames).color = PAPER
    return scene


def _effect(scene: bpy.types.Scene, kind: str, *, channel: int, frame: int, length: int):
    new = scene.sequence_editor.strips.new_effect
    try:
        return new(kind.title(), kind, channel, frame, length=length)
    except TypeError:  # Blender 4.5
        return new(kind.title(), kind, channel, frame, frame_end=frame + length)


def _image(scene: bpy.types.Scene, pictures: Sequence[Path], *, channel: int):
    strips = scene.sequence_editor.strips
    strip = strips.new_image("Image", str(pictures[0]), channel, 1, fit_method="ORIGINAL")
    for picture in pictures[1:]:
        strip.elements.append(picture.name)
    strip.frame_final_duration = len(pictures)
    strip.blend_type = "ALPHA_OVER"
    return strip


def _text(scene, text: str, place: tuple[float, float], colour, *, channel: int, frame: int = 1):
    strip = _effect(scene, "TEXT", channel=channel, frame=frame, length=1)
    strip.text = text
    folder = bpy.utils.system_resource("DATAFILES", path="fonts")
    strip.font = bpy.data.fonts.load(os.path.join(folder, FONT), check_existing=True)
    strip.font_size = 0.55 * CAPTION_HEIGHT
    strip.color = colour
    strip.location = (place[0] / scene.render.resolution_x, place[1] / scene.render.resolution_y)
    strip.blend_type = "ALPHA_OVER"


def _size(picture: Path) -> tuple[int, int]:
    image = bpy.data.images.load(str(picture))
    width, height = image.size
    bpy.data.images.remove(image)
    return width, height


def _write(scene: bpy.types.Scene, path: Path, *, animation: bool) -> None:
    scene.render.filepath = str(path)
    scene.render.use_file_extension = False
    # Naming the scene to the operator instead would render it at the other scene's frame.
    shown = bpy.context.window.scene
    bpy.context.window.scene = scene
    bpy.ops.render.render(animation=animation, write_still=not animation)
    bpy.context.window.scene = shown
    bpy.data.scenes.remove(scene)
