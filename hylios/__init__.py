"""HyLIoS: light and tanning in human skin.

Specimens, spectra of absorbers, light transport, tanning and the colour of a spectrum, after
T. F. Chen, "On the Modelling of Hyperspectral Light and Skin Interactions and the Simulation of
Skin Appearance Changes Due to Tanning" (PhD thesis, University of Waterloo). Docstrings cite its
equations and tables by number.

The names below are all that most work needs. A name is loaded when it is first used, so importing
this package takes no time, and numba, colour-science and scipy come in with the names that need
them. Python's own way of doing so (PEP 562) needs no other package: the Blender add-on carries a
part of this one and nothing else.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hylios.adding import spectrum as solve_spectrum
    from hylios.adding.absorptance import tabulated as ultraviolet_absorptance
    from hylios.adding.redness import erythema
    from hylios.errors import InputError
    from hylios.lab.colour import Colour
    from hylios.lab.fit import fit_colour, fit_spectrum
    from hylios.skin import Skin
    from hylios.skin.phototypes import PHOTOTYPES as SKIN_TYPES
    from hylios.skin.phototypes import named_specimen as specimen
    from hylios.skin.phototypes import skin_type
    from hylios.skin.specimen import Specimen
    from hylios.skin.specimen_file import read_specimen
    from hylios.sun.doses import of_sun as sun_doses
    from hylios.sun.doses import of_uv_index as uv_index_doses
    from hylios.sun.protection import sunscreen
    from hylios.table import SkinTable, read_table
    from hylios.tanning import ErythemaDynamics, Exposures, TanningHistory
    from hylios.tissue import Model
    from hylios.transport.angular import brdf
    from hylios.transport.radial import profile
    from hylios.transport.simulate import spectrum as walk_spectrum

__version__ = "0.1.0"

__all__ = [
    "SKIN_TYPES",
    "Colour",
    "ErythemaDynamics",
    "Exposures",
    "InputError",
    "Model",
    "Skin",
    "SkinTable",
    "Specimen",
    "TanningHistory",
    "brdf",
    "erythema",
    "fit_colour",
    "fit_spectrum",
    "profile",
    "read_specimen",
    "read_table",
    "skin_type",
    "solve_spectrum",
    "specimen",
    "sun_doses",
    "sunscreen",
    "ultraviolet_absorptance",
    "uv_index_doses",
    "walk_spectrum",
]

_HOMES = {
    "SKIN_TYPES": "hylios.skin.phototypes:PHOTOTYPES",
    "Colour": "hylios.lab.colour:Colour",
    "ErythemaDynamics": "hylios.tanning:ErythemaDynamics",
    "Exposures": "hylios.tanning:Exposures",
    "InputError": "hylios.errors:InputError",
    "Model": "hylios.tissue:Model",
    "Skin": "hylios.skin:Skin",
    "SkinTable": "hylios.table:SkinTable",
    "Specimen": "hylios.skin.specimen:Specimen",
    "TanningHistory": "hylios.tanning:TanningHistory",
    "brdf": "hylios.transport.angular:brdf",
    "erythema": "hylios.adding.redness:erythema",
    "fit_colour": "hylios.lab.fit:fit_colour",
    "fit_spectrum": "hylios.lab.fit:fit_spectrum",
    "profile": "hylios.transport.radial:profile",
    "read_specimen": "hylios.skin.specimen_file:read_specimen",
    "read_table": "hylios.table:read_table",
    "skin_type": "hylios.skin.phototypes:skin_type",
    "solve_spectrum": "hylios.adding:spectrum",
    "specimen": "hylios.skin.phototypes:named_specimen",
    "sun_doses": "hylios.sun.doses:of_sun",
    "sunscreen": "hylios.sun.protection:sunscreen",
    "ultraviolet_absorptance": "hylios.adding.absorptance:tabulated",
    "uv_index_doses": "hylios.sun.doses:of_uv_index",
    "walk_spectrum": "hylios.transport.simulate:spectrum",
}
"""Where each name is made, module and name there; the same as the imports above, for a test."""


def __getattr__(name: str) -> Any:
    home = _HOMES.get(name)
    if home is None:
        raise AttributeError(f"hylios has no name {name!r}; dir(hylios) lists its names.")
    module, original = home.split(":")
    try:
        value = getattr(import_module(module), original)
    except ModuleNotFoundError as error:
        raise ImportError(_missing(name, error.name or module), name=error.name) from error
    globals()[name] = value
    return value


def _missing(name: str, module: str) -> str:
    if module.startswith("hylios"):
        return (
            f"hylios.{name} is not in this copy of hylios, which a Blender add-on carries; "
            "the project's own installation has all of it."
        )
    return f"hylios.{name} needs the module {module!r}; install the project with its requirements."


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
