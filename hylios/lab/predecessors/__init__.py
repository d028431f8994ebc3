"""Skin models that the thesis compares itself with (figures 6.2 to 6.4), apart from its own.

Importing `biospec` imports numba, importing `donner_jensen` imports scipy.
"""
