"""Look-up table of a skin's appearance over its tanning states: what it holds, and its file.

The table builder writes the file with OpenImageIO; builder and add-on read it with `read_table`,
which needs numpy and the standard library alone. `docs/table_format.md` describes the file.
"""

from hylios.table.axes import LOOK_AXES, STATE_NAMES, LookAxes, StateAxes
from hylios.table.file import read_table
from hylios.table.interpolation import INTERPOLATIONS
from hylios.table.planes import MEANINGS, PLANES
from hylios.table.provenance import (
    MinimalDoses,
    absorptance,
    described_dynamics,
    melanin_dynamics,
    melanin_kinetics,
    minimal_doses,
    own_spectra,
    skin_of,
)
from hylios.table.schema import FORMAT, FORMAT_VERSION, require_provenance
from hylios.table.skin_table import SkinTable
from hylios.table.stored import (
    CHECKSUM_ATTRIBUTE,
    HEADER_ATTRIBUTE,
    StoredTable,
    from_stored,
    to_stored,
)

__all__ = [
    "CHECKSUM_ATTRIBUTE",
    "FORMAT",
    "FORMAT_VERSION",
    "HEADER_ATTRIBUTE",
    "INTERPOLATIONS",
    "LOOK_AXES",
    "MEANINGS",
    "PLANES",
    "STATE_NAMES",
    "LookAxes",
    "MinimalDoses",
    "SkinTable",
    "StateAxes",
    "StoredTable",
    "absorptance",
    "described_dynamics",
    "from_stored",
    "melanin_dynamics",
    "melanin_kinetics",
    "minimal_doses",
    "own_spectra",
    "read_table",
    "require_provenance",
    "skin_of",
    "to_stored",
]
