"""Tints of skin as seen in the ultraviolet and the infrared.

The thesis shows both "in pseudo colour": reflectance as a grey under "a tinted greyscale filter"
(appendix D; figures 6.9 to 6.12, 6.20 and 6.28). It prints no tint.
"""

TINTS = {"uv": (0.72, 0.60, 1.0), "ir": (1.0, 0.66, 0.60)}
"""Linear Rec.709 of skin of reflectance 1: violet and red, for the end of the visible that is
nearer. They are this project's choice."""
