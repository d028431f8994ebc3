"""HyLIoS: light and tanning in human skin.

Specimens, spectral figures, light transport, tanning dynamics and the colour of a spectrum, after
T. F. Chen, "On the Modelling of Hyperspectral Light and Skin Interactions and the Simulation of
Skin Appearance Changes Due to Tanning" (PhD thesis, University of Waterloo). Docstrings cite its
equations and tables by number.

Importing this package, its specimens, its tanning model or its tables needs numpy alone. numba is
imported by `hylios.transport`, colour-science by `hylios.lab.colour`.
"""

__version__ = "0.1.0"
