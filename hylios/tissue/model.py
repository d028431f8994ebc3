"""What the light model needs besides the specimen: spectra of absorbers, and readings."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from hylios.errors import InputError
from hylios.spectra import Spectra, Spectrum, published_spectra
from hylios.tissue.readings import complete_readings


@dataclass(frozen=True)
class Model:
    """Spectra of what absorbs in skin, and readings of the thesis's text.

    `Model()` is the project's own. What is given takes the place of the published spectrum or the
    default reading of that name; the rest stays. Equal and hashable by the spectra's identity and
    the readings' names, so that results can be kept by model.

    Attributes
    ----------
    spectra : mapping of str to Spectrum
        All of `hylios.spectra.published_spectra` by name, with those given in their places.
    readings : mapping of str to str
        All of `READINGS` by name, with those given in their places.

    Raises
    ------
    InputError
        If there is no spectrum, no reading or no choice of that name.

    Examples
    --------
    Another reading of the thesis where its text is open (`hylios.tissue.READINGS`):

    >>> import hylios
    >>> model = hylios.Model(readings={"rayleigh": "every_collision"})
    >>> spectrum = hylios.solve_spectrum(hylios.specimen("S3"), [450], model=model)
    """

    spectra: Spectra = field(default_factory=dict)
    readings: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self):
        published = published_spectra()
        for name in self.spectra:
            if name not in published:
                raise InputError(
                    f"there is no spectrum {name!r}; there are {', '.join(published)}."
                )
        spectra = MappingProxyType({**published, **self.spectra})
        object.__setattr__(self, "spectra", spectra)
        object.__setattr__(self, "readings", complete_readings(self.readings))

    @property
    def own_spectra(self) -> dict[str, Spectrum]:
        """Spectra that are not the published ones."""
        published = published_spectra()
        return {
            name: spectrum
            for name, spectrum in self.spectra.items()
            if spectrum is not published[name]
        }

    def __hash__(self) -> int:
        return hash((frozenset(self.spectra.items()), frozenset(self.readings.items())))

    def __reduce__(self):
        # Views of dictionaries do not travel to other processes.
        return Model, (self.own_spectra, dict(self.readings))
