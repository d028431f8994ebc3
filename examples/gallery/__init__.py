"""Skin as a new material shows it: places of a body, near and far, in two lights."""
