"""What the renders after figures 6.9 to 6.12, 6.19 and 6.20 show. Needs no Blender."""

from dataclasses import dataclass

from examples.figures.spectral_looks import VISIBLE, with_melanin
from hylios.skin.specimen import Specimen

UV, IR, WATER_IR = 365.0, 1100.0, 1650.0
"""Wavelengths of the pictures in nm, as the captions have them."""

WET_FROM = 0.02
"""Drops of water lie where x is less, in metres."""

LIGHT, MODERATE, DARK = 0.015, 0.07, 0.30
"""Melanin in the epidermis."""


@dataclass(frozen=True)
class SpectralShot:
    """One picture.

    Attributes
    ----------
    name : str
    stage : str
        A key of `examples.figures.stages.spectral_stages`.
    nm : float
        Wavelength, or `VISIBLE`.
    melanin, water : float
        Of the skin: share of the epidermis, and a multiple of the usual.
    scattering : bool
        Whether light moves below the surface (BSSRDF), or leaves where it comes in (BRDF).
    spots : bool
        Whether the skin has freckles and moles.
    films : bool
        Whether sunscreen and water lie on it.
    brightness : float
        By which the picture is shown brighter.
    """

    name: str
    stage: str
    nm: float
    melanin: float = LIGHT
    water: float = 1.0
    scattering: bool = True
    spots: bool = False
    films: bool = False
    brightness: float = 1.0

    @property
    def skin(self) -> Specimen:
        """The specimen."""
        return with_melanin(self.melanin, self.water)


def said_of(nm: float) -> str:
    """A wavelength for people to read."""
    return "visible" if nm == VISIBLE else f"{nm:.0f} nm"


def shots() -> list[SpectralShot]:
    """All pictures; a name begins with the figure's."""
    domains = (UV, VISIBLE, IR)
    return [
        *(
            SpectralShot(
                f"6.9 {said_of(nm)}, {'BSSRDF' if scattering else 'BRDF'}",
                "face",
                nm,
                scattering=scattering,
                spots=True,
                brightness=0.6 if nm == IR else 0.85,
            )
            for scattering in (True, False)
            for nm in domains
        ),
        *(
            SpectralShot(f"6.10 {melanin:.1%} melanin", "face", UV, melanin=melanin)
            for melanin in (LIGHT, MODERATE, DARK)
        ),
        *(
            SpectralShot(f"6.11 {1.0 - water:.0%} less water", "face", WATER_IR, water=water)
            for water in (1.0, 0.8, 0.6)
        ),
        *(
            SpectralShot(
                f"6.12 {said_of(nm)}",
                "face",
                nm,
                spots=True,
                brightness=0.8 if nm < 1300.0 else 2.0,
            )
            for nm in (1200.0, 1400.0)
        ),
        *(
            SpectralShot(
                f"6.19 {melanin:.1%} melanin{'' if scattering else ', BRDF'}",
                "lit from behind",
                VISIBLE,
                melanin=melanin,
                scattering=scattering,
                brightness=1.6,
            )
            for scattering in (True, False)
            for melanin in (LIGHT, MODERATE)
        ),
        *(
            SpectralShot(f"6.20 {said_of(nm)}", "beach", nm, films=True)
            for nm in (UV, VISIBLE, WATER_IR)
        ),
    ]


def of_figures(figures: tuple[str, ...]) -> list[SpectralShot]:
    """The pictures of some figures."""
    return [shot for shot in shots() if shot.name.split()[0] in figures]
