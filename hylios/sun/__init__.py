"""Doses of ultraviolet in the units people have: spectra, sun, UV index, under sunscreen or cloth.

numpy only. What skin absorbs of it the light model tells (`hylios.adding.absorptance`).
"""
