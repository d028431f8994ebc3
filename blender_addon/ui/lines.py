"""Several short lines under one icon."""

from typing import Any

import bpy

from ..translations import told


def draw_lines(layout: bpy.types.UILayout, lines: tuple[str, ...], icon: str) -> None:
    column: Any = layout.column(align=True)
    column.scale_y = 0.8
    for line in lines:
        column.label(text=told(line), icon=icon if line == lines[0] else "BLANK1")
