"""The BRDF that Marschner and others measured on a forehead, as the lobes fitted to it.

S. R. Marschner, S. H. Westin, E. P. F. Lafortune, K. E. Torrance and D. P. Greenberg 1999,
"Image-Based BRDF Measurement Including Human Skin" (Eurographics Workshop on Rendering, 139 to
152): a digital camera and a flash, three colour channels. Cornell's Program of Computer Graphics
gives with the data coefficients of three lobes and a diffuse term after E. P. F. Lafortune, S.-C.
Foo, K. E. Torrance and D. P. Greenberg 1997, "Non-Linear Approximation of Reflectance Functions".

The samples themselves were not at hand. The coefficients are those that the renderer pbrt (M. Pharr
and G. Humphreys, version 1) carries as its material "skin"; its blue paint is Cornell's. Three
things are not established:

- whether the coefficients are those of Cornell's Caucasian (a man of 43 years) or of the other
  subject for whom it gives coefficients (a South Asian man of 23);
- which of Cornell's subjects figure 6.7 shows;
- whether the channels stand in one order throughout, for Cornell once had them reversed. So only
  their mean is used here, which no order changes.
"""

import numpy as np

DIFFUSE = np.array([0.428425, 0.301341, 0.331054])
"""Diffuse reflectance by channel."""

ALONG = np.array(
    [
        [-1.131747, -1.016939, -0.966018],
        [-0.546570, -0.643533, -0.638934],
        [-0.998888, -1.020153, -1.027479],
    ]
)
"""C_xy of the three lobes, by channel."""

ACROSS = np.array(
    [
        [-1.209182, -1.462488, -1.222419],
        [0.380123, 0.410559, 0.437367],
        [0.857998, 0.703913, 0.573625],
    ]
)
"""C_z of the three lobes, by channel."""

EXPONENT = np.array(
    [
        [6.421658, 3.699932, 3.524889],
        [3.685044, 4.266495, 4.539742],
        [64.208486, 63.919687, 43.809866],
    ]
)
"""n of the three lobes, by channel."""


def forehead(incidence: float, polar: np.ndarray, azimuth: np.ndarray) -> np.ndarray:
    """f_r in 1/sr, the mean of the three channels; angles in degrees, (N,) each.

    Azimuth 0 is the side to which a mirror sends the light. The sum over the lobes is of
    (C_xy (u_x v_x + u_y v_y) + C_z u_z v_z)^n, where that is positive, with u and v pointing to
    the light and to the eye.
    """
    theta, beyond, turn = (np.radians(angle) for angle in (incidence, polar, azimuth))
    along = -np.sin(theta) * np.sin(beyond) * np.cos(turn)
    across = np.cos(theta) * np.cos(beyond)
    base = ALONG * along[:, None, None] + ACROSS * across[:, None, None]
    lobes = np.maximum(base, 0.0) ** EXPONENT
    return np.mean(DIFFUSE / np.pi + lobes.sum(axis=1), axis=-1)
