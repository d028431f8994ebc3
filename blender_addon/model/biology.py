"""Tables of skins with another biology, and how to build them outside Blender."""

import functools
import shlex
from pathlib import Path

from hylios.changed_table import changed_table
from hylios.errors import InputError
from hylios.skin import Skin
from hylios.skin.biology import Biology
from hylios.skin.phototypes import PHOTOTYPES, phototype
from hylios.skin.specimen import SPECIMENS
from hylios.table import MinimalDoses, SkinTable, skin_of

from . import catalogue
from .settings import TanSettings


def table_with(
    path: Path,
    biology: Biology,
    *,
    kinetics: str = "thesis",
    rough: bool = False,
    bands: bool = False,
) -> SkinTable:
    """The table in a file with another biology; as it is where nothing changes.

    Parameters
    ----------
    kinetics, rough, bands
        As in `hylios.changed_table.changed_table`.

    Raises
    ------
    InputError
        If the file is not a table, or cannot be changed.
    """
    if biology == Biology():
        return catalogue.table(path)
    return _changed(path, catalogue.stamp(path), biology, kinetics, rough, bands)


@functools.lru_cache(maxsize=4)
def _changed(
    path: Path, stamp: tuple[int, int], biology: Biology, kinetics: str, rough: bool, bands: bool
) -> SkinTable:
    table = catalogue.table(path)
    return changed_table(table, biology, kinetics=kinetics, rough=rough, bands=bands)


def build_command(settings: TanSettings, output: str = "skin.exr") -> str:
    """What to type into a shell for a table with an object's biology and sensitivity.

    Raises
    ------
    InputError
        If the table cannot be used, does not describe its skin, or that tans by rates of its own.
    """
    provenance = catalogue.provenance(settings.table)
    skin, doses = skin_of(provenance), settings.minimal_doses(provenance)
    specimen = settings.biology.of(skin.specimen)
    words = ["lut-builder", "build"]
    if skin.specimen.name in PHOTOTYPES:
        usual = phototype(skin.specimen.name).skin
        words += ["--skin", skin.specimen.name]
    else:
        base = SPECIMENS.get(skin.specimen.name, SPECIMENS["S3"])
        usual = Skin.of(base, skin.pigmentation)
        words += ["--specimen", base.name, "--pigmentation", skin.pigmentation]
    if skin.dynamics != usual.dynamics:
        raise InputError(
            f"the skin {skin.specimen.name!r} tans by rates of its own; build its table by the "
            "command that built it, with --set for what differs."
        )
    for name, value in vars(specimen).items():
        if name != "name" and value != getattr(usual.specimen, name):
            shown = value if isinstance(value, str) else f"{value:.6g}"
            words += ["--set", f"{name}={shown}"]
    if specimen != usual.specimen or doses != MinimalDoses(usual.mmd, usual.med):
        words += ["--mmd", f"{doses.mmd:.6g}", "--med", f"{doses.med:.6g}"]
    if skin.untanned != usual.untanned:
        words += ["--untanned", skin.untanned]
    return shlex.join([*words, "-o", output])
