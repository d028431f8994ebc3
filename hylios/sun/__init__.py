"""Doses of ultraviolet from what people know: spectra, the sun, a UV index, sunscreen, cloth.

numpy only. How much of it skin absorbs, the light model says (`hylios.adding.absorptance`).
"""
