"""Earlier skin models, with which the thesis compares its own (figures 6.2 to 6.4).

Importing `biospec` imports numba, importing `donner_jensen` imports scipy.
"""
