"""What may lie on the skin, and how days may lie on the timeline, as menus offer it."""

from ..model.timing import FRAMES, OWN, SCENE, SPEED

FILMS = (
    ("NONE", "Dry", "Nothing lies on the skin"),
    ("WATER", "Water", "Skin that came out of the water"),
    ("OIL", "Oil", "Oiled skin"),
    ("SUNSCREEN", "Sunscreen", "Skin with sunscreen on it; times in the sun set how it protects"),
)
"""What may lie on the skin, the names of liquids in capitals."""

TIMINGS = (
    (SCENE, "Scene's Frames", "From the first to the last frame of the scene"),
    (SPEED, "Start and Speed", "From a frame on, so many days in a second of animation"),
    (FRAMES, "Two Frames", "From one frame to another"),
    (OWN, "Own Keys", "By your own keys of the object's property tan_day; Apply leaves them"),
)
