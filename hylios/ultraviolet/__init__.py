"""Doses of ultraviolet in the units people have: spectra, sun, UV index, under sunscreen or cloth.

Needs numpy alone. `absorptance` is the one module that asks the light model (`hylios.adding`).
"""
