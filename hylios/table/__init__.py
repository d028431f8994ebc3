"""Look-up table of a skin's appearance over its tanning states: what it holds, and its file.

The table builder writes the file with OpenImageIO; builder and add-on read it with `read_table`,
which needs numpy and the standard library alone. `docs/table_format.md` describes the file.
"""

from hylios.table.axes import STATE_NAMES, StateAxes
from hylios.table.file import read_table
from hylios.table.interpolation import INTERPOLATIONS
from hylios.table.planes import MEANINGS, PLANES
from hylios.table.provenance import described_dynamics, melanin_dynamics
from hylios.table.schema import (
    CHECKSUM_ATTRIBUTE,
    FORMAT,
    FORMAT_VERSION,
    HEADER_ATTRIBUTE,
    StoredTable,
    from_stored,
    to_stored,
)
from hylios.table.table import SkinTable

__all__ = [
    "CHECKSUM_ATTRIBUTE",
    "FORMAT",
    "FORMAT_VERSION",
    "HEADER_ATTRIBUTE",
    "INTERPOLATIONS",
    "MEANINGS",
    "PLANES",
    "STATE_NAMES",
    "SkinTable",
    "StateAxes",
    "StoredTable",
    "described_dynamics",
    "from_stored",
    "melanin_dynamics",
    "read_table",
    "to_stored",
]
