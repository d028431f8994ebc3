"""What the thesis says of figures 6.9 to 6.12, 6.19 and 6.20, checked on renders."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from examples.figures import report
from examples.figures.spectral_looks import VISIBLE
from examples.figures.spectral_shots import WET_FROM, SpectralShot
from hylios.lab.colour import linear_of_srgb, srgb
from hylios.pseudo_colour import TINTS

ULTRAVIOLET_ENDS = 400.0
IDENTICAL = 0.05
"""Reflectances that differ by less are practically identical."""
UNSEEN = 0.02
"""Contrast of spots that is not to be seen."""
SKIN_RED = 0.03
"""Albedo in the red from which on a pixel is skin: the cap has less."""

Rows = list[report.Row]


@dataclass(frozen=True)
class Seen:
    """A shot with what was read from it; pictures are (rows, columns, 3).

    Attributes
    ----------
    picture : sRGB
    scattered : light that has been inside, linear
    albedo : of the shader
    gloss : float
        Share of the light from the face that has not been inside.
    face : (rows, columns) bool array
        What faces the camera.
    bare : (rows, columns) bool array
        Where no sunscreen lies, of that.
    position : in metres
    """

    shot: SpectralShot
    picture: np.ndarray
    scattered: np.ndarray
    albedo: np.ndarray
    gloss: float
    face: np.ndarray
    bare: np.ndarray
    position: np.ndarray
    subject: str

    @classmethod
    def of(cls, shot: SpectralShot, path: Path) -> "Seen":
        """From the file of `examples.figures.spectral_scenes`."""
        with np.load(path) as file:
            face = file["seen"]
            whole, inside = (float(file[name][face].mean()) for name in ("combined", "scattered"))
            return cls(
                shot=shot,
                picture=file["picture"],
                scattered=file["scattered"],
                albedo=file["albedo"],
                gloss=1.0 - inside / whole,
                face=face,
                bare=file["uncovered"],
                position=file["position"],
                subject=str(file["subject"]),
            )

    @property
    def light(self) -> float:
        """Mean light out of the face."""
        return float(self.scattered[self.face].mean())

    @property
    def spots(self) -> float:
        """Contrast of what differs in albedo: its standard deviation over its mean."""
        albedo = self.albedo[self.face].mean(axis=-1)
        return float(albedo.std() / albedo.mean())


def pseudo_colour(one: Seen) -> np.ndarray:
    """The picture, in the tint of its band's swatches outside the visible."""
    nm = one.shot.nm
    if nm == VISIBLE:
        return one.picture
    tint = TINTS["uv" if nm < ULTRAVIOLET_ENDS else "ir"]
    skin = one.albedo[..., :1] > 0.0
    return np.where(skin, srgb(linear_of_srgb(one.picture) * np.array(tint)), one.picture)


def _listed(seen: Sequence[Seen], what: Callable[[Seen], float], form: str = ".1%") -> str:
    values = ", ".join(format(what(one), form) for one in seen)
    return f"{values} ({'; '.join(one.shot.name.split(' ', 1)[1] for one in seen)})"


def domains(seen: Sequence[Seen]) -> Rows:
    """Rows of figure 6.9."""
    soft, sharp = seen[:3], seen[3:]
    gloss, spots = [one.gloss for one in soft], [one.spots for one in soft]
    apart = [
        float(np.abs(one.scattered - other.scattered)[one.face].mean() / other.light)
        for one, other in zip(soft, sharp, strict=True)
    ]
    return [
        report.claim(
            "6.9",
            "glossier under UV, more diffuse under IR light",
            "so it is",
            "share of light that has not been inside: " + _listed(soft, lambda one: one.gloss),
            gloss[0] > gloss[1] > gloss[2],
        ),
        report.claim(
            "6.9",
            "irregularities of pigment intensified under UV, less apparent under IR light",
            "so it is",
            "contrast of spots: " + _listed(soft, lambda one: one.spots),
            spots[0] > spots[1] > spots[2],
        ),
        report.claim(
            "6.9",
            "a BRDF may do in the UV; in the IR it lacks the soft look of a BSSRDF",
            "so it is",
            "mean difference of the two: " + ", ".join(f"{value:.1%}" for value in apart),
            apart[0] < apart[1] < apart[2],
        ),
    ]


def melanin(seen: Sequence[Seen]) -> Rows:
    """Rows of figure 6.10."""
    light = [float(one.albedo[one.face].mean()) for one in seen]
    said = f"reflectance of the shader: {', '.join(f'{value:.3f}' for value in light)}"
    return [
        report.claim(
            "6.10",
            "fast convergence to low reflectance with more melanin",
            "so it is",
            said,
            light[0] - light[1] > light[1] - light[2] > 0.0,
        ),
        report.claim(
            "6.10",
            "moderate and dark practically identical",
            f"practically identical (here: within {IDENTICAL:g})",
            f"{light[1] - light[2]:.3f} apart",
            light[1] - light[2] < IDENTICAL,
        ),
    ]


def water(seen: Sequence[Seen]) -> Rows:
    """Rows of figure 6.11."""
    light = [one.light for one in seen]
    return [
        report.claim(
            "6.11",
            "less water, more reflectance in the IR",
            "so it is",
            "light out of the face: " + _listed(seen, lambda one: one.light, ".3f"),
            light[0] < light[1] < light[2],
        )
    ]


def infrared(seen: Sequence[Seen]) -> Rows:
    """Rows of figure 6.12."""
    before, after = seen
    return [
        report.claim(
            "6.12",
            "irregularities of pigment disappear beyond 1100 nm",
            f"so it is (here: contrast below {UNSEEN:.0%})",
            "contrast of spots: " + _listed(seen, lambda one: one.spots, ".2%"),
            max(before.spots, after.spots) < UNSEEN,
        ),
        report.claim(
            "6.12",
            "darker and glossier where water absorbs (1400 nm)",
            "so it is",
            "light out of the face: "
            + _listed(seen, lambda one: one.light, ".3f")
            + f"; share that has not been inside {before.gloss:.0%}, {after.gloss:.0%}",
            after.light < before.light and after.gloss > before.gloss,
        ),
    ]


def translucency(seen: Sequence[Seen]) -> Rows:
    """Rows of figure 6.19."""
    soft, sharp = seen[:2], seen[2:]
    shade = []
    for one, other in zip(soft, sharp, strict=True):
        red, without = one.scattered[..., 0], other.scattered[..., 0]
        skin = other.albedo[..., 0] > SKIN_RED
        dark = skin & (without < 0.1 * np.percentile(without[skin], 95.0))
        shade.append(float(red[dark].mean() / max(without[dark].mean(), 1e-6)))
    light = [float(one.albedo[one.face].mean()) for one in soft]
    return [
        report.claim(
            "6.19",
            "darker with 7 % melanin than with 1.5 %",
            "so it is",
            f"albedo {light[0]:.3f} and {light[1]:.3f}",
            light[0] > light[1],
        ),
        report.claim(
            "6.19",
            "light from behind makes translucency prominent",
            "so it is",
            "red light in the shade, as a multiple of that without scattering below: "
            + ", ".join(f"{value:.1f}" for value in shade),
            min(shade) > 1.5,
        ),
    ]


def films(seen: Sequence[Seen]) -> Rows:
    """Rows of figure 6.20."""
    screen, wet = [], []
    for one in seen:
        albedo = one.albedo.mean(axis=-1)
        bare, under = one.face & one.bare, one.face & ~one.bare
        screen.append(float(np.median(albedo[under]) / np.median(albedo[bare])))
        drops = bare & (one.position[..., 0] < WET_FROM)
        wet.append(float(np.percentile(albedo[drops], 2.0) / np.percentile(albedo[drops], 98.0)))
    return [
        _dark_film("sunscreen dark in the UV only", screen, 0),
        _dark_film("water dark in the IR only", wet, 2),
    ]


def _dark_film(what: str, kept: Sequence[float], place: int) -> report.Row:
    others = [share for number, share in enumerate(kept) if number != place]
    return report.claim(
        "6.20",
        what,
        "so it is",
        "light out of skin under it, of bare skin's: "
        + ", ".join(f"{share:.2f}" for share in kept)
        + " (365 nm, visible, 1650 nm)",
        kept[place] < 0.7 and min(others) > 0.9,
    )


CLAIMS: dict[str, Callable[[Sequence[Seen]], Rows]] = {
    "6.9": domains,
    "6.10": melanin,
    "6.11": water,
    "6.12": infrared,
    "6.19": translucency,
    "6.20": films,
}
