"""Random walk of light through plane layers, compiled with numba.

Importing this package imports numba; nothing else in `hylios` does.
"""
